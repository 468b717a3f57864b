// Cells that pictures learn from: their number and their memory, for any size of scene.
#include "scenes/light/transport/learned_cells.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/emitter_sight.hpp"
#include "scenes/light/transport/resolver.hpp"
#include "scenes/light/transport/trace.hpp"
#include "tests/kit/described.hpp"

using namespace luxodus;

namespace {

std::string lamp_at(const std::string& name, const std::string& position) {
  return "[[emitter]]\nname = \"" + name +
         "\"\nshape = \"point\"\ndistribution = \"isotropic\"\nposition = " + position +
         "\nflux_lm = 100\n";
}

std::shared_ptr<const CompiledScene> compiled_text(const std::string& text) {
  const auto d = test::described_text(text);
  auto scene = compile_scene(d, find_scenario(*d, "").value(), {});
  if (!scene.ok()) FAIL(scene.problem().text());
  return scene.value();
}

}  // namespace

TEST_CASE("a scene without extent is one cell of a metre", "[transport]") {
  const auto scene = compiled_text(lamp_at("a", "[1, 2, 3]") + lamp_at("b", "[1, 2, 3]"));
  REQUIRE(scene->diagonal_m == 0);
  const CellGrid grid(*scene, limits::learned_cells);
  CHECK(grid.count() == 1);
  CHECK(grid.edge() == 1);
  CHECK(grid.cell_of(Vec3(5, -7, 0)) == 0);
}

TEST_CASE("a scene as large as coordinates allow has no more cells than requested", "[transport]") {
  const auto scene = compiled_text(lamp_at("a", "[-1e7, -1e7, -1e7]") +
                                   lamp_at("b", "[1e7, 1e7, 1e7]") + lamp_at("c", "[0, 0, 0]"));
  for (const int64_t most : {limits::learned_cells, int64_t{1000}, int64_t{1}}) {
    const CellGrid grid(*scene, most);
    CHECK(static_cast<int64_t>(grid.count()) <= most);
    // The edge is at most a quarter longer than needed: half as many cells.
    CHECK(static_cast<double>(grid.count()) > 0.4 * static_cast<double>(most));
    CHECK(grid.cell_of(scene->local_low) == 0);
    CHECK(grid.cell_of(scene->local_high) == grid.count() - 1);
  }
}

TEST_CASE("a place is in the cell found for it", "[transport]") {
  const auto scene = compiled_text(lamp_at("a", "[0, 0, 0]") + lamp_at("b", "[7, 3, 2.5]"));
  const CellGrid grid(*scene, limits::learned_cells);
  for (size_t cell = 0; cell < grid.count(); ++cell) {
    const Vec3 middle = grid.low_of(cell) + Vec3(0.5_r * grid.edge());
    CHECK(grid.cell_of(middle) == cell);
  }
}

TEST_CASE("knowledge of emitters takes no more memory than allowed", "[transport]") {
  std::string many;
  for (size_t i = 0; i < limits::asked_emitters + 50; ++i)
    many += lamp_at("lamp " + std::to_string(i), "[" + std::to_string(4 * i) + ", 600, 100]");
  const auto large = compiled_text(many + lamp_at("last", "[0, 0, 0]"));
  const uint64_t bytes = emitter_sight_bytes(*large);
  CHECK(bytes <= limits::sight_bytes);
  CHECK(bytes > limits::sight_bytes / 4);
  const auto small = compiled_text(lamp_at("a", "[0, 0, 0]") + lamp_at("b", "[7, 3, 2.5]"));
  CHECK(emitter_sight_bytes(*small) < (1 << 24));
  CHECK(emitter_sight_bytes(*compiled_text(lamp_at("alone", "[0, 0, 0]"))) == 0);
}

TEST_CASE("a learned cell takes no more memory than was counted for it", "[transport]") {
  std::string lamps;
  for (size_t i = 0; i < 200; ++i)
    lamps += lamp_at("lamp " + std::to_string(i),
                     "[0, 0, " + std::to_string(1e-3 * static_cast<double>(i)) + "]");
  const auto scene = compiled_text(lamps);
  EmbreeDevice device;
  SceneIndex index(device, *scene);
  MergedResolver resolver(*scene, index);
  const EmitterSight sight(*scene);
  const CellSight& seen = sight.at(Vec3(0), Vec3(0), resolver);
  REQUIRE(seen.asked.size() == 200);
  REQUIRE(seen.bright.size() == limits::bright_emitters);
  const uint64_t cells = CellGrid(*scene, limits::learned_cells).count();
  CHECK(sizeof(seen) + seen.asked.capacity() * sizeof(seen.asked[0]) +
            seen.cumulative.capacity() * sizeof(seen.cumulative[0]) +
            seen.bright.capacity() * sizeof(seen.bright[0]) <
        emitter_sight_bytes(*scene) / cells);
}
