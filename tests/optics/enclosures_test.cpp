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

/// Parts that the reference gives one and the same flux: images of one another, as a rule.
struct Alike {
  std::vector<uint32_t> parts;  // numbers of objects
  double incident = 0;          // flux into all of them
};

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

/// The parts of a cube's walls, sorted into those that are alike. Objects stand in the order of the
/// table: walls, i, j.
std::vector<Alike> alike_parts(const std::string& set) {
  constexpr double same = 2e-7;  // the table has eight digits
  std::vector<Alike> classes;
  uint32_t part = 0;
  for (const Row& row : reference_table("cube_radiosity_patches.csv")) {
    if (row.text("set") != set) continue;
    const double flux = row.number("E_incident_avg") / (parts * parts);
    auto at = std::find_if(classes.begin(), classes.end(), [&](const Alike& c) {
      return std::abs(c.incident / static_cast<double>(c.parts.size()) - flux) < same;
    });
    if (at == classes.end()) at = classes.insert(at, Alike{});
    at->parts.push_back(part++);
    at->incident += flux;
  }
  REQUIRE(part == 6 * parts * parts);
  return classes;
}

void check_cube(const std::string& set, int64_t particles) {
  INFO(set);
  std::vector<Wall> walls;
  SceneDescription scene = cube_of(set, walls);
  const std::vector<Alike> classes = alike_parts(set);
  std::vector<BinSum> sums;
  for (const Alike& c : classes) sums.push_back({&TallyBlocks::surfaces, c.parts});
  std::vector<std::string> names;
  for (const Object& o : scene.objects) names.push_back(o.name);
  RunOptions options;
  options.particles = particles;
  const Run run(std::move(scene), options, sums);
  for (uint32_t w = 0; w < walls.size(); ++w) {
    INFO(walls[w].name);
    check_within(run.into_group(w), walls[w].incident, half_percent, 2e-5);
  }
  for (uint32_t c = 0; c < classes.size(); ++c) {
    const Alike& alike = classes[c];
    INFO(alike.parts.size() << " parts like " << names[alike.parts[0]]);
    check_within(run.sum(c), alike.incident, half_percent, 1e-4);
    // Each on its own, so that none of them makes up for another.
    const auto count = static_cast<double>(alike.parts.size());
    for (const uint32_t part : alike.parts) {
      INFO(names[part]);
      check_within(run.into(names[part]), alike.incident / count, 2 * half_percent, 1e-4);
    }
  }
  // Not one particle in millions finds a gap between the 96 quads.
  CHECK(run.ledger().escaped == 0);
}

}  // namespace

TEST_CASE("walls and their parts in diffuse cubes with one glowing wall receive their radiosity") {
  check_cube("c01_ceiling_emits_rho.5", 1 << 22);
  check_cube("c03_office", 1 << 22);
  check_cube("c07_opposite_pair_mirrorless", 1 << 23);
  check_cube("c09_floor_strip_lowlevel", 1 << 22);
}

TEST_CASE("walls and their parts in a cube without symmetry receive their radiosity") {
  check_cube("c05_one_wall_emits_unequal", 1 << 23);
}

TEST_CASE("walls and their parts in diffuse cubes around a point source receive their radiosity") {
  check_cube("p01_point_centre_rho.0", 1 << 22);
  check_cube("p03_point_centre_rho.5", 1 << 22);
  check_cube("p05_point_centre_rho.95", 1 << 20);
  check_cube("p07_point_low_sooty", 1 << 23);
}

TEST_CASE("walls and their parts in an evenly glowing cube receive one and the same irradiance") {
  check_cube("c11_furnace_all_emit_rho.5", 1 << 22);
}

TEST_CASE("a wall that glows up to its edges loses no light at them") {
  // Particles are born a millionth off the edges: on them they would start in the next wall.
  SceneDescription scene;
  const int wall = add_grey(scene, 0.5);
  const std::vector<Face> faces = faces_of_box({0, 0, 0}, {1, 1, 1});
  for (const Face& f : faces) add_quad(scene, f.name, f.corner, f.u, f.v, wall);
  add_rectangle(scene, {0.5, 0.5, 1 - 1e-5}, {0, 0, -1}, 1, 1, 1);
  RunOptions options;
  options.particles = 1 << 24;
  const Run run(std::move(scene), options, {every_side()});
  CHECK(run.sum(0).value == 0);
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

TEST_CASE("a closed sphere of any reflectance receives the sum of all reflections") {
  // Over a closed surface of one reflectance the flux does not depend on its shape.
  const auto shape = shapes::sphere(1, 1e-3);
  REQUIRE(shape.ok());
  for (const Row& row : reference_table("misc_exact.csv")) {
    if (row.text("id") != "sphere_integrating") continue;
    INFO(row.text("parameters"));
    const double rho = parameter(row.text("parameters"), "rho");
    SceneDescription scene;
    add_mesh(scene, "sphere", shape->mesh, add_grey(scene, rho));
    add_point(scene, {0.3, 0.2, -0.4}, 1);
    RunOptions options;
    options.particles = rho > 0.9 ? 1 << 14 : 1 << 17;
    options.batch_particles = 256;
    const Run run(std::move(scene), options);
    check_within(run.into("sphere") * (1 / (4 * pi)), row.number("value"), half_percent);
    CHECK(run.ledger().escaped == 0);
  }
}

TEST_CASE("in an integrating sphere each reflection adds one and the same irradiance everywhere") {
  const auto shape = shapes::sphere(1, 2.5e-4);
  REQUIRE(shape.ok());
  const Mesh& mesh = shape->mesh;
  for (const Row& row : reference_table("misc_exact.csv")) {
    if (row.text("id") != "sphere_integrating_indirect") continue;
    INFO(row.text("parameters"));
    SceneDescription scene;
    add_mesh(scene, "sphere", mesh, add_grey(scene, parameter(row.text("parameters"), "rho")));
    add_point(scene, {0.3, 0.2, -0.4}, 1);
    BinSum places{&TallyBlocks::probes, {}};
    for (size_t t = 0; t < mesh.triangles.size(); t += mesh.triangles.size() / 3) {
      const glm::uvec3 c = mesh.triangles[t];
      const auto& p = mesh.positions;
      ProbeMeasure probe;
      probe.name = "probe " + std::to_string(t);
      probe.position = (p[c[0]] + p[c[1]] + p[c[2]]) / 3.0;
      probe.normal = -glm::normalize(glm::cross(p[c[1]] - p[c[0]], p[c[2]] - p[c[0]]));
      places.bins.push_back(static_cast<uint32_t>(scene.probes.size()));
      scene.probes.push_back(probe);
    }
    const auto probes = static_cast<double>(places.bins.size());
    const double lm_per_w = efficacy_lm_per_w(scene.emitters[0].spectrum);
    scene.run.eye_share = 10;
    RunOptions options;
    options.particles = 1 << 16;
    options.batch_particles = 256;
    const Run run(std::move(scene), options, {places});
    // Facets stand off the sphere by up to 0.025 %, and no point of one sees its own.
    constexpr double slack = 1.5e-3;
    for (uint32_t p = 0; p < places.bins.size(); ++p) {
      check_within(run.value(run.blocks().probes, p) * (1 / lm_per_w), row.number("value"),
                   2 * half_percent, slack);
    }
    check_within(run.sum(0) * (1 / (probes * lm_per_w)), row.number("value"), half_percent, slack);
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
    options.particles = 1 << 19;
    const Run run(std::move(scene), options, {every_side()});
    INFO(row.text("parameters"));
    check_within(run.sum(0), cut / (1 - rho * (1 - cut)), half_percent, 2e-3);
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
    const double absorbed = row.number("value");
    RunOptions options;
    options.particles = absorbed < 0.01 ? 1 << 20 : 1 << 18;
    const Run run(std::move(scene), options);
    INFO(p);
    check_within(run.absorbed_by(body), absorbed, half_percent, 2e-4);
    check_within(run.absorbed_by("outer"), 1 - absorbed, half_percent, 2e-4 * absorbed);
  }
}

namespace {

/// Two unit squares facing each other between perfect mirrors: infinite plates. The lower one
/// emits 1.
SceneDescription plates(double r1, double r2, double distance) {
  SceneDescription scene;
  add_mirror_walls(scene, {0, 0, 0}, {1, 1, distance});
  const std::vector<Face> faces = faces_of_box({0, 0, 0}, {1, 1, distance});
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
    options.particles = 1 << 16;
    options.batch_particles = 1 << 9;
    const Run run(plates(parameter(p, "r1"), parameter(p, "r2"), 0.5), options);
    INFO(p);
    check_within(run.into("plate 2"), rows[i].number("value"), half_percent, 3e-5);
    check_within(run.into("plate 1"), rows[i + 1].number("value"), half_percent, 3e-5);
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
    check_within(run.into("plate 2"), rows[i].number("value"), half_percent, 5e-5);
    check_within(run.absorbed_by_medium(0), rows[i + 1].number("value"), half_percent, 5e-5);
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
    const double opposite = row.number("to_opposite_wall");
    RunOptions options;  // 10 free paths let through 140 of 2^25 particles: 8 %
    options.particles =
        std::clamp(particles_for(opposite), options.particles, options.particles << 5);
    const Run run(std::move(scene), options, {{&TallyBlocks::surfaces, {2, 3, 4, 5}}});
    INFO("tau " << tau);
    constexpr double slack = 2e-5;  // the source stands off its wall by a hundredth of a millimetre
    const auto check = [&](const Estimate& estimate, double share, double parts_of_it) {
      check_share(estimate, parts_of_it * share, options.particles, 1, slack * share);
    };
    check(run.into("x1"), opposite, 1);
    check(run.sum(0), row.number("to_each_side_wall"), 4);
    for (const std::string side : {"y0", "y1", "z0", "z1"})
      check(run.into(side), row.number("to_each_side_wall"), 1);
    if (tau > 0) check(run.absorbed_by_medium(0), row.number("absorbed_in_volume"), 1);
    CHECK(run.ledger().escaped == 0);
  }
}

}  // namespace luxodus::light
