// What changes and moves the objects of an FDS input file: clocks, controls and ramps of clocks,
// &MOVE, and objects that only their line names.
#include "scenes/formats/fds_input/drivers.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "scenes/formats/fds_input/input_building.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using Catch::Contains;
using luxodus::test::TemporaryFolder;

namespace {

struct DrivenCase {
  TemporaryFolder folder;

  Result<FdsInput> read(const std::string& text) const {
    folder.write("case.fds",
                 "&HEAD CHID='room' /\n&MESH IJK=10,10,10, XB=0,10,0,10,0,10 /\n" + text);
    return read_fds_input(folder / "case.fds");
  }
  FdsInput good(const std::string& text) const {
    auto input = read(text);
    if (!input) FAIL(input.problem().text());
    return std::move(input).value();
  }
};

FireBuilding as_written(const FdsInput& input, const FdsInputOptions& options = {}) {
  auto building = exact_building(input, options);
  if (!building) FAIL(building.problem().text());
  return std::move(building).value();
}

/// The course of an obstruction that a control drives; the clock is the device "t".
FdsCourse course_by(const std::string& groups) {
  const auto input = DrivenCase().good(
      "&DEVC ID='t', QUANTITY='TIME' /\n&DEVC ID='a', QUANTITY='TIME', SETPOINT=10 /\n"
      "&DEVC ID='b', QUANTITY='TIME', SETPOINT=20 /\n"
      "&DEVC ID='heat', QUANTITY='TEMPERATURE', SETPOINT=60 /\n" +
      groups + "&OBST XB=1,2,1,2,0,1, CTRL_ID='c' /\n");
  return input.obstructions.at(0).course;
}

using Turns = std::vector<double>;

}  // namespace

TEST_CASE("a ramp of the clock drives what is there while it is above zero", "[fds][input]") {
  const std::string control = "&CTRL ID='c', FUNCTION_TYPE='CUSTOM', INPUT_ID='t', RAMP_ID='r' /\n";
  const auto ramp = [&](const std::string& points) { return course_by(control + points); };
  const FdsCourse lid = ramp(
      "&RAMP ID='r', T=0., F=1. /\n&RAMP ID='r', T=1.9, F=1. /\n&RAMP ID='r', T=2.1, F=-1. /\n");
  CHECK_FALSE(lid.at_start);  // until the first step
  REQUIRE(lid.turns_s.size() == 2);
  CHECK(lid.turns_s[0] == 0);
  CHECK(lid.turns_s[1] == Approx(2.0));
  CHECK(lid.at(1));
  CHECK_FALSE(lid.at(2.5));
  // Up and down again, by the points in any order.
  const FdsCourse twice = ramp(
      "&RAMP ID='r', T=30, F=-1 /\n&RAMP ID='r', T=0, F=-1 /\n&RAMP ID='r', T=10, F=-1 /\n"
      "&RAMP ID='r', T=20, F=1 /\n");
  CHECK(twice.turns_s == Turns{15, 25});
  CHECK(ramp("&RAMP ID='r', T=0, F=-1 /\n&RAMP ID='r', T=9, F=-1 /\n").turns_s.empty());
  // A ramp of what the fire does is named, and so is one that is not there.
  CHECK_THAT(course_by("&CTRL ID='c', FUNCTION_TYPE='CUSTOM', INPUT_ID='heat', RAMP_ID='r' /\n"
                       "&RAMP ID='r', T=0, F=1 /\n")
                 .driven_by,
             Contains("\"c\""));
  CHECK_THAT(course_by(control).driven_by, Contains("\"c\""));
}

TEST_CASE("a ramp that is too long is told, and the building is read", "[fds][input]") {
  std::string groups =
      "&DEVC ID='t', QUANTITY='TIME' /\n"
      "&CTRL ID='c', FUNCTION_TYPE='CUSTOM', INPUT_ID='t', RAMP_ID='r' /\n";
  for (size_t i = 0; i <= fds_input::limits::turns + 5; ++i)
    groups += "&RAMP ID='r', T=" + std::to_string(i) + ", F=1 /\n";
  const FdsInput input = DrivenCase().good(groups + "&OBST XB=1,2,1,2,0,1, CTRL_ID='c' /\n");
  CHECK_THAT(input.obstructions.at(0).course.driven_by, Contains("\"c\""));
  REQUIRE(input.notes.size() == 1);
  CHECK_THAT(input.notes[0],
             Contains("line 10005") && Contains("\"r\"") && Contains("more than 10000 points"));
}

TEST_CASE("controls of clocks change at the times of their inputs", "[fds][input]") {
  struct Row {
    const char* control;
    bool at_start;
    Turns turns;
  };
  for (const Row& row :
       {Row{"FUNCTION_TYPE='ALL', INPUT_ID='a','b'", false, {20}},
        Row{"FUNCTION_TYPE='ANY', INPUT_ID='a','b'", false, {10}},
        Row{"FUNCTION_TYPE='ANY', INPUT_ID='a','b', INITIAL_STATE=T", true, {10}},
        Row{"FUNCTION_TYPE='ONLY', N=1, INPUT_ID='a','b', LATCH=F", false, {10, 20}},
        Row{"FUNCTION_TYPE='ONLY', N=1, INPUT_ID='a','b'", false, {10}},
        Row{"FUNCTION_TYPE='AT_LEAST', N=2, INPUT_ID='a','b'", false, {20}},
        Row{"FUNCTION_TYPE='TIME_DELAY', DELAY=5, INPUT_ID='a'", false, {15}}}) {
    INFO(row.control);
    const FdsCourse course = course_by(std::string("&CTRL ID='c', ") + row.control + " /\n");
    CHECK(course.at_start == row.at_start);
    CHECK(course.turns_s == row.turns);
    CHECK(course.driven_by.empty());
  }
  // Controls of controls.
  CHECK(course_by("&CTRL ID='x', FUNCTION_TYPE='ALL', INPUT_ID='a' /\n"
                  "&CTRL ID='c', FUNCTION_TYPE='TIME_DELAY', DELAY=7, INPUT_ID='x' /\n")
            .turns_s == Turns{17});
  for (const char* control :
       {"FUNCTION_TYPE='ALL', INPUT_ID='a','heat'", "FUNCTION_TYPE='ALL', INPUT_ID='c'",
        "FUNCTION_TYPE='ALL', INPUT_ID='none'", "FUNCTION_TYPE='DEADBAND', INPUT_ID='a'",
        "INPUT_ID='a'", "FUNCTION_TYPE='ALL'"}) {
    INFO(control);
    const FdsCourse course = course_by(std::string("&CTRL ID='c', ") + control + " /\n");
    CHECK_THAT(course.driven_by, Contains("\"c\""));
    CHECK(course.turns_s.empty());
  }
}

TEST_CASE("a clock that does not latch, or trips below its setpoint, is read so", "[fds][input]") {
  const auto course = [](const std::string& device) {
    return DrivenCase()
        .good("&DEVC ID='d', QUANTITY='TIME', SETPOINT=10" + device +
              " /\n&OBST XB=1,2,1,2,0,1, DEVC_ID='d' /\n")
        .obstructions.at(0)
        .course;
  };
  CHECK(course("").turns_s == Turns{10});
  CHECK(course(", TRIP_DIRECTION=-1").turns_s == Turns{0});
  CHECK(course(", TRIP_DIRECTION=-1, LATCH=F").turns_s == Turns{0, 10});
  CHECK_FALSE(course(", CONVERSION_FACTOR=60").driven_by.empty());
}

TEST_CASE("an object without an ID is named by its line and box, and can be left out",
          "[fds][input]") {
  const auto input = DrivenCase().good(
      "&OBST XB=1,2,1,2,0,1, DEVC_ID='d1' /\n&OBST XB=3,4,1,2,0,1, DEVC_ID='d2' /\n"
      "&DEVC ID='d1', QUANTITY='TEMPERATURE', SETPOINT=60., INITIAL_STATE=T /\n"
      "&DEVC ID='d2', QUANTITY='TEMPERATURE', SETPOINT=70., INITIAL_STATE=T /\n");
  FdsInputOptions options;
  const FireBuilding both = as_written(input, options);
  CHECK(both.solids == 2);
  REQUIRE(both.notes.size() == 2);
  CHECK_THAT(both.notes[0], Contains("line 3") && Contains("XB 1, 2, 1, 2, 0, 1") &&
                                Contains("\"d1\"") && Contains("--without \"line 3\""));
  CHECK_THAT(both.notes[1], Contains("line 4") && Contains("\"d2\""));
  options.without = {"line 4"};
  CHECK(as_written(input, options).solids == 1);
  CHECK(as_written(input, options).notes.size() == 1);
  options.without = {"line 5"};
  CHECK_THAT(exact_building(input, options).problem().text(), Contains("line 12"));
}

TEST_CASE("a place in the middle of a cell is snapped as FDS computes it", "[fds][input]") {
  // 23.5 cells from the low face; multiplied by the inverse of a cell it is a little less.
  const TemporaryFolder folder;
  folder.write("case.fds",
               "&HEAD CHID='x' /\n&MESH IJK=35,36,8, XB=0,0.875,-0.8875,0.0125,0,0.2, MULT_ID='m' "
               "/\n&MULT ID='m', DY=0.9, J_UPPER=1 /\n&OBST XB=0.2,0.7,0.6,0.625,0,0.2 /\n");
  const auto input = read_fds_input(folder / "case.fds");
  REQUIRE(input.ok());
  const auto fire = snapped_case(input.value(), {});
  REQUIRE(fire.ok());
  const fds::Mesh& mesh = fire->meshes.at(1);
  REQUIRE(mesh.obstructions.size() == 1);
  const auto& [low, high] = mesh.obstructions[0];
  CHECK(mesh.nodes[1][static_cast<size_t>(low.y)] == Approx(0.5875));
  CHECK(mesh.nodes[1][static_cast<size_t>(high.y)] == Approx(0.6125));
}

TEST_CASE("null values keep defaults, and one behind the last number is none", "[fds][input]") {
  const auto input = DrivenCase().good(
      "&OBST XB=1,2,1,2,0,1, , SURF_ID='INERT' /\n&OBST XB=4,5,1,2,0,1,, SURF_ID='INERT' /\n"
      "&OBST ID=, XB=7,8,1,2,0,1, PERMIT_HOLE=, COLOR='RED' /\n");
  REQUIRE(input.obstructions.size() == 3);
  CHECK(input.obstructions[1].box.low.x == 4);
  CHECK(input.obstructions[2].permit_hole);
  CHECK_THAT(DrivenCase().read("&OBST XB=1,2,1,2,0,1,7 /\n").problem().text(),
             Contains("more than 6 numbers"));
}

TEST_CASE("a stretched grid changes nothing of a building as written, and is not snapped",
          "[fds][input]") {
  const auto input = DrivenCase().good("\n&TRNX ID='t', CC=1, PC=2 /\n&OBST XB=1,2,1,2,0,1 /\n");
  const FireBuilding building = as_written(input);
  CHECK(building.solids == 1);
  REQUIRE(building.notes.size() == 1);
  CHECK_THAT(building.notes[0], Contains("line 4") && Contains("stretched"));
  const auto snapped = snapped_building(input, {});
  REQUIRE_FALSE(snapped.ok());
  CHECK_THAT(snapped.problem().text(), Contains("case.fds:4:") && Contains(".smv"));
}

TEST_CASE("moved bodies and boxes stand where &MOVE puts them", "[fds][input]") {
  const std::string moves =
      "&MOVE ID='shift', DX=1, DY=2, DZ=3 /\n"
      "&MOVE ID='quarter', X0=1, Y0=1, ROTATION_ANGLE=90 /\n"
      "&MOVE ID='eighth', ROTATION_ANGLE=45 /\n&MOVE ID='flip', SCALEX=-2 /\n"
      "&MOVE ID='all', T34=0,1,0, -1,0,0, 0,0,1, 5,0,0 /\n";
  const auto box_of = [&](const std::string& id) {
    const auto input = DrivenCase().good(moves + "&OBST XB=1,3,1,2,0,1, MOVE_ID='" + id + "' /\n");
    return input.obstructions.at(0).box;
  };
  CHECK(box_of("shift").low == glm::dvec3(2, 3, 3));
  // x becomes y, and y becomes -x, about (1, 1).
  CHECK(glm::length(box_of("quarter").low - glm::dvec3(0, 1, 0)) < 1e-12);
  CHECK(glm::length(box_of("quarter").high - glm::dvec3(1, 3, 1)) < 1e-12);
  CHECK(glm::length(box_of("all").low - glm::dvec3(3, 1, 0)) < 1e-12);
  CHECK_THAT(
      DrivenCase().read(moves + "&OBST XB=1,3,1,2,0,1, MOVE_ID='eighth' /\n").problem().text(),
      Contains("off the axes"));
  // Bodies turn freely; a mirrored one still faces outwards.
  const auto body = [&](const std::string& id) {
    const auto input = DrivenCase().good(moves + "&GEOM XB=1,3,1,2,0,1, MOVE_ID='" + id + "' /\n");
    return input.bodies.at(0).mesh;
  };
  const auto volume = [](const Mesh& mesh) {
    double sum = 0;
    for (const auto& t : mesh.triangles)
      sum += glm::dot(mesh.positions[t.x], glm::cross(mesh.positions[t.y], mesh.positions[t.z]));
    return sum / 6;
  };
  CHECK(volume(body("eighth")) == Approx(2));
  CHECK(volume(body("flip")) == Approx(4));
  double farthest = 0;
  for (const glm::dvec3& p : body("eighth").positions) farthest = std::max(farthest, p.y);
  CHECK(farthest == Approx((3 + 2) / std::sqrt(2)));
  CHECK_THAT(DrivenCase().read("&MOVE ID='m', AXIS=0,0,0 /\n").problem().text(),
             Contains("no length"));
  CHECK_THAT(DrivenCase().read("&MOVE ID='m', SCALE=0 /\n").problem().text(), Contains("flat"));
  CHECK_THAT(DrivenCase().read("&MOVE ID='m', T34(1,1:4)=1,0,0,2 /\n").problem().text(),
             Contains("twelve numbers"));
}

TEST_CASE("planes of symmetry become walls with a note", "[fds][input]") {
  const auto input = DrivenCase().good(
      "&VENT MB='XMIN', SURF_ID='MIRROR' /\n&VENT MB='XMAX', SURF_ID='PERIODIC FLOW ONLY' /\n"
      "&VENT MB='YMAX', SURF_ID='PERIODICAL' /\n");
  CHECK(input.openings.empty());
  const FireBuilding building = as_written(input);
  REQUIRE(building.notes.size() == 1);
  CHECK_THAT(building.notes[0], Contains("line 3: MIRROR, and 1 more") && Contains("opaque walls"));
}

TEST_CASE("a file of &CATF elsewhere is passed over if it has nothing of a building",
          "[fds][input]") {
  const DrivenCase fds;
  std::filesystem::create_directory(fds.folder / "case");
  const auto read = [&](const std::string& other) {
    fds.folder.write("other.fds", other);
    fds.folder.write("case/case.fds",
                     "&HEAD CHID='x' /\n&MESH /\n&CATF OTHER_FILES='../other.fds' /\n");
    return read_fds_input(fds.folder / "case/case.fds");
  };
  const auto chemistry = read("a comment\n&SPEC ID='OXYGEN' /\n &REAC FUEL='METHANE',\n C=1 /\n");
  REQUIRE(chemistry.ok());
  REQUIRE(chemistry->notes.size() == 1);
  CHECK_THAT(chemistry->notes[0], Contains("other.fds") && Contains("passed over"));
  for (const char* other :
       {"&SPEC ID='A' /\n&OBST XB=0,1,0,1,0,1 /\n", "&UNKNOWN A=1 /\n", "nothing\n", ""}) {
    INFO(other);
    const auto input = read(other);
    REQUIRE_FALSE(input.ok());
    CHECK_THAT(input.problem().text(), Contains("no file in the folder"));
  }
}

TEST_CASE("the end of a run is read", "[fds][input]") {
  CHECK(DrivenCase().good("&TIME T_END=30. /\n").end_s == 30);
  CHECK_FALSE(DrivenCase().good("").end_s);
}
