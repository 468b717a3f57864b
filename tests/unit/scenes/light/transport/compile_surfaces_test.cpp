// Compiled surfaces: limits, patches and cells.
#include "scenes/light/transport/compile_surfaces.hpp"

#include <catch2/catch.hpp>

#include "scenes/light/optics/quadric_shapes.hpp"
#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/trace.hpp"

using namespace luxodus;

namespace {

/// A scene of equal squares at one place, one object each.
CompiledScene squares(int count, double edge_m, double patch_edge_m, bool one_patch = false) {
  auto description = std::make_shared<SceneDescription>();
  description->materials.resize(1);
  for (int i = 0; i < count; ++i) {
    Object square;
    square.name = "square " + std::to_string(i);
    square.place = {"squares.toml", 10 * i + 1};
    square.mesh = {{{0, 0, 0}, {edge_m, 0, 0}, {edge_m, edge_m, 0}, {0, edge_m, 0}},
                   {{0, 1, 2}, {0, 2, 3}},
                   {}};
    square.patch_edge_m = patch_edge_m;
    square.one_patch = one_patch;
    description->objects.push_back(square);
  }
  CompiledScene scene;
  scene.description = description;
  compile_materials(scene);
  return scene;
}

}  // namespace

TEST_CASE("patches are counted without wrapping, and too many are refused with the surface",
          "[transport][compile]") {
  // Finest subdivision: 2^31 patches per triangle, so a square has 2^32, which is 0 in 32 bits.
  CompiledScene wraps = squares(1, 1e7, 1e-4);
  const auto refused = compile_triangles(wraps, 1);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.problem().where.file == "squares.toml");
  CHECK(refused.problem().what.find("\"square 0\"") != std::string::npos);
  CHECK(refused.problem().what.find("patch_edge_m larger") != std::string::npos);
}

TEST_CASE("the surface that exceeds the limit of patches is named", "[transport][compile]") {
  // sqrt(2) / 2.5e-4 is cut in 5657: 128 million patches per square, so the second is one too many.
  CompiledScene fits = squares(1, 1, 2.5e-4);
  REQUIRE(compile_triangles(fits, 1).ok());
  CHECK(fits.patch_count == 4u * 5657 * 5657);
  CompiledScene breaks = squares(2, 1, 2.5e-4);
  const auto refused = compile_triangles(breaks, 1);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.problem().where.line == 11);
}

TEST_CASE("an object of one patch has two bins and its whole area", "[transport][compile]") {
  CompiledScene scene = squares(3, 2, 0.1, true);
  REQUIRE(compile_triangles(scene, 1).ok());
  CHECK(scene.patch_count == 6);
  for (const TriangleRecord& t : scene.cells[0].triangles) {
    CHECK(t.first_patch == 2 * t.surface);
    CHECK(t.subdivision == 1);
    CHECK(scene.surfaces[t.surface].patches == 2);
    CHECK(scene.surfaces[t.surface].patch_area_m2(t) == Approx(4));
  }
  const CompiledScene cut = [] {
    CompiledScene s = squares(1, 2, 1);
    REQUIRE(compile_triangles(s, 1).ok());
    return s;
  }();
  const TriangleRecord& t = cut.cells[0].triangles[0];
  CHECK(cut.surfaces[0].patch_area_m2(t) * t.subdivision * t.subdivision == Approx(2));
}

namespace {

/// A scene with a flame and no solids.
SceneDescription flame() {
  SceneDescription scene;
  Medium m;
  m.name = "flame";
  m.kind = MediumKind::bounded;
  const QuadricShape ball = ellipsoid({1, 1, 1});
  m.quadric = ball.quadric;
  m.local_bounds = ball.bounds;
  m.emission = MediumEmission{};
  m.emission->power_w = 1;
  scene.media.push_back(m);
  return scene;
}

auto compiled(SceneDescription scene, int cells) {
  return compile_scene(std::make_shared<const SceneDescription>(std::move(scene)), {}, {cells});
}

}  // namespace

TEST_CASE("a scene without triangles can be traced with any number of cells",
          "[transport][compile]") {
  SceneDescription lamp;
  lamp.run.batch_particles = 8;
  lamp.emitters.resize(1);
  lamp.emitters[0].mains_flux = 1;
  const auto scene = compiled(lamp, 4);
  REQUIRE(scene.ok());
  const EmbreeDevice device(BuildThreads::calling);
  const SceneIndex index(device, *scene.value());
  BatchScores scores;
  scores.reset(scene.value()->layout);
  make_batch_tracer(*scene.value(), GeometryAccess::resident(index), 1)->trace(0, 0, 8, scores);
  CHECK(scores.balance.escaped == scores.balance.emitted);
}

TEST_CASE("a scene that has only media has no size and is refused", "[transport][compile]") {
  const auto refused = compiled(flame(), 1);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.problem().what.find("nothing but media") != std::string::npos);
  SceneDescription seen = flame();
  seen.observers.resize(1);
  CHECK(compiled(seen, 1).ok());
}

TEST_CASE("the unit of lengths is at least the edge of a voxel", "[transport][compile]") {
  SceneDescription seen = flame();
  seen.media[0].optics.extinction.sigma_t = 1;
  seen.observers.resize(1);
  seen.run.voxel_edge_m = 10;
  const auto scene = compiled(seen, 1);
  REQUIRE(scene.ok());
  CHECK(scene.value()->length_unit_m == 16);
}
