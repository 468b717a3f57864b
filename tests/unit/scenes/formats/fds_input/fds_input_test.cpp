// Buildings of FDS input files: their content, multiplied, cut and snapped, compared with the
// results of FDS.
#include "scenes/formats/fds_input/fds_input.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "runtime/core/reading_share.hpp"
#include "scenes/formats/fds_input/colours.hpp"
#include "scenes/formats/fds_input/input_building.hpp"
#include "scenes/formats/fields/fds_cells.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using Catch::Contains;
using luxodus::test::TemporaryFolder;

namespace {

constexpr const char* one_mesh = "&HEAD CHID='room' /\n&MESH IJK=10,10,10, XB=0,10,0,10,0,10 /\n";

struct Case {
  TemporaryFolder folder;

  Result<FdsInput> read(const std::string& text) {
    folder.write("case.fds", text);
    return read_fds_input(folder / "case.fds");
  }
  FdsInput good(const std::string& text) {
    auto input = read(one_mesh + text);
    if (!input) FAIL(input.problem().text());
    return std::move(input).value();
  }
  std::string fault(const std::string& text) {
    const auto input = read(one_mesh + text);
    return input ? "" : input.problem().text();
  }
};

double volume(const fds_input::Box& box) {
  const glm::dvec3 size = box.high - box.low;
  return size.x * size.y * size.z;
}

/// Gas cells of the first mesh.
std::vector<uint8_t> gas_of(const FdsInput& input, const FdsInputOptions& options = {}) {
  const auto fire = snapped_case(input, options);
  if (!fire) FAIL(fire.problem().text());
  return fds::gas_cells(fire.value(), 0, options.at_s);
}

size_t solid_cells(const FdsInput& input, const FdsInputOptions& options = {}) {
  const auto gas = gas_of(input, options);
  return static_cast<size_t>(std::count(gas.begin(), gas.end(), 0));
}

}  // namespace

TEST_CASE("an obstruction has its box, its surface and its colour", "[fds][input]") {
  Case fds;
  const auto input = fds.good(
      "&SURF ID='WALL', RGB=255,0,51, DEFAULT=T /\n&SURF ID='WOOD', COLOR='SIENNA' /\n"
      "&OBST XB=1,0,3,2,4,5 /\n"
      "&OBST ID='box', XB=1,2,1,2,1,2, SURF_IDS='WALL','WOOD','WALL' /\n"
      "&OBST XB=1,2,1,2,1,2, SURF_ID6='WOOD','WALL','WALL','WALL','WALL','WALL', RGB=0,255,0, "
      "TRANSPARENCY=0.5, PERMIT_HOLE=F /\n");
  REQUIRE(input.obstructions.size() == 3);
  const auto& [first, second, third] =
      std::tie(input.obstructions[0], input.obstructions[1], input.obstructions[2]);
  CHECK(first.box.low == glm::dvec3(0, 2, 4));
  CHECK(first.box.high == glm::dvec3(1, 3, 5));
  CHECK(input.surfaces[first.surface].name == "WALL");
  CHECK(input.surfaces[first.surface].rgb == glm::dvec3(1, 0, 0.2));
  CHECK_FALSE(first.rgb);
  CHECK(input.surfaces[second.surface].name == "WOOD");
  CHECK(input.surfaces[third.surface].name == "WALL");
  REQUIRE(third.rgb);
  CHECK(*third.rgb == glm::dvec3(0, 1, 0));
  CHECK(third.opacity == 0.5);
  CHECK_FALSE(third.permit_hole);
  CHECK(input.case_name == "room");
}

TEST_CASE("a multiplied box stands where FDS puts it", "[fds][input]") {
  Case fds;
  const auto lows = [&](const std::string& mult) {
    std::vector<glm::dvec3> out;
    for (const FdsObstruction& o :
         fds.good("&MULT ID='m', " + mult + " /\n&OBST XB=0,1,0,1,0,1, MULT_ID='m' /\n")
             .obstructions)
      out.push_back(o.box.low);
    return out;
  };
  using Places = std::vector<glm::dvec3>;
  CHECK(lows("DX=2, I_UPPER=2") == Places{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}});
  CHECK(lows("DX=2, I_LOWER=-1, I_UPPER=0, DX0=1, DZ0=3") == Places{{-1, 0, 3}, {1, 0, 3}});
  CHECK(lows("DX=2, DY=3, I_UPPER=1, J_UPPER=1") ==
        Places{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {2, 3, 0}});
  // Consecutive copies, along a diagonal.
  CHECK(lows("DX=1, DZ=2, N_UPPER=2") == Places{{0, 0, 0}, {1, 0, 2}, {2, 0, 4}});
  CHECK(lows("DX=1, N_UPPER=3, N_LOWER_SKIP=1, N_UPPER_SKIP=2") == Places{{0, 0, 0}, {3, 0, 0}});
  CHECK(lows("DX=1, I_UPPER=3, I_LOWER_SKIP=3") == Places{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  // A column within a field is skipped.
  CHECK(lows("DX=1, DY=1, I_UPPER=2, J_UPPER=1, I_LOWER_SKIP=1, I_UPPER_SKIP=1").size() == 4);
  // Copies may grow.
  const auto grown =
      fds.good("&MULT ID='m', DXB=0,1,0,0,0,0, N_UPPER=2 /\n&OBST XB=0,1,0,1,0,1, MULT_ID='m' /\n");
  CHECK(grown.obstructions[2].box.high.x == 3);
  CHECK(grown.obstructions[2].box.low.x == 0);
}

TEST_CASE("a hole cuts obstructions exactly, except those that forbid it", "[fds][input]") {
  using fds_input::Box;
  const Box wall{{0, 0, 0}, {10, 0.2, 3}};
  const Box door{{4, -1, 0}, {5, 1, 2}};
  double left = 0;
  const auto pieces = fds_input::without(wall, door);
  for (const Box& piece : pieces) {
    left += volume(piece);
    CHECK_FALSE(fds_input::cuts(door, piece));
  }
  CHECK(left == Approx(volume(wall) - 1 * 0.2 * 2));
  CHECK(pieces.size() == 3);
  // A hole around a plate cuts it, one along its face does not.
  const Box plate{{0, 0, 0}, {10, 0, 3}};
  CHECK(fds_input::without(plate, door).size() == 3);
  CHECK(fds_input::without(plate, Box{{4, 0, 0}, {5, 1, 2}}).size() == 1);
  CHECK(fds_input::without(plate, Box{{-1, -1, -1}, {11, 1, 4}}).empty());

  Case fds;
  const std::string text =
      "&OBST ID='wall', XB=0,10,5,6,0,3 /\n&OBST ID='post', XB=4,5,5,6,0,3, PERMIT_HOLE=F /\n"
      "&HOLE XB=3.5,5.5,4,7,0,2 /\n";
  const auto exact = exact_building(fds.good(text), {});
  REQUIRE(exact.ok());
  CHECK(exact->solids == 4);  // three parts of the wall, and the post
  // Parts of the wall, and the post, keep the materials of their obstructions in both.
  CHECK(exact->tables.materials().size() ==
        snapped_building(fds.good(text), {})->tables.materials().size());
  // 30 cells of the wall, minus 2 x 2 (3.5 snaps to 4, 5.5 to 6), and the post's 1 x 2 among them.
  CHECK(solid_cells(fds.good(text)) == 30 - 4 + 2);
}

TEST_CASE("progress counts obstructions, once for each mesh if they are snapped", "[fds][input]") {
  Case fds;
  const FdsInput input = fds.good(
      "&MESH IJK=10,10,10, XB=10,20,0,10,0,10 /\n&OBST XB=1,2,5,6,0,3 /\n&OBST XB=4,5,5,6,0,3 /\n"
      "&OBST XB=11,12,5,6,0,3 /\n");
  ReadingShare exact, snapped;
  // Others have as much work, and have not begun.
  const ReadingPart others(&exact, 3), other_meshes(&snapped, 6);
  FdsInputOptions options;
  options.reading = &exact;
  REQUIRE(exact_building(input, options).ok());
  CHECK(exact.share() == std::optional(0.5));
  options.reading = &snapped;
  REQUIRE(snapped_building(input, options).ok());
  CHECK(snapped.share() == std::optional(0.5));
}

TEST_CASE("cells are snapped as FDS snaps them", "[fds][input]") {
  Case fds;
  const auto cells = [&](const std::string& xb, const std::string& more = "") {
    return solid_cells(fds.good("&OBST XB=" + xb + more + " /\n"));
  };
  CHECK(cells("0.4,2.6,0,10,0,10") == 300);
  CHECK(cells("0.6,2.4,0,10,0,10") == 100);
  CHECK(cells("1.1,1.3,0,10,0,10") == 0);  // a plate
  CHECK(cells("1.1,1.3,0,10,0,10", ", THICKEN=T") == 100);
  CHECK(cells("1.45,1.55,0,10,0,10") == 0);  // straddles the middle of a cell, but is thin
  CHECK(cells("1.3,1.7,0,10,0,10") == 100);
  CHECK(cells("-5,20,-5,20,-1,1") == 100);
  CHECK(cells("20,21,0,10,0,10") == 0);
  CHECK(solid_cells(fds.good("&MISC THICKEN_OBSTRUCTIONS=T /\n&OBST XB=1.1,1.3,0,10,0,10 /\n")) ==
        100);
}

TEST_CASE("a clock changes obstructions, holes and openings, and other drivers are named in notes",
          "[fds][input]") {
  Case fds;
  const auto input = fds.good(
      "&DEVC ID='t', QUANTITY='TIME', SETPOINT=40, INITIAL_STATE=T, XYZ=0,0,0 /\n"
      "&DEVC ID='u', QUANTITY='TIME', SETPOINT=30, XYZ=0,0,0 /\n"
      "&DEVC ID='heat', QUANTITY='TEMPERATURE', SETPOINT=60, XYZ=0,0,0 /\n"
      "&OBST ID='curtain', XB=2,3,0,10,5,10, DEVC_ID='t' /\n"
      "&OBST ID='wall', XB=5,6,0,10,0,10 /\n&HOLE ID='door', XB=5,6,4,5,0,2, DEVC_ID='u' /\n"
      "&OBST ID='damper', XB=8,9,0,10,0,10, DEVC_ID='heat' /\n");
  const auto at = [&](double s) {
    FdsInputOptions options;
    options.at_s = s;
    return solid_cells(input, options);
  };
  CHECK(at(0) == 50 + 100);
  CHECK(at(35) == 50 + 98);
  CHECK(at(60) == 98);
  const auto building = exact_building(input, {});
  REQUIRE(building.ok());
  REQUIRE(building->notes.size() == 1);
  CHECK_THAT(building->notes[0], Contains("damper") && Contains("heat") && Contains("not there"));
  FdsInputOptions options;
  options.without = {"wall"};
  CHECK(solid_cells(input, options) == 50);
  options.without = {"wal"};
  CHECK_THAT(exact_building(input, options).problem().text(), Contains("\"wal\""));
}

TEST_CASE("openings leave gaps in the faces of meshes, and give places of exits", "[fds][input]") {
  Case fds;
  const auto built = [&](const std::string& vent) {
    auto building = exact_building(fds.good(vent), {});
    if (!building) FAIL(building.problem().text());
    return std::move(building).value();
  };
  CHECK(built("").faces == 6);
  CHECK(built("&VENT MB='XMAX', SURF_ID='OPEN' /\n").faces == 5);
  CHECK(built("&VENT DB='ZMAX', SURF_ID='OPEN' /\n").faces == 5);
  CHECK(built("&VENT PBY=10, SURF_ID='OPEN' /\n").faces == 5);
  CHECK(built("&VENT PBY=5, SURF_ID='OPEN' /\n").faces == 6);
  const auto door = built("&VENT XB=0,0,4,6,0,2, SURF_ID='OPEN' /\n");
  CHECK(door.faces == 8);
  CHECK(door.open_sides == std::vector<std::string>{"west"});
  REQUIRE(door.exits.size() == 1);
  CHECK(door.exits[0] == glm::dvec3(0, 5, 0));
  CHECK(built("&VENT XB=0,0,4,6,1,2, SURF_ID='OPEN' /\n").exits.empty());
  CHECK(built("&VENT XB=0,0,4,6,0,2, SURF_ID='INERT' /\n").faces == 6);
  // Between two meshes there is no wall, so an opening there has no effect.
  const auto two =
      built("&MESH IJK=5,5,5, XB=10,20,0,10,0,10 /\n&VENT XB=10,10,0,10,0,10, SURF_ID='OPEN' /\n");
  CHECK(two.faces == 10);
  CHECK(two.open_sides.empty());
}

TEST_CASE("bodies of triangles and simple solids have their volume", "[fds][input]") {
  Case fds;
  const auto volume_of = [](const Mesh& mesh) {
    double sum = 0;
    for (const glm::uvec3& t : mesh.triangles)
      sum +=
          glm::dot(mesh.positions[t.x], glm::cross(mesh.positions[t.y], mesh.positions[t.z])) / 6;
    return sum;
  };
  const auto body = [&](const std::string& text) {
    const auto input = fds.good(text);
    REQUIRE(input.bodies.size() == 1);
    return input.bodies[0];
  };
  CHECK(volume_of(body("&GEOM ID='t', VERTS=0,0,0, 1,0,0, 0,1,0, 0,0,1, "
                       "FACES=1,3,2,1, 1,2,4,1, 2,3,4,1, 1,4,3,1 /\n")
                      .mesh) == Approx(1 / 6.0));
  CHECK(volume_of(body("&GEOM XB=1,2,1,3,1,4 /\n").mesh) == Approx(6));
  const double pi = 3.14159265358979;
  CHECK(volume_of(body("&GEOM SPHERE_ORIGIN=5,5,5, SPHERE_RADIUS=2 /\n").mesh) ==
        Approx(4 / 3.0 * pi * 8).epsilon(0.01));
  const auto cylinder = body(
      "&GEOM CYLINDER_ORIGIN=5,5,5, CYLINDER_AXIS=1,0,0, CYLINDER_LENGTH=4, CYLINDER_RADIUS=1 /\n");
  CHECK(volume_of(cylinder.mesh) == Approx(4 * pi).epsilon(0.01));
  double low = 100, high = -100;
  for (const glm::dvec3& p : cylinder.mesh.positions) {
    low = std::min(low, p.x);
    high = std::max(high, p.x);
  }
  CHECK(low == Approx(3));
  CHECK(high == Approx(7));
  // Faces of two surfaces are two bodies.
  const auto parts = fds.good(
      "&SURF ID='A' /\n&SURF ID='B' /\n&GEOM SURF_ID='A','B', VERTS=0,0,0, 1,0,0, 0,1,0, 0,0,1, "
      "FACES=1,3,2,1, 1,2,4,2 /\n");
  REQUIRE(parts.bodies.size() == 2);
  CHECK(parts.surfaces[parts.bodies[1].surface].name == "B");
}

TEST_CASE("colours have the names that FDS gives them", "[fds][input]") {
  const auto bytes = [](const char* name) {
    const auto rgb = fds_input::colour_rgb(name);
    return rgb ? glm::ivec3(glm::round(*rgb * 255.0)) : glm::ivec3(-1);
  };
  CHECK(bytes("ALICE BLUE") == glm::ivec3(240, 248, 255));
  CHECK(bytes("YELLOW") == glm::ivec3(255, 255, 0));
  CHECK(bytes("INDIAN RED") == glm::ivec3(205, 92, 92));
  CHECK(bytes("GRAY 60") == glm::ivec3(153));
  CHECK(bytes("SKY BLUE 2").z < bytes("SKY BLUE").z);
  CHECK(bytes("MAUVE") == glm::ivec3(-1));
  Case fds;
  CHECK_THAT(fds.good("&SURF ID='A', COLOR='MAUVE' /\n").notes.at(0), Contains("MAUVE"));
}

TEST_CASE("an unsupported key that changes geometry is rejected by name, with its line",
          "[fds][input]") {
  Case fds;
  CHECK_THAT(fds.fault("&GEOM ID='g',\n BINARY_FILE='g.bingeom' /\n"),
             Contains("case.fds:4:") && Contains("BINARY_FILE") && Contains("VERTS"));
  CHECK_THAT(fds.fault("&GEOM ZVALS=1,2,3 /\n"), Contains("ZVALS"));
  CHECK_THAT(fds.fault("&OBST XB=0,1,0,1,0,1, SHAPE='SPHERE', RADIUS=1 /\n"),
             Contains("case.fds:3:") && Contains("SHAPE"));
  CHECK_THAT(fds.fault("&MESH IJK=2,1,2, XB=0,1,0,1,0,1, CYLINDRICAL=T /\n"),
             Contains("CYLINDRICAL"));
}

TEST_CASE("references of an input file to missing things are rejected", "[fds][input]") {
  Case fds;
  CHECK_THAT(fds.fault("&OBST XB=0,1,0,1,0,1, MULT_ID='m' /\n"), Contains("no &MULT \"m\""));
  CHECK_THAT(fds.fault("&OBST XB=0,1,0,1,0,1, SURF_ID='S' /\n"), Contains("no &SURF \"S\""));
  CHECK_THAT(fds.fault("&OBST XB=0,1,0,1,0,1, DEVC_ID='d' /\n"), Contains("no &DEVC \"d\""));
  CHECK_THAT(fds.fault("&GEOM XB=0,1,0,1,0,1, MOVE_ID='m' /\n"), Contains("no &MOVE \"m\""));
  CHECK_THAT(fds.fault("&OBST ID='a' /\n"), Contains("no XB"));
  CHECK_THAT(fds.fault("&GEOM VERTS=0,0,0, FACES=1,2,3,1 /\n"), Contains("vertex 2"));
  CHECK_THAT(fds.fault("&VENT XB=0,1,0,1,0,1, SURF_ID='OPEN' /\n"), Contains("no plane"));
  CHECK_THAT(fds.fault("&VENT MB='UP', SURF_ID='OPEN' /\n"), Contains("XMIN"));
  CHECK_THAT(fds.fault("&MULT ID='m', DX=1, I_UPPER=999999 /\n"), Contains("at most 200000"));
  CHECK_THAT(fds.fault("&MULT ID='m', DX=1, I_UPPER=999, J_UPPER=999, DY=1 /\n"),
             Contains("more than 200000 copies"));
  CHECK_THAT(fds.fault("&MESH IJK=0,1,1 /\n"), Contains("IJK"));
  CHECK_THAT(fds.fault("&MESH XB=1,1,0,1,0,1 /\n"), Contains("no volume"));
  CHECK_THAT(fds.read("&HEAD CHID='x' /\n").problem().text(), Contains("no &MESH"));
  CHECK_THAT(fds.fault("&HEAD CHID='../x' /\n"), Contains("CHID"));
}

TEST_CASE("files that &CATF names are read, within the folder only", "[fds][input]") {
  Case fds;
  fds.folder.write(
      "more.fds",
      "&HEAD CHID='other' /\n&OBST XB=0,1,0,1,0,1 /\n&TAIL /\n&OBST XB=0,1,0,1,0,2 /\n");
  const auto input = fds.good("&CATF OTHER_FILES='more.fds' /\n");
  CHECK(input.obstructions.size() == 1);
  CHECK(input.case_name == "room");
  fds.folder.write("nested.fds", "\n&CATF OTHER_FILES='more.fds' /\n");
  CHECK_THAT(fds.fault("&CATF OTHER_FILES='nested.fds' /\n"), Contains("nested.fds:2:"));
  CHECK_THAT(fds.fault("&CATF OTHER_FILES='../more.fds' /\n"), Contains("no file in the folder"));
  CHECK_THAT(fds.fault("&CATF OTHER_FILES='/etc/hostname' /\n"), Contains("no file in the folder"));
  CHECK_THAT(fds.fault("&CATF OTHER_FILES='absent.fds' /\n"), Contains("absent.fds"));
  const TemporaryFolder elsewhere;
  elsewhere.write("x.fds", "&OBST XB=0,1,0,1,0,1 /\n");
  std::filesystem::create_symlink(elsewhere / "x.fds", fds.folder / "link.fds");
  CHECK_THAT(fds.fault("&CATF OTHER_FILES='link.fds' /\n"), Contains("no file in the folder"));
}

TEST_CASE("input files give the cells that FDS computed with", "[fds][input]") {
  const std::filesystem::path results = std::filesystem::path(LUX_SHARED_DATA) / "fds_results";
  for (const char* name : {"corridor", "layered", "uniform", "uniform677"}) {
    const std::filesystem::path stem = results / name / name;
    const std::filesystem::path input_file = stem.string() + ".fds", index = stem.string() + ".smv";
    if (!std::filesystem::exists(input_file)) {
      WARN("skipped: the results of FDS are not there (" << input_file.string() << ")");
      continue;
    }
    INFO(name);
    const auto input = read_fds_input(input_file);
    REQUIRE(input.ok());
    const auto computed = fds::read_case(index);
    REQUIRE(computed.ok());
    for (const double at_s : {0.0, 60.0}) {
      FdsInputOptions options;
      options.at_s = at_s;
      const auto made = snapped_case(input.value(), options);
      REQUIRE(made.ok());
      REQUIRE(made->meshes.size() == computed->meshes.size());
      size_t solids = 0;
      for (size_t m = 0; m < made->meshes.size(); ++m) {
        const fds::Mesh &mine = made->meshes[m], &theirs = computed->meshes[m];
        REQUIRE(mine.cells == theirs.cells);
        for (size_t axis = 0; axis < 3; ++axis)
          for (size_t i = 0; i < mine.nodes[axis].size(); ++i)
            CHECK(mine.nodes[axis][i] == Approx(theirs.nodes[axis][i]).margin(1e-5));
        const auto gas = fds::gas_cells(made.value(), m, at_s);
        CHECK(gas == fds::gas_cells(computed.value(), m, at_s));
        solids += static_cast<size_t>(std::count(gas.begin(), gas.end(), 0));
        REQUIRE(mine.openings.size() == theirs.openings.size());
        for (size_t i = 0; i < mine.openings.size(); ++i) {
          CHECK(glm::length(mine.openings[i].low - theirs.openings[i].low) < 1e-4);
          CHECK(glm::length(mine.openings[i].high - theirs.openings[i].high) < 1e-4);
        }
      }
      CHECK(solids > 0);
      const auto a = fire_building_of(made.value(), at_s), b = read_fire_building(index, at_s);
      REQUIRE(a.ok());
      REQUIRE(b.ok());
      CHECK(a->faces == b->faces);
      CHECK(a->open_sides == b->open_sides);
      REQUIRE(a->exits.size() == b->exits.size());
      for (size_t i = 0; i < a->exits.size(); ++i)  // the index has five decimals
        CHECK(glm::length(a->exits[i] - b->exits[i]) < 1e-4);
    }
  }
}
