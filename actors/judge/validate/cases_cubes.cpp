// Closed cubes with diffuse walls against the continuous radiosity solution, for each wall and for
// 4 x 4 parts of it; and cubes filled with absorbing gas, between black walls.
#include <algorithm>
#include <cmath>

#include "actors/judge/validate/case.hpp"
#include "actors/judge/validate/reference.hpp"
#include "actors/judge/validate/scene_kit.hpp"
#include "runtime/core/check.hpp"

namespace luxodus::light {

namespace {

constexpr int parts = 4;

std::string part_name(const std::string& wall, int i, int j) {
  return wall + " " + std::to_string(i) + " " + std::to_string(j);
}

/// A wall as 4 x 4 objects in the order of the table, and one surface group.
void add_wall(SceneDescription& scene, const BoxFace& face, const Row& row) {
  LUX_CHECK(row.text("wall").substr(0, 2) == face.name, "walls of a cube in another order");
  const int material = add_grey(scene, row.number("rho"));
  SurfaceGroupMeasure group;
  group.name = row.text("wall");
  // i and j run along the wall's axes in the order x, y, z.
  const bool u_first =
      face.u.x + 2 * face.u.y + 3 * face.u.z < face.v.x + 2 * face.v.y + 3 * face.v.z;
  const glm::dvec3 u = face.u / static_cast<double>(parts), v = face.v / static_cast<double>(parts);
  for (int i = 0; i < parts; ++i) {
    for (int j = 0; j < parts; ++j) {
      const glm::dvec3 corner = face.corner + u * static_cast<double>(u_first ? i : j) +
                                v * static_cast<double>(u_first ? j : i);
      add_quad(scene, part_name(group.name, i, j), corner, u, v, material);
      group.objects.push_back(part_name(group.name, i, j));
    }
  }
  scene.surface_groups.push_back(group);
}

SceneDescription cube_of(const std::vector<Row>& walls) {
  SceneDescription scene;
  const std::vector<BoxFace> faces = faces_of_box({0, 0, 0}, {1, 1, 1});
  LUX_CHECK(walls.size() == faces.size(), "a cube has six walls");
  for (size_t f = 0; f < faces.size(); ++f) {
    add_wall(scene, faces[f], walls[f]);
    const double exitance = walls[f].number("M_emitted");
    if (exitance > 0) add_face_emitter(scene, faces[f], exitance);
  }
  if (!walls[0].text("point_source_xyz").empty()) {
    const std::vector<double> p = walls[0].numbers("point_source_xyz");
    add_point(scene, {p[0], p[1], p[2]}, 1);
  }
  return scene;
}

/// Parts with equal reference flux: usually mirror images of one another.
struct Alike {
  std::vector<uint32_t> parts;  // numbers of objects: walls, i, j, in the order of the table
  double incident = 0;          // flux into all of them
};

std::vector<Alike> alike_parts(const std::string& set) {
  constexpr double same = 2e-7;  // the table has eight digits
  std::vector<Alike> classes;
  uint32_t part = 0;
  for (const Row& row : rows_where("cube_radiosity_patches.csv", "set", set)) {
    const double flux = row.number("E_incident_avg") / (parts * parts);
    auto at = std::find_if(classes.begin(), classes.end(), [&](const Alike& c) {
      return std::abs(c.incident / static_cast<double>(c.parts.size()) - flux) < same;
    });
    if (at == classes.end()) at = classes.insert(at, Alike{});
    at->parts.push_back(part++);
    at->incident += flux;
  }
  LUX_CHECK(part == 6 * parts * parts, "a cube's walls have 96 parts");
  return classes;
}

PreparedCase cube_plan(const std::string& set) {
  const std::vector<Row> walls = rows_where("cube_radiosity.csv", "set", set);
  PreparedCase plan;
  plan.scene = cube_of(walls);
  // A hundred reflections at 0.95 take as long as five histories.
  plan.quick_particles = set.starts_with("p05") ? 1 << 16 : 1 << 18;
  // Biases of sources that are 0.01 mm in front of their walls.
  constexpr double of_walls = 2e-5, of_parts = 1e-4;
  for (uint32_t w = 0; w < walls.size(); ++w) {
    plan.add(
        "flux into " + walls[w].text("wall"), walls[w].number("E_incident_avg"),
        [w](const Traced& run) { return run.into_group(w); }, of_walls);
  }
  const std::vector<Alike> classes = alike_parts(set);
  for (uint32_t c = 0; c < classes.size(); ++c) {
    const Alike& alike = classes[c];
    plan.sums.push_back({&TallyBlocks::surfaces, alike.parts});
    plan.add(
        "flux into " + std::to_string(alike.parts.size()) + " parts like " +
            plan.scene.objects[alike.parts[0]].name,
        alike.incident, [c](const Traced& run) { return run.sum(c); }, of_parts);
    // Each part separately, so that their errors cannot cancel.
    const auto count = static_cast<double>(alike.parts.size());
    for (const uint32_t part : alike.parts) {
      const std::string name = plan.scene.objects[part].name;
      plan.add(
          "flux into " + name, alike.incident / count,
          [name](const Traced& run) { return run.into(name); }, of_parts);
    }
  }
  plan.add_closed();
  return plan;
}

PreparedCase gas_cube_plan(const Row& row) {
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  scene.run.voxels = false;
  const int black = add_grey(scene, 0);
  const std::vector<BoxFace> faces = faces_of_box({0, 0, 0}, {1, 1, 1});
  for (const BoxFace& f : faces) add_quad(scene, f.name, f.corner, f.u, f.v, black);
  add_face_emitter(scene, faces[0], 1);
  const double tau = row.number("tau_side");
  constexpr double off_the_wall = 2e-5;
  plan.add(
      "flux into the opposite wall", row.number("to_opposite_wall"),
      [](const Traced& run) { return run.into("x1"); }, off_the_wall);
  for (const std::string side : {"y0", "y1", "z0", "z1"})
    plan.add(
        "flux into " + side, row.number("to_each_side_wall"),
        [side](const Traced& run) { return run.into(side); }, off_the_wall);
  if (tau > 0) {
    add_homogeneous(scene, smoke(tau, 0));
    plan.add(
        "absorbed by the gas", row.number("absorbed_in_volume"),
        [](const Traced& run) { return run.absorbed_by_medium(0); }, off_the_wall);
  }
  plan.add_closed();
  return plan;
}

}  // namespace

void add_cube_cases(Cases& cases) {
  std::string last;
  for (const Row& row : reference_table("cube_radiosity.csv")) {
    const std::string set = row.text("set");
    if (set == last) continue;
    last = set;
    cases.push_back({"cube", "cube " + set, "cube_radiosity.csv, cube_radiosity_patches.csv",
                     [set] { return cube_plan(set); }});
  }
  for (const Row& row : reference_table("cube_absorbing.csv")) {
    cases.push_back({"cube", "cube of gas, optical depth " + row.text("tau_side"),
                     "cube_absorbing.csv", [row] { return gas_cube_plan(row); }});
  }
}

}  // namespace luxodus::light
