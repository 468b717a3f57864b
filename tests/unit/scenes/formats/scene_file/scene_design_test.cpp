// The [design] table, and variants that place, turn and remove luminaires.
#include <fmt/format.h>

#include "scenes/light/world/design.hpp"
#include "tests/unit/scenes/formats/scene_file/scene_fixture.hpp"

namespace luxodus {
namespace {

std::string lamp_named(const std::string& name) {
  return "[[luminaire]]\nname = \"" + name + R"("
file = "lamp.ies"
position = [1, 1, 2.9]
circuit = "emergency"
emergency = "non-maintained"
emergency_factor = 1
maintenance_factor = 0.8
end_of_duration_factor = 0.5
)";
}
const std::string lamp = lamp_named("old");

std::string problems_of(SceneFolder& folder, const std::string& text) {
  return all_problems(folder.read(text));
}

}  // namespace

TEST_CASE("a scene without types places its own luminaires, or a generic one if it has none",
          "[format][scene][design]") {
  SceneFolder folder;
  const SceneDescription own = good(folder, lamp + lamp_named("second"));
  REQUIRE(own.design);
  REQUIRE(own.design->types.size() == 1);
  CHECK(own.design->types[0].name == "lamp");
  CHECK(own.design->types[0].emitter.circuit == "emergency");
  CHECK(same(own.design->types[0].emitter.frame.origin, glm::dvec3(0)));
  const SceneDescription none = good(folder, "[design]\n");
  REQUIRE(none.design->types.size() == 1);
  CHECK(none.design->types[0].emitter.emergency_flux == near(200 * 0.8 * 0.7));
}

TEST_CASE("luminaires of one file with other beams are types of their own",
          "[format][scene][design]") {
  const auto spot = [](const char* name, double inner, double outer) {
    return fmt::format(R"(
[[emitter]]
name = "{}"
shape = "point"
distribution = "spot"
spot_inner_deg = {}
spot_outer_deg = {}
position = [1, 1, 2.9]
flux_lm = 300
emergency = "non-maintained"
emergency_flux = 300
maintenance_factor = 1
end_of_duration_factor = 1
)",
                       name, inner, outer);
  };
  SceneFolder folder;
  const auto types = [&](const std::string& text) {
    return good(folder, text).design->types.size();
  };
  CHECK(types(spot("a", 20, 30) + spot("b", 20, 30)) == 1);
  CHECK(types(spot("a", 20, 30) + spot("b", 20, 40)) == 2);
  CHECK(types(spot("a", 20, 30) + spot("b", 10, 30)) == 2);
}

TEST_CASE("a variant places types of the design, and removes luminaires",
          "[format][scene][design]") {
  SceneFolder folder;
  folder.put("base.toml", lamp + "[[design.type]]\nname = \"new type\"\nlike = \"old\"\n");
  const SceneDescription scene = good(folder, R"(
include = ["base.toml"]
[[change]]
kind = "luminaire"
of = "old"
remove = true
[[change]]
kind = "design_type"
of = "new type"
copy = "L1"
position = [2, 3, 2.8]
rotation_deg = 90
)");
  REQUIRE(scene.emitters.size() == 1);
  const Emitter& e = scene.emitters[0];
  CHECK(e.name == "L1");
  CHECK(same(e.frame.origin, {2, 3, 2.8}));
  CHECK(e.emergency_ageing == near(0.4));
  CHECK(same(e.frame.axes[0], {0, 1, 0}));
  CHECK(same(e.frame.axes[2], {0, 0, 1}));
}

TEST_CASE("contradictory designs are rejected with their line", "[format][scene][design]") {
  SceneFolder folder;
  const auto refused = [&](const std::string& text, const std::string& words) {
    const std::string told = problems_of(folder, lamp + text);
    INFO(text << "\n" << told);
    CHECK(told.find(words) != std::string::npos);
  };
  refused("[design]\nfixed = [\"old\"]\nremovable = [\"old\"]\n", "named twice");
  refused("[design]\nmovable = [\"old\"]\nremoved = [\"old\"]\n", "named twice");
  refused("[design]\nexisting_signs = \"movable\"\n", "existing_signs");
  refused("[design]\nmove_cost = 0\n", "move_cost");
  refused("[design]\nfixed = [\"absent\"]\n", "no such luminaire");
  refused("[design]\nover = [\"nowhere\"]\n", "no such route");
  refused("[[design.type]]\nname = \"t\"\nlike = \"absent\"\n", "to be like");
  refused("[[design.type]]\nname = \"t\"\nfile = \"lamp.ies\"\n", "no light in an emergency");
  refused("[[design.type]]\nname = \"t\"\nlike = \"old\"\nemergency_flux = 3\n", "exclude");
  refused("[design]\nobjective = \"weighted\"\nweight_number = 0\n", "nothing is sought");
  refused("[[change]]\nkind = \"design_type\"\nof = \"lamp\"\nposition = [1, 1, 2]\n", "'copy'");
  refused("[[change]]\nkind = \"luminaire\"\nof = \"old\"\nremove = true\nfactor = 2\n", "goes");
}

}  // namespace luxodus
