// Charts, sheets of luminaires and rooms of a report: what they show is what the assessment found,
// and no text covers another.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <regex>

#include "actors/judge/report/luminaire_drawing.hpp"
#include "actors/judge/report/overview.hpp"
#include "actors/judge/report/report.hpp"
#include "actors/judge/report/surface_chart.hpp"
#include "actors/judge/report/svg_sheet.hpp"
#include "scenes/emergency/spacing.hpp"
#include "tests/unit/actors/judge/assess/assessed_room.hpp"

namespace luxodus {

using namespace test;

namespace {

const AssessmentRecord& lit_room() {
  static const AssessmentRecord record = recorded(room, codes_alone());
  return record;
}

struct WrittenValue {
  double x, y, size;
  std::string text;
  double left() const { return x - text_width_mm(text, size) / 2; }
  double right() const { return x + text_width_mm(text, size) / 2; }
};

/// The numbers of a chart's group of values.
std::vector<WrittenValue> values_of(const std::string& svg) {
  const size_t from = svg.find("<g class=\"values\"");
  REQUIRE(from != std::string::npos);
  const std::string group = svg.substr(from, svg.find("</g>", from) - from);
  const std::regex text(
      "<text x=\"([-0-9.]+)\" y=\"([-0-9.]+)\" font-size=\"([0-9.]+)\"[^>]*>([^<]+)<");
  std::vector<WrittenValue> out;
  for (std::sregex_iterator at(group.begin(), group.end(), text), end; at != end; ++at)
    out.push_back({std::stod((*at)[1]), std::stod((*at)[2]), std::stod((*at)[3]), (*at)[4]});
  return out;
}

size_t count_of(const std::string& text, const std::string& piece) {
  size_t out = 0;
  for (size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) ++out;
  return out;
}

SurfaceChart chart_of(const AssessmentRecord& record, const PlanSize& size = {180, 92}) {
  static std::vector<std::unique_ptr<Schedule>> kept;
  kept.push_back(std::make_unique<Schedule>(record));
  return surface_chart(record, *kept.back(), english(), record.surfaces.front(), size);
}

}  // namespace

TEST_CASE("values on a chart are at least 7 pt and cover neither each other nor the route",
          "[report][chart]") {
  const AssessmentRecord& a = lit_room();
  REQUIRE(a.surfaces.size() == 1);
  for (const double width : {180.0, 120.0, 70.0}) {
    const SurfaceChart chart = chart_of(a, {width, 92});
    const auto values = values_of(chart.plan.svg);
    REQUIRE(values.size() > 4);
    CHECK(values.size() == chart.values);
    CHECK(chart.points >= chart.values);
    // The route is a straight line along x in the middle of its chart.
    const std::regex route("class=\"route\" d=\"M([-0-9.]+) ([-0-9.]+)L");
    std::smatch line;
    REQUIRE(std::regex_search(chart.plan.svg, line, route));
    const double route_y = std::stod(line[2]);
    for (size_t i = 0; i < values.size(); ++i) {
      const WrittenValue& one = values[i];
      INFO(width << " mm: " << one.text);
      CHECK(one.size >= 7 * 25.4 / 72 - 0.005);
      // Digits reach from the baseline up by 0.72 of their size.
      CHECK((one.y < route_y - 0.2 || one.y - 0.72 * one.size > route_y + 0.2));
      for (size_t j = 0; j < i; ++j) {
        const WrittenValue& other = values[j];
        const bool apart = one.right() <= other.left() || other.right() <= one.left() ||
                           one.y <= other.y - 0.72 * other.size ||
                           other.y <= one.y - 0.72 * one.size;
        CHECK(apart);
      }
    }
  }
}

TEST_CASE("a chart and its table state the smallest, mean and largest of its points",
          "[report][chart]") {
  const SurfaceGridRecord& centre = lit_room().surfaces.front().grids.front();
  CHECK(centre.kind == "centre");
  double least = 1e9, most = 0, sum = 0;
  for (const PlanPoint& point : centre.points) {
    least = std::min(least, point.lux);
    most = std::max(most, point.lux);
    sum += point.lux;
  }
  CHECK(centre.least == least);
  CHECK(centre.most == most);
  CHECK(centre.mean == Approx(sum / static_cast<double>(centre.points.size())));
  // The lamp hangs above the middle of the route, at 6 m.
  CHECK(centre.brightest.x == Approx(6).margin(0.51));
  CHECK(std::abs(centre.darkest.x - 6) > 4);
  const std::string page = report_html(lit_room(), {}, {});
  const Texts t = english();
  CHECK(page.find(escaped(t.number(least)) + "\u00a0lx") != std::string::npos);
  CHECK(page.find(escaped(t.number(most)) + "\u00a0lx") != std::string::npos);
}

TEST_CASE("a door that a route passes cuts no line of its chart", "[report][chart]") {
  AssessmentRecord with_door = lit_room();
  auto& walls = with_door.plan.levels.front().walls;
  walls.push_back({{8, -2}, {8, -0.5}});
  walls.push_back({{8, 0.5}, {8, 2}});
  walls.push_back({{8, 0.5}, {8.9, 0.4}});  // its open leaf
  CHECK(count_of(chart_of(with_door).plan.svg, "class=\"isolux\"") ==
        count_of(chart_of(lit_room()).plan.svg, "class=\"isolux\""));
  CHECK(count_of(chart_of(lit_room()).plan.svg, "class=\"isolux\"") > 0);
}

TEST_CASE("on stairs a chart is coloured by the points on the treads, not by the floor below them",
          "[report][chart]") {
  AssessmentRecord a = lit_room();
  for (DrawnLux& lux : a.plan.levels.front().map.lux) lux.lux = 0;  // as in the body of a stair
  const std::string dark = chart_of(a).plan.svg;
  for (SurfaceGridRecord& grid : a.surfaces.front().grids)
    for (PlanPoint& point : grid.points) point.place.z = point.place.x > 6 ? 1.7 : 0.02;
  const std::string stairs = chart_of(a).plan.svg;
  const std::string darkest = std::string("<path fill=\"") + lux_colour(0);
  CHECK(dark.find(darkest) != std::string::npos);
  CHECK(count_of(dark, "<path fill=") == 1);
  CHECK(count_of(stairs, "<path fill=") > 1);
}

TEST_CASE("the sheet of a luminaire has its curve and spacing, and says what is not stated",
          "[report][sheet]") {
  const std::string text =
      replaced(room, "[[route]]", rated_lamp("level", "[3, 0, 2.9]") + "[[route]]");
  AssessmentRecord a = recorded(text, codes_alone());
  const auto lamp = std::find_if(a.luminaires.begin(), a.luminaires.end(),
                                 [](const LuminaireRecord& one) { return one.name == "level"; });
  REQUIRE(lamp != a.luminaires.end());
  const SheetRecord& sheet = a.sheets.at(lamp->sheet);
  const double isotropic = 1000 / (4 * std::numbers::pi);
  for (const auto* curve : {&sheet.c0_c180, &sheet.c90_c270})
    for (const double cd : *curve) CHECK(cd == Approx(isotropic).epsilon(1e-3));
  // 500 lm on emergency supply, whose initial flux is not known: one life.
  REQUIRE_FALSE(sheet.spacing.empty());
  for (const SpacingRowRecord& row : sheet.spacing) {
    CHECK(row.factor == 1);
    const double candela = 500 / (4 * std::numbers::pi), h = row.height_m - 0.02;
    CHECK(row.along.has_value() == (candela / (h * h) >= row.level_lx));
    if (!row.along) continue;
    CHECK(row.along->to_wall_m ==
          Approx(std::sqrt(std::pow(candela * h / row.level_lx, 2.0 / 3) - h * h)).epsilon(1e-4));
  }
  CHECK(std::any_of(sheet.spacing.begin(), sheet.spacing.end(),
                    [](const SpacingRowRecord& row) { return row.height_m == Approx(2.9); }));
  const std::string page = report_html(a, {}, {});
  CHECK(page.find(english()("sheet.not_stated")) != std::string::npos);
  CHECK(page.find(english()("sheet.no_body")) != std::string::npos);
  a.sheets[lamp->sheet].article = "LX <9>";
  a.sheets[lamp->sheet].body_m = {0.3, 0.1, 0.05};
  const std::string stated = report_html(a, {}, {});
  CHECK(stated.find("LX &lt;9&gt;") != std::string::npos);
  CHECK(stated.find("300 × 100 × 50 mm") != std::string::npos);
}

TEST_CASE("each room is listed with what it holds, and named on the plan", "[report][rooms]") {
  const std::string rooms =
      "[[room]]\nname = \"west\"\noutline = [[0, -2], [5.9, -2], [5.9, 2], [0, 2]]\n"
      "[[room]]\nname = \"east\"\noutline = [[5.9, -2], [12, -2], [12, 2], [5.9, 2]]\n";
  const AssessmentRecord a = recorded(room + rooms, codes_alone());
  REQUIRE(a.rooms.size() == 2);
  CHECK(a.rooms[0].area_m2 == Approx(5.9 * 4));
  CHECK(a.rooms[0].emergency + a.rooms[0].mains + a.rooms[0].signs == 0);
  CHECK(a.rooms[1].emergency == 1);
  CHECK(a.rooms[1].signs == 1);
  const Schedule schedule(a);
  const std::string plan = Plans(a, schedule, english(), {}).installation(0).svg;
  for (const char* name : {">west<", ">east<", ">23.6 m²<"})
    CHECK(plan.find(name) != std::string::npos);
}

TEST_CASE("a rule that is judged without and with furniture has one row", "[report]") {
  const AssessmentRecord& a = lit_room();
  const std::string page = report_html(a, {}, {});
  const size_t from = page.find("<h2 id=\"places\""), to = page.find("<h2 id=\"sights\"");
  const std::string section = page.substr(from, to - from);
  CHECK(section.find(english()("column.without")) != std::string::npos);
  CHECK(count_of(section, "<span class=\"id\">E1</span>") == 1);
  CHECK(count_of(section, "<span class=\"id\">E4</span>") == 1);
}

TEST_CASE("clauses stand beside the edition that has them", "[report]") {
  AssessOptions options = codes_alone();
  options.rules = {"en1838-2024"};
  const std::string page = report_html(recorded(room, options), {}, {});
  CHECK(page.find("EN 1838:2013, taken over by EN 1838:2024") != std::string::npos);
  CHECK(page.find(" of 2013") == std::string::npos);
}

TEST_CASE("the cover shows every storey, its luminaires and signs", "[report][overview]") {
  const AssessmentRecord& a = lit_room();
  const Schedule schedule(a);
  const std::string one = overview_svg(a, schedule, english(), {180, 88});
  CHECK(count_of(one, "<circle") == 1);
  AssessmentRecord two = a;
  two.plan.levels.push_back(two.plan.levels.front());
  two.plan.levels.back().floor_m = 3;
  const Schedule storeys(two);
  const std::string both = overview_svg(two, storeys, english(), {180, 88});
  CHECK(count_of(both, "fill-opacity") == 2 * count_of(one, "fill-opacity"));
}

}  // namespace luxodus
