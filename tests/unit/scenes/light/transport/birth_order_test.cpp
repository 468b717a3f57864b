// Ordering particles by their emitters before they are traced.
#include "scenes/light/transport/birth_order.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "scenes/light/geometry/primitives.hpp"
#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/trace.hpp"

using namespace luxodus;

namespace {

/// Four black rooms far apart, each with a lamp of different power and colour.
std::shared_ptr<const CompiledScene> four_rooms() {
  auto scene = std::make_shared<SceneDescription>();
  scene->materials.emplace_back().reflectance = Spectrum::constant(0);
  for (int i = 0; i < 4; ++i) {
    Object room;
    room.name = "room " + std::to_string(i);
    room.mesh = shapes::box({1, 1, 1}, shapes::BoxAt::corner)->mesh;
    for (glm::dvec3& p : room.mesh.positions) p.x += 10 * i;
    scene->objects.push_back(room);
    Emitter lamp;
    lamp.name = "lamp " + std::to_string(i);
    lamp.frame.origin = {10 * i + 0.5, 0.5, 0.5};
    lamp.distribution = Distribution::isotropic;
    lamp.mains_flux = 100 * (i + 1);
    lamp.spectrum = i % 2 == 0 ? blackbody_shape(2700) : illuminant_d65_shape();
    scene->emitters.push_back(lamp);
  }
  scene->run.band_edges_nm = {380, 500, 600, 780};
  auto compiled = compile_scene(scene, find_scenario(*scene, "").value(), {});
  REQUIRE(compiled.ok());
  return compiled.value();
}

/// The object that a particle reaches: here it shows which lamp sent it.
size_t lit_by(const CompiledScene& scene, BatchTracer& tracer, uint64_t particle) {
  BatchScores scores;
  scores.reset(scene.layout);
  tracer.trace(0, particle, 1, scores);
  for (size_t s = 0; s < scene.surfaces.size(); ++s) {
    const CompiledSurface& surface = scene.surfaces[s];
    for (uint32_t patch = 0; patch < surface.patches; ++patch) {
      for (int band = 0; band < scene.bands.count(); ++band) {
        const auto at =
            scene.layout.score_index(scene.blocks.patches, surface.first_patch + patch, band, 0);
        if (scores.scores[static_cast<size_t>(at)] != 0) return s;
      }
    }
  }
  return scene.surfaces.size();
}

}  // namespace

TEST_CASE("the predicted emitter is the one that the particle comes from", "[transport][birth]") {
  const auto scene = four_rooms();
  REQUIRE(scene->bands.count() == 3);
  const EmbreeDevice device;
  const SceneIndex index(device, *scene);
  const auto tracer = make_batch_tracer(*scene, GeometryAccess::resident(index), 5);
  std::set<uint32_t> seen;
  for (uint64_t particle = 100; particle < 400; ++particle) {
    const uint32_t emitter = emitter_of_particle(*scene, 5, 0, particle);
    CHECK(lit_by(*scene, *tracer, particle) == emitter);
    seen.insert(emitter);
  }
  CHECK(seen.size() == 4);
}

TEST_CASE("an order by emitters has every particle once, neighbours together",
          "[transport][birth]") {
  const auto scene = four_rooms();
  const auto places = places_of_emitters(*scene);
  CHECK(places == std::vector<uint32_t>{0, 1, 2, 3});
  std::vector<uint32_t> order;
  order_by_emitter(*scene, places, 5, 0, 1000, 500, order);
  std::vector<uint32_t> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  for (uint32_t i = 0; i < 500; ++i) CHECK(sorted[i] == i);
  const auto place = [&](uint32_t i) {
    return places[emitter_of_particle(*scene, 5, 0, 1000 + i)];
  };
  CHECK(std::is_sorted(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return std::pair(place(a), a) < std::pair(place(b), b);
  }));
}
