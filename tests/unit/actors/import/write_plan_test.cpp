// The scene that the user's table makes of a DXF plan.
#include "actors/import/write_plan.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "actors/import/join_lines.hpp"
#include "scenes/formats/dxf/dxf_plan.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"
#include "tests/kit/small_dxf.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

DxfPlan plan_of(const std::string& text) {
  auto plan = dxf_plan_of(text, "test.dxf");
  if (!plan) FAIL(plan.problem().text());
  return std::move(plan).value();
}

}  // namespace

TEST_CASE("the user's table says what layers and blocks become", "[import][dxf]") {
  const TemporaryFolder folder;
  const auto out = folder / "office";
  const DxfPlan plan = plan_of(dxf_drawing());
  const auto first = write_plan(plan, plan.metres_per_unit, "office.dxf", out.string());
  REQUIRE(first.ok());
  CHECK(first->walls == 0);
  CHECK_FALSE(first->asked.empty());
  std::ofstream(out / "plan.toml") << "ceiling_m = 3\n"
                                      "[[layer]]\nname = \"WALLS\"\nas = \"wall\"\n"
                                      "thickness_m = 0.2\nheight_m = 3\n"
                                      "[[block]]\nname = \"LAMP\"\nas = \"luminaire\"\n"
                                      "height_m = 2.9\n"
                                      "[[block]]\nname = \"EXIT\"\nas = \"sign\"\ntype = \"exit\"\n"
                                      "height_m = 2.3\n";
  folder.write("office/lamp.ies",
               "IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 10\n0 45 90\n"
               "0\n300 200 0\n");
  std::ofstream(out / "fixtures.toml")
      << "[[luminaire_type]]\nname = \"LAMP\"\nfile = \"lamp.ies\"\n"
         "[[sign_type]]\nname = \"exit\"\nwidth = 0.3\nheight = 0.15\nplain = \"green\"\n"
         "smallest_detail = 0.02\nmains_white = 500\nmains_green = 100\nemergency_white = 50\n"
         "emergency_green = 10\n";
  const auto second = write_plan(plan, plan.metres_per_unit, "office.dxf", out.string());
  REQUIRE(second.ok());
  CHECK(second->walls == 4);
  CHECK(second->luminaires == 1);
  CHECK(second->signs == 1);
  CHECK(second->kept_scene);
  const ReadScene scene = read_scene(out / "scene.toml");
  for (const Problem& p : scene.problems.list()) UNSCOPED_INFO(p.text());
  REQUIRE(scene.scene.has_value());
  CHECK(scene.scene->objects.size() == 6);  // four walls, floor, ceiling
  Bounds walls;
  for (const Object& object : scene.scene->objects)
    if (object.name.starts_with("WALLS"))
      for (const glm::dvec3& p : object.mesh.positions) walls.extend(p);
  // The drawn line is the middle of a wall.
  CHECK((walls.low.x == Approx(-0.1) && walls.high.y == Approx(4.1)));
  REQUIRE(scene.scene->signs.size() == 1);
  CHECK(scene.scene->signs[0].frame.axes[2].x == Approx(-1));
  CHECK(scene.scene->signs[0].frame.origin.z == Approx(2.3));
}

TEST_CASE("the reference explains every key of a plan's table like the schema", "[import][dxf]") {
  std::ifstream in(std::string(LUX_SOURCE_DIR) + "/docs/reference/plan-file.md");
  const std::string page((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  std::string tables = toml::schema_markdown(plan_schema());
  while (tables.ends_with('\n')) tables.pop_back();
  CHECK(page.find(tables) != std::string::npos);
}

TEST_CASE("a table's mistakes are reported with their line, also metres taken for kilometres",
          "[import][dxf]") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "office");
  folder.write("office/plan.toml", "[[layer]]\nname = \"WALLS\"\nas = \"wal\"\n");
  const DxfPlan plan = plan_of(dxf_drawing());
  const auto bad = write_plan(plan, 1e-3, "office.dxf", (folder / "office").string());
  REQUIRE_FALSE(bad.ok());
  CHECK(bad.problem().where.line == 3);
  const auto large = write_plan(plan, 1000, "office.dxf", (folder / "other").string());
  REQUIRE_FALSE(large.ok());
  CHECK(large.problem().what.find("is its unit right?") != std::string::npos);
}

TEST_CASE("a curve of pieces shorter than a wall is a wall, and marks are told", "[import][dxf]") {
  const TemporaryFolder folder;
  DxfPlan plan;
  const auto at = [](int i) {
    const double turn = i * 0.009 / 3;  // pieces of 9 mm on a radius of 3 m
    return glm::dvec2(3 * std::cos(turn), 3 * std::sin(turn));
  };
  // Pieces in any order and direction.
  for (int i = 0; i < 999; ++i) {
    const int k = i * 7 % 999;
    plan.segments.push_back({"W", at(i % 2 == 0 ? k : k + 1), at(i % 2 == 0 ? k + 1 : k)});
  }
  plan.segments.push_back({"W", {8, 8}, {8.0005, 8}});
  std::filesystem::create_directories(folder / "o");
  folder.write("o/plan.toml", "[[layer]]\nname = \"W\"\nas = \"sheet\"\nheight_m = 3\n");
  const auto written = write_plan(plan, 1, "plan.dxf", (folder / "o").string());
  REQUIRE(written.ok());
  CHECK(written->walls > 300);
  REQUIRE(written->notes.size() == 1);
  CHECK(written->notes[0].find("1 line") == 0);
  const ReadScene scene = read_scene(folder / "o/scene.toml");
  for (const Problem& p : scene.problems.list()) UNSCOPED_INFO(p.text());
  REQUIRE(scene.scene.has_value());
  double area = 0;
  for (const Object& object : scene.scene->objects)
    if (object.name.starts_with("W ")) area += area_of(object.mesh);
  CHECK(area == Approx(999 * 0.009 * 3).epsilon(1e-3));
}

TEST_CASE("lines that are long stay as they are, and short ones join where they meet",
          "[import][dxf]") {
  const DrawnLine lines[] = {{{0, 0}, {1, 0}},       {{1, 0}, {1.01, 0}}, {{1.02, 0}, {1.01, 0}},
                             {{1.03, 0}, {1.02, 0}}, {{1.03, 0}, {2, 0}}, {{5, 5}, {5.01, 5}},
                             {{6, 6}, {6.0001, 6}}};
  const JoinedLines joined = join_short_lines(lines);
  REQUIRE(joined.lines.size() == 4);
  CHECK(joined.lines[0].to.x == 1);
  CHECK(glm::length(joined.lines[1].to - joined.lines[1].from) == Approx(0.03));
  CHECK(joined.lines[2].to.x == 2);
  CHECK(joined.lines[3].to.x == 5.01);
  CHECK(joined.dropped == 1);
}

TEST_CASE("layers whose names a scene cannot bear stay apart", "[import][dxf]") {
  const TemporaryFolder folder;
  const DxfPlan plan = plan_of(dxf_drawing(dxf_line("A/B", "0", "0", "9", "9") +
                                           dxf_line("A\"B", "0", "0", "9", "9") +
                                           dxf_line("WÄNDE", "0", "0", "9", "9")));
  REQUIRE(write_plan(plan, 1e-3, "office.dxf", (folder / "o").string()).ok());
  std::ifstream in(folder / "o/plan.toml");
  const std::string table((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  for (const char* name : {"name = \"A-B\"", "name = \"A-B#2\"", "name = \"WÄNDE\""})
    CHECK(table.find(name) != std::string::npos);
}

TEST_CASE("the contents of a block become part of the plan where the table says so",
          "[import][dxf]") {
  const TemporaryFolder folder;
  const auto text_of = [&](const char* file) {
    std::ifstream in(folder / "o" / file);
    return std::string((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  };
  DxfPlan plan;
  plan.inserts.push_back({"FLOOR", "0", {10, 0}});
  plan.blocks["FLOOR"].segments = {{"WALLS", {0, 0}, {5, 0}}, {"WALLS", {5, 0}, {5, 4}}};
  plan.blocks["FLOOR"].inserts = {{"LAMP", "LIGHTS", {2, 2}}};
  const auto first = write_plan(plan, 1, "plan.dxf", (folder / "o").string());
  REQUIRE(first.ok());
  CHECK(text_of("plan.toml").find("# 1 time; holds 2 lines, 1 block") != std::string::npos);
  REQUIRE(first->notes.size() == 1);
  CHECK(first->notes[0].find("the block \"FLOOR\" holds 1 block, which") == 0);
  folder.write("o/plan.toml", "[[block]]\nname = \"FLOOR\"\nas = \"contents\"\n");
  const auto second = write_plan(plan, 1, "plan.dxf", (folder / "o").string());
  REQUIRE(second.ok());
  CHECK(second->lines == 2);
  CHECK(second->blocks == 1);
  const std::string rules = text_of("plan.toml");
  CHECK(rules.find("name = \"WALLS\"") != std::string::npos);
  CHECK(rules.find("name = \"LAMP\"") != std::string::npos);
  folder.write("o/plan.toml",
               "[[block]]\nname = \"FLOOR\"\nas = \"contents\"\n[[block]]\nname = \"LAMP\"\n"
               "as = \"luminaire\"\n[[layer]]\nname = \"WALLS\"\nas = \"sheet\"\n");
  folder.write("o/fixtures.toml", "[[luminaire_type]]\nname = \"LAMP\"\n");
  const auto third = write_plan(plan, 1, "plan.dxf", (folder / "o").string());
  REQUIRE(third.ok());
  CHECK(third->walls == 2);
  CHECK(third->luminaires == 1);
  CHECK(text_of("building.toml").find("position = [12, 2, 2.5]") != std::string::npos);
}

TEST_CASE("a block without contents that is to be opened is asked for", "[import][dxf]") {
  const TemporaryFolder folder;
  DxfPlan plan;
  plan.segments.push_back({"W", {0, 0}, {5, 0}});
  plan.inserts.push_back({"FLOOR", "0", {10, 0}});
  std::filesystem::create_directories(folder / "o");
  folder.write("o/plan.toml", "[[block]]\nname = \"FLOOR\"\nas = \"contents\"\n");
  const auto written = write_plan(plan, 1, "plan.dxf", (folder / "o").string());
  REQUIRE(written.ok());
  CHECK(std::count(written->asked.begin(), written->asked.end(),
                   "the drawing holds no contents of the block \"FLOOR\"") == 1);
}

TEST_CASE("a sign of a mirrored block looks along the block's own y axis", "[import][dxf]") {
  const TemporaryFolder folder;
  DxfPlan plan;
  plan.segments.push_back({"W", {0, 0}, {5, 0}});
  plan.inserts.push_back({"EXIT", "S", {4, 3}, 150, true});
  plan.inserts.push_back({"LAMP", "S", {4, 3}, 150, true});
  std::filesystem::create_directories(folder / "o");
  folder.write("o/plan.toml",
               "[[block]]\nname = \"EXIT\"\nas = \"sign\"\n[[block]]\nname = \"LAMP\"\n"
               "as = \"luminaire\"\n");
  folder.write("o/fixtures.toml",
               "[[luminaire_type]]\nname = \"LAMP\"\n[[sign_type]]\nname = \"EXIT\"\n");
  const auto written = write_plan(plan, 1, "plan.dxf", (folder / "o").string());
  REQUIRE(written.ok());
  REQUIRE(written->notes.size() == 1);
  CHECK(written->notes[0].find("1 luminaire of mirrored blocks") == 0);
  std::ifstream in(folder / "o/building.toml");
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  CHECK(text.find("facing = [0.500000, 0.866025, 0]") != std::string::npos);
}
