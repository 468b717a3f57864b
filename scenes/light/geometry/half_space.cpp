#include "scenes/light/geometry/half_space.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "scenes/light/geometry/mesh_tools.hpp"
#include "scenes/light/geometry/polygon.hpp"

namespace luxodus {

namespace {

using Ring = std::vector<glm::dvec2>;

bool in_triangle(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c,
                 const glm::dvec2& p) {
  return twice_signed_area(a, b, p) >= 0 && twice_signed_area(b, c, p) >= 0 &&
         twice_signed_area(c, a, p) >= 0;
}

/// Joins a hole to the boundary around it by two edges at one place (Eberly, Triangulation by Ear
/// Clipping, 2002).
bool join_hole(std::vector<uint32_t>& ring, std::vector<uint32_t> hole,
               const std::vector<glm::dvec2>& p) {
  const auto rightmost = std::max_element(hole.begin(), hole.end(),
                                          [&](uint32_t a, uint32_t b) { return p[a].x < p[b].x; });
  std::rotate(hole.begin(), rightmost, hole.end());
  const glm::dvec2 m = p[hole.front()];
  double nearest = 1e300;
  std::optional<size_t> bridge;
  for (size_t i = 0; i < ring.size(); ++i) {
    const size_t next = (i + 1) % ring.size();
    const glm::dvec2 a = p[ring[i]], b = p[ring[next]];
    if ((a.y > m.y) == (b.y > m.y) && a.y != m.y && b.y != m.y) continue;
    if (std::min(a.y, b.y) > m.y || std::max(a.y, b.y) < m.y || a.y == b.y) continue;
    const double x = a.x + (m.y - a.y) * (b.x - a.x) / (b.y - a.y);
    if (x < m.x || x >= nearest || a.y > b.y) continue;  // its inner side faces the hole
    nearest = x;
    bridge = a.x > b.x ? i : next;
  }
  if (!bridge) return false;
  const glm::dvec2 hit(nearest, m.y);
  const glm::dvec2 far = p[ring[*bridge]];
  // A corner within the triangle hides the bridge's: the one nearest in direction does not.
  double best = std::abs(far.y - m.y) / std::max(far.x - m.x, 1e-300);
  for (size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec2 q = p[ring[i]];
    if (q == far || q.x < m.x) continue;
    const bool inside = far.y < m.y ? in_triangle(m, far, hit, q) : in_triangle(m, hit, far, q);
    const double slope = std::abs(q.y - m.y) / std::max(q.x - m.x, 1e-300);
    const glm::dvec2 before = p[ring[(i + ring.size() - 1) % ring.size()]],
                     after = p[ring[(i + 1) % ring.size()]];
    if (!inside || slope >= best || twice_signed_area(before, q, after) > 0) continue;
    best = slope;
    bridge = i;
  }
  const uint32_t at = ring[*bridge];
  std::vector<uint32_t> joined(hole);
  joined.push_back(hole.front());
  joined.push_back(at);
  ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(*bridge) + 1, joined.begin(),
              joined.end());
  return true;
}

/// Cuts ears off a ring that may touch itself. Of the ears the one that is least flat is taken, so
/// that points on straight edges do not remain as a line. Where they do, by rounding, a flat
/// triangle takes each off: it has no area, and keeps the mesh closed.
std::optional<std::vector<glm::uvec3>> cut_ears(std::vector<uint32_t> ring,
                                                const std::vector<glm::dvec2>& p) {
  // Share of a triangle's squared size below which a corner is on a straight line.
  constexpr double flat_corner = 1e-10;
  std::vector<glm::uvec3> out;
  while (ring.size() > 3) {
    const size_t n = ring.size();
    double best = 0, flattest = flat_corner;
    std::optional<size_t> ear, flat;
    for (size_t i = 0; i < n; ++i) {
      const uint32_t a = ring[(i + n - 1) % n], b = ring[i], c = ring[(i + 1) % n];
      const double area = twice_signed_area(p[a], p[b], p[c]);
      const double size = glm::dot(p[b] - p[a], p[b] - p[a]) + glm::dot(p[c] - p[b], p[c] - p[b]) +
                          glm::dot(p[a] - p[c], p[a] - p[c]);
      const double quality = size > 0 ? area / size : 0;
      if (std::abs(quality) < flattest) flattest = std::abs(quality), flat = i;
      if (!(quality > std::max(best, flat_corner))) continue;
      const bool blocked = std::any_of(ring.begin(), ring.end(), [&](uint32_t q) {
        return p[q] != p[a] && p[q] != p[b] && p[q] != p[c] && in_triangle(p[a], p[b], p[c], p[q]);
      });
      if (blocked) continue;
      best = quality;
      ear = i;
      if (n > 300 && best > 0.05) break;  // good enough among many
    }
    if (!ear) ear = flat;
    if (!ear) return std::nullopt;
    const size_t i = *ear;
    out.push_back({ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
  }
  out.push_back({ring[0], ring[1], ring[2]});
  return out;
}

/// One cut of a mesh.
class Cut {
 public:
  Cut(const Mesh& mesh, const HalfSpace& keep, double on_plane) : mesh_(mesh), keep_(keep) {
    for (const glm::dvec3& p : mesh.positions) {
      const double above = glm::dot(keep.normal, p) - keep.offset;
      above_.push_back(std::abs(above) <= on_plane ? 0 : above);
    }
    out_.positions = mesh.positions;
    on_plane_.assign(mesh.positions.size(), 0);
    for (size_t i = 0; i < above_.size(); ++i) on_plane_[i] = above_[i] == 0;
  }

  std::optional<Mesh> make() {
    if (std::none_of(above_.begin(), above_.end(), [](double a) { return a > 0; })) return mesh_;
    if (std::none_of(above_.begin(), above_.end(), [](double a) { return a < 0; })) return Mesh{};
    for (const glm::uvec3& t : mesh_.triangles) keep_below(t);
    const auto edges = open_boundary();
    if (!edges || !close(*edges)) return std::nullopt;
    Mesh whole;
    std::vector<uint32_t> number(out_.positions.size(), UINT32_MAX);
    for (glm::uvec3 t : out_.triangles) {
      for (glm::length_t i = 0; i < 3; ++i) {
        uint32_t& to = number[t[i]];
        if (to == UINT32_MAX) {
          to = static_cast<uint32_t>(whole.positions.size());
          whole.positions.push_back(out_.positions[t[i]]);
        }
        t[i] = to;
      }
      whole.triangles.push_back(t);
    }
    return whole;
  }

 private:
  uint32_t crossing(uint32_t a, uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto [at, fresh] = crossings_.try_emplace({a, b}, 0);
    if (fresh) {
      at->second = static_cast<uint32_t>(out_.positions.size());
      const double share = above_[a] / (above_[a] - above_[b]);
      out_.positions.push_back(mesh_.positions[a] +
                               share * (mesh_.positions[b] - mesh_.positions[a]));
      on_plane_.push_back(1);
    }
    return at->second;
  }

  /// Triangles in the plane are left out: the cut face takes their place.
  void keep_below(const glm::uvec3& t) {
    std::vector<uint32_t> kept;
    bool any_below = false;
    for (glm::length_t i = 0; i < 3; ++i) {
      const uint32_t a = t[i], b = t[(i + 1) % 3];
      if (above_[a] <= 0) kept.push_back(a);
      any_below = any_below || above_[a] < 0;
      if ((above_[a] < 0 && above_[b] > 0) || (above_[a] > 0 && above_[b] < 0))
        kept.push_back(crossing(a, b));
    }
    if (!any_below) return;
    for (size_t i = 2; i < kept.size(); ++i)
      out_.triangles.push_back({kept[0], kept[i - 1], kept[i]});
  }

  /// Directed edges of the cut face; nothing if another edge is open.
  std::optional<std::multimap<uint32_t, uint32_t>> open_boundary() {
    std::map<std::pair<uint32_t, uint32_t>, int> count;
    for (const glm::uvec3& t : out_.triangles)
      for (glm::length_t i = 0; i < 3; ++i) {
        const uint32_t a = t[i], b = t[(i + 1) % 3];
        if (a == b) continue;
        if (a < b)
          ++count[{a, b}];
        else
          --count[{b, a}];
      }
    std::multimap<uint32_t, uint32_t> out;
    for (const auto& [edge, n] : count) {
      if (n == 0) continue;
      if (on_plane_[edge.first] == 0 || on_plane_[edge.second] == 0 || std::abs(n) > 1)
        return std::nullopt;
      // The face that closes it runs the other way.
      if (n > 0)
        out.emplace(edge.second, edge.first);
      else
        out.emplace(edge.first, edge.second);
    }
    return out;
  }

  glm::dvec2 flat(uint32_t i) const {
    return {glm::dot(u_, out_.positions[i]), glm::dot(v_, out_.positions[i])};
  }

  /// Loops of the boundary; where several meet in a point, each turns as far right as it can, so
  /// that none crosses another.
  std::optional<std::vector<std::vector<uint32_t>>> loops(
      std::multimap<uint32_t, uint32_t> edges) const {
    std::vector<std::vector<uint32_t>> out;
    while (!edges.empty()) {
      std::vector<uint32_t> loop{edges.begin()->first};
      uint32_t before = loop.front(), at = edges.begin()->second;
      edges.erase(edges.begin());
      while (at != loop.front()) {
        const auto [first, last] = edges.equal_range(at);
        if (first == last) return std::nullopt;
        auto next = first;
        double sharpest = 1e300;
        for (auto way = first; way != last; ++way) {
          const glm::dvec2 in = flat(at) - flat(before), on = flat(way->second) - flat(at);
          const double turn = std::atan2(in.x * on.y - in.y * on.x, in.x * on.x + in.y * on.y);
          if (turn < sharpest) sharpest = turn, next = way;
        }
        loop.push_back(at);
        before = at;
        at = next->second;
        edges.erase(next);
      }
      out.push_back(std::move(loop));
    }
    return out;
  }

  bool close(const std::multimap<uint32_t, uint32_t>& edges) {
    const glm::dvec3 n = keep_.normal;
    u_ = glm::normalize(
        glm::cross(std::abs(n.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0), n));
    v_ = glm::cross(n, u_);
    const auto found = loops(edges);
    if (!found) return false;
    std::vector<std::pair<Ring, std::vector<uint32_t>>> outer, holes;
    for (const auto& loop : *found) {
      Ring ring;
      for (const uint32_t i : loop) ring.push_back(flat(i));
      (signed_area(ring) > 0 ? outer : holes).emplace_back(std::move(ring), loop);
    }
    for (const auto& [ring, points] : outer) {
      std::vector<Ring> rings{ring};
      std::vector<uint32_t> number = points;
      for (const auto& [hole, hole_points] : holes) {
        if (innermost(outer, hole) != &ring) continue;
        rings.push_back(hole);
        number.insert(number.end(), hole_points.begin(), hole_points.end());
      }
      const auto triangles = fill(rings);
      if (!triangles) return false;
      for (const glm::uvec3& t : *triangles)
        out_.triangles.push_back({number[t.x], number[t.y], number[t.z]});
    }
    return true;
  }

  static const Ring* innermost(const std::vector<std::pair<Ring, std::vector<uint32_t>>>& outer,
                               const Ring& hole) {
    const Ring* best = nullptr;
    for (const auto& [ring, points] : outer)
      if (is_within(ring, hole.front()) &&
          (best == nullptr || std::abs(signed_area(ring)) < std::abs(signed_area(*best))))
        best = &ring;
    return best;
  }

  const Mesh& mesh_;
  HalfSpace keep_;
  std::vector<double> above_;
  std::vector<char> on_plane_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> crossings_;
  Mesh out_;
  glm::dvec3 u_{0}, v_{0};
};

}  // namespace

std::optional<Mesh> cut(const Mesh& mesh, const HalfSpace& keep, double on_plane) {
  return Cut(mesh, keep, on_plane).make();
}

std::optional<std::vector<glm::uvec3>> fill(std::span<const std::vector<glm::dvec2>> rings) {
  std::vector<glm::dvec2> points;
  std::vector<std::vector<uint32_t>> numbered;
  for (const auto& ring : rings) {
    std::vector<uint32_t> numbers(ring.size());
    std::iota(numbers.begin(), numbers.end(), static_cast<uint32_t>(points.size()));
    points.insert(points.end(), ring.begin(), ring.end());
    if (ring.size() < 3) return std::nullopt;
    numbered.push_back(std::move(numbers));
  }
  if (numbered.empty() || points.size() > limits::face_points) return std::nullopt;
  std::vector<uint32_t> whole = numbered.front();
  // From the right, so that a bridge crosses no hole that comes later.
  std::sort(numbered.begin() + 1, numbered.end(), [&](const auto& a, const auto& b) {
    const auto right = [&](const auto& ring) {
      double x = -1e300;
      for (const uint32_t i : ring) x = std::max(x, points[i].x);
      return x;
    };
    return right(a) > right(b);
  });
  for (size_t i = 1; i < numbered.size(); ++i)
    if (!join_hole(whole, numbered[i], points)) return std::nullopt;
  return cut_ears(std::move(whole), points);
}

}  // namespace luxodus
