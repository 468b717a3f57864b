// Changes that are in no file: those of a program that varies a scene.
#include <catch2/catch.hpp>

#include "scenes/formats/scene_file/scene_file.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;

namespace {

const std::string lamp_to_change =
    "title = \"A lamp\"\n[[emitter]]\nname = \"lamp\"\nshape = \"point\"\n"
    "distribution = \"isotropic\"\nposition = [0, 0, 1]\nflux_lm = 100\nspectrum = \"E\"\n";

}  // namespace

TEST_CASE("changes of a scene are read as those of a file that includes it", "[scene]") {
  const test::TemporaryFolder folder;
  const auto file = folder.write("lamp.toml", lamp_to_change);
  folder.write("brighter.toml",
               "include = [\"lamp.toml\"]\n[[change]]\nkind = \"luminaire\"\nof = \"lamp\"\n"
               "factor = 3\n");
  const std::string change = "change = [{kind = \"luminaire\", of = \"lamp\", factor = 3}]\n";
  const ReadScene plain = read_scene(file), changed = read_scene(file, {}, change);
  const ReadScene written = read_scene(folder / "brighter.toml");
  REQUIRE(plain.scene);
  REQUIRE(changed.scene);
  REQUIRE(written.scene);
  CHECK(changed.scene->emitters.at(0).mains_flux == 3 * plain.scene->emitters.at(0).mains_flux);
  CHECK(changed.scene->emitters.at(0).mains_flux == written.scene->emitters.at(0).mains_flux);
  CHECK(changed.scene->name == "lamp");
  CHECK(changed.scene->file == file.string());
  CHECK(changed.scene->content_hash != plain.scene->content_hash);
}

TEST_CASE("a wrong change that is in no file is reported with its line", "[scene]") {
  const test::TemporaryFolder folder;
  const auto file = folder.write("lamp.toml", lamp_to_change);
  const auto told = [&](const std::string& changes) {
    const ReadScene read = read_scene(file, {}, changes);
    REQUIRE_FALSE(read.scene);
    REQUIRE_FALSE(read.problems.empty());
    CHECK(read.problems.list().front().where.file == named_changes);
    return read.problems.list().front();
  };
  CHECK(told("change = [{kind = \"luminaire\", of = \"lamp\"},\n"
             "{kind = \"luminaire\", of = \"tube\", factor = 2}]\n")
            .where.line == 2);
  CHECK(told("change = [\n").where.line > 0);  // no TOML
  CHECK(told("changes = []\n").what.find("changes") != std::string::npos);
}
