#include "actors/apps/view/flames.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/light/optics/media_set.hpp"
#include "scenes/light/optics/spectrum.hpp"
#include "scenes/light/transport/flame_moment.hpp"
#include "scenes/light/transport/flame_points.hpp"

namespace luxodus {

namespace {

/// Points of a flame leave out its rim: the box is larger than theirs by this share.
constexpr double rim = 0.1;
/// Points along a side of a cell at which its glow is read.
constexpr int glow_points_a_side = 2;

/// The mean emission per volume of each cell, scaled to a total of one.
std::vector<double> glow_of(const CompiledScene& scene, const LiveFlame& flame,
                            ResidentData& data) {
  const glm::dvec3 cell = flame.size / glm::dvec3(flame.count);
  const glm::dvec3 low = flame.low - scene.local_origin;
  std::vector<double> out;
  for (int z = 0; z < flame.count.z; ++z)
    for (int y = 0; y < flame.count.y; ++y)
      for (int x = 0; x < flame.count.x; ++x) {
        double sum = 0;
        for (int k = 0; k < glow_points_a_side * glow_points_a_side * glow_points_a_side; ++k) {
          const glm::dvec3 at(k % glow_points_a_side, k / glow_points_a_side % glow_points_a_side,
                              k / glow_points_a_side / glow_points_a_side);
          const glm::dvec3 place =
              low + (glm::dvec3(x, y, z) + (at + 0.5) / double{glow_points_a_side}) * cell;
          sum +=
              scene.media.emission_density(static_cast<int>(flame.medium), glm::vec3(place), data);
        }
        out.push_back(sum);
      }
  return out;
}

std::optional<LiveFlameShape> shape_of(const CompiledScene& scene, uint32_t medium) {
  for (const SteadyFlame& flame : steady_flames(scene)) {
    if (flame.medium != static_cast<int>(medium)) continue;
    const Bounds box = flame.body->bounds();
    LiveFlameShape out{box.low + scene.local_origin, box.high - box.low, 0, flame.seed};
    for (int b = 0; b < scene.bands.count(); ++b)
      out.extinction_per_m =
          std::max(out.extinction_per_m, scene.media.tables().sigma_of(b, flame.component));
    return out;
  }
  return std::nullopt;
}

LiveFlame flame_of(const CompiledScene& scene, const CompiledEmitter& e, ResidentData& data) {
  LiveFlame out;
  out.group = scene.groups[static_cast<size_t>(e.group)].name;
  out.medium = e.medium;
  out.shape = shape_of(scene, e.medium);
  const auto points = flame_points(scene.media, e.medium, data);
  glm::dvec3 low(points.front()), high(points.front());
  for (const glm::vec3& p : points) {
    low = glm::min(low, glm::dvec3(p));
    high = glm::max(high, glm::dvec3(p));
  }
  const glm::dvec3 more = rim / 2 * (high - low);
  out.low = low - more + scene.local_origin;
  out.size = glm::max(high - low + 2.0 * more, glm::dvec3(1e-3));
  const double longest = std::max({out.size.x, out.size.y, out.size.z});
  for (int k = 0; k < 3; ++k)
    out.count[k] = std::max(
        1, static_cast<int>(std::lround(limits::view_flame_cells * out.size[k] / longest)));
  const std::vector<double> glow = glow_of(scene, out, data);
  const double brightest = *std::max_element(glow.begin(), glow.end());
  if (!(brightest > 0)) return out;
  double sum = 0;  // of bytes: the flame's light is distributed by them
  for (const double one : glow) {
    const auto byte = static_cast<unsigned char>(std::lround(255 * one / brightest));
    sum += byte;
    out.cells.push_back(static_cast<char>(byte));
  }
  std::array<double, 3> xyz{};
  for (int b = 0; b < scene.bands.count(); ++b) {
    const double watts = e.power_w[static_cast<size_t>(b)];
    xyz[0] += watts * scene.bands[b].x_per_w;
    xyz[1] += watts * scene.bands[b].lm_per_w;
    xyz[2] += watts * scene.bands[b].z_per_w;
  }
  const glm::dvec3 cell = out.size / glm::dvec3(out.count);
  const double per_byte = 1 / (4 * std::numbers::pi * sum * cell.x * cell.y * cell.z);
  out.colour = linear_srgb_from_xyz(xyz);
  for (double& channel : out.colour) channel *= 255 * per_byte;
  return out;
}

}  // namespace

std::vector<LiveFlame> flames_of(const CompiledScene& scene, const SceneIndex& index) {
  std::vector<const CompiledEmitter*> flames;
  for (const CompiledEmitter& e : scene.emitters)
    if (e.kind == EmitterKind::volume && e.luminous_flux_lm > 0) flames.push_back(&e);
  std::stable_sort(flames.begin(), flames.end(), [](const auto* a, const auto* b) {
    return a->luminous_flux_lm > b->luminous_flux_lm;
  });
  if (flames.size() > limits::view_flames) flames.resize(limits::view_flames);
  ResidentData data(scene, index);
  std::vector<LiveFlame> out;
  for (const CompiledEmitter* e : flames)
    if (LiveFlame flame = flame_of(scene, *e, data); !flame.cells.empty())
      out.push_back(std::move(flame));
  return out;
}

}  // namespace luxodus
