#include "actors/display/flux_radiance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "actors/run/parallel_for.hpp"
#include "scenes/geometry/patches.hpp"
#include "scenes/transport/detectors.hpp"
#include "scenes/transport/emission.hpp"
#include "scenes/transport/packed_scene.hpp"
#include "scenes/transport/readout.hpp"

namespace luxodus {

namespace {

/// Marks voxels of a grid that a box, grown by `grown` edges, may touch and `touches` affirms.
class VoxelMarks {
 public:
  explicit VoxelMarks(const VoxelGrid& grid) : grid_(grid), free_(grid.count(), true) {}

  template <class Touches>
  void mark(glm::vec3 low, glm::vec3 high, float grown, Touches&& touches) {
    const glm::vec3 from = (low - grid_.low) / grid_.edge - grown;
    const glm::vec3 to = (high - grid_.low) / grid_.edge + grown;
    for (int z = first(from.z); z <= last(to.z, grid_.nz); ++z) {
      for (int y = first(from.y); y <= last(to.y, grid_.ny); ++y) {
        for (int x = first(from.x); x <= last(to.x, grid_.nx); ++x) {
          const auto voxel = static_cast<size_t>((int64_t{z} * grid_.ny + y) * grid_.nx + x);
          if (!free_[voxel]) continue;
          const glm::vec3 centre = grid_.low + (glm::vec3(x, y, z) + 0.5f) * grid_.edge;
          if (touches(centre)) free_[voxel] = false;
        }
      }
    }
  }

  std::vector<bool> take() { return std::move(free_); }

 private:
  static int first(float at) { return std::max(0, static_cast<int>(std::floor(at))); }
  static int last(float at, int count) {
    return std::min(count - 1, static_cast<int>(std::floor(at)));
  }

  const VoxelGrid& grid_;
  std::vector<bool> free_;
};

/// Of a voxel's edge: what lies so near to its face may be on either side, by rounding.
constexpr float rounding = 1e-3f;

void mark_triangle(const VoxelGrid& grid, const TriangleRecord& t, VoxelMarks& marks) {
  const glm::vec3 low = glm::min(t.corner[0], glm::min(t.corner[1], t.corner[2]));
  const glm::vec3 high = glm::max(t.corner[0], glm::max(t.corner[1], t.corner[2]));
  const glm::vec3 n = t.normal;
  const float reach =
      (0.5f + rounding) * grid.edge * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
  marks.mark(low, high, rounding, [&](const glm::vec3& centre) {
    return std::abs(glm::dot(centre - t.corner[0], n)) <= reach;
  });
}

/// Of a voxel: fluence, and the net flux along x, y, z.
constexpr size_t voxel_values = 4;
/// Over which the slope of a phase function is taken.
constexpr double cosine_step = 0.02;
constexpr size_t max_voxel_table_bytes = size_t{256} << 20;

class FluxRadiance final : public KnownRadiance {
 public:
  explicit FluxRadiance(const LocalRun& run)
      : scene_(run.scene()),
        readout_(run.scene(), run.totals()),
        run_threads_(run.threads()),
        bands_(static_cast<size_t>(run.scene().bands.count())),
        table_(size_t{run.scene().patch_count} * bands_),
        patch_errors_(run.scene().patch_count) {
    for (const CompiledSurface& s : scene_.surfaces)
      if (s.one_patch) fill(s.first_patch, s.patches, s.area_m2);
    constexpr int64_t per_row = 1024;  // triangles
    const auto read = for_each_cell(scene_, [&](const GeometryCell& cell) {
      const auto count = static_cast<int64_t>(cell.triangles.size());
      const auto fill_row = [&](int64_t row) {
        for (int64_t i = row * per_row; i < std::min(count, (row + 1) * per_row); ++i)
          fill_triangle(cell.triangles[static_cast<size_t>(i)]);
      };
      parallel_for((count + per_row - 1) / per_row, run.threads(), [&] { return fill_row; });
    });
    if (!read) throw std::runtime_error(read.problem().text());
    auto gas = voxels_of_gas(scene_);
    if (!gas) throw std::runtime_error(gas.problem().text());
    gas_ = std::move(gas).value();
    fill_voxels();
  }

  double of_surface(const Hit& hit, bool front, int band) const override {
    return static_cast<double>(table_[patch_of(hit, front) * bands_ + static_cast<size_t>(band)]);
  }
  KnownError error_of_surface(const Hit& hit, bool front) const override {
    const size_t patch = patch_of(hit, front);
    return {patch, static_cast<double>(patch_errors_[patch])};
  }

  bool knows(const Vec3& place) const override {
    if (gas_.empty()) return false;
    const uint32_t voxel = voxel_of(scene_.voxels, place);
    return voxel != none_index && gas_[voxel];
  }

  double of_medium(const Vec3& place, const Vec3& direction, const PhaseFunction& phase,
                   int band) const override {
    const uint32_t voxel = voxel_of(scene_.voxels, place);
    const size_t at = voxel_values * (voxel * bands_ + static_cast<size_t>(band));
    if (!voxels_.empty()) return turned(&voxels_[at], direction, phase);
    std::array<float, voxel_values> values;
    read_voxel(voxel, band, values.data());
    return turned(values.data(), direction, phase);
  }

  /// By the errors of the fluence and of each component of the net flux, as if they were
  /// independent: the squares of what each changes in `turned`.
  KnownError error_of_medium(const Vec3& place, const Vec3& direction,
                             const PhaseFunction& phase) const override {
    const uint32_t voxel = voxel_of(scene_.voxels, place);
    std::array<Estimate, voxel_values> read;
    const Estimate* of = read.data();
    if (voxel_errors_.empty())
      for (uint32_t q = 0; q < voxel_values; ++q) read[q] = lumens(scene_.blocks.voxels, voxel, q);
    else
      of = &voxel_errors_[voxel_values * voxel];
    const KnownError unknown{uint64_t{scene_.patch_count} + voxel, 0};
    if (!(of[0].value > 0)) return unknown;
    constexpr double everywhere = 1 / (4 * static_cast<double>(pi_f));
    const glm::dvec3 net(of[1].value, of[2].value, of[3].value), to(direction);
    const double beam = glm::length(net);
    const glm::dvec3 along = beam > 0 ? net / beam : to;
    const double cosine = -glm::dot(along, to);
    const auto turn = [&](double c) {
      return static_cast<double>(evaluate(phase, static_cast<Real>(c)));
    };
    const double turned_here = turn(cosine);
    const double aside = cosine > 0 ? cosine - cosine_step : cosine + cosine_step;
    const double slope = (turn(aside) - turned_here) / (aside - cosine);
    const double even = std::max(0.0, of[0].value - beam) * everywhere;
    // A longer net flux sends more one way and less everywhere; one turned aside meets the phase
    // function elsewhere.
    const glm::dvec3 by_net =
        (turned_here - (even > 0 ? everywhere : 0)) * along - slope * (to + cosine * along);
    double squares = even > 0 ? std::pow(everywhere * of[0].standard_error, 2) : 0;
    for (int k = 0; k < 3; ++k)
      squares += std::pow(by_net[k] * of[static_cast<size_t>(k) + 1].standard_error, 2);
    const double light = even + beam * turned_here;
    return {unknown.bin, light > 0 ? std::sqrt(squares) / light : 0};
  }

 private:
  static size_t patch_of(const Hit& hit, bool front) {
    const TriangleRecord& t = *hit.triangle;
    const uint32_t n = t.subdivision;
    return t.first_patch + (front ? 0 : n * n) + sub_triangle(hit.u, hit.v, n);
  }

  /// What one scattering sends against `direction` of light of such fluence and net flux. Of the
  /// fluence, as much as the net flux goes one way; the rest comes from everywhere. That has the
  /// moments of the light up to the first, and is exact for a beam and for even light.
  static double turned(const float* values, const Vec3& direction, const PhaseFunction& phase) {
    const glm::dvec3 net(values[1], values[2], values[3]);
    const double beam = glm::length(net);
    const double even =
        std::max(0.0, static_cast<double>(values[0]) - beam) / (4 * static_cast<double>(pi_f));
    if (!(beam > 0)) return even;
    const double cosine = -glm::dot(net, glm::dvec3(direction)) / beam;
    return even + beam * static_cast<double>(evaluate(phase, static_cast<Real>(cosine)));
  }

  /// Fluence and net flux of a voxel in a band [W/m2].
  void read_voxel(uint32_t voxel, int band, float* values) const {
    const auto edge = static_cast<double>(scene_.voxels.edge);
    for (uint32_t q = 0; q < voxel_values; ++q)
      values[q] = static_cast<float>(readout_.watts(scene_.blocks.voxels, voxel, band, q).value /
                                     (edge * edge * edge));
  }

  /// Every path that ends in a voxel reads it in all bands: from sums of 128 bits that takes longer
  /// than to trace the path. Where there are too many voxels for that, they are read as they are
  /// asked for.
  void fill_voxels() {
    const size_t bytes = gas_.size() * voxel_values * (bands_ * sizeof(float) + sizeof(Estimate));
    if (bytes > max_voxel_table_bytes) return;
    voxels_.resize(gas_.size() * bands_ * voxel_values);
    voxel_errors_.resize(gas_.size() * voxel_values);
    constexpr size_t per_row = 1024;  // voxels
    const auto fill_row = [&](int64_t row) {
      const size_t first = static_cast<size_t>(row) * per_row;
      for (size_t voxel = first; voxel < std::min(gas_.size(), first + per_row); ++voxel) {
        if (!gas_[voxel]) continue;
        const auto bin = static_cast<uint32_t>(voxel);
        for (size_t b = 0; b < bands_; ++b)
          read_voxel(bin, static_cast<int>(b), &voxels_[voxel_values * (voxel * bands_ + b)]);
        for (uint32_t q = 0; q < voxel_values; ++q)
          voxel_errors_[voxel_values * voxel + q] = lumens(scene_.blocks.voxels, bin, q);
      }
    };
    parallel_for(static_cast<int64_t>((gas_.size() + per_row - 1) / per_row), run_threads_,
                 [&] { return fill_row; });
  }

  /// Of all source groups. A group of one batch does not know its error: what it brings counts as
  /// quite uncertain.
  Estimate lumens(uint32_t block, uint32_t bin, uint32_t quantity) const {
    Estimate sum;
    double variance = 0;
    for (int g = 0; g < static_cast<int>(scene_.groups.size()); ++g) {
      const Estimate own = readout_.lumens(block, bin, quantity, g);
      const double error = std::isnan(own.standard_error) ? own.value : own.standard_error;
      sum.value += own.value;
      variance += error * error;
    }
    sum.standard_error = std::sqrt(variance);
    return sum;
  }

  void fill_triangle(const TriangleRecord& t) {
    const CompiledSurface& surface = scene_.surfaces[t.surface];
    if (surface.one_patch) return;
    fill(t.first_patch, 2 * t.subdivision * t.subdivision, surface.patch_area_m2(t));
  }
  void fill(uint32_t first, uint32_t count, double area_m2) {
    const double per_watt = 1 / (static_cast<double>(pi_f) * area_m2);
    for (uint32_t patch = first; patch < first + count; ++patch) {
      for (size_t b = 0; b < bands_; ++b) {
        const Estimate out = readout_.watts(scene_.blocks.patches, patch, static_cast<int>(b), 1);
        table_[patch * bands_ + b] = static_cast<float>(out.value * per_watt);
      }
      const Estimate out = lumens(scene_.blocks.patches, patch, 1);
      patch_errors_[patch] = out.value > 0 ? static_cast<float>(out.relative_error()) : 0.0f;
    }
  }

  const CompiledScene& scene_;
  const Readout readout_;
  int run_threads_;
  size_t bands_;
  std::vector<float> table_;         // of patches, by band
  std::vector<float> patch_errors_;  // relative, of all bands together
  std::vector<bool> gas_;            // by voxel; empty without voxels
  std::vector<float> voxels_;  // voxel_values by voxel and band; empty where they are too many
  std::vector<Estimate> voxel_errors_;  // [lm m], voxel_values by voxel
};

}  // namespace

Result<std::vector<bool>> voxels_of_gas(const CompiledScene& scene) {
  const VoxelGrid& grid = scene.voxels;
  if (!(grid.edge > 0)) return std::vector<bool>();
  VoxelMarks marks(grid);
  const auto read = for_each_cell(scene, [&](const GeometryCell& cell) {
    for (const TriangleRecord& t : cell.triangles) mark_triangle(grid, t, marks);
  });
  if (!read) return read.problem();
  for (uint32_t i = 0; i < scene.emitters.size(); ++i) {
    const EmitterBound bound = emitter_bound(scene, i);
    const glm::vec3 centre(bound.centre), reach(static_cast<float>(bound.radius));
    marks.mark(centre - reach, centre + reach, 1, [](const glm::vec3&) { return true; });
  }
  return marks.take();
}

std::unique_ptr<KnownRadiance> flux_radiance(const LocalRun& run) {
  return std::make_unique<FluxRadiance>(run);
}

}  // namespace luxodus
