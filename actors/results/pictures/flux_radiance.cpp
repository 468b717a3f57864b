#include "actors/results/pictures/flux_radiance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "actors/results/pictures/gas_volumes.hpp"
#include "actors/results/run/parallel_for.hpp"
#include "scenes/light/geometry/patches.hpp"
#include "scenes/light/transport/detectors.hpp"
#include "scenes/light/transport/emission.hpp"
#include "scenes/light/transport/packed_scene.hpp"
#include "scenes/light/transport/readout.hpp"

namespace luxodus {

namespace {

constexpr size_t max_voxel_table_bytes = size_t{256} << 20;
/// Largest share of a voxel's light in second differences to its neighbours at which eyes read it.
/// With 0.75 and more the veil in the kitchen was 3 % too bright.
constexpr double max_curved = 0.5;
/// Largest share of all light in a voxel by which the third moment of the scattered light may be
/// unknown, after one more scattering, if eyes read it. Without a limit the veil in haze was 4 to 6
/// % too bright.
constexpr double max_unknown = 0.2;
/// Edge of a block, in voxels, whose errors are taken as fully correlated.
constexpr uint32_t err_alike = 2;

/// Relative error of a band of a patch at which its colour is half its own, half its surface's.
constexpr double settled_band_error = 0.2;

class FluxRadiance final : public RadianceCache {
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
    const auto settle = [&](int64_t surface) {
      settle_colours(scene_.surfaces[static_cast<size_t>(surface)]);
    };
    parallel_for(static_cast<int64_t>(scene_.surfaces.size()), run.threads(),
                 [&] { return settle; });
    for (const PhaseFunction& phase : scene_.phases)
      largest_g_ = std::max(largest_g_, static_cast<double>(std::abs(phase.mean_cosine())));
    find_cached_voxels();
    fill_voxels();
    sharpen_voxels();
  }

  double of_surface(const Hit& hit, bool front, int band) const override {
    return static_cast<double>(table_[patch_of(hit, front) * bands_ + static_cast<size_t>(band)]);
  }
  CachedError error_of_surface(const Hit& hit, bool front) const override {
    const size_t patch = patch_of(hit, front);
    return {patch, static_cast<double>(patch_errors_[patch])};
  }

  CachedLight cached_at(const Vec3& place, bool diffused) const override {
    if (cached_.empty()) return CachedLight::nothing;
    const uint32_t voxel = voxel_of(scene_.voxels, place);
    if (voxel == none_index) return CachedLight::nothing;
    if (diffused) return cached_[voxel];
    return eyes_read_[voxel] ? CachedLight::scattered : CachedLight::nothing;
  }

  uint32_t choose_voxel(const Vec3& place, const Vec3& chance, CachedLight which) const override {
    const VoxelGrid& grid = scene_.voxels;
    const Vec3 at = (place - Vec3(grid.low)) / Real{grid.edge};
    const std::array<int, 3> stride = {1, grid.nx, grid.nx * grid.ny};
    const std::array<int, 3> count = {grid.nx, grid.ny, grid.nz};
    uint32_t voxel = voxel_of(grid, place);
    for (int axis = 0; axis < 3; ++axis) {
      const Real cell = std::floor(at[axis]);
      const Real off = at[axis] - cell - 0.5_r;  // from the voxel's centre
      if (chance[axis] >= std::abs(off)) continue;
      const int next = static_cast<int>(cell) + (off > 0 ? 1 : -1);
      if (next < 0 || next >= count[static_cast<size_t>(axis)]) continue;
      const auto step = static_cast<uint32_t>(stride[static_cast<size_t>(axis)]);
      const uint32_t other = off > 0 ? voxel + step : voxel - step;
      const bool open = gas_.open[std::min(voxel, other)] >> axis & 1;
      if (open && cached_[other] >= which) voxel = other;
    }
    return voxel;
  }

  double of_medium(uint32_t voxel, const Vec3& direction, const PhaseFunction& phase, int band,
                   CachedLight which) const override {
    std::array<float, voxel_quantities> read;
    const float* values =
        voxels_.empty() ? read.data() : &voxels_[place_of(voxel, static_cast<size_t>(band), 0)];
    if (voxels_.empty()) read_voxel(voxel, band, read.data());
    return turned(values, direction, phase, which);
  }

  /// Propagates the errors of a voxel's quantities as if they were independent: sums the squares of
  /// the changes of `turned`.
  CachedError error_of_medium(uint32_t voxel, const Vec3& direction, const PhaseFunction& phase,
                              CachedLight which) const override {
    std::array<Estimate, voxel_quantities> read;
    const Estimate* of = read.data();
    if (voxel_errors_.empty())
      for (uint32_t q = 0; q < voxel_quantities; ++q)
        read[q] = lumens(scene_.blocks.voxels, voxel, q);
    else
      of = &voxel_errors_[voxel_quantities * voxel];
    const CachedError unknown{uint64_t{scene_.patch_count} + block_of(voxel), 0};
    std::array<float, voxel_quantities> values;
    for (size_t q = 0; q < values.size(); ++q) values[q] = static_cast<float>(of[q].value);
    const double light = turned(values.data(), direction, phase, which);
    if (!(light > 0)) return unknown;
    const bool all = which == CachedLight::all;
    double squares = 0;
    for (size_t q = all ? 0 : first_scattered_quantity;
         q < (all ? first_scattered_quantity : values.size()); ++q) {
      const float own = values[q];
      values[q] += static_cast<float>(of[q].standard_error);
      squares += std::pow(turned(values.data(), direction, phase, which) - light, 2);
      values[q] = own;
    }
    return {unknown.bin, std::sqrt(squares) / light};
  }

 private:
  /// Marks voxels that are known: their gas volume is, and they are not inside flames. Light
  /// straight from emitters, which varies close to them, is known where no emitter is within an
  /// edge.
  void find_cached_voxels() {
    const LitPlaces lit{
        [&](uint32_t voxel) { return lumens(scene_.blocks.voxels, voxel, 0).value > 0; },
        [&](const TriangleRecord& t, bool front) { return side_lm_m2(t, front); }};
    auto gas = find_lit_gas(scene_, lit, run_threads_);
    if (!gas) throw std::runtime_error(gas.problem().text());
    gas_ = std::move(gas).value();
    for (const float share : gas_.share)
      cached_.push_back(share > 0 ? CachedLight::all : CachedLight::nothing);
    for (uint32_t i = 0; i < scene_.emitters.size() && !cached_.empty(); ++i) {
      const EmitterBound bound = emitter_bound(scene_, i);
      if (scene_.emitters[i].kind == EmitterKind::volume)
        know_at_most(CachedLight::nothing, bound.centre, bound.radius);
      know_at_most(CachedLight::scattered, bound.centre,
                   bound.radius + static_cast<Real>(scene_.voxels.edge));
    }
  }

  double side_lm_m2(const TriangleRecord& t, bool front) const {
    const uint32_t side = uint32_t{t.subdivision} * t.subdivision;
    const uint32_t first = t.first_patch + (front ? 0 : side);
    double most = 0;  // of light in and out: a pane transmits light that entered on its other side
    for (const uint32_t quantity : {0u, 1u}) {
      double sum = 0;
      for (uint32_t patch = first; patch < first + side; ++patch)
        sum += lumens(scene_.blocks.patches, patch, quantity).value;
      most = std::max(most, sum);
    }
    const CompiledSurface& surface = scene_.surfaces[t.surface];
    return most / (surface.one_patch ? surface.area_m2 : side * surface.patch_area_m2(t));
  }

  /// Calls visit(neighbour) for adjacent voxels that are known and connected to it.
  template <class Visit>
  void for_each_neighbour(size_t voxel, Visit&& visit) const {
    const VoxelGrid& grid = scene_.voxels;
    const std::array<size_t, 3> stride = {
        1, static_cast<size_t>(grid.nx),
        static_cast<size_t>(grid.nx) * static_cast<size_t>(grid.ny)};
    const auto open = [&](size_t lower, size_t axis) {
      return (gas_.open[lower] >> axis & 1) != 0;
    };
    for (size_t axis = 0; axis < 3; ++axis) {
      const size_t up = voxel + stride[axis], down = voxel - stride[axis];
      if (open(voxel, axis) && cached_[up] != CachedLight::nothing) visit(up);
      if (voxel >= stride[axis] && open(down, axis) && cached_[down] != CachedLight::nothing)
        visit(down);
    }
  }

  /// A voxel's mean, and the interpolation between means, are smoother than the light by an eighth
  /// of the second differences, which is subtracted here.
  void sharpen_voxels() {
    eyes_read_.assign(cached_.size(), false);
    if (voxels_.empty()) return;
    const std::vector<float> means = voxels_;
    for (size_t v = 0; v < cached_.size(); ++v) {
      if (cached_[v] == CachedLight::nothing) continue;
      for (size_t b = 0; b < bands_; ++b) {
        for (size_t q = first_scattered_quantity; q < voxel_quantities; ++q) {
          float second = 0;
          for_each_neighbour(
              v, [&](size_t n) { second += means[place_of(n, b, q)] - means[place_of(v, b, q)]; });
          voxels_[place_of(v, b, q)] -= second / 8;
        }
      }
      eyes_read_[v] = is_even(means, v) && unknown_share(means, v) <= max_unknown;
    }
  }

  /// Whether subtracting an eighth of the second differences is enough.
  bool is_even(const std::vector<float>& means, size_t voxel) const {
    const double light = luminous(means, voxel, first_scattered_quantity);
    double second = 0;
    for_each_neighbour(
        voxel, [&](size_t n) { second += luminous(means, n, first_scattered_quantity) - light; });
    return std::abs(second) <= max_curved * light;
  }

  /// The share of a voxel's light by which the third moment of the scattered light is unknown,
  /// after one more scattering. It is known for a beam and for isotropic light; for a mean cosine m
  /// between them it is uncertain by about m (1 - m^2). Scattering keeps g^3 of it, and it weighs 7
  /// times as much as the fluence.
  double unknown_share(const std::vector<float>& means, size_t voxel) const {
    const double all = luminous(means, voxel, 0);
    const double scattered = luminous(means, voxel, first_scattered_quantity);
    if (!(all > 0 && scattered > 0)) return 0;
    const auto net = [&](size_t axis) {
      return luminous(means, voxel, first_scattered_quantity + 1 + axis);
    };
    const double m = std::min(1.0, std::hypot(net(0), net(1), net(2)) / scattered);
    return 7 * std::pow(largest_g_, 3) * m * (1 - m * m) * scattered / all;
  }

  size_t place_of(size_t voxel, size_t band, size_t quantity) const {
    return voxel_quantities * (voxel * bands_ + band) + quantity;
  }

  /// A quantity of a voxel in lumens over all bands, from `values` laid out like `voxels_`.
  double luminous(const std::vector<float>& values, size_t voxel, size_t quantity) const {
    double sum = 0;
    for (size_t b = 0; b < bands_; ++b)
      sum += scene_.bands[static_cast<int>(b)].lm_per_w *
             static_cast<double>(values[place_of(voxel, b, quantity)]);
    return sum;
  }

  /// Lowers to `most` what is known of the voxels in a cube.
  void know_at_most(CachedLight most, const Vec3& centre, Real reach) {
    const VoxelGrid& grid = scene_.voxels;
    const glm::vec3 middle = (glm::vec3(centre) - grid.low) / grid.edge;
    const float half = static_cast<float>(reach) / grid.edge;
    const glm::vec3 cells(grid.nx, grid.ny, grid.nz);
    const glm::ivec3 from(glm::max(glm::floor(middle - half), glm::vec3(0)));
    const glm::ivec3 to(glm::min(glm::floor(middle + half), cells - 1.0f));
    for (int z = from.z; z <= to.z; ++z) {
      for (int y = from.y; y <= to.y; ++y) {
        for (int x = from.x; x <= to.x; ++x) {
          CachedLight& at = cached_[static_cast<size_t>((int64_t{z} * grid.ny + y) * grid.nx + x)];
          at = std::min(at, most);
        }
      }
    }
  }

  /// Voxels whose errors are correlated: a particle scores in several adjacent ones.
  uint64_t block_of(uint32_t voxel) const {
    const auto nx = static_cast<uint32_t>(scene_.voxels.nx);
    const auto ny = static_cast<uint32_t>(scene_.voxels.ny);
    const uint32_t x = voxel % nx / err_alike, y = voxel / nx % ny / err_alike;
    return (uint64_t{voxel / nx / ny / err_alike} * ny + y) * nx + x;
  }

  static size_t patch_of(const Hit& hit, bool front) {
    const TriangleRecord& t = *hit.triangle;
    const uint32_t n = t.subdivision;
    return t.first_patch + (front ? 0 : n * n) + sub_triangle(hit.u, hit.v, n);
  }

  /// Radiance that one scattering sends against `direction` from a voxel's light. For all light
  /// from the moments up to the first; for scattered light, which eyes see directly, up to the
  /// second.
  static double turned(const float* values, const Vec3& direction, const PhaseFunction& phase,
                       CachedLight which) {
    if (which == CachedLight::scattered) values += first_scattered_quantity;
    const Vec3 net(values[1], values[2], values[3]);
    const Real beam = glm::length(net);
    const Real fluence{values[0]};
    if (!(fluence > 0)) return 0;
    const Real cosine = beam > 0 ? -glm::dot(net, direction) / beam : 0;
    const Real mean_cosine = std::min(1.0_r, beam / fluence);
    if (which == CachedLight::all)
      return static_cast<double>(fluence * evaluate_spread(phase, cosine, mean_cosine));
    const Vec3& d = direction;
    const Real xx{values[4]}, yy{values[5]}, xy{values[6]}, xz{values[7]}, yz{values[8]};
    const Real square = d.x * d.x * xx + d.y * d.y * yy + d.z * d.z * (fluence - xx - yy) +
                        2 * (d.x * d.y * xy + d.x * d.z * xz + d.y * d.z * yz);
    return static_cast<double>(
        fluence * evaluate_spread(phase, cosine, mean_cosine, 1.5_r * square / fluence - 0.5_r));
  }

  /// Fluence and net flux of a voxel in a band [W/m2].
  void read_voxel(uint32_t voxel, int band, float* values) const {
    const double volume = std::pow(static_cast<double>(scene_.voxels.edge), 3) *
                          static_cast<double>(gas_.share[voxel]);
    for (uint32_t q = 0; q < voxel_quantities; ++q)
      values[q] =
          static_cast<float>(readout_.watts(scene_.blocks.voxels, voxel, band, q).value / volume);
  }

  /// Every path that ends in a voxel reads all its bands, and reading 128-bit sums takes longer
  /// than tracing the path. So they are converted once; if there are too many voxels, on demand.
  void fill_voxels() {
    const size_t bytes =
        cached_.size() * voxel_quantities * (bands_ * sizeof(float) + sizeof(Estimate));
    if (bytes > max_voxel_table_bytes) return;
    voxels_.resize(cached_.size() * bands_ * voxel_quantities);
    voxel_errors_.resize(cached_.size() * voxel_quantities);
    constexpr size_t per_row = 1024;  // voxels
    const auto fill_row = [&](int64_t row) {
      const size_t first = static_cast<size_t>(row) * per_row;
      for (size_t voxel = first; voxel < std::min(cached_.size(), first + per_row); ++voxel) {
        if (cached_[voxel] == CachedLight::nothing) continue;
        const auto bin = static_cast<uint32_t>(voxel);
        for (size_t b = 0; b < bands_; ++b)
          read_voxel(bin, static_cast<int>(b), &voxels_[place_of(voxel, b, 0)]);
        for (uint32_t q = 0; q < voxel_quantities; ++q)
          voxel_errors_[voxel_quantities * voxel + q] = lumens(scene_.blocks.voxels, bin, q);
      }
    };
    parallel_for(static_cast<int64_t>((cached_.size() + per_row - 1) / per_row), run_threads_,
                 [&] { return fill_row; });
  }

  /// Sums all source groups. A group with one batch has no error estimate: its contribution counts
  /// as fully uncertain.
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

  /// Gives patches with few counts the colour of their surface, at their own luminance: a particle
  /// has one band, so the light of such a patch has a colour by chance.
  void settle_colours(const CompiledSurface& surface) {
    const auto luminance = [&](const auto* by_band) {
      double sum = 0;
      for (size_t b = 0; b < bands_; ++b)
        sum += static_cast<double>(by_band[b]) * scene_.bands[static_cast<int>(b)].lm_per_w;
      return sum;
    };
    float* const first = &table_[size_t{surface.first_patch} * bands_];
    std::vector<double> whole(bands_);
    for (size_t i = 0; i < surface.patches * bands_; ++i)
      whole[i % bands_] += static_cast<double>(first[i]);
    const double of_whole = luminance(whole.data());
    if (!(of_whole > 0)) return;
    for (size_t patch = 0; patch < surface.patches; ++patch) {
      const auto relative = static_cast<double>(patch_errors_[surface.first_patch + patch]);
      const double known =
          1 / (1 + static_cast<double>(bands_) * std::pow(relative / settled_band_error, 2));
      float* const of_patch = first + patch * bands_;
      const double share = (1 - known) * luminance(of_patch) / of_whole;
      for (size_t b = 0; b < bands_; ++b)
        of_patch[b] =
            static_cast<float>(known * static_cast<double>(of_patch[b]) + share * whole[b]);
    }
  }

  const CompiledScene& scene_;
  const Readout readout_;
  int run_threads_;
  size_t bands_;
  std::vector<float> table_;         // of patches, by band
  std::vector<float> patch_errors_;  // relative, of all bands together
  LitGas gas_;
  std::vector<CachedLight> cached_;  // by voxel; empty without voxels
  std::vector<bool> eyes_read_;      // scattered light, by voxel
  double largest_g_ = 0;             // the largest |mean cosine| of the scene's phase functions
  std::vector<float> voxels_;  // voxel_quantities by voxel and band; empty where they are too many
  std::vector<Estimate> voxel_errors_;  // [lm m], voxel_quantities by voxel
};

}  // namespace

std::unique_ptr<RadianceCache> flux_radiance(const LocalRun& run) {
  return std::make_unique<FluxRadiance>(run);
}

}  // namespace luxodus
