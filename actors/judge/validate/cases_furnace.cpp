// A uniform radiation field stays uniform in smoke of any density that does not absorb, or is as
// hot as the walls. Exact for every voxel, layer and body.
#include <cmath>

#include "actors/judge/validate/case.hpp"
#include "actors/judge/validate/reference.hpp"
#include "actors/judge/validate/scene_kit.hpp"
#include "runtime/core/check.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"
#include "scenes/light/geometry/primitives.hpp"

namespace luxodus::light {

namespace {

constexpr double off_the_walls = 2e-5;  // bias of sources 0.01 mm in front of the walls
constexpr const char* walls[] = {"x0", "x1", "y0", "y1", "z0", "z1"};
constexpr const char* kinds[] = {"homogeneous", "layers", "a ball", "cells",
                                 "all over one another"};

/// Walls over a box, all of one reflectance, all emitting `exitance`.
void add_glowing_box(SceneDescription& scene, const glm::dvec3& size, double reflectance,
                     double exitance) {
  const int wall = add_grey(scene, reflectance);
  for (const BoxFace& f : faces_of_box({0, 0, 0}, size)) {
    add_quad(scene, f.name, f.corner, f.u, f.v, wall);
    add_face_emitter(scene, f, exitance * glm::length(f.u) * glm::length(f.v));
  }
}

/// Smoke without absorption, of one of the kinds, in a box of `size`.
void add_white_smoke(SceneDescription& scene, const glm::dvec3& size, size_t kind) {
  const bool all = kind == 4;
  if (kind == 0 || all) add_homogeneous(scene, smoke(1.5, 1, 0.6));
  if (kind == 1 || all)
    add_layers(scene, 0.3 * size.z, {0.3 * size.z, 0.2 * size.z},
               {smoke(0.5, 1, 0.9), smoke(4, 1, -0.5)});
  if (kind == 2 || all)
    add_ball(scene, size * glm::dvec3(0.4, 0.5, 0.6), 0.3 * std::min({size.x, size.y, size.z}),
             smoke(8, 1));
  if (kind == 3 || all)
    add_cells(
        scene, 0.1 * size, 0.7 * size, 20,
        [](const glm::dvec3& p) {
          return 3 * (1 + std::sin(9 * p.x) * std::cos(7 * p.y + 5 * p.z));
        },
        1, 0.7);
}

void add_path(PreparedCase& plan, uint32_t volume, const std::string& where, double reference) {
  plan.add(
      "path in " + where, reference,
      [volume](const Traced& run) { return run.track_length(volume); }, off_the_walls);
}

void add_walls(PreparedCase& plan, double irradiance) {
  for (const std::string wall : walls)
    plan.add(
        "flux into " + wall, irradiance, [wall](const Traced& run) { return run.into(wall); },
        off_the_walls);
}

PreparedCase room_plan(size_t kind) {
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  scene.run.voxel_edge_m = 0.5;
  add_glowing_box(scene, {1, 1, 1}, 0.5, 0.5);  // irradiance 0.5 / (1 - 0.5) = 1
  add_white_smoke(scene, {1, 1, 1}, kind);
  add_layer_group(scene, 0, 1);
  add_box_group(scene, {0.5, 0.1, 0.2}, {0.8, 0.9, 0.5});
  add_shell_group(scene, {0.4, 0.5, 0.6}, 0, 0.3);
  add_shell_group(scene, {0.5, 0.5, 0.5}, 0.3, 0.45);
  plan.quick_particles = 1 << 16;
  plan.batch_particles = 2048;
  const double fluence = exact("equilibrium_fluence", "E=1");
  const auto ball = [](double r) { return 4 * pi / 3 * r * r * r; };
  add_path(plan, 0, "the room", fluence);
  add_path(plan, 1, "a box", fluence * 0.3 * 0.8 * 0.3);
  add_path(plan, 2, "a sphere", fluence * ball(0.3));
  add_path(plan, 3, "a shell", fluence * (ball(0.45) - ball(0.3)));
  add_walls(plan, 1);
  for (const std::string wall : walls) {
    // Both sides of its first triangle: the bins of maps and pictures.
    plan.add(
        "flux into half of " + wall, 0.5,
        [wall](const Traced& run) { return run.into_patch(wall, 0); }, off_the_walls);
    plan.add("flux into the back of " + wall, 0,
             [wall](const Traced& run) { return run.into_patch(wall, 1); })
        .certain = true;
  }
  for (uint32_t v = 0; v < 8; ++v)
    plan.add(
        "path in voxel " + std::to_string(v), fluence / 8,
        [v](const Traced& run) { return run.watts(run.blocks().voxels, v); }, 2.5 * off_the_walls);
  plan.add("absorbed", 0, [](const Traced& run) { return run.absorbed_by_medium(0); }).certain =
      true;
  plan.add_closed();
  return plan;
}

/// Smoke of varying density that scatters and glows like the walls.
PreparedCase hot_smoke_plan() {
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  scene.run.voxels = false;
  add_glowing_box(scene, {1, 1, 1}, 0.3, 0.7);  // irradiance 1, fluence 4
  const auto sigma_t = [](const glm::dvec3& p) { return 0.2 + 5 * p.x * p.z; };
  Medium& m = add_cells(scene, {0, 0, 0}, {1, 1, 1}, 10, sigma_t, 0.4, 0.5);
  double power = 0;
  for (const float s : m.data.extinction) {
    m.data.emission.push_back(s);
    power += 4 * 0.6 * static_cast<double>(s) / 1000;
  }
  m.emission = MediumEmission{};
  m.emission->power_w = power;
  add_box_group(scene, {0.2, 0.2, 0.2}, {0.5, 0.9, 0.6});
  add_box_group(scene, {0, 0, 0}, {0.5, 1, 0.5});
  add_box_group(scene, {0.5, 0, 0.5}, {1, 1, 1});
  add_path(plan, 0, "a box", 4 * 0.3 * 0.7 * 0.4);
  add_path(plan, 1, "the thin quarter", 4 * 0.25);
  add_path(plan, 2, "the thick quarter", 4 * 0.25);
  // Emitted: 4 x 0.6 x the mean extinction, 0.2 + 5 x (mean x) (mean z), x volume.
  const auto absorbed = [&](uint32_t group, const std::string& where, double x, double z,
                            double volume) {
    plan.add(
        "absorbed in " + where, 4 * 0.6 * (0.2 + 5 * x * z) * volume,
        [group](const Traced& run) { return run.absorbed_in(group); }, 5 * off_the_walls);
  };
  absorbed(0, "a box", 0.35, 0.4, 0.3 * 0.7 * 0.4);
  absorbed(1, "the thin quarter", 0.25, 0.25, 0.25);
  absorbed(2, "the thick quarter", 0.75, 0.75, 0.25);
  add_walls(plan, 1);
  return plan;
}

/// Blanco and Fournier: the mean path through a body is four volumes divided by its surface.
PreparedCase box_path_plan(size_t kind) {
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  scene.run.voxels = false;
  add_glowing_box(scene, {6, 4, 3}, 0, 1 / 108.0);
  add_white_smoke(scene, {6, 4, 3}, kind);
  add_layer_group(scene, 0, 3);
  add_layer_group(scene, 1, 2);
  plan.quick_particles = 1 << 16;
  plan.batch_particles = 2048;
  add_path(plan, 0, "the box", exact("mean_track_box", "6x4x3"));
  add_path(plan, 1, "its middle third", exact("mean_track_box", "6x4x3") / 3);
  return plan;
}

PreparedCase body_path_plan(const Mesh& body, double exact_mean) {
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  scene.run.voxels = false;
  Mesh inside = body;
  for (glm::uvec3& t : inside.triangles) std::swap(t.y, t.z);
  const int black = add_grey(scene, 0);
  Emitter& e = add_emitter(scene, EmitterShape::mesh, {0, 0, 0.5}, {0, 0, -1}, 1);
  e.mesh = inside;
  e.body_material = scene.materials[static_cast<size_t>(black)].name;
  add_homogeneous(scene, smoke(2, 1, 0.5));
  add_ball(scene, {0.2, 0, 0.3}, 0.5, smoke(5, 1));
  add_layer_group(scene, -5, 5);
  plan.quick_particles = 1 << 15;
  plan.batch_particles = 2048;
  // For the mesh itself, for which the law is exact, too.
  const double mean = 4 * std::abs(signed_volume_of(body)) / area_of(body);
  add_path(plan, 0, "the body", mean);
  plan.compute("mean path of the mesh", exact_mean, mean, 3e-3);
  return plan;
}

}  // namespace

void add_furnace_cases(Cases& cases) {
  for (size_t kind = 0; kind < 5; ++kind) {
    cases.push_back({"furnace", std::string("furnace, white smoke: ") + kinds[kind],
                     "fluence = 4 x irradiance", [kind] { return room_plan(kind); }});
  }
  cases.push_back({"furnace", "furnace, smoke as hot as the walls", "absorbed = emitted",
                   [] { return hot_smoke_plan(); }});
  for (size_t kind = 0; kind < 5; ++kind) {
    cases.push_back({"furnace", std::string("mean path in a box, white smoke: ") + kinds[kind],
                     "misc_exact.csv, 4 V / S", [kind] { return box_path_plan(kind); }});
  }
  const auto add_body = [&](const std::string& name, const Result<Shape>& shape, double mean) {
    LUX_CHECK(shape.ok(), "no body");
    cases.push_back({"furnace", "mean path in a " + name, "misc_exact.csv, 4 V / S",
                     [mesh = shape->mesh, mean] { return body_path_plan(mesh, mean); }});
  };
  add_body("drum", shapes::cylinder(1, 2, 200), exact("mean_track_cylinder", "R=1;H=2"));
  add_body("sphere", shapes::sphere(1, 1e-3), exact("mean_track_sphere", "R=1"));
}

}  // namespace luxodus::light
