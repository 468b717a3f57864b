// Infinite layers of gas that absorb and glow and do not scatter: exponential integrals.
#include <algorithm>

#include "tests/optics/light_kit.hpp"

namespace luxodus::light {
namespace {

constexpr double edge = 4;  // [m] of the mirrored box that stands for infinity
constexpr int64_t least_particles = 1 << 20;
constexpr int64_t most_particles = 1 << 25;

int64_t affordable(double share) {
  return std::clamp(particles_for(share), least_particles, most_particles);
}

/// Black floor and ceiling (objects 4 and 5) around gas of `height`, which is infinite otherwise.
SceneDescription black_plates(double height) {
  SceneDescription scene;
  scene.run.voxels = false;
  add_mirror_walls(scene, {0, 0, 0}, {edge, edge, height});
  const int black = add_grey(scene, 0);
  const std::vector<Face> faces = faces_of_box({0, 0, 0}, {edge, edge, height});
  add_quad(scene, "floor", faces[4].corner, faces[4].u, faces[4].v, black);
  add_quad(scene, "ceiling", faces[5].corner, faces[5].u, faces[5].v, black);
  return scene;
}

/// Gas of one extinction from `low` to `high` that glows evenly with a power of 1 and absorbs.
void add_glowing_gas(SceneDescription& scene, double low, double high, double extinction) {
  Medium& gas = add_cells(
      scene, {0, 0, low}, {edge, edge, high - low}, 2,
      [&](const glm::dvec3&) { return extinction; }, 0);
  gas.data.emission = gas.data.extinction;
  gas.emission = MediumEmission{};
  gas.emission->power_w = 1;
}

/// Rows of misc_exact.csv of that name.
std::vector<Row> exact_rows(const std::string& id) {
  std::vector<Row> rows = reference_table("misc_exact.csv");
  std::erase_if(rows, [&](const Row& row) { return row.text("id") != id; });
  REQUIRE_FALSE(rows.empty());
  return rows;
}

}  // namespace

TEST_CASE("a layer of gas passes and absorbs of diffuse light what the exponential integral says") {
  for (const Row& row : exact_rows("2E3")) {
    const std::string& depth = row.text("parameters");
    const double passed = row.number("value");
    if (passed < 1e-8) continue;  // nothing that could be counted
    INFO(depth);
    SceneDescription scene = black_plates(1);
    add_homogeneous(scene, smoke(parameter(depth, "tau"), 0));
    add_face_emitter(scene, faces_of_box({0, 0, 0}, {edge, edge, 1})[5], 1);
    RunOptions options;
    options.particles = affordable(passed);
    const Run run(std::move(scene), options);
    constexpr double slack = 5e-5;  // the light stands 0.01 mm off the ceiling
    check_share(run.into("floor"), passed, options.particles, 1, slack * passed);
    check_within(run.absorbed_by_medium(0), exact("slab_emissivity", depth), half_percent, slack);
    CHECK(run.ledger().escaped == 0);
  }
}

TEST_CASE("of the light of an evenly glowing layer the share that escapes is the exact one") {
  for (const Row& row : exact_rows("slab_emission_escape")) {
    INFO(row.text("parameters"));
    SceneDescription scene = black_plates(1);
    add_glowing_gas(scene, 0, 1, parameter(row.text("parameters"), "tau"));
    RunOptions options;
    options.particles = affordable(row.number("value"));
    const Run run(std::move(scene), options, {{&TallyBlocks::surfaces, {4, 5}}});
    check_share(run.sum(0), row.number("value"), options.particles);
    check_within(run.absorbed_by_medium(0), 1 - row.number("value"), half_percent);
  }
}

TEST_CASE("a flame between absorbing layers reaches floor and ceiling in the exact shares") {
  const std::vector<Row> to_floor = exact_rows("flame_layer_to_floor"),
                         to_ceiling = exact_rows("flame_layer_to_ceiling"),
                         absorbed = exact_rows("flame_layer_absorbed");
  REQUIRE(to_floor.size() == to_ceiling.size());
  REQUIRE(to_floor.size() == absorbed.size());
  for (size_t i = 0; i < to_floor.size(); ++i) {
    // "tau floor->ceiling 0.1|1|2": depths of the layers, floor to ceiling.
    std::string depths = to_floor[i].text("parameters");
    INFO(depths);
    REQUIRE(depths.rfind("tau floor->ceiling ", 0) == 0);
    depths.erase(0, depths.rfind(' ') + 1);
    const size_t bar = depths.find('|');
    const double below = std::stod(depths), flame = std::stod(depths.substr(bar + 1)),
                 above = std::stod(depths.substr(depths.rfind('|') + 1));
    SceneDescription scene = black_plates(3);
    add_glowing_gas(scene, 1, 2, flame);
    add_layers(scene, 0, {1, 1, 1}, {smoke(below, 0), smoke(0, 0), smoke(above, 0)});
    RunOptions options;
    options.particles = affordable(to_ceiling[i].number("value"));
    const Run run(std::move(scene), options, {{&TallyBlocks::media_power, {0, 1}}});
    check_share(run.into("floor"), to_floor[i].number("value"), options.particles);
    check_share(run.into("ceiling"), to_ceiling[i].number("value"), options.particles);
    check_share(run.sum(0), absorbed[i].number("value"), options.particles);
  }
}

}  // namespace luxodus::light
