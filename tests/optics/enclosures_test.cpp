// Closed rooms without smoke: cubes against the continuous radiosity solution, spheres and plates
// against closed forms.
#include <algorithm>
#include <cmath>

#include "scenes/geometry/mesh_tools.hpp"
#include "scenes/geometry/primitives.hpp"
#include "tests/optics/light_kit.hpp"

namespace luxodus::light {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr int parts = 4;

std::string part_name(const std::string& wall, int i, int j) {
  return wall + " " + std::to_string(i) + " " + std::to_string(j);
}

struct Wall {
  std::string name;  // of the tables: x0 .. z0_floor, z1_ceiling
  double reflectance = 0, exitance = 0, incident = 0;
};

std::vector<std::string> set_names() {
  std::vector<std::string> names;
  for (const Row& row : reference_table("cube_radiosity.csv")) {
    if (names.empty() || names.back() != row.text("set")) names.push_back(row.text("set"));
  }
  return names;
}

/// A unit cube whose walls are 4 x 4 objects each, and one surface group per wall.
SceneDescription cube_of(const std::string& set, std::vector<Wall>& walls) {
  SceneDescription scene;
  std::vector<Row> rows;
  for (const Row& row : reference_table("cube_radiosity.csv")) {
    if (row.text("set") == set) rows.push_back(row);
  }
  const std::vector<Face> faces = faces_of_box({0, 0, 0}, {1, 1, 1});
  REQUIRE(rows.size() == faces.size());
  for (size_t f = 0; f < faces.size(); ++f) {
    const Row& row = rows[f];
    const Wall wall{row.text("wall"), row.number("rho"), row.number("M_emitted"),
                    row.number("E_incident_avg")};
    REQUIRE(wall.name.substr(0, 2) == faces[f].name);
    const int material = add_grey(scene, wall.reflectance);
    SurfaceGroupMeasure group;
    group.name = wall.name;
    // i and j run along the wall's axes in the order x, y, z.
    const bool u_first = faces[f].u.x + 2 * faces[f].u.y + 3 * faces[f].u.z <
                         faces[f].v.x + 2 * faces[f].v.y + 3 * faces[f].v.z;
    const glm::dvec3 u = faces[f].u / static_cast<double>(parts);
    const glm::dvec3 v = faces[f].v / static_cast<double>(parts);
    for (int i = 0; i < parts; ++i) {
      for (int j = 0; j < parts; ++j) {
        const glm::dvec3 corner = faces[f].corner + u * static_cast<double>(u_first ? i : j) +
                                  v * static_cast<double>(u_first ? j : i);
        add_quad(scene, part_name(wall.name, i, j), corner, u, v, material);
        group.objects.push_back(part_name(wall.name, i, j));
      }
    }
    scene.surface_groups.push_back(group);
    if (wall.exitance > 0) add_face_emitter(scene, faces[f], wall.exitance);
    walls.push_back(wall);
  }
  if (!rows[0].text("point_source_xyz").empty()) {
    const std::vector<double> p = rows[0].numbers("point_source_xyz");
    add_point(scene, {p[0], p[1], p[2]}, 1);
  }
  return scene;
}

}  // namespace

TEST_CASE("walls and their parts in diffuse cubes receive what continuous radiosity says") {
  const std::vector<Row> patches = reference_table("cube_radiosity_patches.csv");
  for (const std::string& set : set_names()) {
    std::vector<Wall> walls;
    RunOptions options;
    if (set.find("rho.95") != std::string::npos) options.particles /= 4;
    const Run run(cube_of(set, walls), options);
    for (uint32_t w = 0; w < walls.size(); ++w) {
      INFO(set << " " << walls[w].name);
      check_within(run.into_group(w), walls[w].incident, 6e-3, 2e-5);
    }
    for (const Row& row : patches) {
      if (row.text("set") != set) continue;
      INFO(set << " " << row.text("wall") << " " << row.text("i") << " " << row.text("j"));
      const double flux = row.number("E_incident_avg") / (parts * parts);
      const auto name = part_name(row.text("wall"), static_cast<int>(row.number("i")),
                                  static_cast<int>(row.number("j")));
      check_within(run.into(name), flux, 3.5e-2, 2e-4);
    }
    // A hit within rounding of an edge may go on from behind the other wall: one particle in
    // millions.
    for (uint32_t side = 0; side < 6; ++side) CHECK(run.escaped(side).value < 1e-5);
  }
}

TEST_CASE("a plane in a wall counts what the wall receives, cell by cell") {
  std::vector<Wall> walls;
  SceneDescription scene = cube_of("c03_office", walls);
  const Face floor = faces_of_box({0, 0, 0}, {1, 1, 1})[4];
  PlaneMeasure plane;
  plane.name = "floor";
  plane.corner = floor.corner;
  plane.edge_u = floor.u;
  plane.edge_v = floor.v;
  plane.cells_u = plane.cells_v = parts;
  scene.planes.push_back(plane);
  const Run run(std::move(scene));
  for (int j = 0; j < parts; ++j) {
    for (int i = 0; i < parts; ++i) {
      const auto bin = static_cast<uint32_t>(j * parts + i);
      const double sum = run.watts(run.blocks().plane_cells, bin, 0).value +
                         run.watts(run.blocks().plane_cells, bin, 1).value;
      // The same flights end on both; edges between the cells are a few ulps apart.
      CHECK(sum == Approx(run.into(part_name("z0_floor", i, j)).value).epsilon(1e-4));
    }
  }
}

TEST_CASE("in an integrating sphere each reflection adds one and the same irradiance everywhere") {
  const double bound = 1e-3;
  auto shape = shapes::sphere(1, bound);
  REQUIRE(shape.ok());
  for (const Row& row : reference_table("misc_exact.csv")) {
    const bool total = row.text("id") == "sphere_integrating";
    if (!total && row.text("id") != "sphere_integrating_indirect") continue;
    INFO(row.text("id") << " " << row.text("parameters"));
    SceneDescription scene;
    add_mesh(scene, "sphere", shape->mesh,
             add_grey(scene, parameter(row.text("parameters"), "rho")));
    add_point(scene, {0.3, 0.2, -0.4}, 1);
    RunOptions options;
    const bool long_lives = parameter(row.text("parameters"), "rho") > 0.9;
    options.particles = total && !long_lives ? 1 << 17 : 1 << 14;
    options.batch_particles = 256;
    for (size_t t = 0; !total && t < shape->mesh.triangles.size();
         t += shape->mesh.triangles.size() / 3) {
      const glm::uvec3 c = shape->mesh.triangles[t];
      const auto& p = shape->mesh.positions;
      ProbeMeasure probe;
      probe.name = "probe " + std::to_string(t);
      probe.position = (p[c[0]] + p[c[1]] + p[c[2]]) / 3.0;
      probe.normal = -glm::normalize(glm::cross(p[c[1]] - p[c[0]], p[c[2]] - p[c[0]]));
      scene.probes.push_back(probe);
    }
    const size_t probes = scene.probes.size();
    const double lm_per_w = efficacy_lm_per_w(scene.emitters[0].spectrum);
    if (total) {
      // Over a closed surface of one reflectance the flux does not depend on its shape.
      const Run run(std::move(scene), options);
      check_within(run.into("sphere") * (1 / (4 * pi)), row.number("value"), 6e-3);
    } else {
      scene.run.eye_share = 10;
      const Run run(std::move(scene), options);
      for (uint32_t p = 0; p < probes; ++p) {
        // The mesh stands off the sphere by `bound`, and no point of it sees its own facet.
        check_within(run.value(run.blocks().probes, p) * (1 / lm_per_w), row.number("value"), 3e-2,
                     4e-3);
      }
    }
  }
}

TEST_CASE("a sphere's port lets out the share that its solid angle and area say") {
  auto shape = shapes::sphere(1, 5e-4);
  REQUIRE(shape.ok());
  for (const Row& row : reference_table("misc_exact.csv")) {
    if (row.text("id") != "sphere_port_exit") continue;
    const double rho = parameter(row.text("parameters"), "rho");
    const double share = parameter(row.text("parameters"), "f");
    Mesh open = shape->mesh;
    std::erase_if(open.triangles, [&](const glm::uvec3& t) {
      return (open.positions[t[0]].z + open.positions[t[1]].z + open.positions[t[2]].z) / 3 >
             1 - 2 * share;
    });
    const double cut = 1 - area_of(open) / area_of(shape->mesh);
    REQUIRE(cut == Approx(share).epsilon(2e-2));  // whole facets are cut
    SceneDescription scene;
    add_mesh(scene, "sphere", open, add_grey(scene, rho));
    add_point(scene, {0, 0, 0}, 1);
    RunOptions options;
    options.particles = 1 << 18;
    const Run run(std::move(scene), options);
    Estimate escaped{0, 0};
    for (uint32_t side = 0; side < 6; ++side) {
      escaped.value += run.escaped(side).value;
      escaped.standard_error += run.escaped(side).standard_error;
    }
    INFO(row.text("parameters"));
    check_within(escaped, cut / (1 - rho * (1 - cut)), 1e-2, 2e-3);
    CHECK(cut / (1 - rho * (1 - cut)) == Approx(row.number("value")).epsilon(2e-2));
  }
}

TEST_CASE("concentric spheres share light by their areas") {
  for (const Row& row : reference_table("misc_exact.csv")) {
    if (row.text("id") != "concentric_absorbed_inner") continue;
    const std::string& p = row.text("parameters");
    const double r1 = parameter(p, "r1"), r2 = parameter(p, "r2");
    // Cut alike, so that the ratio of their areas is exact.
    const auto inner = shapes::sphere(r1, 1e-3 * r1), outer = shapes::sphere(r2, 1e-3 * r2);
    REQUIRE(inner.ok());
    REQUIRE(outer.ok());
    REQUIRE(inner->mesh.triangles.size() == outer->mesh.triangles.size());
    SceneDescription scene;
    add_mesh(scene, "outer", outer->mesh, add_grey(scene, parameter(p, "rho2")));
    const int material = add_grey(scene, parameter(p, "rho1"));
    Emitter& e = add_emitter(scene, EmitterShape::mesh, {0, 0, 0}, {0, 0, -1}, 1);
    e.mesh = inner->mesh;
    e.body_material = scene.materials[static_cast<size_t>(material)].name;
    const std::string body = e.name + " body";
    RunOptions options;
    options.particles = 1 << 18;
    const Run run(std::move(scene), options);
    INFO(p);
    const double absorbed = row.number("value");
    check_near(run.absorbed_by(body), absorbed, 1.5e-3, 2e-4 * absorbed);
    check_near(run.absorbed_by("outer"), 1 - absorbed, 1.5e-3, 2e-4);
  }
}

namespace {

/// Two unit squares facing each other between perfect mirrors: infinite plates. The lower one
/// emits 1.
SceneDescription plates(double r1, double r2, double distance) {
  SceneDescription scene;
  const int mirror = add_mirror(scene, 1);
  const std::vector<Face> faces = faces_of_box({0, 0, 0}, {1, 1, distance});
  for (size_t f = 0; f < 4; ++f)
    add_quad(scene, faces[f].name, faces[f].corner, faces[f].u, faces[f].v, mirror);
  add_quad(scene, "plate 1", faces[4].corner, faces[4].u, faces[4].v, add_grey(scene, r1));
  add_quad(scene, "plate 2", faces[5].corner, faces[5].u, faces[5].v, add_grey(scene, r2));
  add_face_emitter(scene, faces[4], 1);
  return scene;
}

}  // namespace

TEST_CASE("infinite parallel plates exchange a geometric series") {
  const std::vector<Row> rows = reference_table("misc_exact.csv");
  for (size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].text("id") != "parallel_plates_E2") continue;
    const std::string& p = rows[i].text("parameters");
    RunOptions options;
    options.particles = 1 << 15;
    options.batch_particles = 1 << 9;
    const Run run(plates(parameter(p, "r1"), parameter(p, "r2"), 0.5), options);
    INFO(p);
    check_within(run.into("plate 2"), rows[i].number("value"), 8e-3, 3e-5);
    check_within(run.into("plate 1"), rows[i + 1].number("value"), 8e-3, 3e-5);
  }
}

TEST_CASE("gas between infinite plates takes its share of every passage") {
  const std::vector<Row> rows = reference_table("misc_exact.csv");
  for (size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].text("id") != "parallel_plates_gas_E2") continue;
    const std::string& p = rows[i].text("parameters");
    SceneDescription scene = plates(parameter(p, "r1"), parameter(p, "r2"), 0.5);
    scene.run.voxels = false;
    add_homogeneous(scene, smoke(parameter(p, "tau") / 0.5, 0));
    const Run run(std::move(scene));
    INFO(p);
    check_within(run.into("plate 2"), rows[i].number("value"), 3e-3, 5e-5);
    check_within(run.absorbed_by_medium(0), rows[i + 1].number("value"), 2e-3, 5e-5);
  }
}

TEST_CASE("a cube of absorbing gas passes the exact share to every wall") {
  for (const Row& row : reference_table("cube_absorbing.csv")) {
    SceneDescription scene;
    scene.run.voxels = false;
    const int black = add_grey(scene, 0);
    const std::vector<Face> faces = faces_of_box({0, 0, 0}, {1, 1, 1});
    for (const Face& f : faces) add_quad(scene, f.name, f.corner, f.u, f.v, black);
    add_face_emitter(scene, faces[0], 1);
    const double tau = row.number("tau_side");
    if (tau > 0) add_homogeneous(scene, smoke(tau, 0));
    const Run run(std::move(scene));
    INFO("tau " << tau);
    check_near(run.into("x1"), row.number("to_opposite_wall"), 6e-4, 1e-5);
    for (const std::string side : {"y0", "y1", "z0", "z1"})
      check_near(run.into(side), row.number("to_each_side_wall"), 6e-4, 1e-5);
    if (tau > 0)
      check_near(run.absorbed_by_medium(0), row.number("absorbed_in_volume"), 6e-4, 1e-5);
  }
}

}  // namespace luxodus::light
