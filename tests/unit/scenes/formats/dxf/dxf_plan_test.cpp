// DXF plans: lines, arcs and block references as drawn. The seed is LUXODUS_SEED, or 1;
// LUXODUS_MUTATIONS sets how many drawings are mutated.
#include "scenes/formats/dxf/dxf_plan.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <utility>

#include "scenes/formats/dxf/dxf_contents.hpp"
#include "tests/fuzz/mutate.hpp"
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

double length_of(const DxfPlan& plan, const std::string& layer) {
  double sum = 0;
  for (const DxfSegment& s : plan.segments)
    if (s.layer == layer) sum += glm::length(s.to - s.from);
  return sum;
}

bool is_finite_plan(const DxfPlan& plan) {
  for (const DxfSegment& s : plan.segments)
    for (const double x : {s.from.x, s.from.y, s.to.x, s.to.y})
      if (!std::isfinite(x)) return false;
  for (const DxfInsert& i : plan.inserts)
    if (!std::isfinite(i.at.x) || !std::isfinite(i.at.y) || !std::isfinite(i.rotation_deg))
      return false;
  return true;
}

bool says(const DxfPlan& plan, const std::string& words) {
  for (const std::string& note : plan.notes)
    if (note.find(words) != std::string::npos) return true;
  return false;
}

/// Lowest and highest coordinates of a layer.
std::pair<glm::dvec2, glm::dvec2> extent_of(const DxfPlan& plan, const std::string& layer) {
  glm::dvec2 low(1e300), high(-1e300);
  for (const DxfSegment& s : plan.segments) {
    if (s.layer != layer) continue;
    low = glm::min(low, glm::min(s.from, s.to));
    high = glm::max(high, glm::max(s.from, s.to));
  }
  return {low, high};
}

bool near(const glm::dvec2& a, const glm::dvec2& b) {
  return glm::length(a - b) < 1e-9;
}

std::string refusal_of(const std::string& text) {
  const auto plan = dxf_plan_of(text, "x.dxf");
  return plan ? std::string("read") : plan.problem().text();
}

std::string unit_variable(const char* value) {
  return dxf_groups({{9, "$INSUNITS"}, {70, value}});
}

std::string written_in(const char* version, const char* page) {
  return dxf_groups({{9, "$ACADVER"}, {1, version}, {9, "$DWGCODEPAGE"}, {3, page}});
}

}  // namespace

TEST_CASE("a drawing's unit, sides of polylines and blocks are read", "[dxf]") {
  const DxfPlan plan = plan_of(dxf_drawing());
  CHECK(plan.metres_per_unit == 1e-3);
  CHECK(plan.segments.size() == 4);  // and none from within the block
  CHECK(length_of(plan, "WALLS") == Approx(18'000));
  REQUIRE(plan.inserts.size() == 2);
  CHECK(plan.inserts[0].block == "LAMP");
  CHECK(plan.inserts[0].rotation_deg == 30);
  CHECK(plan.inserts[1].at.x == 4900);
  CHECK(plan_of(dxf_drawing("", "0")).metres_per_unit == 0);
}

TEST_CASE("arcs and bulges become chords of nearly their length", "[dxf]") {
  const double half_circle = 3.141592653589793 * 500;
  const DxfPlan arc = plan_of(dxf_drawing(dxf_groups({{0, "ARC"},
                                                      {8, "ARCS"},
                                                      {10, "0"},
                                                      {20, "0"},
                                                      {30, "0"},
                                                      {40, "500"},
                                                      {50, "270"},
                                                      {51, "90"}})));
  CHECK(length_of(arc, "ARCS") == Approx(half_circle).epsilon(2e-3));
  const DxfPlan bulge = plan_of(dxf_drawing(dxf_groups({{0, "LWPOLYLINE"},
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

TEST_CASE("circles, ellipses and splines become chords of nearly their length", "[dxf]") {
  const double pi = 3.141592653589793;
  const DxfPlan plan =
      plan_of(dxf_of(dxf_groups({{0, "CIRCLE"}, {8, "C"}, {10, "5"}, {20, "6"}, {40, "2"}}) +
                     dxf_groups({{0, "ELLIPSE"},
                                 {8, "E"},
                                 {10, "1"},
                                 {20, "1"},
                                 {11, "0"},
                                 {21, "3"},
                                 {40, "1"},
                                 {41, "0"},
                                 {42, "6.2831853071795871"}}) +
                     dxf_groups({{0, "ELLIPSE"},
                                 {8, "Q"},
                                 {10, "0"},
                                 {20, "0"},
                                 {11, "4"},
                                 {21, "0"},
                                 {40, "0.5"},
                                 {41, "0"},
                                 {42, "1.5707963267948966"}})));
  CHECK(length_of(plan, "C") == Approx(2 * pi * 2).epsilon(2e-3));
  CHECK(near(extent_of(plan, "C").first, {3, 4}));
  CHECK(length_of(plan, "E") == Approx(2 * pi * 3).epsilon(2e-3));
  CHECK(near(extent_of(plan, "Q").second, {4, 2}));
  CHECK(near(extent_of(plan, "Q").first, {0, 0}));
  CHECK(plan.notes.empty());
}

TEST_CASE("splines follow their control points, knots and weights", "[dxf]") {
  const auto spline = [](std::initializer_list<const char*> knots,
                         std::initializer_list<std::pair<const char*, const char*>> corners,
                         std::initializer_list<const char*> weights, const char* degree) {
    std::string text = dxf_groups({{0, "SPLINE"}, {8, "S"}, {70, "8"}, {71, degree}});
    for (const char* k : knots) text += dxf_groups({{40, k}});
    for (const char* w : weights) text += dxf_groups({{41, w}});
    for (const auto& [x, y] : corners) text += dxf_groups({{10, x}, {20, y}, {30, "0"}});
    return dxf_of(text);
  };
  // A cubic Bezier curve: its middle is (p0 + 3 p1 + 3 p2 + p3) / 8.
  const DxfPlan bezier = plan_of(spline({"0", "0", "0", "0", "1", "1", "1", "1"},
                                        {{"0", "0"}, {"1", "2"}, {"3", "2"}, {"4", "0"}}, {}, "3"));
  REQUIRE(bezier.segments.size() == 8);
  CHECK(near(bezier.segments[3].to, {2, 1.5}));
  CHECK(near(bezier.segments.back().to, {4, 0}));
  // A rational one of degree 2 with weight cos 45 deg is a quarter of a circle.
  const DxfPlan quarter =
      plan_of(spline({"0", "0", "0", "1", "1", "1"}, {{"1", "0"}, {"1", "1"}, {"0", "1"}},
                     {"1", "0.70710678118654752", "1"}, "2"));
  for (const DxfSegment& s : quarter.segments) CHECK(glm::length(s.to) == Approx(1));
  // Two knots fewer than its points need: told, not drawn.
  const std::string broken =
      spline({"0", "0", "1", "1"}, {{"0", "0"}, {"1", "2"}, {"3", "2"}}, {}, "2");
  CHECK(refusal_of(broken).find("1 SPLINE whose knots do not fit") != std::string::npos);
  std::string fitted = dxf_groups({{0, "SPLINE"}, {8, "F"}, {70, "8"}, {71, "3"}});
  for (const char* x : {"0", "1", "2"}) fitted += dxf_groups({{11, x}, {21, "0"}});
  CHECK(length_of(plan_of(dxf_of(fitted)), "F") == Approx(2));
}

TEST_CASE("an array of blocks is one block for each place", "[dxf]") {
  const auto array = [](const char* turn) {
    return plan_of(dxf_of(dxf_groups({{0, "INSERT"},
                                      {8, "L"},
                                      {2, "LAMP"},
                                      {10, "1"},
                                      {20, "1"},
                                      {50, turn},
                                      {70, "3"},
                                      {71, "2"},
                                      {44, "2.5"},
                                      {45, "3"}})));
  };
  const DxfPlan level = array("0"), turned = array("90");
  REQUIRE(level.inserts.size() == 6);
  CHECK(near(level.inserts[0].at, {1, 1}));
  CHECK(near(level.inserts[2].at, {6, 1}));
  CHECK(near(level.inserts[5].at, {6, 4}));
  // Columns lie along the block's own x axis.
  REQUIRE(turned.inserts.size() == 6);
  CHECK(near(turned.inserts[2].at, {1, 6}));
  CHECK(near(turned.inserts[3].at, {-2, 1}));
  CHECK(refusal_of(dxf_of(dxf_groups({{0, "INSERT"}, {2, "LAMP"}, {70, "30000"}, {71, "30000"}})))
            .find("more than 1000000") != std::string::npos);
}

TEST_CASE("an extrusion along -z mirrors blocks, arcs and polylines", "[dxf]") {
  const auto down = [](std::string text) {
    return text + dxf_groups({{210, "0"}, {220, "0"}, {230, "-1.0"}});
  };
  const DxfPlan plan = plan_of(dxf_of(
      down(dxf_groups({{0, "INSERT"}, {8, "L"}, {2, "LAMP"}, {10, "-4"}, {20, "3"}, {50, "30"}})) +
      down(dxf_groups(
          {{0, "ARC"}, {8, "A"}, {10, "-5"}, {20, "4"}, {40, "2"}, {50, "0"}, {51, "90"}})) +
      down(dxf_groups({{0, "LWPOLYLINE"},
                       {8, "P"},
                       {70, "0"},
                       {10, "-1"},
                       {20, "0"},
                       {42, "1"},
                       {10, "-3"},
                       {20, "0"}})) +
      down(dxf_line("W", "1", "2", "3", "4"))));
  REQUIRE(plan.inserts.size() == 1);
  CHECK(near(plan.inserts[0].at, {4, 3}));
  CHECK(plan.inserts[0].rotation_deg == Approx(150));
  CHECK(plan.inserts[0].mirrored);
  // About (5, 4) from 90 to 180 degrees.
  CHECK(near(extent_of(plan, "A").first, {3, 4}));
  CHECK(near(extent_of(plan, "A").second, {5, 6}));
  CHECK(near(extent_of(plan, "P").first, {1, 0}));
  CHECK(near(extent_of(plan, "P").second, {3, 1}));
  // Lines are in the drawing's own coordinates, whatever their extrusion.
  CHECK(near(extent_of(plan, "W").first, {1, 2}));
}

TEST_CASE("negative scales turn or mirror a block", "[dxf]") {
  const auto scaled = [](const char* x, const char* y) {
    return plan_of(dxf_of(dxf_groups({{0, "INSERT"}, {2, "B"}, {50, "30"}, {41, x}, {42, y}})))
        .inserts.at(0);
  };
  CHECK(scaled("2", "1").rotation_deg == Approx(30));
  CHECK_FALSE(scaled("2", "1").mirrored);
  CHECK(scaled("-1", "-1").rotation_deg == Approx(210));
  CHECK_FALSE(scaled("-1", "-1").mirrored);
  CHECK(scaled("1", "-1").rotation_deg == Approx(30));
  CHECK(scaled("1", "-1").mirrored);
}

TEST_CASE("names are read in the code page of the drawing", "[dxf]") {
  const auto layer = [](const std::string& raw, const std::string& header) {
    return plan_of(dxf_of(dxf_line(raw.c_str(), "0", "0", "1", "0"), header)).segments.at(0).layer;
  };
  CHECK(layer("W\xc4NDE", written_in("AC1015", "ANSI_1252")) == "WÄNDE");
  CHECK(layer("\xd1\xf2\xe5\xed\xfb", written_in("AC1015", "ANSI_1251")) == "Стены");
  CHECK(layer("\xc4\xe2\xe5\xf0\xe8", written_in("AC1015", "ansi_1251")) == "Двери");
  CHECK(layer("\x95\xc7", written_in("AC1015", "ANSI_932")) == "壁");
  CHECK(layer("W\x8eNDE", written_in("AC1009", "dos850")) == "WÄNDE");
  CHECK(layer("WÄNDE", written_in("AC1027", "ANSI_1252")) == "WÄNDE");  // UTF-8 since 2007
  CHECK(layer("W\\U+00C4NDE", written_in("AC1015", "ANSI_1252")) == "WÄNDE");
  CHECK(layer("\\M+195C7", written_in("AC1015", "ANSI_932")) == "壁");
  CHECK(layer("WÄNDE", "") == "WÄNDE");
  CHECK(layer("W\xc4NDE", "") == "WÄNDE");
  // What is not of the code page is told, and keeps names apart.
  const DxfPlan wrong =
      plan_of(dxf_of(dxf_line("A\xff", "0", "0", "1", "0") + dxf_line("A\xfe", "0", "0", "1", "0"),
                     written_in("AC1032", "ANSI_1252")));
  CHECK(wrong.segments[0].layer != wrong.segments[1].layer);
  CHECK(says(wrong, "2 names are not in the code page of the drawing (UTF-8)"));
  CHECK(
      says(plan_of(dxf_of(dxf_line("A\xff", "0", "0", "1", "0"), written_in("AC1015", "KLINGON"))),
           "KLINGON"));
}

TEST_CASE("what is not read is counted by its kind, and sheets of paper are no building", "[dxf]") {
  const std::string on_paper = dxf_groups({{67, "1"}});
  const DxfPlan plan = plan_of(
      dxf_of(dxf_line("W", "0", "0", "5", "0") + dxf_groups({{0, "SOLID"}, {8, "C"}, {10, "1"}}) +
             dxf_groups({{0, "MLINE"}, {8, "C"}, {10, "1"}, {11, "2"}}) +
             dxf_groups({{0, "MLINE"}, {8, "C"}}) + dxf_groups({{0, "3DFACE"}, {8, "C"}}) +
             dxf_line("PAPER", "0", "0", "300", "200") + on_paper +
             dxf_insert("LAMP", "300", "200", "0") + on_paper +
             dxf_groups({{0, "POLYLINE"},
                         {8, "PAPER"},
                         {66, "1"},
                         {67, "1"},
                         {0, "VERTEX"},
                         {10, "1"},
                         {0, "VERTEX"},
                         {10, "2"},
                         {0, "SEQEND"}}) +
             dxf_groups({{0, "LWPOLYLINE"}, {8, "W"}, {10, "0"}, {20, "0"}, {10, "0"}, {20, "4"}}) +
             dxf_line("W", "0", "0", "9", "9") + dxf_groups({{60, "1"}})));
  CHECK(plan.segments.size() == 2);
  CHECK(plan.inserts.empty());
  CHECK(says(plan, "not read: 2 MLINE"));
  CHECK(says(plan, "not read: 1 SOLID"));
  CHECK(says(plan, "not read: 1 3DFACE"));
  CHECK(says(plan, "not read: 3 things of the paper space"));
  CHECK(says(plan, "not read: 1 thing set invisible"));
}

TEST_CASE("frames of spline fits are not drawn, and meshes are told", "[dxf]") {
  const auto vertex = [](const char* x, const char* y, const char* flags) {
    return dxf_groups({{0, "VERTEX"}, {8, "W"}, {10, x}, {20, y}, {70, flags}});
  };
  const std::string end = dxf_groups({{0, "SEQEND"}, {8, "W"}});
  const DxfPlan plan = plan_of(dxf_of(
      dxf_groups({{0, "POLYLINE"}, {8, "W"}, {66, "1"}, {70, "4"}}) + vertex("0", "9", "16") +
      vertex("0", "0", "8") + vertex("2", "0", "8") + vertex("2", "9", "16") + end +
      dxf_groups({{0, "POLYLINE"}, {8, "W"}, {66, "1"}, {70, "64"}}) + vertex("0", "7", "192") +
      vertex("0", "8", "192") + end));
  CHECK(plan.segments.size() == 1);
  CHECK(length_of(plan, "W") == Approx(2));
  CHECK(says(plan, "not read: 1 POLYLINE that is a mesh"));
}

TEST_CASE("layers that are off or frozen are read, and told", "[dxf]") {
  const DxfPlan plan = plan_of(
      dxf_groups({{0, "SECTION"}, {2, "TABLES"}, {0, "TABLE"},  {2, "LAYER"},   {0, "LAYER"},
                  {2, "OLD"},     {70, "0"},     {62, "-7"},    {0, "LAYER"},   {2, "ICE"},
                  {70, "1"},      {62, "7"},     {0, "LAYER"},  {2, "W"},       {70, "4"},
                  {62, "7"},      {0, "ENDTAB"}, {0, "ENDSEC"}, {0, "SECTION"}, {2, "ENTITIES"}}) +
      dxf_line("OLD", "0", "0", "1", "0") + dxf_line("ICE", "0", "0", "1", "0") +
      dxf_line("W", "0", "0", "1", "0") + dxf_groups({{0, "ENDSEC"}, {0, "EOF"}}));
  CHECK(plan.segments.size() == 3);
  CHECK(plan.notes.size() == 2);
  CHECK(says(plan, "\"OLD\" is off in the drawing"));
  CHECK(says(plan, "\"ICE\" is frozen in the drawing"));
}

namespace {

/// A drawing with a block WING: its base point is (1, 0); it holds a line of 2 on the layer "0",
/// one on the layer WALLS, a hatch and a LAMP at (3, 0). `more`: further blocks.
std::string wing_drawing(const std::string& entities, const std::string& more = "") {
  return dxf_groups({{0, "SECTION"},
                     {2, "BLOCKS"},
                     {0, "BLOCK"},
                     {2, "WING"},
                     {70, "0"},
                     {10, "1"},
                     {20, "0"}}) +
         dxf_line("0", "1", "0", "3", "0") + dxf_line("WALLS", "1", "0", "1", "1") +
         dxf_groups({{0, "HATCH"}, {8, "0"}}) + dxf_insert("LAMP", "3", "0", "0") +
         dxf_groups({{0, "ENDBLK"}}) + more +
         dxf_groups({{0, "ENDSEC"}, {0, "SECTION"}, {2, "ENTITIES"}}) + entities +
         dxf_groups({{0, "ENDSEC"}, {0, "EOF"}});
}

std::string block_of(const char* name, const std::string& contents) {
  return dxf_groups({{0, "BLOCK"}, {2, name}, {70, "0"}}) + contents + dxf_groups({{0, "ENDBLK"}});
}

Result<DxfPlan> opened(const std::string& text) {
  return with_contents_of(plan_of(text), [](const std::string& block) { return block != "LAMP"; });
}

}  // namespace

TEST_CASE("blocks that are other drawings are told and stay closed", "[dxf]") {
  const std::string site = dxf_groups({{0, "BLOCK"}, {2, "SITE"}, {70, "4"}, {0, "ENDBLK"}});
  const std::string text = wing_drawing(dxf_insert("SITE", "0", "0", "0"), site);
  CHECK(says(plan_of(text), "the block \"SITE\" is another drawing"));
  const auto plan = opened(text);
  REQUIRE(plan.ok());
  REQUIRE(plan->inserts.size() == 1);
  CHECK(plan->inserts[0].block == "SITE");
}

TEST_CASE("what a block holds stands where its reference puts it", "[dxf]") {
  const std::string turned = dxf_groups({{0, "INSERT"},
                                         {8, "EAST"},
                                         {2, "WING"},
                                         {10, "10"},
                                         {20, "5"},
                                         {41, "2"},
                                         {42, "-2"},
                                         {50, "90"}});
  const DxfPlan closed = plan_of(wing_drawing(turned));
  CHECK(closed.segments.empty());
  CHECK(closed.notes.empty());
  const auto plan = opened(wing_drawing(turned));
  REQUIRE(plan.ok());
  REQUIRE(plan->segments.size() == 2);
  // By hand: p goes to (10, 5) + 2 (p.x - 1) (0, 1) + 2 p.y (1, 0).
  CHECK(plan->segments[0].layer == "EAST");
  CHECK(near(plan->segments[0].from, {10, 5}));
  CHECK(near(plan->segments[0].to, {10, 9}));
  CHECK(plan->segments[1].layer == "WALLS");
  CHECK(near(plan->segments[1].to, {12, 5}));
  REQUIRE(plan->inserts.size() == 1);
  CHECK(plan->inserts[0].block == "LAMP");
  CHECK(near(plan->inserts[0].at, {10, 9}));
  CHECK(plan->inserts[0].rotation_deg == Approx(90));
  CHECK(plan->inserts[0].mirrored);
  CHECK(says(plan.value(), "not read: 1 HATCH in the block \"WING\""));
}

TEST_CASE("blocks within one another are opened, and arrays of them", "[dxf]") {
  const std::string floor = block_of("FLOOR", dxf_insert("WING", "0", "10", "180"));
  const std::string array = dxf_groups(
      {{0, "INSERT"}, {8, "0"}, {2, "FLOOR"}, {10, "0"}, {20, "0"}, {70, "3"}, {44, "20"}});
  const auto plan = opened(wing_drawing(array, floor));
  REQUIRE(plan.ok());
  CHECK(plan->segments.size() == 6);
  REQUIRE(plan->inserts.size() == 3);
  CHECK(near(plan->inserts[2].at, {38, 10}));
  CHECK(plan->inserts[2].rotation_deg == Approx(180));
}

TEST_CASE("blocks that hold themselves, or too much, are rejected where they are opened", "[dxf]") {
  const std::string loop =
      block_of("A", dxf_insert("B", "0", "0", "0")) + block_of("B", dxf_insert("A", "0", "0", "0"));
  const auto endless = opened(wing_drawing(dxf_insert("A", "0", "0", "0"), loop));
  REQUIRE_FALSE(endless.ok());
  CHECK(endless.problem().what.find("holds itself") != std::string::npos);
  std::string tree = block_of("T0", dxf_line("W", "0", "0", "1", "0"));
  for (int i = 1; i <= 25; ++i) {
    const std::string inner = "T" + std::to_string(i - 1);
    const std::string two = dxf_insert(inner.c_str(), "0", "0", "0");
    tree += block_of(("T" + std::to_string(i)).c_str(), two + two);
  }
  const auto broad = opened(wing_drawing(dxf_insert("T25", "0", "0", "0"), tree));
  REQUIRE_FALSE(broad.ok());
  CHECK(broad.problem().what.find("open fewer") != std::string::npos);
  const std::string odd = block_of("ODD", dxf_line("W", "0", "x", "1", "0"));
  CHECK(plan_of(wing_drawing(dxf_insert("ODD", "0", "0", "0"), odd)).inserts.size() == 1);
  const auto unreadable = opened(wing_drawing(dxf_insert("ODD", "0", "0", "0"), odd));
  REQUIRE_FALSE(unreadable.ok());
  CHECK(unreadable.problem().what.find("in the block \"ODD\": ") == 0);
  CHECK(unreadable.problem().where.line > 0);
}

TEST_CASE("every unit of length that DXF has is read, and others are told", "[dxf]") {
  const auto metres = [](const char* unit) {
    return plan_of(dxf_of(dxf_line("W", "0", "0", "1", "0"), unit_variable(unit))).metres_per_unit;
  };
  // From Autodesk's table of INSUNITS.
  const std::pair<const char*, double> units[] = {
      {"1", 0.0254},  {"2", 0.3048},  {"3", 1609.344}, {"4", 1e-3},
      {"5", 1e-2},    {"6", 1},       {"7", 1000},     {"8", 2.54e-8},
      {"9", 2.54e-5}, {"10", 0.9144}, {"12", 1e-9},    {"13", 1e-6},
      {"14", 0.1},    {"15", 10},     {"16", 100},     {"21", 0.3048006096}};
  for (const auto& [unit, size] : units) {
    INFO(unit);
    CHECK(metres(unit) == Approx(size).epsilon(1e-9));
  }
  CHECK(metres("0") == 0);
  const DxfPlan odd = plan_of(dxf_of(dxf_line("W", "0", "0", "1", "0"), unit_variable("99")));
  CHECK(odd.metres_per_unit == 0);
  CHECK(odd.unit_problem.find("$INSUNITS = 99") != std::string::npos);
  CHECK(plan_of(dxf_drawing("", "0")).unit_problem.find("states no unit") != std::string::npos);
}

TEST_CASE("a byte order mark, line ends of three kinds and a missing end are read", "[dxf]") {
  const std::string text = dxf_of(dxf_line("W", "0", "0", "1", "0"));
  CHECK(plan_of("\xef\xbb\xbf" + text).segments.size() == 1);
  for (const char* end : {"\r\n", "\r"}) {
    std::string other;
    for (const char c : text) other += c == '\n' ? std::string(end) : std::string(1, c);
    CHECK(plan_of(other).segments.size() == 1);
  }
  CHECK(says(plan_of(text.substr(0, text.size() - 6)), "does not end with EOF"));
  CHECK(plan_of(text + "\n\x1a").notes.empty());
  CHECK(plan_of(text + "what follows\nis not of the drawing\n").notes.empty());
}

TEST_CASE("a value that is no number is an error with its line", "[dxf]") {
  for (const char* word : {"nan", "inf", "1e999", "0,5", "x", ""}) {
    INFO(word);
    const std::string text = dxf_of(dxf_line("W", "0", word, "1", "0"));
    const auto plan = dxf_plan_of(text, "x.dxf");
    REQUIRE_FALSE(plan.ok());
    CHECK(plan.problem().where.line == 18);
    CHECK(plan.problem().what.find("is no number") != std::string::npos);
  }
  const auto shifted = dxf_plan_of(dxf_of("0\nLINE\nWALLS\n8\n"), "x.dxf");
  REQUIRE_FALSE(shifted.ok());
  CHECK(shifted.problem().where.line == 13);
  CHECK(shifted.problem().what.find("a group code is expected") != std::string::npos);
}

TEST_CASE("a file that is not a plan is rejected with a message", "[dxf]") {
  CHECK(refusal_of("AC1027 and more").find("this is a DWG drawing: save it as DXF in text") !=
        std::string::npos);
  CHECK(refusal_of("AutoCAD Binary DXF\r\n\x1a").find("in binary DXF: save it as DXF in text") !=
        std::string::npos);
  CHECK(refusal_of("hello\nworld\n") == "x.dxf: this is no DXF drawing");
  CHECK(refusal_of("").find("no DXF drawing") != std::string::npos);
  CHECK(refusal_of(dxf_of(dxf_groups({{0, "3DFACE"}, {8, "W"}}))).find("not read: 1 3DFACE") !=
        std::string::npos);
  const TemporaryFolder folder;
  const auto read = read_dxf_plan(folder.write("a.dxf", dxf_drawing()));
  REQUIRE(read.ok());
  CHECK(read->segments.size() == 4);
  CHECK(read_dxf_plan(folder / "absent.dxf").problem().text().find("absent.dxf") !=
        std::string::npos);
}

TEST_CASE("mutated drawings are read or rejected with one sentence", "[dxf]") {
  const char* seed_text = std::getenv("LUXODUS_SEED");
  const char* count_text = std::getenv("LUXODUS_MUTATIONS");
  const uint64_t seed = seed_text != nullptr ? std::strtoull(seed_text, nullptr, 0) : 1;
  const uint64_t tries = count_text != nullptr ? std::strtoull(count_text, nullptr, 0) : 2000;
  INFO("seed " << seed);
  Random random(seed, RandomStream::test);
  random.start(0);
  const auto bytes_of = [](const std::string& text) {
    const auto* from = reinterpret_cast<const std::byte*>(text.data());
    return Bytes(from, from + text.size());
  };
  std::string curves = dxf_groups(
      {{0, "SPLINE"},  {8, "S"},    {71, "2"},       {40, "0"},     {40, "0"},   {40, "0"},
       {40, "1"},      {40, "1"},   {40, "1"},       {41, "1"},     {41, "0.7"}, {41, "1"},
       {10, "1"},      {20, "0"},   {10, "1"},       {20, "1"},     {10, "0"},   {20, "1"},
       {0, "ELLIPSE"}, {8, "E"},    {10, "1"},       {20, "2"},     {11, "3"},   {40, "0.5"},
       {41, "0"},      {42, "3"},   {230, "-1"},     {0, "INSERT"}, {2, "LAMP"}, {70, "3"},
       {71, "2"},      {44, "1"},   {0, "POLYLINE"}, {8, "P"},      {70, "5"},   {0, "VERTEX"},
       {10, "1"},      {42, "0.5"}, {0, "VERTEX"},   {10, "2"},     {70, "16"},  {0, "SEQEND"}});
  const Bytes one = bytes_of(dxf_drawing(curves)),
              other = bytes_of(dxf_of(dxf_line("\xc4\\U+00C4\\M+195C7", "1e308", "-1", "7", "2"),
                                      written_in("AC1015", "ANSI_932") + unit_variable("2")));
  uint64_t read = 0;
  for (uint64_t i = 0; i < tries; ++i) {
    const Bytes harmed = i % 2 == 0 ? mutated(one, other, random) : mutated(other, one, random);
    const auto plan = dxf_plan_of(
        std::string(reinterpret_cast<const char*>(harmed.data()), harmed.size()), "harmed.dxf");
    if (plan) {
      REQUIRE(is_finite_plan(plan.value()));
      const auto contents = with_contents_of(plan.value(), [](const std::string&) { return true; });
      if (contents) REQUIRE(is_finite_plan(contents.value()));
    } else
      REQUIRE_FALSE(plan.problem().what.empty());
    read += plan.ok() ? 1 : 0;
  }
  CHECK(read > tries / 10);
  CHECK(read < tries);
}
