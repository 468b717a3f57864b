// Extremes of media, emitters and reflectances, and reciprocity. README.md lists where the other
// hard cases are tested.
#include <atomic>
#include <cmath>

#include "scenes/light/transport/birth_order.hpp"
#include "scenes/light/transport/history.hpp"
#include "scenes/light/world/measurements.hpp"
#include "tests/optics/posed_room.hpp"

namespace luxodus::light {

TEST_CASE("light exchanged by two sheets through smoke is reciprocal") {
  const auto sheet = [](SceneDescription& scene, bool emits, const std::string& name,
                        const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v) {
    add_quad(scene, name, corner, u, v, add_grey(scene, 0));
    const glm::dvec3 normal = glm::normalize(glm::cross(u, v));
    if (emits) add_face_emitter(scene, {name, corner, u, v, normal}, 1);
  };
  const auto exchange = [&](bool forward) {
    SceneDescription scene = posed_room({}, Level::without);
    clear_measurements(scene);
    scene.signs.clear();
    scene.media.resize(1);
    add_homogeneous(scene, smoke(0.3, 0.9, 0.5));
    scene.emitters.clear();
    // Equal areas, so that equal shares of power are expected.
    sheet(scene, forward, "a", {0.3, 0.3, 0.4}, {0.6, 0, 0}, {0, 0.6, 0});
    sheet(scene, !forward, "b", {3.7, 1.0, 1.2}, {0, 0, 0.6}, {0, 0.6, 0});
    RunOptions options;
    options.seed = forward ? 3 : 4;
    options.particles = 1 << 22;
    // The front sides of two triangles: four patches per object; a is the eighth object.
    const uint32_t first = forward ? 4 * 8 : 4 * 7;
    return Run(std::move(scene), options, {{&TallyBlocks::patches, {first, first + 2}}}).sum(0);
  };
  check_agree(exchange(true), exchange(false), 2 * half_percent);
}

namespace {

/// A beam of 1 W on a layer of gas between mirrors: reflected light escapes upwards.
Run beam_on_layer(double depth, double albedo, int64_t particles) {
  constexpr double edge = 4;
  SceneDescription scene;
  scene.run.voxels = false;
  add_mirror_walls(scene, {0, 0, 0}, {edge, edge, 1.1});
  add_quad(scene, "end", {0, 0, 0}, {edge, 0, 0}, {0, edge, 0}, add_grey(scene, 0));
  add_layers(scene, 0, {1}, {smoke(depth, albedo)});
  add_rectangle(scene, {2, 2, 1.05}, {0, 0, -1}, 1, 1, 1).distribution = Distribution::collimated;
  RunOptions options;
  options.particles = particles * thrift;
  options.batch_particles = 256;
  return Run(std::move(scene), options);
}

/// The share of a particle's weight that a collision absorbs on average.
double taken_by_collision(const Run& run) {
  return static_cast<double>(run.balance().absorbed_media) / static_cast<double>(unit_weight) /
         static_cast<double>(run.balance().collisions);
}

}  // namespace

TEST_CASE("a layer of depth 1e-6 transmits a beam, and one of 1e4 is a half space") {
  const Run thin = beam_on_layer(1e-6, 0.5, int64_t{1} << 24);
  CHECK(thin.into("end").value == Approx(1).epsilon(1e-5));
  const double expected = 1e-6 * static_cast<double>(thin.balance().particles);
  CHECK(std::abs(static_cast<double>(thin.balance().collisions) - expected) <
        4 * std::sqrt(expected));
  CHECK(taken_by_collision(thin) == Approx(0.5).epsilon(0.01));
  const Row half_space = rows_where("halfspace_H.csv", "albedo", "0.9").front();
  check_within(beam_on_layer(1e4, 0.9, 1 << 20).escaped(5), half_space.number("R(mu0=1)"),
               half_percent);
}

TEST_CASE(
    "gas of albedo 1 - 1e-6 reflects and transmits like gas of albedo 1, less its absorption") {
  const Run all = beam_on_layer(10, 1, 1 << 18), nearly = beam_on_layer(10, 1 - 1e-6, 1 << 18);
  CHECK(all.balance().absorbed_media == 0);
  // Shares are multiples of 2^-32, and weights fall by some 2e-5.
  CHECK(taken_by_collision(nearly) == Approx(1e-6).epsilon(5e-4));
  // Some 20 collisions each absorb 2e-5 of the light.
  check_within(nearly.escaped(5), all.escaped(5).value, half_percent, 1e-4);
}

TEST_CASE("an empty layer between dense ones changes nothing") {
  const auto passed = [](const std::vector<double>& thickness,
                         const std::vector<SmokeOptics>& gas) {
    SceneDescription scene;
    scene.run.voxels = false;
    add_mirror_walls(scene, {0, 0, 0}, {4, 4, 2.1});
    add_quad(scene, "end", {0, 0, 0}, {4, 0, 0}, {0, 4, 0}, add_grey(scene, 0));
    add_layers(scene, 0, thickness, gas);
    add_rectangle(scene, {2, 2, 2.05}, {0, 0, -1}, 1, 1, 1);
    RunOptions options;
    options.particles = 1 << 20;
    return Run(std::move(scene), options).into("end");
  };
  const SmokeOptics dense = smoke(1.5, 0.9), clear = smoke(0, 0.9), almost = smoke(1e-12, 0.9);
  const Estimate without = passed({0.5, 0.5}, {dense, dense});
  check_agree(passed({0.5, 1, 0.5}, {dense, clear, dense}), without, half_percent);
  check_agree(passed({0.5, 1, 0.5}, {dense, almost, dense}), without, half_percent);
}

namespace {

/// Number of weak emitters of 1 W on either side of one of 1 MW.
constexpr uint64_t weak_emitters = 512, strong_w = 1'000'000;

/// Beams on a black floor: each weak one on its own cell of a plane, 32 x 32 in a metre.
SceneDescription strong_among_weak() {
  SceneDescription scene;
  add_quad(scene, "floor", {0, 0, 0}, {40, 0, 0}, {0, 32, 0}, add_grey(scene, 0));
  const auto beam = [&](const glm::dvec3& at, double flux_w) {
    add_emitter(scene, EmitterShape::point, at, {0, 0, -1}, flux_w).distribution =
        Distribution::collimated;
  };
  for (uint64_t i = 0; i < 2 * weak_emitters; ++i) {
    if (i == weak_emitters) beam({36, 16, 2}, static_cast<double>(strong_w));
    beam({static_cast<double>(i % 32) + 0.5, static_cast<double>(i / 32) + 0.5, 2}, 1);
  }
  PlaneMeasure plane;
  plane.name = "weak";
  plane.corner = {0, 0, 1};
  plane.edge_u = {32, 0, 0};
  plane.edge_v = {0, 32, 0};
  plane.cells_u = plane.cells_v = 32;
  scene.planes.push_back(plane);
  return scene;
}

}  // namespace

TEST_CASE("an emitter a million times weaker than others gets its share of all random numbers") {
  SceneDescription description = strong_among_weak();
  description.run.batch_particles = 4096;
  const auto scene = compile(std::move(description));
  const std::vector<uint64_t>& cdf = scene->groups[0].emitter_cdf[0];
  constexpr uint64_t total_w = strong_w + 2 * weak_emitters;
  REQUIRE(cdf.size() == 2 * weak_emitters + 1);
  REQUIRE(scene->emitters[weak_emitters].power_w[0] == Approx(strong_w));
  // Interval bounds are exact to a rounding of double, which is 1e-10 of a weak share.
  uint64_t before = 0, power = 0;
  for (size_t i = 0; i < cdf.size(); ++i) {
    const uint64_t watts = i == weak_emitters ? strong_w : 1;
    const double share = std::ldexp(static_cast<double>(cdf[i] - before), -64);
    CHECK(share * static_cast<double>(total_w) == Approx(static_cast<double>(watts)).epsilon(1e-8));
    before = cdf[i];
    power += watts;
  }
  CHECK(power == total_w);
  CHECK(cdf.back() == ~uint64_t{0});
  // Each particle comes from the emitter whose interval of power contains its 64 bits, in exact
  // arithmetic.
  HistoryRandom random(*scene, 3);
  int weak = 0;
  for (uint64_t particle = 0; particle < (uint64_t{1} << 19) / static_cast<uint64_t>(thrift);
       ++particle) {
    random.start(particle);
    const uint64_t bits = random.bits64();
    const auto watt = static_cast<uint64_t>((static_cast<Int128>(bits) * total_w) >> 64);
    const uint64_t expected = watt < weak_emitters              ? watt
                              : watt < weak_emitters + strong_w ? weak_emitters
                                                                : watt - strong_w + 1;
    if (expected != weak_emitters) ++weak;
    REQUIRE(emitter_of_particle(*scene, 3, 0, particle) == expected);
  }
  CHECK(weak > 200 / thrift);
}

TEST_CASE("a thousand emitters a million times weaker than another get a thousandth of the light") {
  RunOptions options;
  options.particles = 1 << 24;
  options.batch_particles = 1 << 18;
  const Run run(strong_among_weak(), options);
  constexpr uint32_t beams = 1;  // excluded from computed light
  check_within(run.watts(run.blocks().planes, 0, beams), 2 * weak_emitters, half_percent);
  // Each of them gets some 17 particles.
  const double particles = static_cast<double>(run.balance().particles) / run.emitted_w();
  double squares = 0;
  for (uint32_t cell = 0; cell < 2 * weak_emitters; ++cell) {
    const double hits = run.watts(run.blocks().plane_cells, cell, beams).value * particles;
    squares += (hits - particles) * (hits - particles) / particles;
    if (thrift == 1) CHECK(hits > 0);
  }
  const double degrees = 2 * weak_emitters;
  // Poisson's variance is an upper bound, since stratified numbers are more even.
  CHECK(squares < degrees + 4 * std::sqrt((2 + 1 / particles) * degrees));
}

namespace {

/// A closed unit cube of one reflectance around a lamp of 1 W.
SceneDescription white_room(double reflectance) {
  SceneDescription scene;
  const int wall = add_grey(scene, reflectance);
  for (const BoxFace& f : faces_of_box({0, 0, 0}, {1, 1, 1}))
    add_quad(scene, f.name, f.corner, f.u, f.v, wall);
  add_point(scene, {0.4, 0.5, 0.6}, 1);
  return scene;
}

}  // namespace

TEST_CASE("a closed room of reflectance 0.999 receives its lamp's flux a thousand times") {
  RunOptions options;
  options.particles = (1 << 12) * thrift;
  options.batch_particles = 32;
  const Run run(white_room(0.999), options, {{&TallyBlocks::surfaces, {0, 1, 2, 3, 4, 5}}});
  // 0.999 in single precision is exact to 6e-8, of which a thousandth remains to be absorbed.
  check_within(run.sum(0), 1000, 4 * half_percent, 6e-5);
  CHECK(run.balance().escaped == 0);
}

TEST_CASE("a history that never ends counts as lost, and the energy balance closes") {
  SceneDescription scene = white_room(1);
  scene.run.batch_particles = 4;
  Traced run(compile(std::move(scene)), 1, 2);
  StopRule stop;
  stop.particles = 8;
  const std::atomic<bool> interrupt{false};
  run.local().run(stop, interrupt, [](const Progress&) {});
  CHECK(run.balance().lost() == run.balance().emitted);
  CHECK(run.balance().closes());
}

TEST_CASE("walls of a millimetre keep light in") {
  SceneDescription scene = white_room(0.8);
  const int wall = add_grey(scene, 0.8);
  for (const BoxFace& f : faces_of_box({-1e-3, -1e-3, -1e-3}, {1.001, 1.001, 1.001}))
    add_quad(scene, "outer " + f.name, f.corner, f.u, f.v, wall);
  RunOptions options;
  options.particles = 1 << 22;
  const Run run(std::move(scene), options);
  for (const std::string name : {"x0", "x1", "y0", "y1", "z0", "z1"})
    CHECK(run.into("outer " + name).value == 0);
  CHECK(run.balance().escaped == 0);
}

// A flight may end within a rounding of a wall and continue behind it.
TEST_CASE("a closed room of the thickest smoke leaks no light") {
  constexpr double extinction = 500;
  SceneDescription scene;
  scene.run.voxels = false;
  const int wall = add_grey(scene, 0.5);
  for (const BoxFace& f : faces_of_box({0, 0, 0}, {1, 1, 1})) {
    add_quad(scene, f.name, f.corner, f.u, f.v, wall);
    add_face_emitter(scene, f, 1);
  }
  SECTION("by a layer") {
    add_layers(scene, 0, {1}, {smoke(extinction, 1)});
  }
  SECTION("by a data set") {
    add_cells(
        scene, {0, 0, 0}, {1, 1, 1}, 4, [](const glm::dvec3&) { return extinction; }, 1);
  }
  RunOptions options;
  options.particles = 1 << 15;
  const Run run(std::move(scene), options);
  CHECK(run.balance().escaped == 0);
}

TEST_CASE("where surfaces coincide each particle hits one, and none is lost") {
  SceneDescription scene = white_room(0.5);
  const BoxFace floor = faces_of_box({0, 0, 0}, {1, 1, 1})[4];
  add_quad(scene, "carpet", floor.corner, floor.u, floor.v, add_grey(scene, 0.5));
  const Run twice(std::move(scene)), once(white_room(0.5), {.seed = 2});
  const double on_floor = twice.into("z0").value + twice.into("carpet").value;
  CHECK(on_floor == Approx(once.into("z0").value).epsilon(2e-2));
  check_agree(twice.into("z1"), once.into("z1"), half_percent);
  CHECK(twice.balance().escaped == 0);
}

}  // namespace luxodus::light
