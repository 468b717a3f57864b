// Scenes that change in time: values as rows [seconds, value], the clock of [time], doors,
// exhausted supplies.
#include <catch2/catch.hpp>

#include "scenes/light/signs/onset.hpp"
#include "tests/unit/scenes/formats/scene_file/scene_fixture.hpp"

namespace luxodus {
namespace {

const std::string sinking =
    "[[medium]]\nname = \"smoke\"\nkind = \"layered\"\n[[medium.layer]]\n"
    "z_low = [[0, 3], [100, 1]]\nz_high = 3\nextinction = [[0, 0.2], [50, 0.4], [100, 2]]\n"
    "albedo = 0.2\n";
const std::string growing =
    "[[medium]]\nname = \"flame\"\nkind = \"bounded\"\nbody = \"cone\"\nradius = 0.3\nheight = 1\n"
    "position = [1, 2, 0]\nextinction = 1\nalbedo = 0.1\n[medium.emission]\n"
    "power_w = [[0, 0], [100, 2e5]]\ntemperature_k = 1400\n";
const std::string clock = "[time]\nfrom = 0\nto = 100\nstep = 30\nmains_fail_at = 40\n";
const std::string exit_sign =
    "[[sign]]\nname = \"exit\"\nposition = [9, 1, 2]\nfacing = [-1, 0, 0]\nwidth = 0.4\n"
    "height = 0.2\nplain = \"green\"\nsmallest_detail = 0.02\nmains_white = 500\n"
    "mains_green = 50\nemergency_white = 60\nemergency_green = 6\nduration_h = 0.02\n";
const std::string emergency = "[[scenario]]\nname = \"fire\"\noperation = \"emergency\"\n";

ReadScene read_at(SceneFolder& folder, const std::string& text, std::optional<double> at_s) {
  return read_scene(folder.put("scene.toml", text), at_s);
}

SceneDescription good_at(SceneFolder& folder, const std::string& text, double at_s) {
  ReadScene read = read_at(folder, text, at_s);
  INFO(all_problems(read));
  REQUIRE(read.scene.has_value());
  return *read.scene;
}

std::string refused_at(SceneFolder& folder, const std::string& text,
                       std::optional<double> at_s = std::nullopt) {
  const ReadScene read = read_at(folder, text, at_s);
  REQUIRE_FALSE(read.scene.has_value());
  return all_problems(read);
}

}  // namespace

TEST_CASE("a layer of a design fire sinks and thickens linearly between its rows",
          "[format][scene][time]") {
  SceneFolder f;
  const SceneDescription at_75 = good_at(f, sinking, 75);
  const Layer& layer = at_75.media.at(0).layers.at(0);
  CHECK(layer.z_low == near(1.5));
  CHECK(layer.z_high == 3);
  CHECK(layer.optics.extinction.sigma_t == near(1.2));
  CHECK(at_75.at_s == 75);
  const SceneDescription at_100 = good_at(f, sinking, 100);
  CHECK(at_100.media.at(0).layers.at(0).z_low == 1);
  CHECK(at_100.content_hash != at_75.content_hash);  // another state is another scene
  CHECK(good_at(f, sinking, 75).content_hash == at_75.content_hash);
}

TEST_CASE("a fire that has not begun is absent, and scenarios and changes may name it",
          "[format][scene][time]") {
  SceneFolder f;
  const std::string named =
      "[[scenario]]\nname = \"s\"\nmedia = { smoke = 0.5, flame = 1 }\n"
      "[[change]]\nkind = \"medium\"\nof = \"smoke\"\nfactor = 2\n";
  CHECK(good_at(f, sinking + growing + named, 0).media.empty());
  const SceneDescription later = good_at(f, sinking + growing + named, 50);
  REQUIRE(later.media.size() == 2);
  REQUIRE(later.media.at(1).emission.has_value());
  CHECK(later.media.at(1).emission->power_w == near(1e5));
}

TEST_CASE("impossible values over time are rejected with their line", "[format][scene][time]") {
  SceneFolder f;
  const auto with = [](const std::string& rows) {
    std::string text = sinking;
    text.replace(text.find("[[0, 3], [100, 1]]"), 18, rows);
    return text;
  };
  CHECK(refused_at(f, with("[[0, 3], [0, 2]]"), 0)
            .find("scene.toml:5: the times of 'z_low' must "
                  "ascend: 0 s follows 0 s") != std::string::npos);
  CHECK(refused_at(f, with("[[0, 3, 1]]"), 0).find("rows of two numbers") != std::string::npos);
  CHECK(refused_at(f, with("[]"), 0).find("has no row [seconds, value]") != std::string::npos);
  CHECK(refused_at(f, with("[[0, 1e9]]"), 0).find("must lie in") != std::string::npos);
  CHECK(refused_at(f, sinking, 100.5).find("known from 0 to 100 s, and the time is 100.5 s") !=
        std::string::npos);
  CHECK(refused_at(f, sinking, -1).find("the time is -1 s") != std::string::npos);
  CHECK(refused_at(f, sinking).find("changes in time, and no time is said") != std::string::npos);
  CHECK(refused_at(f, with("[[0, 4], [100, 1]]"), 0).find("must lie above 'z_low' at 0 s") !=
        std::string::npos);
  CHECK(refused_at(f, emergency, 5).find("nothing in this scene changes in time") !=
        std::string::npos);
}

TEST_CASE("a clock sets the time of a scene, and its mistakes are reported",
          "[format][scene][time]") {
  SceneFolder f;
  const SceneDescription first = good(f, clock + sinking + emergency);
  CHECK(first.at_s == 0);
  REQUIRE(first.time.has_value());
  CHECK(first.time->step_s == 30);
  CHECK(first.time->mains_fail_at_s == 40);
  CHECK_FALSE(first.time->walking_speed_m_s.has_value());
  CHECK(refused_at(f, "[time]\nfrom = 9\nto = 8\nstep = 1\n").find("before 'from'") !=
        std::string::npos);
  CHECK(refused_at(f, "[time]\nto = 8000\nstep = 1\n").find("more than 1000 states") !=
        std::string::npos);
  CHECK(refused_at(f, clock).find("no scenario says what is lit then") != std::string::npos);
  CHECK(refused_at(f, clock + emergency + "seconds_after_failure = 5\n")
            .find("follows from 'mains_fail_at'") != std::string::npos);
}

TEST_CASE("a supply without a duration lasts, and none does without emergency operation",
          "[format][scene][time]") {
  CHECK_FALSE(is_exhausted(std::nullopt, 1e9));
  CHECK_FALSE(is_exhausted(10, 9.9));
  CHECK(is_exhausted(10, 10));
  SceneFolder f;
  CHECK(refused_at(f,
                   "[[luminaire]]\nname = \"lamp\"\nfile = \"lamp.ies\"\nposition = [0, 0, 2]\n"
                   "duration_h = 1\n")
            .find("'duration_h' is given, but 'emergency' is not") != std::string::npos);
}

TEST_CASE("doors open and close at their times", "[format][scene][time]") {
  SceneFolder f;
  const std::string door =
      "[[object]]\nname = \"door\"\nshape = \"quad\"\ncorner = [0, 0, 0]\nedge_u = [0, 0, 2]\n"
      "edge_v = [0, 1, 0]\nmaterial = \"grey50\"\ndoor = { hinge = [0, 0, 0], open_angle_deg = 85 "
      "}\n";
  const std::string text = "[time]\nto = 100\nstep = 10\n" + door +
                           "[[scenario]]\nname = \"s\"\ndoors_closed = [\"door\"]\n"
                           "doors_open_at = { door = 20 }\ndoors_close_at = { door = 60 }\n";
  const auto open = [&](double at_s) {
    const Scenario s = good_at(f, text, at_s).scenarios.at(0);
    CHECK(s.doors_open.size() + s.doors_closed.size() == 1);
    return s.doors_open.size() == 1;
  };
  CHECK_FALSE(open(0));
  CHECK_FALSE(open(19.9));
  CHECK(open(20));
  CHECK(open(59));
  CHECK_FALSE(open(60));
  CHECK(refused_at(f, door + "[[scenario]]\nname = \"s\"\ndoors_open_at = { door = 20 }\n")
            .find("no time is said") != std::string::npos);
  CHECK(refused_at(f,
                   "[time]\nto = 1\nstep = 1\n[[scenario]]\nname = \"s\"\n"
                   "doors_open_at = { dor = 20 }\n")
            .find("there is no door") != std::string::npos);
}

TEST_CASE("an object comes and goes at its times, and its name is known in between",
          "[format][scene][time]") {
  SceneFolder f;
  const auto curtain = [](const std::string& more) {
    return "[[object]]\nname = \"curtain\"\nshape = \"box\"\nlow = [0, 0, 0]\nhigh = [1, 1, 1]\n"
           "material = \"grey50\"\n" +
           more + "[[surface_group]]\nname = \"cloth\"\nobjects = [\"curtain\"]\n";
  };
  const auto is_there = [&](const std::string& more, double at_s) {
    return !good_at(f, curtain(more), at_s).objects.empty();
  };
  CHECK(is_there("vanishes_at = [40]\n", 39.9));
  CHECK_FALSE(is_there("vanishes_at = [40]\n", 40));
  CHECK_FALSE(is_there("appears_at = [10, 60]\nvanishes_at = [40]\n", 9));
  CHECK(is_there("appears_at = [10, 60]\nvanishes_at = [40]\n", 10));
  CHECK_FALSE(is_there("appears_at = [10, 60]\nvanishes_at = [40]\n", 50));
  CHECK(is_there("appears_at = [10, 60]\nvanishes_at = [40]\n", 60));
  CHECK(good_at(f, curtain("vanishes_at = [40]\n"), 0).content_hash !=
        good_at(f, curtain("vanishes_at = [40]\n"), 50).content_hash);
  CHECK_THAT(refused_at(f, curtain("vanishes_at = [40]\n")),
             Catch::Contains("scene.toml:7") && Catch::Contains("no time is said"));
  CHECK_THAT(refused_at(f, curtain("vanishes_at = [40]\nappears_at = [40]\n"), 0),
             Catch::Contains("appears and vanishes at 40 s"));
}

TEST_CASE("the routes that a sign leads to must exist", "[format][scene][time]") {
  SceneFolder f;
  const std::string way = "[[sign.leads_to]]\nroute = \"corridor\"\narrow = \"left\"\n";
  const std::string route =
      "[[route]]\nname = \"corridor\"\npath = [[0, 0, 0], [9, 0, 0]]\nwidth = 2\n";
  const SceneDescription scene = good(f, exit_sign + way + route);
  REQUIRE(scene.signs.at(0).leads_to.size() == 1);
  CHECK(scene.signs.at(0).leads_to.at(0).route == "corridor");
  CHECK(scene.signs.at(0).leads_to.at(0).arrow == SignArrow::left);
  CHECK(refused_at(f, exit_sign + way).find("there is no route 'corridor'") != std::string::npos);
  CHECK(
      refused_at(f, exit_sign + way + way + route).find("leads to the route 'corridor' already") !=
      std::string::npos);
}

}  // namespace luxodus
