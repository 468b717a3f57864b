// Maps and their files: what a program that looks up the nearest place and time is told.
#include "actors/judge/visibility_map/map_files.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "runtime/core/regular_file.hpp"
#include "tests/kit/process.hpp"
#include "tests/unit/actors/judge/visibility_map/small_smoky_room.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// A map of 3 by 2 places, one sign, three times: all read but for what is said.
VisibilityMap small_map() {
  VisibilityMap map;
  map.scene = "small";
  map.grid = {{0, 0}, 1, 3, 2};
  map.heights_m = {1.65};
  map.times_s = {0, 10, 40};
  map.signs = {"exit"};
  map.sign_places = {{1.5, 5, 2}};
  map.answers.assign(map.table(1, 0, 0), SignAnswer::read);
  map.surely_seen.assign(map.answers.size(), 1);
  return map;
}

void set(VisibilityMap& map, size_t state, size_t place, SignAnswer answer) {
  map.answers[map.table(0, state, 0) + place] = answer;
  map.surely_seen[map.table(0, state, 0) + place] = answer == SignAnswer::seen ? 1 : 0;
}

EvacSign exit_sign() {
  EvacSign out;
  out.node = "exit";
  out.description = Json::array();
  for (const Json& value : {Json("exit"), Json(1.5), Json(5), Json(180), Json(8)})
    out.description.push_back(value);
  return out;
}

size_t nearest(const std::vector<double>& axis, double value) {
  size_t best = 0;
  for (size_t i = 0; i < axis.size(); ++i)
    if (std::abs(axis[i] - value) < std::abs(axis[best] - value)) best = i;
  return best;
}

/// As the other program looks up.
bool told(const EvacTable& table, const std::vector<char>& values, double time_s, double x,
          double y) {
  const size_t at = nearest(table.times_s, time_s) * table.y_m.size() + nearest(table.y_m, y);
  return values[at * table.x_m.size() + nearest(table.x_m, x)] != 0;
}

/// Runs the independent reader.
std::string read_back(const std::vector<std::string>& words) {
  std::vector<std::string> all{std::string(LUX_SOURCE_DIR) + "/tests/tools/read_visibility_map.py"};
  all.insert(all.end(), words.begin(), words.end());
  Process python("/usr/bin/python3", all);
  const int code = python.wait();
  INFO(python.text());
  CHECK(code == 0);
  return python.text();
}

const char* const config = R"({
  "exits": {"way out": {"sign": {"x": 11.9, "y": 0.0, "alpha": 270}}, "other": {}},
  "checkpoints": {"c": {"sign": null}}
})";

}  // namespace

TEST_CASE("between two times a map says what holds at both", "[judge][visibility_map]") {
  VisibilityMap map = small_map();
  set(map, 1, 4, SignAnswer::seen);  // at (1.5, 1.5), 10 s
  set(map, 2, 0, SignAnswer::undecided);
  const EvacTable table = evac_table(map, 0, {exit_sign()});
  const auto read = [&](double t, double x, double y) { return told(table, table.read, t, x, y); };
  for (const double t : {0.0, 0.1, 4.0, 9.9, 10.1, 25.0, 39.9}) {
    CHECK(read(t, 2.5, 0.5));
    CHECK_FALSE(read(t, 1.5, 1.5));  // not at 10 s, hence neither before nor after
    CHECK(told(table, table.seen, t, 1.5, 1.5));
    CHECK(read(t, 0.5, 0.5) == (t < 10));  // undecided at 40 s is false
  }
}

TEST_CASE("beyond its places and times a map says no", "[judge][visibility_map]") {
  const EvacTable table = evac_table(small_map(), 0, {exit_sign()});
  CHECK(told(table, table.read, 5, 0.1, 0.1));
  CHECK_FALSE(told(table, table.read, 5, -0.1, 0.5));
  CHECK_FALSE(told(table, table.read, 5, 3.1, 0.5));
  CHECK_FALSE(told(table, table.read, 5, 1.5, 2.1));
  CHECK_FALSE(told(table, table.read, 5, 1e6, 1e6));
  CHECK_FALSE(told(table, table.read, -0.5, 1.5, 0.5));
  CHECK_FALSE(told(table, table.read, 40.5, 1.5, 0.5));
  VisibilityMap still = small_map();
  still.times_s.clear();
  const EvacTable always = evac_table(still, 0, {exit_sign()});
  CHECK(told(always, always.read, 1e4, 1.5, 0.5));
}

TEST_CASE("directions of view are compass bearings", "[judge][visibility_map]") {
  const glm::dvec3 north(0, 5, 2), east(5, 0, 2);
  CHECK(is_in_view(0, {0, 0}, north));
  CHECK_FALSE(is_in_view(0, {0, 0}, east));
  CHECK(is_in_view(90, {0, 0}, east));
  CHECK(is_in_view(45, {0, 0}, east));
  CHECK(is_in_view(30, {0, 0}, east));
  CHECK_FALSE(is_in_view(29, {0, 0}, east));
  CHECK(is_in_view(180, {5, 0}, east));  // straight above
}

TEST_CASE("signs of a config.json are those of the scene by name, or by place and direction",
          "[judge][visibility_map]") {
  const auto scene = described_text(smoky_room("0.5"));
  const std::vector<const Sign*> signs{&scene->signs.front()};
  const TemporaryFolder folder;
  const auto by_place = read_evac_signs(folder.write("a.json", config), signs);
  REQUIRE(by_place);
  REQUIRE(by_place->size() == 1);
  CHECK(by_place->front().node == "way out");
  CHECK(by_place->front().description.dump() == R"(["way out",11.9,0.0,270,3])");
  const auto by_name = read_evac_signs(
      folder.write("b.json", R"({"waypoints": {"exit": {"sign": {"x": 0, "y": 0, "alpha": 0,
                                 "c": 8}}}})"),
      signs);
  REQUIRE(by_name);
  CHECK(by_name->front().sign == 0);
  const auto refused = [&](const char* text, const char* words) {
    const auto read = read_evac_signs(folder.write("c.json", text), signs);
    REQUIRE_FALSE(read);
    INFO(read.problem().text());
    CHECK(read.problem().text().find(words) != std::string::npos);
  };
  refused("{", "no config.json");
  refused("[]", "no JSON object");
  refused("{}", "no exit, checkpoint or waypoint has a \"sign\"");
  refused(R"({"exits": {"e": {"sign": {"x": 1}}}})", "needs the numbers x, y and alpha");
  refused(R"({"exits": {"e": {"sign": {"x": 11.9, "y": 0, "alpha": 90}}}})", "none of the map");
  refused(R"({"exits": {"e": {"sign": {"x": 5, "y": 0, "alpha": 270}}}})", "none of the map");
}

TEST_CASE("a program that follows the rules of pyFDS-Evac reads a map back",
          "[judge][visibility_map]") {
  const TemporaryFolder folder;
  const auto scene_file = folder.write("room.toml", thickening_room());
  const auto config_file = folder.write("config.json", config);
  MapRequest request;
  request.estimates.states = states_of(scene_file);
  request.estimates.options.rounds = 2;
  request.spacing_m = 0.5;
  request.heights_m = {1.65, 1.0};
  request.facings_deg = {90, 270};
  const auto map = make_map(request, nobody_interrupts, say_nothing);
  INFO((map ? "" : map.problem().text()));
  REQUIRE(map);
  CHECK(map->grid.columns >= 24);
  const std::vector<const Sign*> signs{&request.estimates.states.last->signs.front()};
  const auto evac = read_evac_signs(config_file, signs);
  REQUIRE(evac);
  EvacRun run{config_file, folder.path(), 10, 2};
  const auto fds_folder = fds_folder_of(run, *request.estimates.states.last);
  REQUIRE(fds_folder);
  REQUIRE(write_map(folder.path(), map.value(), evac.value(),
                    evac_meta(run, *fds_folder, evac.value())));
  const std::string file = folder / evac_map_file;
  const auto answers = [&](const std::string& by_hand) {
    std::vector<std::string> words{file,
                                   "--config",
                                   config_file,
                                   "--fds-dir",
                                   folder.path(),
                                   "--ask=15,10.1,0.1,way out",
                                   "--ask=15,3.1,-1.1,way out",
                                   "--ask=45,1.1,0.9,way out",
                                   "--ask=15,-3,0.1,way out",
                                   "--ask=61,10.1,0.1,way out"};
    if (!by_hand.empty()) words.push_back(by_hand);
    return read_back(words);
  };
  // Near the sign in thin smoke; behind the screen; far away in dense smoke; outside; too late.
  CHECK(answers("") == "taken\ntrue\nfalse\nfalse\nfalse\nfalse\n");
  CHECK(answers("--by-hand") == answers(""));
  CHECK(read_back({file, "--config", config_file, "--fds-dir", folder.path(), "--interval", "5"}) ==
        "not taken\n");
  CHECK(std::filesystem::exists(folder / "visibility" / "visibility_1m.npz"));
  CHECK(std::filesystem::exists(folder / "visibility" / "state_0002_1.65m.vti"));
  const auto table = read_regular_file(folder / map_table_file, 1 << 24);
  REQUIRE(table);
  CHECK(table->substr(0, table->find('\n')) == "time_s,height_m,x_m,y_m,exit");
}

TEST_CASE("what pyFDS-Evac will do with a file is said", "[judge][visibility_map]") {
  CHECK(evac_words({}, std::nullopt, "a.npz").find("will NOT take") != std::string::npos);
  CHECK(evac_words({}, "/x", "a.npz").find("not known") != std::string::npos);
  const std::string words = evac_words({"c.json", "", 5, 1.5}, "/nowhere", "a.npz");
  CHECK(words.find("will take a.npz for c.json") != std::string::npos);
  CHECK(words.find("--reroute-interval 5 --smoke-slice-height 1.5") != std::string::npos);
  CHECK(words.find("no folder /nowhere") != std::string::npos);
}

TEST_CASE("a map that is too large is refused before anything is traced",
          "[judge][visibility_map]") {
  MapRequest request;
  request.estimates.states.last = described_text(smoky_room("0.5"));
  request.spacing_m = 1e-4;
  const auto large = make_map(request, nobody_interrupts, say_nothing);
  REQUIRE_FALSE(large);
  CHECK(large.problem().text().find("--map-spacing") != std::string::npos);
  request.spacing_m = 1;
  request.estimates.signs = {"exitt"};
  const auto unknown = make_map(request, nobody_interrupts, say_nothing);
  REQUIRE_FALSE(unknown);
  CHECK(unknown.problem().text().find("there is no sign \"exitt\"") != std::string::npos);
}

TEST_CASE("a map ends when it is interrupted", "[judge][visibility_map]") {
  const std::atomic<bool> interrupted{true};
  MapRequest request;
  request.estimates.states.last = described_text(smoky_room("0.5"));
  request.spacing_m = 1;
  const auto map = make_map(request, interrupted, say_nothing);
  REQUIRE_FALSE(map);
  CHECK(map.problem().text().find("interrupted") != std::string::npos);
}
