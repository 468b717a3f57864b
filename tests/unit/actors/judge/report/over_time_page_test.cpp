// Tests guidance over time in a report: its section on the page, and the map of places and times.
#include <librsvg/rsvg.h>

#include <array>
#include <catch2/catch.hpp>

#include "actors/judge/report/guidance_map.hpp"
#include "actors/judge/report/report.hpp"
#include "runtime/core/regular_file.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/judge/assess/assessed_room.hpp"

namespace luxodus {

using namespace test;

namespace {

bool holds_text(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

/// A route with three places, three states and two walkers.
AssessmentRecord with_guidance() {
  OverTime over;
  over.walking_speed_m_s = 0.5;
  over.holds_for = {0.1, 0.5, 0};
  RouteOverTime route;
  route.route = "way <out>";
  route.eye_height_m = 1.65;
  route.guided.length_m = 9;
  route.guided.along_m = {0, 3, 6};
  constexpr Guidance yes = Guidance::guided, no = Guidance::not_guided;
  route.guided.at = {{yes, yes, yes}, {yes, Guidance::undecided, yes}, {no, no, no}};
  route.guided.times_s = {0, 30, 60};
  for (const double at : route.guided.times_s) over.states.emplace_back().at_s = at;
  route.by_jin = route.by_line = route.by_fds = route.guided;
  route.visibility_m.assign(3, {30.0, 12.5, std::nullopt});
  route.signs.assign(3, {"exit", "exit", ""});
  for (const double start : {0.0, 60.0}) route.walks.push_back({walk(route.guided, start, 0.5)});
  over.routes.push_back(route);
  AssessOptions options;
  options.reality = false;
  AssessmentRecord a = recorded(room, options);
  a.over_time = over;
  return a;
}

}  // namespace

TEST_CASE("a report says and draws until when routes are guided, in each language", "[report]") {
  const AssessmentRecord a = with_guidance();
  const std::array<const char*, 3> until{"up to 0 s, lost by 30 s", "bis 0 s, verloren bis 30 s",
                                         "jusqu’à 0 s, perdu à 30 s"};
  for (const Language language : {Language::en, Language::de, Language::fr}) {
    ReportOptions options;
    options.language = language;
    const std::string page = report_html(a, {}, options);
    CHECK(holds_text(page, "id=\"over-time\""));
    CHECK(holds_text(page, until[static_cast<size_t>(language)]));
    CHECK(holds_text(page, "ASET/RSET"));
    CHECK(holds_text(page, "way &lt;out&gt;"));
    CHECK_FALSE(holds_text(page, "way <out>"));
  }
  AssessmentRecord silent = a;
  silent.over_time.reset();
  CHECK_FALSE(holds_text(report_html(silent, {}, {}), "id=\"over-time\""));
  const std::string map =
      guidance_map(*a.over_time, a.over_time->routes[0], Texts(Language::en), 180);
  GError* error = nullptr;
  RsvgHandle* drawing =
      rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(map.data()), map.size(), &error);
  REQUIRE(drawing != nullptr);
  g_object_unref(drawing);
  // Two intervals of three places: in the first one place is undecided, in the second one is not
  // guided.
  const auto count = [&](const std::string& colour) {
    size_t out = 0;
    for (size_t at = map.find(colour); at != std::string::npos; at = map.find(colour, at + 1))
      ++out;
    return out;
  };
  CHECK(count("#2f8f5b") == 2 + 1);  // one more in the legend
  CHECK(count("#e0b23a") == 1 + 1);
  CHECK(count("#4a2a33") == 3 + 1);
  const TemporaryFolder folder;
  REQUIRE(write_report(folder.path(), a, {}).ok());
  const auto written =
      read_regular_file(folder.path() / "plans" / "guided_way__out__1.65m.svg", uint64_t{1} << 20);
  REQUIRE(written.ok());
  CHECK(written.value() == map);
}

}  // namespace luxodus
