// Guided routes over time in rooms with a known answer: smoke that sinks below a sign, mains that
// fail, an exhausted supply, people who walk.
#include "actors/judge/assess/over_time.hpp"

#include <catch2/catch.hpp>

#include "actors/judge/assess/guidance_words.hpp"
#include "tests/kit/small_fire.hpp"
#include "tests/unit/actors/judge/assess/assessed_room.hpp"

namespace luxodus {
namespace {

/// The room with a sign that leads along its route; the first table of `more` may belong to the
/// sign.
std::string timed_room(const std::string& sign_more, const std::string& more) {
  return test::replaced(test::room, "lighting = \"internal\"\n",
                        "lighting = \"internal\"\n" + sign_more +
                            "[[sign.leads_to]]\nroute = \"way\"\narrow = \"ahead\"\n") +
         more;
}

/// Dense smoke under the ceiling; its lower boundary is at 3 m at 0 s and sinks by 2 cm/s.
std::string sinking(const std::string& extinction) {
  return "[[medium]]\nname = \"smoke\"\nkind = \"layered\"\n[[medium.layer]]\n"
         "z_low = [[0, 3], [100, 1]]\nz_high = 3\nalbedo = 0.3\nextinction = " +
         extinction + "\n";
}

SceneAtTime scenes_of(const std::string& text) {
  return [text](double at_s) -> Result<std::shared_ptr<const SceneDescription>> {
    const test::TemporaryFolder folder;
    ReadScene read = read_scene(folder.write("scene.toml", text), at_s);
    if (!read.scene) return read.problems.list().front();
    return std::make_shared<const SceneDescription>(std::move(*read.scene));
  };
}

Result<OverTime> tried_over(const std::string& text, const std::vector<double>& times) {
  static const std::atomic<bool> nobody{false};
  return assess_over_time(times, scenes_of(text), {}, nobody, [](const std::string&, double) {});
}

OverTime over(const std::string& text, const std::vector<double>& times) {
  auto result = tried_over(text, times);
  INFO((result.ok() ? "" : result.problem().text()));
  REQUIRE(result.ok());
  return std::move(result).value();
}

size_t guided_places(const RouteOverTime& route, size_t state) {
  size_t out = 0;
  for (size_t i = 0; i < route.guided.along_m.size(); ++i) out += route.guided.holds(state, i);
  return out;
}

}  // namespace

TEST_CASE("a route is guided until the lower boundary of the smoke passes the sign",
          "[assess][time]") {
  // Edges of the sign's letters are at 2.125 and 2.275 m: reached at 43.75 and 36.25 s.
  const OverTime all = over(timed_room("", sinking("40")), {0, 20, 35, 46, 60});
  REQUIRE(all.routes.size() == 1);
  const RouteOverTime& route = all.routes.front();
  CHECK(route.route == "way");
  CHECK(route.eye_height_m == 1.65);
  REQUIRE(route.guided.along_m.size() == 3);
  for (size_t t = 0; t < 3; ++t) CHECK(guided_places(route, t) == 3);
  for (size_t t = 3; t < 5; ++t) CHECK(guided_places(route, t) == 0);
  const GuidedTime time = guided_time(route.guided);
  CHECK(time.until_s == 35);
  CHECK(time.lost_by_s == 46);
  CHECK(time.lost_at_m == 0);
  CHECK(route.signs.at(0).at(0) == "exit");
  CHECK(all.holds_for.low_albedo == 0.1);
  CHECK(all.holds_for.high_albedo == 0.5);
}

TEST_CASE("when smoke thickens, no further place becomes guided", "[assess][time]") {
  const std::string smoke =
      "[[medium]]\nname = \"smoke\"\nkind = \"homogeneous\"\nalbedo = 0.3\n"
      "extinction = [[0, 0], [60, 1.2]]\n";
  const OverTime all = over(timed_room("", smoke), {0, 15, 30, 45, 60});
  const RouteOverTime& route = all.routes.front();
  CHECK(guided_places(route, 0) == 3);
  CHECK(guided_places(route, 4) < 3);
  for (size_t t = 1; t < 5; ++t) CHECK(guided_places(route, t) <= guided_places(route, t - 1));
}

TEST_CASE("a sign that only the mains light guides until the mains fail", "[assess][time]") {
  const std::string dark_then = test::replaced(
      test::replaced(timed_room("", "[time]\nto = 60\nstep = 20\nmains_fail_at = 30\n"),
                     "emergency_white = 100", "emergency_white = 0"),
      "emergency_green = 10", "emergency_green = 0");
  const OverTime all = over(dark_then, {0, 20, 40, 60});
  const GuidedTime time = guided_time(all.routes.front().guided);
  CHECK(time.until_s == 20);
  CHECK(time.lost_by_s == 40);
  CHECK(all.states.at(1).operation == Operation::mains);
  CHECK_FALSE(all.states.at(1).seconds_after_failure.has_value());
  CHECK(all.states.at(2).operation == Operation::emergency);
  CHECK(all.states.at(2).seconds_after_failure == 10);
  CHECK(all.states.at(2).lit == 1);
}

TEST_CASE("a sign guides on its supply until the supply is exhausted", "[assess][time]") {
  // 0.01 h are 36 s, counted from the failure at 10 s.
  const OverTime all =
      over(timed_room("duration_h = 0.01\n", "[time]\nto = 60\nstep = 20\nmains_fail_at = 10\n"),
           {0, 20, 45, 46});
  const GuidedTime time = guided_time(all.routes.front().guided);
  CHECK(time.until_s == 45);
  CHECK(time.lost_by_s == 46);
}

TEST_CASE("the rated duration is checked if everything lit states its duration", "[assess][time]") {
  const auto check_of = [](const std::string& text) {
    const Assessment a = test::assessed(text, test::codes_alone());
    const auto at = std::find_if(a.checks.begin(), a.checks.end(),
                                 [](const Check& one) { return one.rule.id == RuleId::E11; });
    REQUIRE(at != a.checks.end());
    return *at;
  };
  const auto hours = [](const std::string& lamp, const std::string& sign) {
    return test::replaced(
        timed_room(sign.empty() ? "" : "duration_h = " + sign + "\n", ""),
        "end_of_duration_factor = 0.75\n",
        "end_of_duration_factor = 0.75\n" + (lamp.empty() ? "" : "duration_h = " + lamp + "\n"));
  };
  CHECK(check_of(hours("", "")).verdict == CheckVerdict::not_assessed);
  CHECK(check_of(hours("1", "")).verdict == CheckVerdict::not_assessed);
  CHECK(check_of(hours("1", "3")).verdict == CheckVerdict::pass);
  CHECK(check_of(hours("1", "3")).value == 1);
  CHECK(check_of(hours("3", "0.5")).verdict == CheckVerdict::fail);
}

TEST_CASE("a person who sets out in time is guided to the end", "[assess][time]") {
  const OverTime all =
      over(timed_room("", sinking("40") + "[time]\nto = 100\nstep = 10\nwalking_speed = 0.5\n"),
           {0, 20, 35, 46});
  const auto& walks = all.routes.front().walks;
  REQUIRE(walks.size() == 4);
  // The last place is 6.67 m along the route: 13.3 s of walking.
  CHECK(walks.at(0).end == GuidedWalk::End::arrives);
  // From there he walks until 40 s, and the state of 46 s is not guided.
  CHECK(walks.at(1).end == GuidedWalk::End::lost);
  CHECK(walks.at(1).at_m == Approx(20.0 / 3));
  CHECK(walks.at(2).end == GuidedWalk::End::lost);
  CHECK(walks.at(2).at_m == 0);
  CHECK(walks.at(3).end == GuidedWalk::End::lost);
  CHECK(walks.at(3).at_m == 0);
}

TEST_CASE("FDS's own visibility is shown beside the verdicts if the case has slices of it",
          "[assess][time][fds]") {
  using namespace test;
  const TemporaryFolder folder;
  const SmallMesh mesh = even_mesh({0, -2, 0}, {1, 1, 0.5}, {12, 4, 6});
  const std::array<int32_t, 6> level{0, 12, 0, 4, 3, 3};  // at 1.5 m
  const auto even = [](float metres) { return std::vector<float>(13 * 5, metres); };
  const auto thin = cell_values(mesh, [](int, int, int) { return 0.01F; });
  folder.write(
      "k.sf", slice_file(mesh, "SOOT EXTINCTION COEFFICIENT", {{0, thin}, {30, thin}, {60, thin}}));
  folder.write("v.sf", part_slice_file(level, "SOOT VISIBILITY",
                                       {{0, even(30)}, {30, even(6)}, {60, even(2)}}));
  const std::string index =
      index_of_meshes({mesh}) + slice_entry(1, true, mesh, "k.sf", "SOOT EXTINCTION COEFFICIENT");
  const std::string text =
      timed_room("",
                 "[[medium]]\nname = \"fire\"\nkind = \"fds\"\nfile = \"fire.smv\"\n"
                 "albedo = 0.2\ng = 0.6\nangstrom = 1\n"
                 "[time]\nto = 60\nstep = 30\n");
  const auto traced = [&](const std::string& whole_index) {
    folder.write("fire.smv", whole_index);
    folder.write("scene.toml", text);
    const SceneAtTime scenes = [&](double at_s) -> Result<std::shared_ptr<const SceneDescription>> {
      ReadScene read = read_scene(folder / "scene.toml", at_s);
      if (!read.scene) return read.problems.list().front();
      return std::make_shared<const SceneDescription>(std::move(*read.scene));
    };
    static const std::atomic<bool> nobody{false};
    auto result =
        assess_over_time({0, 30, 60}, scenes, {}, nobody, [](const std::string&, double) {});
    INFO((result.ok() ? "" : result.problem().text()));
    REQUIRE(result.ok());
    return std::move(result).value();
  };
  const OverTime all = traced(index + part_slice_entry(1, false, level, "v.sf", "SOOT VISIBILITY"));
  const RouteOverTime& route = all.routes.front();
  // The sign is at 11.95 m; places are 1, 4.33 and 7.67 m along the room.
  REQUIRE(route.by_fds.at.size() == 3);
  CHECK(route.by_fds.at[0] == std::vector<Guidance>(3, Guidance::guided));
  CHECK(route.by_fds.at[1] ==
        std::vector<Guidance>{Guidance::not_guided, Guidance::not_guided, Guidance::guided});
  CHECK(route.by_fds.at[2] == std::vector<Guidance>(3, Guidance::not_guided));
  CHECK(route.visibility_m[1][0].value_or(0) == Approx(6));
  // C/K of the thin smoke is 800 m, so the limit of 30 m applies: every place is nearer.
  CHECK(route.by_line.at[2] == std::vector<Guidance>(3, Guidance::guided));
  // Smoke this thin hides no sign, whatever the slice gives.
  CHECK(route.guided.holds(2));
  CHECK(guided_time(route.by_fds).until_s == 0);
  CHECK(guidance_csv(all).text().find("guided,exit,guided,guided,6,not guided\n") !=
        std::string::npos);
  CHECK(guidance_text(all).find("by FDS's VISIBILITY up to 0 s, lost by 30 s") !=
        std::string::npos);

  const OverTime without = traced(index);
  CHECK(without.routes.front().by_fds.at.empty());
  CHECK(guidance_text(without).find("by FDS") == std::string::npos);
  // A slice that cannot be read changes no verdict, and is reported once.
  folder.write("v.sf", "short");
  const OverTime damaged =
      traced(index + part_slice_entry(1, false, level, "v.sf", "SOOT VISIBILITY"));
  CHECK(damaged.routes.front().guided.at == without.routes.front().guided.at);
  REQUIRE(damaged.warnings.size() == 1);
  CHECK(damaged.warnings.front().find("VISIBILITY is not shown") != std::string::npos);
}

TEST_CASE("the line-of-sight method is shown beside the verdicts, with C/K, 30 m, and obstacles",
          "[assess][time]") {
  // Places are 1, 4.33 and 7.67 m along the room, 10.95, 7.62 and 4.28 m from the sign. C is 8: at
  // 1/m the sign is seen within 8 m.
  const std::string even =
      "[[medium]]\nname = \"smoke\"\nkind = \"homogeneous\"\nalbedo = 0.3\n"
      "extinction = [[0, 0], [60, 1], [120, 4]]\n";
  const RouteOverTime route = over(timed_room("", even), {0, 60, 120}).routes.front();
  using enum Guidance;
  REQUIRE(route.by_line.at.size() == 3);
  CHECK(route.by_line.at[0] == std::vector<Guidance>(3, guided));
  CHECK(route.by_line.at[1] == std::vector<Guidance>{not_guided, guided, guided});
  CHECK(route.by_line.at[2] == std::vector<Guidance>(3, not_guided));
  // Smoke above eye height is not on the horizontal line, although the sign hangs in it.
  const RouteOverTime high = over(timed_room("", sinking("40")), {60}).routes.front();
  CHECK(high.guided.at[0] == std::vector<Guidance>(3, not_guided));
  CHECK(high.by_line.at[0] == std::vector<Guidance>(3, guided));
  // A screen at eye height; the sign is visible above it.
  const std::string screen =
      "[[object]]\nname = \"screen\"\nshape = \"box\"\nlow = [6, -2, 1.6]\n"
      "high = [6.05, 2, 1.7]\nmaterial = \"grey50\"\n";
  const RouteOverTime screened =
      over(timed_room("", screen + "[time]\nto = 1\nstep = 1\n"), {0}).routes.front();
  CHECK(screened.by_line.at[0] == std::vector<Guidance>{not_guided, not_guided, guided});
}

TEST_CASE("the line-of-sight method takes extinction at the wavelength of FDS", "[assess]") {
  // No band is centred at 633 nm; bands are tens of nanometres wide.
  const Assessment a =
      test::assessed(test::room +
                     "[[medium]]\nname = \"smoke\"\nkind = \"homogeneous\"\nextinction = 0.5\n"
                     "wavelength_nm = 633\nangstrom = 1\nalbedo = 0.3\n");
  REQUIRE_FALSE(a.sights.empty());
  for (const SightRow& row : a.sights) {
    CHECK(row.line.extinction == Approx(0.5).epsilon(1e-4));
    CHECK(row.line.visibility_m == Approx(8 / 0.5).epsilon(1e-4));
    CHECK(row.line.clear);
  }
}

TEST_CASE(
    "an arrow in another direction guides nobody, and a scene without guiding signs is an error",
    "[assess][time]") {
  const std::string left =
      test::replaced(timed_room("", sinking("0.01")), "arrow = \"ahead\"", "arrow = \"left\"");
  CHECK_FALSE(guided_time(over(left, {0, 10}).routes.front().guided).until_s.has_value());
  const auto silent = tried_over(test::room + sinking("1"), {0, 10});
  REQUIRE_FALSE(silent.ok());
  CHECK(silent.problem().text().find("[[sign.leads_to]]") != std::string::npos);
}

TEST_CASE("the random numbers of a state do not depend on the other states", "[assess][time]") {
  const std::string text = timed_room("", sinking("0.6"));
  const OverTime both = over(text, {20, 60}), one = over(text, {60});
  CHECK(both.routes.front().guided.at.at(1) == one.routes.front().guided.at.at(0));
}

TEST_CASE("guidance over time is written to JSON and read back, and faults in it are named",
          "[assess][time]") {
  const std::string text = timed_room("",
                                      "[time]\nto = 60\nstep = 20\nmains_fail_at = 30\n"
                                      "walking_speed = 1\n");
  Assessment assessment = test::assessed(text, test::codes_alone());
  assessment.over_time = over(text, {0, 20, 40, 60});
  const AssessmentRecord record = record_of(*test::described_text(text), assessment, "1");
  const Json json = assessment_json(record);
  const auto again = assessment_of(json);
  REQUIRE(again);
  CHECK(assessment_json(again.value()) == json);
  CHECK(guidance_text(*again->over_time) == guidance_text(*record.over_time));
  const Json& route = json["over_time"]["routes"][0];
  CHECK(route["guided"][0].text() == "ggg");
  CHECK(route["time"]["until"]["value"] == 60);
  CHECK(route["time"]["lost_by"].is_null());
  CHECK(route["walks"].size() == 4);
  const std::string csv = guidance_csv(*again->over_time).text();
  CHECK(csv.find("way,1.65,0,0,guided,exit,guided,guided,,\n") != std::string::npos);
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 1 + 4 * 3);
  CHECK(guidance_text(*again->over_time).find("up to the last state, 60 s") != std::string::npos);
  Json cut = json;
  cut["over_time"]["routes"][0]["guided"][0] = "gg";
  const auto short_of = assessment_of(cut);
  REQUIRE_FALSE(short_of);
  CHECK(short_of.problem().what.find("as many values") != std::string::npos);
  Json silent = json;
  silent["over_time"]["states"] = Json::array();
  const auto empty = assessment_of(silent);
  REQUIRE_FALSE(empty);
  CHECK(empty.problem().what == "over_time.states is empty");
}

}  // namespace luxodus
