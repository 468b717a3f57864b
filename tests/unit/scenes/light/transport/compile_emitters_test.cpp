// Emitters too small for single precision are refused, or emit without their smallest triangles.
#include <catch2/catch.hpp>

#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;

namespace {

constexpr const char* room = R"(
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [200, 20, 3]
material = "grey50"

[[emitter]]
name = "chip"
shape = "point"
distribution = "isotropic"
position = [199, 10, 2]
flux_lm = 100
)";

/// A scene whose emitter is a mesh of right triangles with these legs [m].
Result<std::shared_ptr<const CompiledScene>> with_mesh(const std::vector<double>& legs) {
  const test::TemporaryFolder folder;
  auto read = read_scene(folder.write("room.toml", room));
  REQUIRE(read.scene);
  SceneDescription scene = std::move(*read.scene);
  Emitter& chip = scene.emitters.front();
  chip.shape = EmitterShape::mesh;
  chip.distribution = Distribution::lambertian;
  for (const double leg : legs) {
    const auto first = static_cast<uint32_t>(chip.mesh.positions.size());
    const glm::dvec3 corner(199, 10, 2);
    for (const glm::dvec3& way : {glm::dvec3(0), glm::dvec3(leg, 0, 0), glm::dvec3(0, leg, 0)})
      chip.mesh.positions.push_back(corner + way);
    chip.mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const Scenario scenario = find_scenario(scene, "").value();
  return compile_scene(std::make_shared<const SceneDescription>(std::move(scene)), scenario, {});
}

}  // namespace

TEST_CASE("an emitter whose triangles are all points is refused by its name and place",
          "[transport][compile][failure]") {
  const auto compiled = with_mesh({1e-7, 3e-7});
  REQUIRE_FALSE(compiled.ok());
  CHECK(compiled.problem().what.find("\"chip\"") != std::string::npos);
  CHECK(compiled.problem().where.line > 0);
}

TEST_CASE("triangles that are points emit nothing beside valid ones", "[transport][compile]") {
  const auto compiled = with_mesh({1e-7, 0.1, 1e-7});
  REQUIRE(compiled.ok());
  const CompiledEmitter& chip = compiled.value()->emitters.front();
  CHECK(chip.texel_cdf == std::vector<double>{0, 1, 1});
  CHECK(chip.area_m2 == Approx(0.005).epsilon(1e-3));
}
