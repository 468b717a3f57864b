// Different ways to the same number agree: analogue and weighted games, eyes and planes, shadow
// rays and tracing. And the error bars that all of this is judged by are honest.
#include <cmath>

#include "scenes/geometry/primitives.hpp"
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
edge_u = [0.4, 0, 0]
edge_v = [0, 0.4, 0]
cells = [1, 1]

[[plane]]
name = "in the smoke"
corner = [2.2, 2.0, 1.9]
edge_u = [0.4, 0, 0]
edge_v = [0, 0.4, 0]
cells = [1, 1]

[[plane]]
name = "on the wall"
corner = [0.005, 1.2, 0.6]
edge_u = [0, 0.4, 0]
edge_v = [0, 0, 0.4]
cells = [1, 1]
)";

constexpr double plane_area = 0.16;

}  // namespace

TEST_CASE("the analogue and the weighted game give the same light") {
  SceneDescription scene = scene_from_toml(furnished_room);
  add_layer_group(scene, 0, 1.4);
  add_layer_group(scene, 1.4, 2.5);
  SceneDescription sampled = scene;
  sampled.run.analogue = true;
  RunOptions options;
  options.particles = 1 << 19;
  const Run weighted(std::move(scene), options);
  options.seed = 2;
  const Run analogue(std::move(sampled), options);
  CHECK(analogue.ledger().roulette_gain == 0);
  CHECK(weighted.ledger().roulette_gain > 0);
  for (uint32_t p = 0; p < 3; ++p) {
    for (uint32_t part = 0; part < 2; ++part) {
      INFO("plane " << p << (part == 0 ? " direct" : " indirect"));
      const uint32_t block = weighted.blocks().planes;
      check_agree(weighted.watts(block, p, part), analogue.watts(block, p, part), 8e-2);
    }
  }
  for (uint32_t v = 0; v < 2; ++v)
    check_agree(weighted.track_length(v), analogue.track_length(v), 5e-3);
  check_agree(weighted.absorbed_by_medium(0), analogue.absorbed_by_medium(0), 1e-2);
  for (const std::string name : {"room.floor", "room.ceiling", "room.x0", "desk", "screen"})
    check_agree(weighted.absorbed_by(name), analogue.absorbed_by(name), 2e-2);
}

TEST_CASE("indirect illuminance by paths from the eye is what crosses a plane there") {
  SceneDescription scene = scene_from_toml(furnished_room);
  constexpr int per_side = 3;
  for (const PlaneMeasure& plane : scene.planes) {
    for (int k = 0; k < per_side * per_side; ++k) {
      ProbeMeasure p;
      p.name = plane.name + " " + std::to_string(k);
      p.position = plane.corner + plane.edge_u * ((k % per_side + 0.5) / per_side) +
                   plane.edge_v * ((k / per_side + 0.5) / per_side);
      p.normal = glm::normalize(glm::cross(plane.edge_u, plane.edge_v));
      scene.probes.push_back(p);
    }
  }
  scene.run.eye_share = 4;
  const double lm_per_w = efficacy_lm_per_w(scene.emitters[0].spectrum);
  RunOptions options;
  options.particles = 1 << 20;
  const Run run(std::move(scene), options);
  constexpr uint32_t n = per_side * per_side;
  for (uint32_t plane = 0; plane < 3; ++plane) {
    INFO("plane " << plane);
    Estimate mean{0, 0};
    for (uint32_t k = 0; k < n; ++k) {
      const Estimate e = run.value(run.blocks().probes, plane * n + k) * (1 / (lm_per_w * n));
      mean.value += e.value;
      mean.standard_error = std::hypot(mean.standard_error, e.standard_error);
    }
    check_agree(mean, run.watts(run.blocks().planes, plane, 1) * (1 / plane_area), 3e-2);
  }
}

TEST_CASE("direct light along shadow rays is the direct light that tracing counts") {
  RunOptions options;
  options.particles = 1 << 20;
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
      sum += direct_light_at(run.scene(), run.local().index(),
                             glm::vec3(at - run.scene().local_origin),
                             glm::vec3(glm::normalize(glm::cross(plane.edge_u, plane.edge_v))), {})
                 .total_lx();
    }
    check_within(run.watts(run.blocks().planes, i, 0) * (1 / plane_area),
                 sum / (per_side * per_side * lm_per_w), 3e-2, 3e-3);
  }
}

TEST_CASE(
    "error bars are honest: of 200 runs as many are within one and two of them as theory says") {
  // A cube of known solution, scattering gas and roulette included: white smoke, equal walls, so E
  // = 1.
  SceneDescription scene;
  scene.run.voxels = false;
  scene.run.batch_particles = 128;
  const int wall = add_grey(scene, 0.5);
  for (const Face& f : faces_of_box({0, 0, 0}, {1, 1, 1})) {
    add_quad(scene, f.name, f.corner, f.u, f.v, wall);
    add_face_emitter(scene, f, 0.5);
  }
  add_homogeneous(scene, smoke(2, 1, 0.5));
  add_box_group(scene, {0.2, 0.2, 0.2}, {0.6, 0.7, 0.8});
  const auto compiled = compile(std::move(scene));
  constexpr int runs = 200;
  constexpr int64_t particles = 64 * 128;
  std::vector<std::pair<std::string, std::vector<double>>> z = {
      {"wall", {}}, {"volume", {}}, {"patch", {}}};
  for (int seed = 0; seed < runs; ++seed) {
    LocalRun run(compiled, static_cast<uint64_t>(1000 + seed), 1);
    StopRule stop;
    stop.particles = particles;
    const std::atomic<bool> interrupt{false};
    run.run(stop, interrupt, [](const Progress&) {});
    const Readout readout(*compiled, run.totals());
    const auto add = [&](size_t k, const Estimate& e, double truth) {
      z[k].second.push_back((e.value - truth) / e.standard_error);
    };
    add(0, readout.watts(compiled->blocks.surfaces, 2, 0, 0), 1);
    add(1, readout.watts(compiled->blocks.volume_length, 0, 0, 0), 4 * 0.4 * 0.5 * 0.6);
    add(2, readout.watts(compiled->blocks.patches, compiled->surfaces[4].first_patch, 0, 0), 0.5);
  }
  for (const auto& [name, values] : z) {
    INFO(name);
    int one = 0, two = 0;
    double mean = 0;
    for (const double v : values) {
      one += std::abs(v) < 1;
      two += std::abs(v) < 2;
      mean += v / runs;
    }
    // Student's t of 63 degrees: 0.679 and 0.950; three binomial standard deviations of 200: 0.099
    // and 0.046.
    CHECK(std::abs(one / static_cast<double>(runs) - 0.679) < 0.099);
    CHECK(std::abs(two / static_cast<double>(runs) - 0.950) < 0.046);
    CHECK(std::abs(mean) < 3 / std::sqrt(static_cast<double>(runs)));
  }
}

}  // namespace luxodus::light
