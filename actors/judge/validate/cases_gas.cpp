// Infinite layers of gas that absorb and glow without scattering: exponential integrals.
#include "actors/judge/validate/case.hpp"
#include "actors/judge/validate/reference.hpp"
#include "actors/judge/validate/scene_kit.hpp"
#include "runtime/core/check.hpp"

namespace luxodus::light {

namespace {

constexpr double gas_edge = 4;  // [m] of the mirrored box that represents infinity

/// Black floor and ceiling (objects 4 and 5) around gas of `height`, otherwise infinite.
SceneDescription black_plates(double height) {
  SceneDescription scene;
  scene.run.voxels = false;
  add_mirror_walls(scene, {0, 0, 0}, {gas_edge, gas_edge, height});
  const int black = add_grey(scene, 0);
  const std::vector<BoxFace> faces = faces_of_box({0, 0, 0}, {gas_edge, gas_edge, height});
  add_quad(scene, "floor", faces[4].corner, faces[4].u, faces[4].v, black);
  add_quad(scene, "ceiling", faces[5].corner, faces[5].u, faces[5].v, black);
  return scene;
}

/// Gas of uniform extinction from `low` to `high` that emits uniformly with a power of 1 and
/// absorbs.
void add_glowing_gas(SceneDescription& scene, double low, double high, double extinction) {
  Medium& gas = add_cells(
      scene, {0, 0, low}, {gas_edge, gas_edge, high - low}, 2,
      [&](const glm::dvec3&) { return extinction; }, 0);
  gas.data.emission = gas.data.extinction;
  gas.emission = MediumEmission{};
  gas.emission->power_w = 1;
}

PreparedCase layer_plan(const std::string& depth, double passed) {
  PreparedCase plan;
  plan.scene = black_plates(1);
  add_homogeneous(plan.scene, smoke(parameter(depth, "tau"), 0));
  add_face_emitter(plan.scene, faces_of_box({0, 0, 0}, {gas_edge, gas_edge, 1})[5], 1);
  constexpr double off_the_ceiling = 5e-5;  // bias of a light 0.01 mm in front of it
  plan.add(
      "absorbed", 1 - passed, [](const Traced& run) { return run.absorbed_by_medium(0); },
      off_the_ceiling);
  plan.add(
      "passed", passed, [](const Traced& run) { return run.into("floor"); }, off_the_ceiling);
  plan.add_closed();
  return plan;
}

/// A black body's exitance would be 1 / (4 tau) if the gas emits 1: a plate receives its emissivity
/// times that.
PreparedCase glowing_layer_plan(double tau, double escaping, double emissivity) {
  PreparedCase plan;
  plan.scene = black_plates(1);
  add_glowing_gas(plan.scene, 0, 1, tau);
  plan.sums.push_back({&TallyBlocks::surfaces, {4, 5}});
  plan.add("escaped", escaping, [](const Traced& run) { return run.sum(0); });
  plan.add("absorbed", 1 - escaping, [](const Traced& run) { return run.absorbed_by_medium(0); });
  for (const std::string plate : {"floor", "ceiling"}) {
    plan.add("emissivity towards the " + plate, emissivity,
             [=](const Traced& run) { return run.into(plate) * (4 * tau); })
        .unit = 4 * tau;
  }
  return plan;
}

struct Flame {
  double below, flame, above;             // optical depths, floor to ceiling
  double to_floor, to_ceiling, absorbed;  // shares
};

PreparedCase flame_plan(const Flame& f) {
  PreparedCase plan;
  plan.scene = black_plates(3);
  add_glowing_gas(plan.scene, 1, 2, f.flame);
  add_layers(plan.scene, 0, {1, 1, 1}, {smoke(f.below, 0), smoke(0, 0), smoke(f.above, 0)});
  plan.sums.push_back({&TallyBlocks::media_power, {0, 1}});
  plan.add("to the floor", f.to_floor, [](const Traced& run) { return run.into("floor"); });
  plan.add("to the ceiling", f.to_ceiling, [](const Traced& run) { return run.into("ceiling"); });
  plan.add("absorbed", f.absorbed, [](const Traced& run) { return run.sum(0); });
  return plan;
}

void add_flames(Cases& cases) {
  const std::vector<Row> to_floor = rows_where(exact_table, "id", "flame_layer_to_floor"),
                         to_ceiling = rows_where(exact_table, "id", "flame_layer_to_ceiling"),
                         absorbed = rows_where(exact_table, "id", "flame_layer_absorbed");
  LUX_CHECK(to_floor.size() == to_ceiling.size() && to_floor.size() == absorbed.size(),
            "three rows for each flame");
  for (size_t i = 0; i < to_floor.size(); ++i) {
    // "tau floor->ceiling 0.1|1|2": depths of the layers, floor to ceiling.
    std::string depths = to_floor[i].text("parameters");
    depths.erase(0, depths.rfind(' ') + 1);
    const Flame flame{std::stod(depths),
                      std::stod(depths.substr(depths.find('|') + 1)),
                      std::stod(depths.substr(depths.rfind('|') + 1)),
                      to_floor[i].number("value"),
                      to_ceiling[i].number("value"),
                      absorbed[i].number("value")};
    cases.push_back({"gas", "flame between layers of depth " + depths, exact_table,
                     [flame] { return flame_plan(flame); }});
  }
}

}  // namespace

void add_gas_cases(Cases& cases) {
  for (const Row& row : rows_where(exact_table, "id", "2E3")) {
    const std::string depth = row.text("parameters");
    const double passed = row.number("value");
    cases.push_back({"gas", "layer of gas, " + depth, "misc_exact.csv, 2 E3(tau)",
                     [=] { return layer_plan(depth, passed); }});
  }
  for (const Row& row : rows_where(exact_table, "id", "slab_emission_escape")) {
    const std::string depth = row.text("parameters");
    const double tau = parameter(depth, "tau"), escaping = row.number("value");
    const double emissivity = exact("slab_emissivity", depth);
    cases.push_back({"gas", "glowing layer, " + depth, exact_table,
                     [=] { return glowing_layer_plan(tau, escaping, emissivity); }});
  }
  add_flames(cases);
}

}  // namespace luxodus::light
