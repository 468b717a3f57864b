// DXF plans: lines, arcs and blocks as drawn, and the scene that a person's table makes of them.
// The seed is LUXODUS_SEED, or 1; LUXODUS_MUTATIONS says how many drawings are harmed.
#include "actors/import/dxf_plan.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>

#include "actors/import/write_plan.hpp"
#include "scenes/scene_file/scene_file.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// Pairs of code and value, a line each.
std::string groups(std::initializer_list<std::pair<int, std::string>> pairs) {
  std::string out;
  for (const auto& [code, value] : pairs) out += std::to_string(code) + "\n" + value + "\n";
  return out;
}

std::string line(const char* layer, const char* x1, const char* y1, const char* x2,
                 const char* y2) {
  return groups(
      {{0, "LINE"}, {8, layer}, {10, x1}, {20, y1}, {30, "0"}, {11, x2}, {21, y2}, {31, "0"}});
}

std::string insert(const char* block, const char* x, const char* y, const char* turn) {
  return groups(
      {{0, "INSERT"}, {8, "LIGHTS"}, {2, block}, {10, x}, {20, y}, {30, "0"}, {50, turn}});
}

/// A room of 5 m x 4 m in millimetres, as a closed polyline, with two blocks in it.
std::string drawing(const std::string& more = "", const char* unit = "4") {
  return groups({{0, "SECTION"},
                 {2, "HEADER"},
                 {9, "$INSUNITS"},
                 {70, unit},
                 {0, "ENDSEC"},
                 {0, "SECTION"},
                 {2, "BLOCKS"},
                 {0, "BLOCK"},
                 {8, "0"},
                 {2, "LAMP"},
                 {70, "0"},
                 {10, "0"},
                 {20, "0"},
                 {30, "0"},
                 {3, "LAMP"},
                 {1, ""}}) +
         line("WALLS", "0", "0", "1", "1") +
         groups({{0, "ENDBLK"},
                 {0, "ENDSEC"},
                 {0, "SECTION"},
                 {2, "ENTITIES"},
                 {0, "LWPOLYLINE"},
                 {8, "WALLS"},
                 {90, "4"},
                 {70, "1"},
                 {10, "0"},
                 {20, "0"},
                 {10, "5000"},
                 {20, "0"},
                 {10, "5000"},
                 {20, "4000"},
                 {10, "0"},
                 {20, "4000"}}) +
         insert("LAMP", "2500", "2000", "30") + insert("EXIT", "4900", "2000", "90") + more +
         groups({{0, "ENDSEC"}, {0, "EOF"}});
}

DxfPlan plan_of(const std::string& text) {
  auto plan = dxf_plan_of(text, "test.dxf");
  if (!plan) FAIL(plan.problem().text());
  return std::move(plan).value();
}

double length_of(const DxfPlan& plan, const std::string& layer) {
  double sum = 0;
  for (const DxfSegment& s : plan.segments)
    if (s.layer == layer) sum += glm::length(s.to - s.from);
  return sum;
}

}  // namespace

TEST_CASE("a drawing's unit, sides of polylines and blocks are read", "[import][dxf]") {
  const DxfPlan plan = plan_of(drawing());
  CHECK(plan.metres_per_unit == 1e-3);
  CHECK(plan.segments.size() == 4);  // and none from within the block
  CHECK(length_of(plan, "WALLS") == Approx(18'000));
  REQUIRE(plan.inserts.size() == 2);
  CHECK(plan.inserts[0].block == "LAMP");
  CHECK(plan.inserts[0].rotation_deg == 30);
  CHECK(plan.inserts[1].at.x == 4900);
  CHECK(plan_of(drawing("", "0")).metres_per_unit == 0);
}

TEST_CASE("arcs and bulges become chords of nearly their length", "[import][dxf]") {
  const double half_circle = 3.141592653589793 * 500;
  const DxfPlan arc = plan_of(drawing(groups({{0, "ARC"},
                                              {8, "ARCS"},
                                              {10, "0"},
                                              {20, "0"},
                                              {30, "0"},
                                              {40, "500"},
                                              {50, "270"},
                                              {51, "90"}})));
  CHECK(length_of(arc, "ARCS") == Approx(half_circle).epsilon(2e-3));
  const DxfPlan bulge = plan_of(drawing(groups({{0, "LWPOLYLINE"},
                                                {8, "ARCS"},
                                                {90, "2"},
                                                {70, "0"},
                                                {10, "0"},
                                                {20, "0"},
                                                {42, "1"},
                                                {10, "1000"},
                                                {20, "0"}})));
  CHECK(length_of(bulge, "ARCS") == Approx(half_circle).epsilon(2e-3));
  // A bulge of 1 is a half circle to the right of the way.
  double lowest = 0;
  for (const DxfSegment& s : bulge.segments)
    if (s.layer == "ARCS") lowest = std::min(lowest, s.to.y);
  CHECK(lowest == Approx(-500));
}

TEST_CASE("what is no plan is refused in words", "[import][dxf]") {
  const auto refusal = [](const std::string& text) {
    const auto plan = dxf_plan_of(text, "x.dxf");
    return plan ? std::string("read") : plan.problem().text();
  };
  CHECK(refusal("AC1027 and more").find("save it as DXF in text") != std::string::npos);
  CHECK(refusal("hello\nworld\n").find("x.dxf: ") == 0);
  CHECK(refusal(groups({{0, "SECTION"}, {2, "ENTITIES"}, {0, "ENDSEC"}, {0, "EOF"}}))
            .find("no lines") != std::string::npos);
  const TemporaryFolder folder;
  const auto read = read_dxf_plan(folder.write("a.dxf", drawing()));
  REQUIRE(read.ok());
  CHECK(read->segments.size() == 4);
  CHECK(read_dxf_plan(folder / "absent.dxf").problem().text().find("absent.dxf") !=
        std::string::npos);
}

TEST_CASE("a person's table says what layers and blocks become", "[import][dxf]") {
  const TemporaryFolder folder;
  const auto out = folder / "office";
  const DxfPlan plan = plan_of(drawing());
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
  // The drawn line is a wall's middle.
  CHECK((walls.low.x == Approx(-0.1) && walls.high.y == Approx(4.1)));
  REQUIRE(scene.scene->signs.size() == 1);
  CHECK(scene.scene->signs[0].frame.axes[2].x == Approx(-1));
  CHECK(scene.scene->signs[0].frame.origin.z == Approx(2.3));
}

TEST_CASE("the reference explains every key of a plan's table as the reader has it",
          "[import][dxf]") {
  std::ifstream in(std::string(LUX_SOURCE_DIR) + "/docs/reference/plan-file.md");
  const std::string page((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  std::string tables = toml::schema_markdown(plan_schema());
  while (tables.ends_with('\n')) tables.pop_back();
  CHECK(page.find(tables) != std::string::npos);
}

TEST_CASE("a table's mistakes are told with their line, and metres taken for kilometres too",
          "[import][dxf]") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "office");
  folder.write("office/plan.toml", "[[layer]]\nname = \"WALLS\"\nas = \"wal\"\n");
  const DxfPlan plan = plan_of(drawing());
  const auto bad = write_plan(plan, 1e-3, "office.dxf", (folder / "office").string());
  REQUIRE_FALSE(bad.ok());
  CHECK(bad.problem().where.line == 3);
  const auto large = write_plan(plan, 1000, "office.dxf", (folder / "other").string());
  REQUIRE_FALSE(large.ok());
  CHECK(large.problem().what.find("is its unit right?") != std::string::npos);
}

TEST_CASE("harmed drawings are read or refused with one sentence", "[import][dxf]") {
  const char* seed_text = std::getenv("LUXODUS_SEED");
  const char* count_text = std::getenv("LUXODUS_MUTATIONS");
  const uint64_t seed = seed_text != nullptr ? std::strtoull(seed_text, nullptr, 0) : 1;
  const int tries = count_text != nullptr ? std::atoi(count_text) : 150;
  INFO("seed " << seed);
  Random random(seed, RandomStream::test);
  random.start(0);
  const auto bytes_of = [](const std::string& text) {
    const auto* from = reinterpret_cast<const std::byte*>(text.data());
    return Bytes(from, from + text.size());
  };
  const Bytes one = bytes_of(drawing()),
              other = bytes_of(drawing(line("A", "1e308", "-1", "nan", "2"), "2"));
  const TemporaryFolder folder;
  int read = 0;
  for (int i = 0; i < tries; ++i) {
    const Bytes harmed = mutated(one, other, random);
    // In a process of its own: dxflib writes beyond its memory for some of them.
    const auto plan = read_dxf_plan(folder.write(
        "harmed.dxf", std::string(reinterpret_cast<const char*>(harmed.data()), harmed.size())));
    if (!plan) {
      REQUIRE_FALSE(plan.problem().what.empty());
      continue;
    }
    ++read;
    for (const DxfSegment& s : plan->segments)
      REQUIRE((std::isfinite(s.from.x) && std::isfinite(s.to.y)));
  }
  CHECK(read > tries / 10);
  CHECK(read < tries);
}
