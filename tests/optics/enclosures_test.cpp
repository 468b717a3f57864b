// Closed rooms without smoke: cubes against the continuous radiosity solution, spheres and plates
// against closed forms. The scenes are those of actors/judge/validate.
#include "tests/optics/light_kit.hpp"

namespace luxodus::light {

TEST_CASE("walls and their parts in diffuse cubes receive their radiosity") {
  check_cases("cube c", 6, {.min_particles = 1 << 22});
}

TEST_CASE("walls and their parts in diffuse cubes around a point source receive their radiosity") {
  for (const std::string set : {"p01", "p03", "p07"})
    check_cases("cube " + set, 1, {.min_particles = 1 << 22});
  check_cases("cube p05", 1, {.min_particles = 1 << 20, .max_particles = 1 << 20});
}

TEST_CASE("a wall that glows up to its edges loses no light at them") {
  // Particles are born a millionth off the edges: on them they would start in the adjacent wall.
  SceneDescription scene;
  const int wall = add_grey(scene, 0.5);
  const std::vector<BoxFace> faces = faces_of_box({0, 0, 0}, {1, 1, 1});
  for (const BoxFace& f : faces) add_quad(scene, f.name, f.corner, f.u, f.v, wall);
  add_rectangle(scene, {0.5, 0.5, 1 - 1e-5}, {0, 0, -1}, 1, 1, 1);
  RunOptions options;
  options.particles = 1 << 24;
  const Run run(std::move(scene), options, {every_side()});
  CHECK(run.sum(0).value == 0);
}

TEST_CASE("a plane in a wall counts what the wall receives, cell by cell") {
  SceneDescription scene = cases_named("cube c03_office").front().plan().scene;
  constexpr int parts = 4;
  const BoxFace floor = faces_of_box({0, 0, 0}, {1, 1, 1})[4];
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
      // The flights that end on both are equal; edges between the cells are a few ulps apart.
      CHECK(sum == Approx(run.into("z0_floor " + std::to_string(i) + " " + std::to_string(j)).value)
                       .epsilon(1e-4));
    }
  }
}

TEST_CASE("a closed sphere of any reflectance receives the sum of all reflections") {
  check_cases("integrating sphere", 5, {.min_particles = 1 << 16, .max_particles = 1 << 17});
}

TEST_CASE("in an integrating sphere each reflection adds equal irradiance everywhere") {
  for (const std::string rho : {"0.2", "0.5", "0.8"})
    check_cases("probes in a sphere rho=" + rho, 1, {.max_particles = 1 << 18});
  for (const std::string rho : {"0.95", "0.99"})
    check_cases("probes in a sphere rho=" + rho, 1,
                {.min_particles = 1 << 16, .max_particles = 1 << 16});
}

TEST_CASE("a sphere's port emits the share given by its solid angle and area") {
  check_cases("sphere with a port", 2, {.min_particles = 1 << 19});
}

TEST_CASE("concentric spheres share light by their areas") {
  check_cases("concentric spheres", 3, {.min_share = 1e-3});
}

TEST_CASE("infinite parallel plates exchange a geometric series, and gas absorbs its share") {
  check_cases("plates r1", 3, {.min_particles = 1 << 16, .max_particles = 1 << 16});
  check_cases("plates and gas", 2, {.min_particles = 1 << 20});
}

TEST_CASE("a cube of absorbing gas transmits the exact share to every wall") {
  check_cases("cube of gas", 7, {.min_share = 1e-3, .max_particles = 1 << 25});
}

}  // namespace luxodus::light
