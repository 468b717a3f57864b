#include "actors/results/pictures/gas_volumes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>

#include "actors/results/run/parallel_for.hpp"
#include "scenes/light/transport/packed_scene.hpp"

namespace luxodus {

namespace limits {
/// Triangles in a voxel: more are not worth their cost.
inline constexpr size_t triangles_in_voxel = 512;
/// Pairs of a voxel and a triangle; with more, no voxel that touches a surface is known.
inline constexpr size_t voxel_triangles = 2'000'000;
/// Smallest share of a voxel's volume that is known well enough.
inline constexpr float min_gas = 1.0f / 16;
/// Share of the light that reaches a voxel's parts: a part with less is the inside of a solid that
/// a particle has entered by rounding.
inline constexpr float dark_share = 1e-3f;
}  // namespace limits

namespace {

/// Sample points of a voxel: a lattice of posts. The outer ones lie just inside the voxel's faces,
/// on the near side of a wall that coincides with one.
constexpr int posts = 5;
constexpr int all_posts = posts * posts * posts;
constexpr double inset = 1e-3;  // share of an edge
constexpr std::array<double, posts> post_at = {inset, 0.25, 0.5, 0.75, 1 - inset};
constexpr int post_of(const glm::ivec3& p) {
  return (p.z * posts + p.y) * posts + p.x;
}
glm::dvec3 place_of(const glm::ivec3& p) {
  return {post_at[static_cast<size_t>(p.x)], post_at[static_cast<size_t>(p.y)],
          post_at[static_cast<size_t>(p.z)]};
}
template <class Visit>
void for_each_post(Visit&& visit) {
  for (int z = 0; z < posts; ++z)
    for (int y = 0; y < posts; ++y)
      for (int x = 0; x < posts; ++x) visit(glm::ivec3(x, y, z));
}

/// Points by which a voxel's volume is estimated.
constexpr int volume_points = 256;
/// Share of an edge: points this close to a voxel's face may be on either side, by rounding.
constexpr float rounding = 1e-3f;
/// Share by which triangles are enlarged, so that no line passes through a seam.
constexpr double seam = 1e-6;
constexpr uint8_t no_part = 255;

/// In edges of the grid, from its corner.
struct Triangle {
  glm::dvec3 corner, side_a, side_b;
  double light[2];  // light on its front and its back [lm/m2]
};

/// Where a line meets a triangle, as a share of its length; beyond 1: nowhere.
constexpr double nowhere = 2;
double crossing(const Triangle& t, const glm::dvec3& from, const glm::dvec3& way) {
  const glm::dvec3 p = glm::cross(way, t.side_b);
  const double determinant = glm::dot(t.side_a, p);
  if (std::abs(determinant) < 1e-14) return nowhere;
  const glm::dvec3 s = from - t.corner;
  const double u = glm::dot(s, p) / determinant;
  if (u < -seam || u > 1 + seam) return nowhere;
  const glm::dvec3 q = glm::cross(s, t.side_a);
  const double v = glm::dot(way, q) / determinant;
  if (v < -seam || u + v > 1 + seam) return nowhere;
  const double along = glm::dot(t.side_b, q) / determinant;
  return along >= 0 && along <= 1 ? along : nowhere;
}

/// A union-find structure over numbers.
class JoinedSets {
 public:
  explicit JoinedSets(size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  uint32_t root(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(uint32_t a, uint32_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<uint32_t> parent_;
};

/// A voxel that touches surfaces, and the parts that they divide it into.
struct CutVoxel {
  uint32_t voxel = 0;
  uint32_t first = 0, count = 0;  // range among the pairs
  uint8_t parts = 0;              // 0: too many triangles to decide
  std::array<uint8_t, all_posts> part;
  std::vector<float> light;  // of each part, if there are several: the largest light on a side that
                             // borders it [lm/m2]
};

class GasVolumes {
 public:
  GasVolumes(const CompiledScene& scene, const LitPlaces& lit, int threads)
      : scene_(scene),
        lit_(lit),
        grid_(scene.voxels),
        threads_(threads),
        cells_(grid_.nx, grid_.ny, grid_.nz),
        cut_at_(grid_.count(), none_index) {}

  Result<LitGas> find() {
    gas_.share.assign(grid_.count(), 1.0f);
    gas_.open.assign(grid_.count(), 0);
    if (auto read = collect(); !read) return read.problem();
    if (pairs_.size() > limits::voxel_triangles) return std::move(gas_);
    list_cut_voxels();
    for_each_cut([&](CutVoxel& c) { part(c); });
    const std::vector<char> lit_sets = follow_light();
    for_each_cut([&](CutVoxel& c) { gas_.share[c.voxel] = share_of(c, lit_sets); });
    return std::move(gas_);
  }

 private:
  struct Pair {
    uint32_t voxel, triangle;
    bool operator<(const Pair& other) const {
      return voxel != other.voxel ? voxel < other.voxel : triangle < other.triangle;
    }
  };

  uint32_t voxel_at(const glm::ivec3& cell) const {
    return static_cast<uint32_t>((cell.z * grid_.ny + cell.y) * grid_.nx + cell.x);
  }
  glm::ivec3 cell_of(uint32_t voxel) const {
    const auto v = static_cast<int>(voxel);
    return {v % grid_.nx, v / grid_.nx % grid_.ny, v / grid_.nx / grid_.ny};
  }

  template <class Work>
  void for_each_cut(const Work& work) {
    constexpr size_t per_row = 64;
    const auto row = [&](int64_t i) {
      const size_t first = static_cast<size_t>(i) * per_row;
      for (size_t c = first; c < std::min(cut_.size(), first + per_row); ++c) work(cut_[c]);
    };
    parallel_for(static_cast<int64_t>((cut_.size() + per_row - 1) / per_row), threads_,
                 [&] { return row; });
  }

  // ---- triangles --------------------------------------------------------------------------------

  Result<void> collect() {
    auto read = for_each_cell(scene_, [&](const GeometryCell& cell) {
      for (const TriangleRecord& t : cell.triangles) collect(t);
    });
    if (read) std::sort(pairs_.begin(), pairs_.end());
    return read;
  }

  MaterialKind material_of(const TriangleRecord& t, size_t side) const {
    return scene_.materials[scene_.surfaces[t.surface].material[side]].kind;
  }

  void collect(const TriangleRecord& t) {
    const MaterialKind front = material_of(t, 0), back = material_of(t, 1);
    if (front == MaterialKind::open && back == MaterialKind::open) return;
    const glm::vec3 low = glm::min(t.corner[0], glm::min(t.corner[1], t.corner[2]));
    const glm::vec3 high = glm::max(t.corner[0], glm::max(t.corner[1], t.corner[2]));
    const glm::vec3 n = t.normal;
    const float reach =
        (0.5f + rounding) * grid_.edge * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    const glm::ivec3 from = first_cell((low - grid_.low) / grid_.edge - rounding);
    const glm::ivec3 to = last_cell((high - grid_.low) / grid_.edge + rounding);
    const auto number = static_cast<uint32_t>(triangles_.size());
    const size_t before = pairs_.size();
    for (int z = from.z; z <= to.z; ++z) {
      for (int y = from.y; y <= to.y; ++y) {
        for (int x = from.x; x <= to.x; ++x) {
          const glm::vec3 centre = grid_.low + (glm::vec3(x, y, z) + 0.5f) * grid_.edge;
          if (std::abs(glm::dot(centre - t.corner[0], n)) > reach) continue;
          gas_.share[voxel_at({x, y, z})] = 0;
          if (pairs_.size() <= limits::voxel_triangles)
            pairs_.push_back({voxel_at({x, y, z}), number});
        }
      }
    }
    if (pairs_.size() == before) return;
    const auto in_edges = [&](const glm::vec3& p) {
      return (glm::dvec3(p) - glm::dvec3(grid_.low)) / static_cast<double>(grid_.edge);
    };
    const glm::dvec3 corner = in_edges(t.corner[0]);
    Triangle own{corner,
                 in_edges(t.corner[1]) - corner,
                 in_edges(t.corner[2]) - corner,
                 {lit_.side_lm_m2(t, true), lit_.side_lm_m2(t, false)}};
    // The normal defines the front, whatever the order of the corners.
    if (glm::dot(glm::cross(own.side_a, own.side_b), glm::dvec3(n)) < 0)
      std::swap(own.light[0], own.light[1]);
    triangles_.push_back(own);
  }

  glm::ivec3 first_cell(const glm::vec3& at) const {
    return glm::max(glm::ivec3(0), glm::ivec3(glm::floor(glm::min(at, glm::vec3(cells_)))));
  }
  glm::ivec3 last_cell(const glm::vec3& at) const {
    return glm::min(cells_ - 1, glm::ivec3(glm::floor(glm::max(at, glm::vec3(-1)))));
  }

  void list_cut_voxels() {
    for (uint32_t i = 0; i < pairs_.size(); ++i) {
      if (cut_.empty() || cut_.back().voxel != pairs_[i].voxel) {
        cut_at_[pairs_[i].voxel] = static_cast<uint32_t>(cut_.size());
        cut_.push_back({});
        cut_.back().voxel = pairs_[i].voxel;
        cut_.back().first = i;
      }
      ++cut_.back().count;
    }
  }

  /// Whether no triangle of a voxel is between two places, in edges of the grid.
  bool clear(const CutVoxel& c, const glm::dvec3& from, const glm::dvec3& to) const {
    for (uint32_t i = c.first; i < c.first + c.count; ++i)
      if (crossing(triangles_[pairs_[i].triangle], from, to - from) <= 1) return false;
    return true;
  }

  /// The light on the first side between two places [lm/m2].
  float light_ahead(const CutVoxel& c, const glm::dvec3& from, const glm::dvec3& to) const {
    double nearest = nowhere, light = 0;
    for (uint32_t i = c.first; i < c.first + c.count; ++i) {
      const Triangle& t = triangles_[pairs_[i].triangle];
      const double at = crossing(t, from, to - from);
      if (!(at < nearest)) continue;
      nearest = at;
      const bool front = glm::dot(glm::cross(t.side_a, t.side_b), to - from) < 0;
      light = t.light[front ? 0 : 1];
    }
    return static_cast<float>(light);
  }

  // ---- parts
  // ------------------------------------------------------------------------------------

  void part(CutVoxel& c) const {
    c.part.fill(no_part);
    if (c.count > limits::triangles_in_voxel) return;
    const glm::dvec3 low(cell_of(c.voxel));
    std::vector<glm::ivec3> open;
    for_each_post([&](const glm::ivec3& seed) {
      if (c.part[static_cast<size_t>(post_of(seed))] != no_part) return;
      c.part[static_cast<size_t>(post_of(seed))] = c.parts;
      open.push_back(seed);
      while (!open.empty()) {
        const glm::ivec3 at = open.back();
        open.pop_back();
        for (int axis = 0; axis < 3; ++axis) {
          for (const int step : {-1, 1}) {
            glm::ivec3 next = at;
            next[axis] += step;
            if (next[axis] < 0 || next[axis] >= posts) continue;
            uint8_t& label = c.part[static_cast<size_t>(post_of(next))];
            if (label != no_part || !clear(c, low + place_of(at), low + place_of(next))) continue;
            label = c.parts;
            open.push_back(next);
          }
        }
      }
      ++c.parts;
    });
    if (c.parts > 1) find_lit_borders(c);
  }

  void find_lit_borders(CutVoxel& c) const {
    c.light.assign(c.parts, 0);
    const glm::dvec3 low(cell_of(c.voxel));
    for_each_post([&](const glm::ivec3& at) {
      for (int axis = 0; axis < 3; ++axis) {
        glm::ivec3 next = at;
        if (++next[axis] == posts) continue;
        const uint8_t here = c.part[static_cast<size_t>(post_of(at))];
        const uint8_t there = c.part[static_cast<size_t>(post_of(next))];
        if (here == there) continue;
        const glm::dvec3 from = low + place_of(at), to = low + place_of(next);
        c.light[here] = std::max(c.light[here], light_ahead(c, from, to));
        c.light[there] = std::max(c.light[there], light_ahead(c, to, from));
      }
    });
  }

  // ---- where light has been
  // ---------------------------------------------------------------------

  /// For each part of each voxel, by number: whether light has been in the gas connected to it.
  std::vector<char> follow_light() {
    first_set_.resize(grid_.count() + size_t{1});
    for (uint32_t v = 0; v < grid_.count(); ++v) {
      const uint32_t parts = cut_at_[v] == none_index ? 1 : cut_[cut_at_[v]].parts;
      first_set_[v + 1] = first_set_[v] + parts;
    }
    sets_.emplace(first_set_.back());
    join_whole_voxels();
    join_cut_voxels();
    std::vector<char> lit_root(first_set_.back(), 0);
    for (uint32_t v = 0; v < grid_.count(); ++v)
      if (cut_at_[v] == none_index && lit_.voxel(v)) lit_root[sets_->root(first_set_[v])] = 1;
    std::vector<char> out(first_set_.back());
    for (uint32_t set = 0; set < out.size(); ++set) out[set] = lit_root[sets_->root(set)];
    for (const CutVoxel& c : cut_) {
      if (c.light.empty()) continue;
      const float most = *std::max_element(c.light.begin(), c.light.end());
      for (uint8_t p = 0; p < c.parts; ++p)
        if (c.light[p] > limits::dark_share * most) out[first_set_[c.voxel] + p] = 1;
    }
    return out;
  }

  void join_whole_voxels() {
    for (uint32_t v = 0; v < grid_.count(); ++v) {
      if (cut_at_[v] != none_index) continue;
      const glm::ivec3 cell = cell_of(v);
      for (int axis = 0; axis < 3; ++axis) {
        glm::ivec3 next = cell;
        if (++next[axis] >= cells_[axis] || cut_at_[voxel_at(next)] != none_index) continue;
        sets_->join(first_set_[v], first_set_[voxel_at(next)]);
        gas_.open[v] |= static_cast<uint8_t>(1 << axis);
      }
    }
  }

  void join_cut_voxels() {
    std::mutex mutex;
    for_each_cut([&](const CutVoxel& c) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const int step : {-1, 1}) {
          const Joins joins = find_joins(c, axis, step);
          const std::lock_guard lock(mutex);
          for (const auto& [a, b] : joins) sets_->join(a, b);
          if (joins.size() <= posts * posts / 2) continue;
          glm::ivec3 lower = cell_of(c.voxel);
          lower[axis] += std::min(step, 0);
          gas_.open[voxel_at(lower)] |= static_cast<uint8_t>(1 << axis);
        }
      }
    });
  }

  /// Pairs of parts, by number, with posts on both sides of a face and nothing between them.
  using Joins = std::vector<std::pair<uint32_t, uint32_t>>;

  /// Joins to the voxel's neighbour along an axis. If both are cut, only the lower one is asked.
  Joins find_joins(const CutVoxel& c, int axis, int step) const {
    Joins joins;
    if (c.parts == 0) return joins;
    glm::ivec3 cell = cell_of(c.voxel);
    const glm::dvec3 low(cell);
    cell[axis] += step;
    if (cell[axis] < 0 || cell[axis] >= cells_[axis]) return joins;
    const uint32_t next = voxel_at(cell);
    const CutVoxel* other = cut_at_[next] == none_index ? nullptr : &cut_[cut_at_[next]];
    if (other != nullptr && (step < 0 || other->parts == 0)) return joins;
    for (int i = 0; i < posts * posts; ++i) {
      glm::ivec3 here;
      here[axis] = step > 0 ? posts - 1 : 0;
      here[(axis + 1) % 3] = i % posts;
      here[(axis + 2) % 3] = i / posts;
      glm::ivec3 there = here;
      there[axis] = posts - 1 - here[axis];
      const glm::dvec3 from = low + place_of(here), to = glm::dvec3(cell) + place_of(there);
      if (!clear(c, from, to) || (other != nullptr && !clear(*other, from, to))) continue;
      const uint32_t beyond =
          other != nullptr ? other->part[static_cast<size_t>(post_of(there))] : 0;
      joins.emplace_back(first_set_[c.voxel] + c.part[static_cast<size_t>(post_of(here))],
                         first_set_[next] + beyond);
    }
    return joins;
  }

  // ---- volumes
  // ----------------------------------------------------------------------------------

  float share_of(const CutVoxel& c, const std::vector<char>& lit_sets) {
    int lit_part = -1;
    for (uint8_t p = 0; p < c.parts; ++p) {
      if (lit_sets[first_set_[c.voxel] + p] == 0) continue;
      if (lit_part >= 0) return 0;
      lit_part = p;
    }
    if (lit_part < 0) return 0;
    int inside = 0;
    // An additive recurrence by powers of one over the plastic number of three dimensions.
    const glm::dvec3 step(0.8191725133961645, 0.6710436067037893, 0.5497004779019703);
    for (int i = 0; i < volume_points; ++i)
      if (part_at(c, glm::fract(0.5 + static_cast<double>(i) * step)) == lit_part) ++inside;
    const float share = static_cast<float>(inside) / volume_points;
    return share >= limits::min_gas ? share : 0;
  }

  /// The part that a place of the voxel belongs to: that of a visible post around it; -1: none.
  int part_at(const CutVoxel& c, const glm::dvec3& place) const {
    const glm::dvec3 low(cell_of(c.voxel));
    const glm::dvec3 scaled = place * static_cast<double>(posts - 1);
    const glm::ivec3 from = glm::min(glm::ivec3(scaled), glm::ivec3(posts - 2));
    const glm::ivec3 nearest(glm::greaterThan(glm::fract(scaled), glm::dvec3(0.5)));
    for (const int flipped : {0, 1, 2, 4, 3, 5, 6, 7}) {
      const glm::ivec3 flip(flipped & 1, flipped >> 1 & 1, flipped >> 2);
      const glm::ivec3 post = from + (nearest ^ flip);
      if (clear(c, low + place, low + place_of(post)))
        return c.part[static_cast<size_t>(post_of(post))];
    }
    return -1;
  }

  const CompiledScene& scene_;
  const LitPlaces& lit_;
  const VoxelGrid& grid_;
  int threads_;
  glm::ivec3 cells_;
  std::vector<Triangle> triangles_;
  std::vector<Pair> pairs_;
  std::vector<CutVoxel> cut_;
  std::vector<uint32_t> cut_at_;     // by voxel; none_index: no surface touches it
  std::vector<uint32_t> first_set_;  // by voxel
  std::optional<JoinedSets> sets_;
  LitGas gas_;
};

}  // namespace

Result<LitGas> find_lit_gas(const CompiledScene& scene, const LitPlaces& lit, int threads) {
  if (!(scene.voxels.edge > 0)) return LitGas();
  return GasVolumes(scene, lit, threads).find();
}

}  // namespace luxodus
