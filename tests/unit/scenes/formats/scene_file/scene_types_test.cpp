// Keys shared by several luminaires or signs, referenced by `type`.
#include <catch2/catch.hpp>

#include "tests/unit/scenes/formats/scene_file/scene_fixture.hpp"

namespace luxodus {
namespace {

const std::string typed_lamp =
    "[[luminaire]]\nname = \"a\"\ntype = \"round\"\nposition = [0, 0, 2]\n";

}  // namespace

TEST_CASE("a luminaire has the keys of its type, and its own keys win", "[format][types]") {
  SceneFolder folder;
  const SceneDescription scene =
      good(folder, typed_lamp +
                       "ifc_guid = \"G\"\n[[luminaire]]\nname = \"b\"\ntype = \"round\"\n"
                       "position = [1, 0, 2]\nmains_factor = 0.25\n"
                       "[[luminaire_type]]\nname = \"round\"\nfile = \"lamp.ies\"\n"
                       "mains_factor = 0.5\ncircuit = \"c\"\n");
  REQUIRE(scene.emitters.size() == 2);
  CHECK(scene.emitters[0].ifc_guid == "G");
  CHECK(scene.emitters[0].circuit == "c");
  CHECK(scene.emitters[0].mains_flux == near(2 * scene.emitters[1].mains_flux));
}

TEST_CASE("a type's file is relative to the file that states the type", "[format][types]") {
  SceneFolder folder;
  std::filesystem::create_directories(folder.path() / "types");
  folder.put("types/inner.ies",
             "IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 10\n0 45 90\n0\n"
             "300 200 0\n");
  folder.put("types/types.toml", "[[luminaire_type]]\nname = \"round\"\nfile = \"inner.ies\"\n");
  CHECK(good(folder, "include = [\"types/types.toml\"]\n" + typed_lamp).emitters.size() == 1);
}

TEST_CASE("a sign has the keys of its type", "[format][types]") {
  SceneFolder folder;
  const SceneDescription scene =
      good(folder,
           "[[sign_type]]\nname = \"exit\"\nplain = \"green\"\nsmallest_detail = 0.02\n"
           "mains_white = 500\nmains_green = 100\nemergency_white = 50\nemergency_green = 10\n"
           "[[sign]]\nname = \"s\"\ntype = \"exit\"\nposition = [0, 0, 2]\nfacing = [1, 0, 0]\n"
           "width = 0.3\nheight = 0.15\nemergency_white = 40\n");
  REQUIRE(scene.signs.size() == 1);
  CHECK(scene.signs[0].colours[0].mains_cd_m2 == 500);
  CHECK(scene.signs[0].colours[0].emergency_cd_m2 == 40);
}

TEST_CASE("an unknown type, or one with keys that types must not have, is reported",
          "[format][types]") {
  SceneFolder folder;
  const std::string absent = all_problems(folder.read(typed_lamp));
  CHECK(absent.find("'round'") != std::string::npos);
  CHECK(absent.find("is missing") == std::string::npos);  // keys that the type would have
  const std::string odd = all_problems(folder.read(
      typed_lamp +
      "[[luminaire_type]]\nname = \"round\"\nfile = \"lamp.ies\"\nposition = [1, 2, 3]\n"));
  CHECK(odd.find("scene.toml:8: unknown key 'position'") != std::string::npos);
}

}  // namespace luxodus
