// The limit of rays in one batch, and the origins of rays that leave a surface beside an edge.
#include "scenes/light/transport/particle.hpp"

#include <catch2/catch.hpp>

#include "scenes/light/optics/offset_ray.hpp"
#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/compile_surfaces.hpp"
#include "scenes/light/transport/trace.hpp"

using namespace luxodus;

namespace {

/// A lamp without surroundings.
std::shared_ptr<const CompiledScene> lamp() {
  SceneDescription scene;
  scene.run.batch_particles = 8;
  scene.emitters.resize(1);
  scene.emitters[0].mains_flux = 1;
  auto made =
      compile_scene(std::make_shared<const SceneDescription>(std::move(scene)), Scenario{}, {});
  REQUIRE(made.ok());
  return made.value();
}

/// One right-angled triangle at a place.
TriangleRecord compiled_triangle(const glm::dvec3& place, double edge_m, double scene_m) {
  auto description = std::make_shared<SceneDescription>();
  description->materials.resize(1);
  Object object;
  object.mesh = {{place, place + glm::dvec3(edge_m, 0, 0), place + glm::dvec3(0, edge_m, edge_m)},
                 {{0, 1, 2}},
                 {}};
  description->objects.push_back(object);
  CompiledScene scene;
  scene.description = description;
  scene.min_offset_m = min_offset(static_cast<Real>(scene_m));
  compile_materials(scene);
  REQUIRE(compile_triangles(scene, 1).ok());
  return scene.cells.at(0).triangles.at(0);
}

}  // namespace

TEST_CASE(
    "particles born after the limit of rays that 64 bits can count are lost, and the balance "
    "closes",
    "[transport]") {
  const auto scene = lamp();
  const EmbreeDevice device(BuildThreads::calling);
  const SceneIndex index(device, *scene);
  const auto tracer = make_batch_tracer(*scene, GeometryAccess::resident(index), 1);
  BatchScores scores;
  scores.reset(scene->layout);
  scores.balance.rays = limits::rays_per_batch - 3;
  tracer->trace(0, 0, 8, scores);
  CHECK(scores.balance.particles == 8);
  CHECK(scores.balance.escaped == 3 * Int128{unit_weight});
  CHECK(scores.balance.lost() == 5 * Int128{unit_weight});
  CHECK(scores.balance.closes());
}

TEST_CASE("hits keep farther from edges than the offset of rays from the surface", "[transport]") {
  for (const double far : {0.0, 1.0, 30.0, 1000.0}) {
    for (const double edge : {0.5, 5.0}) {
      INFO(far << " m out, " << edge << " m");
      const TriangleRecord t = compiled_triangle({far, -far, far}, edge, 40);
      const Vec3 hit = t.at(0, 0);
      const Vec3 start = offset_ray(hit, t.unit_normal(), min_offset(40));
      const double off = glm::distance(glm::dvec3(start), glm::dvec3(hit));
      // Along both legs the hit has moved at least that far from the edge of the other leg.
      const double from_edge = glm::dot(glm::dvec3(hit) - glm::dvec3(t.corner[0]),
                                        glm::normalize(glm::dvec3(t.corner[1] - t.corner[0])));
      const bool as_far_as_may_be = t.edge_margin == TriangleRecord::max_edge_margin;
      CHECK((from_edge >= 16 * off || as_far_as_may_be));
      CHECK(from_edge <= edge / 32);
      CHECK((far > 1 || !as_far_as_may_be));
    }
  }
}
