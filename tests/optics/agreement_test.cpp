// Different methods for one number agree: analogue and weighted, eyes and planes, shadow rays and
// tracing. The error bars that these tests rely on are honest, too.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "scenes/light/geometry/primitives.hpp"
#include "tests/optics/light_kit.hpp"

namespace luxodus::light {
namespace {

/// A furnished grey room with a layer of smoke under the ceiling, written as a scene file.
const char* const furnished_room = R"(
title = "A furnished room with smoke"
patch_edge_m = 1.0

[run]
voxels = false

[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [4, 3, 2.5]
material = "white70"
floor = "grey20"

[[object]]
name = "desk"
shape = "box"
low = [1, 1, 0]
high = [2.2, 1.8, 0.75]
material = "grey40"

[[object]]
name = "screen"
shape = "box"
low = [2.9, 0.4, 0]
high = [3, 1.6, 1.6]
material = "grey60"

[[emitter]]
name = "panel"
shape = "rectangle"
position = [1.3, 1.4, 2.49]
size = [0.6, 0.6]
flux_w = 10
spectrum = "E"

[[emitter]]
name = "globe"
shape = "sphere"
position = [3.5, 2.5, 1.2]
diameter = 0.2
flux_w = 3
spectrum = "E"

[[medium]]
name = "smoke"
kind = "layered"
[[medium.layer]]
z_low = 1.4
z_high = 2.5
extinction = 0.8
albedo = 0.7
phase = "hg"
g = 0.6

[[plane]]
name = "on the desk"
corner = [1.4, 1.2, 0.8]
edge_u = [0.8, 0, 0]
edge_v = [0, 0.8, 0]
cells = [1, 1]

[[plane]]
name = "in the smoke"
corner = [2.2, 2.0, 1.9]
edge_u = [0.8, 0, 0]
edge_v = [0, 0.8, 0]
cells = [1, 1]

[[plane]]
name = "on the wall"
corner = [0.005, 1.2, 0.6]
edge_u = [0, 0.8, 0]
edge_v = [0, 0, 0.8]
cells = [1, 1]
)";

constexpr double plane_area = 0.64;

}  // namespace

TEST_CASE("analogue and weighted absorption give equal light") {
  SceneDescription scene = scene_from_toml(furnished_room);
  add_layer_group(scene, 0, 1.4);
  add_layer_group(scene, 1.4, 2.5);
  SceneDescription sampled = scene;
  sampled.run.analogue = true;
  RunOptions options;
  options.particles = 1 << 23;
  const Run weighted(std::move(scene), options);
  options.seed = 2;
  const Run analogue(std::move(sampled), options);
  CHECK(analogue.balance().roulette_gain == 0);
  CHECK(weighted.balance().roulette_gain > 0);
  for (uint32_t p = 0; p < 3; ++p) {
    for (uint32_t part = 0; part < 2; ++part) {
      INFO("plane " << p << (part == 0 ? " direct" : " indirect"));
      const uint32_t block = weighted.blocks().planes;
      // A five-hundredth of the light reaches the plane in the smoke directly.
      check_agree(weighted.watts(block, p, part), analogue.watts(block, p, part),
                  p == 1 && part == 0 ? 3 * half_percent : 1.5 * half_percent);
    }
  }
  for (uint32_t v = 0; v < 2; ++v)
    check_agree(weighted.track_length(v), analogue.track_length(v), half_percent);
  check_agree(weighted.absorbed_by_medium(0), analogue.absorbed_by_medium(0), half_percent);
  for (const std::string name : {"room.floor", "room.ceiling", "room.x0", "desk", "screen"})
    check_agree(weighted.absorbed_by(name), analogue.absorbed_by(name), half_percent);
}

TEST_CASE("indirect illuminance by paths from the eye equals the flux that crosses a plane there") {
  SceneDescription scene = scene_from_toml(furnished_room);
  constexpr uint32_t per_side = 5, n = per_side * per_side;
  const std::vector<BinSum> probes_of_plane = add_probes_on_planes(scene, per_side);
  scene.run.eye_path_factor = 8;
  const double lm_per_w = efficacy_lm_per_w(scene.emitters[0].spectrum);
  RunOptions options;
  options.particles = 1 << 23;
  const Run run(std::move(scene), options, probes_of_plane);
  for (uint32_t plane = 0; plane < 3; ++plane) {
    INFO("plane " << plane);
    check_agree(run.sum(plane) * (1 / (lm_per_w * n)),
                run.watts(run.blocks().planes, plane, 1) * (1 / plane_area), half_percent);
  }
}

TEST_CASE("direct light by shadow rays equals the direct light that tracing counts") {
  RunOptions options;
  options.particles = 3 << 23;
  Run run(scene_from_toml(furnished_room), options);
  const double lm_per_w = efficacy_lm_per_w(run.scene().description->emitters[0].spectrum);
  constexpr int per_side = 8;
  for (uint32_t i = 0; i < 3; ++i) {
    const PlaneMeasure& plane = run.scene().description->planes[i];
    INFO(plane.name);
    double sum = 0;
    for (int k = 0; k < per_side * per_side; ++k) {
      const glm::dvec3 at = plane.corner + plane.edge_u * ((k % per_side + 0.5) / per_side) +
                            plane.edge_v * ((k / per_side + 0.5) / per_side);
      sum += direct_light_at(run.scene(), GeometryAccess::resident(run.local().index()),
                             glm::vec3(at - run.scene().local_origin),
                             glm::vec3(glm::normalize(glm::cross(plane.edge_u, plane.edge_v))), {})
                 .total_lx();
    }
    check_within(run.watts(run.blocks().planes, i, 0) * (1 / plane_area),
                 sum / (per_side * per_side * lm_per_w), half_percent, 3e-3);
  }
}

namespace {

/// Distances of estimates from the truth in their own standard errors, for runs of `batches`
/// batches.
class Distances {
 public:
  void add(double z) { z_.push_back(z); }
  Distances times(double k) const {
    Distances out;
    for (const double z : z_) out.add(k * z);
    return out;
  }

  double mean() const { return std::accumulate(z_.begin(), z_.end(), 0.0) / size(); }
  double mean_square() const {
    return std::inner_product(z_.begin(), z_.end(), z_.begin(), 0.0) / size();
  }
  double share_within(double z) const {
    const auto within = [&](double v) { return std::abs(v) < z; };
    return static_cast<double>(std::count_if(z_.begin(), z_.end(), within)) / size();
  }
  double size() const { return static_cast<double>(z_.size()); }

 private:
  std::vector<double> z_;
};

constexpr int batches_of_a_run = 64;

/// Whether the distances follow Student's t with 63 degrees of freedom: 0.679 and 0.950 of them
/// within one and two, and a mean square of 63 / 61; each within three of its own standard
/// deviations.
bool honest(const Distances& z) {
  constexpr double one = 0.679, two = 0.950;
  constexpr double freedom = batches_of_a_run - 1;
  constexpr double square = freedom / (freedom - 2);
  // Variance of the square: E t^4 - (E t^2)^2, E t^4 = 3 (E t^2)^2 (freedom - 2) / (freedom - 4).
  const double spread_of_square =
      square * std::sqrt(3 * (freedom - 2) / (freedom - 4) - 1) / std::sqrt(z.size());
  const auto spread_of_share = [&](double p) { return std::sqrt(p * (1 - p) / z.size()); };
  return std::abs(z.share_within(1) - one) < 3 * spread_of_share(one) &&
         std::abs(z.share_within(2) - two) < 3 * spread_of_share(two) &&
         std::abs(z.mean_square() - square) < 3 * spread_of_square;
}

}  // namespace

TEST_CASE("error bars are honest, and 20 % too small or too large would be detected") {
  // A cube with a known solution, including scattering gas and roulette: white smoke, equal walls,
  // so E = 1.
  SceneDescription scene;
  scene.run.voxels = false;
  scene.run.batch_particles = 128;
  const int wall = add_grey(scene, 0.5);
  for (const BoxFace& f : faces_of_box({0, 0, 0}, {1, 1, 1})) {
    add_quad(scene, f.name, f.corner, f.u, f.v, wall);
    add_face_emitter(scene, f, 0.5);
  }
  add_homogeneous(scene, smoke(2, 1, 0.5));
  add_box_group(scene, {0.2, 0.2, 0.2}, {0.6, 0.7, 0.8});
  const auto compiled = compile(std::move(scene));
  const int runs = thrift == 1 ? 800 : 400;
  std::vector<std::pair<std::string, Distances>> measured = {
      {"wall", {}}, {"volume", {}}, {"patch", {}}};
  for (int seed = 0; seed < runs; ++seed) {
    LocalRun run(compiled, static_cast<uint64_t>(1000 + seed), 2);
    StopRule stop;
    stop.particles = batches_of_a_run * compiled->batch_particles;
    const std::atomic<bool> interrupt{false};
    run.run(stop, interrupt, [](const Progress&) {});
    const Readout readout(*compiled, run.totals());
    const auto add = [&](size_t k, const Estimate& e, double truth) {
      measured[k].second.add((e.value - truth) / e.standard_error);
    };
    add(0, readout.watts(compiled->blocks.surfaces, 2, 0, 0), 1);
    add(1, readout.watts(compiled->blocks.volume_length, 0, 0, 0), 4 * 0.4 * 0.5 * 0.6);
    add(2, readout.watts(compiled->blocks.patches, compiled->surfaces[4].first_patch, 0, 0), 0.5);
  }
  for (const auto& [name, z] : measured) {
    INFO(name << ": " << z.share_within(1) << " within one, " << z.share_within(2)
              << " within two, mean square " << z.mean_square());
    CHECK(honest(z));
    CHECK(std::abs(z.mean()) < 3 / std::sqrt(z.size()));
    // The power of this test: the same runs with stated errors a fifth too small or too large.
    CHECK_FALSE(honest(z.times(1 / 0.8)));
    CHECK_FALSE(honest(z.times(1 / 1.2)));
  }
}

}  // namespace luxodus::light
