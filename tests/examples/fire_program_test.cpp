// A fire simulation from its files to a result, in a user's steps: import, check, run at another
// time, the pictures' time.
#include <catch2/catch.hpp>

#include "tests/examples/program_kit.hpp"
#include "tests/kit/small_fire.hpp"

using namespace luxodus::program;
using Catch::Contains;

namespace {

/// A closed room of 2 x 2 x 2 m with an open door in the west: clear at 0 s, 0.5 /m at 30 s.
void write_small_case(const TemporaryFolder& folder) {
  using namespace luxodus::test;
  SmallMesh mesh = even_mesh({0, 0, 0}, {0.5, 0.5, 0.5}, {4, 4, 4});
  mesh.openings = {{0, 0, 0.5, 1.5, 0, 1.5}};
  const auto even = [&](float v) { return cell_values(mesh, [v](int, int, int) { return v; }); };
  folder.write("a.sf", slice_file(mesh, "SOOT EXTINCTION COEFFICIENT",
                                  {{0, even(0)}, {15, even(0.25F)}, {30, even(0.5F)}}));
  folder.write("fire.smv", index_of_meshes({mesh}) +
                               slice_entry(1, true, mesh, "a.sf", "SOOT EXTINCTION COEFFICIENT"));
}

/// A path in the folder, quoted for a command line.
std::string in_folder(const TemporaryFolder& folder, const std::string& name) {
  return (folder / name).string();
}

Outcome import_small_case(const TemporaryFolder& folder) {
  return run_luxodus(folder, "import fds " + in_folder(folder, "fire.smv") + " --out " +
                                 in_folder(folder, "room") + " --at 30s");
}

}  // namespace

TEST_CASE("an imported fire is checked, run at another time, and kept by a second import",
          "[program][fds]") {
  const TemporaryFolder folder;
  write_small_case(folder);
  const Outcome imported = import_small_case(folder);
  INFO(imported.err);
  REQUIRE(imported.code == 0);
  const Outcome checked = run_luxodus(folder, "check " + in_folder(folder, "room/scene.toml"));
  INFO(checked.err);
  CHECK(checked.code == 0);
  CHECK_THAT(checked.err, Contains("the state at 30 s") && Contains("FLAME GLARE IS MISSING"));

  const auto at = [&](const std::string& more) {
    const Outcome run = run_luxodus(folder, "run " + in_folder(folder, "room/scene.toml") +
                                                " --particles 20k --overwrite --out " +
                                                in_folder(folder, "out") + " " + more);
    INFO(run.err);
    REQUIRE(run.code == 0);
    return slurp(folder / "out/result.json");
  };
  CHECK_THAT(at(""), Contains("\"time_s\": 30.0") && !Contains("\"at_s\""));
  CHECK_THAT(at("--at 14s"), Contains("\"time_s\": 14.0") && Contains("\"at_s\": 14.0"));
  const Outcome between =
      run_luxodus(folder, "check " + in_folder(folder, "room/scene.toml") + " --at 14s");
  CHECK_THAT(between.err, Contains("linear between the frames at 0 and 15 s") &&
                              Contains("their mean is no state that the simulation had"));
  const Outcome late =
      run_luxodus(folder, "check " + in_folder(folder, "room/scene.toml") + " --at 60s");
  CHECK(late.code == 2);
  CHECK_THAT(late.err, Contains("there is no frame near 60 s"));

  const std::string mine = "# mine\n";
  folder.write("room/scene.toml", mine);
  REQUIRE(import_small_case(folder).code == 0);
  CHECK(slurp(folder / "room/scene.toml") == mine);
}

TEST_CASE("an input file is imported with the smoke beside it, and the user's files are kept",
          "[program][fds]") {
  const TemporaryFolder folder;
  write_small_case(folder);
  const std::string input =
      "&HEAD CHID='fire' /\n&MESH IJK=4,4,4, XB=0,2,0,2,0,2 /\n"
      "&SURF ID='WOOD', COLOR='SIENNA' /\n"
      "&OBST ID='shelf', XB=1.2,1.9,1.2,1.9,0,0.9, SURF_ID='WOOD', TRANSPARENCY=0.5 /\n"
      "&HOLE XB=1.4,1.6,1,2,0,0.5 /\n&GEOM ID='ball', SPHERE_ORIGIN=0.5,0.5,0.5, "
      "SPHERE_RADIUS=0.2 /\n&VENT XB=0,0,0.5,1.5,0,1.5, SURF_ID='OPEN' /\n";
  folder.write("case.fds", input);
  const auto import_it = [&](const std::string& more) {
    return run_luxodus(folder, "import fds " + in_folder(folder, "case.fds") + " --out " +
                                   in_folder(folder, "room") + " --at 30s " + more);
  };
  const Outcome imported = import_it("");
  INFO(imported.err);
  REQUIRE(imported.code == 0);
  CHECK_THAT(imported.out, Contains("boxes 3, plates 0, bodies 1"));
  CHECK_THAT(slurp(folder / "room/geometry.toml"), Contains("high = [1.4, 1.9, 0.9]"));
  CHECK_THAT(slurp(folder / "room/materials.toml"),
             Contains("\"WOOD\"") && Contains("opacity of 0.5"));
  const Outcome checked = run_luxodus(folder, "check " + in_folder(folder, "room/scene.toml"));
  INFO(checked.err);
  CHECK(checked.code == 0);
  CHECK_THAT(checked.err, Contains("the state at 30 s"));

  folder.write("room/materials.toml", "[[material]]\nname = \"WOOD\"\nreflectance = 0.3\n");
  REQUIRE(import_it("--snap").code == 0);
  CHECK_THAT(slurp(folder / "room/geometry.toml"), Contains("low = [1, 1, 0]"));
  const std::string materials = slurp(folder / "room/materials.toml");
  CHECK_THAT(materials, Contains("reflectance = 0.3") && Contains("\"INERT\""));
  CHECK(import_it("--without shelf").code == 0);
  const Outcome snapped_twice =
      run_luxodus(folder, "import fds " + in_folder(folder, "fire.smv") + " --snap --out " +
                              in_folder(folder, "results"));
  CHECK(snapped_twice.code == 2);
  CHECK_THAT(snapped_twice.err, Contains("are for input files"));
  const Outcome unknown = import_it("--without shelv");
  CHECK(unknown.code == 2);
  CHECK_THAT(unknown.err, Contains("\"shelv\""));
  folder.write("case.fds", input + "&TRNX CC=1, PC=1.2 /\n");
  CHECK_THAT(import_it("--snap").err, Contains("case.fds:8: the grid is stretched"));
  const Outcome stretched = import_it("");
  CHECK(stretched.code == 0);
  CHECK_THAT(stretched.out, Contains("note: line 8: the grid is stretched"));
}

TEST_CASE("an import without a time takes the end of a shorter run", "[program][fds]") {
  const TemporaryFolder folder;
  write_small_case(folder);
  const std::string scene = in_folder(folder, "room/scene.toml");
  REQUIRE(run_luxodus(folder, "import fds " + in_folder(folder, "fire.smv") + " --out " +
                                  in_folder(folder, "room"))
              .code == 0);
  CHECK_THAT(slurp(folder / "room/scene.toml"), Contains("from = 30") && Contains("to = 30"));
  CHECK(run_luxodus(folder, "check " + scene).code == 0);
  folder.write("alone.fds", "&HEAD CHID='alone' /\n&TIME T_END=25 /\n&MESH /\n");
  const Outcome alone = run_luxodus(folder, "import fds " + in_folder(folder, "alone.fds") +
                                                " --out " + in_folder(folder, "alone"));
  CHECK_THAT(alone.out, Contains("not there at 25s"));
}

TEST_CASE("a time that no scene and no pack can have is rejected", "[program][fds]") {
  const TemporaryFolder folder;
  write_small_case(folder);
  REQUIRE(import_small_case(folder).code == 0);
  REQUIRE(run_luxodus(folder, "pack " + in_folder(folder, "room/scene.toml") + " --out " +
                                  in_folder(folder, "fire.luxpack"))
              .code == 0);
  const Outcome packed =
      run_luxodus(folder, "check " + in_folder(folder, "fire.luxpack") + " --at 15s");
  CHECK(packed.code == 2);
  CHECK_THAT(packed.err, Contains("a pack is of one time"));
  folder.write("plain.toml", "title = \"no fire\"\n");
  CHECK_THAT(run_luxodus(folder, "check " + in_folder(folder, "plain.toml") + " --at 15s").err,
             Contains("this scene changes in time"));
  CHECK(run_luxodus(folder, "check " + in_folder(folder, "plain.toml") + " --at soon").code == 2);
}
