// Fortran namelists as FDS reads them.
#include "scenes/formats/fds_input/namelist.hpp"

#include <catch2/catch.hpp>

#include "scenes/formats/fds_input/group_keys.hpp"

using namespace luxodus;
using namespace luxodus::fds_input;

namespace {

std::vector<Group> groups_of(const std::string& text) {
  auto groups = read_namelists(text, "case.fds", {"OBST", "MESH", "SURF"});
  if (!groups) FAIL(groups.problem().text());
  return std::move(groups).value();
}

std::string fault_of(const std::string& text) {
  const auto groups = read_namelists(text, "case.fds", {"OBST"});
  return groups ? "" : groups.problem().text();
}

}  // namespace

TEST_CASE("a group runs from '&' at the start of a line to '/', and all else is a comment",
          "[fds][input]") {
  const std::string text =
      "OBST XB=1 / no group\n"
      "! &OBST ID='comment' /\n"
      "  &OBST ID='a', XB=0,1, ! the rest / is below\n"
      "        0.,.5,-1E0,+1D0 / &OBST ID='behind the end of a group' /\n"
      "&MESHES IJK=1 /\n"
      "&DUMP not a group of ours, and not closed\n"
      "&OBST ID=\"it's\", PERMIT_HOLE=.FALSE./\n";
  const auto groups = groups_of(text);
  REQUIRE(groups.size() == 2);
  CHECK(groups[0].line == 3);
  CHECK(groups[1].line == 7);
  std::optional<Problem> problem;
  GroupKeys a(groups[0], text, problem), b(groups[1], text, problem);
  CHECK(a.text("ID") == "a");
  REQUIRE(a.box("XB"));
  CHECK(a.box("XB")->low == glm::dvec3(0, 0, -1));
  CHECK(a.box("XB")->high == glm::dvec3(1, 0.5, 1));
  CHECK(b.text("ID") == "it's");
  CHECK_FALSE(b.flag("PERMIT_HOLE", true));
  CHECK_FALSE(problem);
}

TEST_CASE("subscripts, repeated and missing values and doubled quotes are read as in Fortran",
          "[fds][input]") {
  const std::string text =
      "&OBST ID='it''s', RGB(2)=7, RGB(1)=6, XB(1:6)=2*0,1,3*2., rgb(3) = 8 /\n"
      "&MESH IJK=4,,6 /\n"
      "&SURF ID(1:2)='A  ','B' /\n";
  const auto groups = groups_of(text);
  std::optional<Problem> problem;
  GroupKeys obst(groups[0], text, problem), mesh(groups[1], text, problem),
      surf(groups[2], text, problem);
  CHECK(obst.text("ID") == "it's");
  CHECK(obst.array("RGB", {0, 0, 0}) == std::vector<double>{6, 7, 8});
  CHECK(obst.array("XB", std::vector<double>(6, 9)) == std::vector<double>{0, 0, 1, 2, 2, 2});
  CHECK(mesh.array("IJK", {10, 10, 10}) == std::vector<double>{4, 10, 6});
  CHECK(surf.texts("ID") == std::vector<std::string>{"A", "B"});
  CHECK_FALSE(problem);
}

TEST_CASE("an unclosed group or text, or a value without a name, is rejected with its line",
          "[fds][input]") {
  using Catch::Contains;
  CHECK_THAT(fault_of("\n&OBST XB=0,1\n"), Contains("case.fds:2:") && Contains("not closed"));
  CHECK_THAT(fault_of("&OBST XB=0\n&OBST XB=1 /\n"), Contains(":1:") && Contains("not closed"));
  CHECK_THAT(fault_of("&OBST\n ID='a\n'/\n"), Contains(":2:") && Contains("quote"));
  CHECK_THAT(fault_of("&OBST 5 /\n"), Contains("before any parameter"));
  CHECK_THAT(fault_of("&OBST XB = = /\n"), Contains("without the name"));
  CHECK_THAT(fault_of("&OBST XB=99999999*1 /\n"), Contains("repeats no value"));
  CHECK_THAT(fault_of("&OBST XB=7999999*1, 2, 3 /\n"), Contains("more than 8000000 values"));
}

TEST_CASE("a value of the wrong type is rejected with its line", "[fds][input]") {
  using Catch::Contains;
  const std::string file = "case.fds";
  const auto fault = [&](const std::string& text, const auto& ask) {
    const auto groups = groups_of(text);
    std::optional<Problem> problem;
    GroupKeys keys(groups.at(0), file, problem);
    ask(keys);
    return problem ? problem->text() : std::string();
  };
  CHECK_THAT(fault("&OBST\n XB=0,1,0,1,0 /", [](GroupKeys& k) { k.box("XB"); }),
             Contains("case.fds:2: XB of &OBST is not six coordinates"));
  CHECK_THAT(fault("&OBST XB=7*1 /", [](GroupKeys& k) { k.box("XB"); }), Contains("more than 6"));
  CHECK_THAT(fault("&OBST XB=0,1,0,1,0,nan /", [](GroupKeys& k) { k.box("XB"); }),
             Contains("no number"));
  CHECK_THAT(fault("&OBST ID=5 /", [](GroupKeys& k) { k.text("ID"); }), Contains("no text"));
  CHECK_THAT(fault("&OBST PERMIT_HOLE=5 /", [](GroupKeys& k) { k.flag("PERMIT_HOLE", true); }),
             Contains("neither T nor F"));
  CHECK_THAT(fault("&OBST N=0.5 /", [](GroupKeys& k) { k.integer("N", 0); }),
             Contains("no whole number"));
  CHECK_THAT(fault("&OBST\n\n RGB(9)=1 /", [](GroupKeys& k) { k.rgb("RGB"); }),
             Contains("case.fds:3:"));
}
