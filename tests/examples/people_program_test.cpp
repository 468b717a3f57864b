// People who choose their way, as a user makes them: a sign that is read at the nearer exit draws
// them there, smoke that hides it leaves them to the way by which they came in, and `walk` follows
// them through no wall.
#include <catch2/catch.hpp>

#include "tests/examples/smoky_corridor.hpp"

using namespace luxodus::program;
using Catch::Contains;

namespace {

/// A corridor of 24 m with an exit at each end, a room beside it, and a sign over the exit in the
/// west. The smoke is stated by each test.
std::string two_exits(double extinction_per_m) {
  return R"(
[[object]]
name = "corridor"
shape = "room"
low = [0, 0, 0]
high = [24, 6, 3]
material = "grey50"

[[object]]
name = "wall west"
shape = "box"
low = [0, 2.4, 0]
high = [9, 2.5, 3]
material = "grey50"

[[object]]
name = "wall east"
shape = "box"
low = [10, 2.4, 0]
high = [24, 2.5, 3]
material = "grey50"
)" + lamp_text("[8, 1.2, 2.97]") +
         smoke_text(extinction_per_m) + sign_text("exit west", "[0.02, 1.2, 2.2]") + R"(
[[sign.leads_to]]
route = "west"
arrow = "ahead"

[[route]]
name = "west"
path = [[12, 1.2, 0], [0.6, 1.2, 0]]
width = 1.2

[[route]]
name = "main entrance"
path = [[1, 1.2, 0], [23.4, 1.2, 0]]
width = 1.2

[[open_area]]
name = "side room"
outline = [[6, 3], [13, 3], [13, 5.5], [6, 5.5]]
z = 0

[[open_area]]
name = "before the room"
outline = [[5, 0.4], [11, 0.4], [11, 2], [5, 2]]
z = 0

[assessment]
irritant_smoke = false
rules = ["en1838-2024"]
eye_heights_m = [1.65]

[[scenario]]
name = "fire"
operation = "emergency"
seconds_after_failure = 60
)";
}

struct TwoExits {
  explicit TwoExits(double extinction_per_m) : place("corridor.toml", two_exits(extinction_per_m)) {
    copy_lamp_and_sign(place.folder);
  }
  Outcome people(const std::string& options) const {
    return place.luxodus("people " + place.scene + " --out " + file.string() + " " + options);
  }
  ScenePlace place;
  fs::path file = place.folder / "people.sqlite";
};

const std::string thirty = "--count 30 --came-by \"main entrance\" --leave-at 0,10";
/// From here the west is nearer, and nothing stands before the sign.
const std::string nearer = " --within \"before the room\"";

}  // namespace

TEST_CASE("a sign that is read at the nearer exit draws people there", "[program][people]") {
  const TwoExits clear(0.05);
  const Outcome run = clear.people(thirty + nearer + " --until 90");
  INFO(run.err << run.out);
  REQUIRE(run.code == 0);
  CHECK_THAT(run.out, Contains("scenario fire: 30 people on") &&
                          Contains("30 left, half of them by") &&
                          Contains("0 are still inside at 90 s") &&
                          Contains("30 followed a sign, 0 the way that they remembered") &&
                          Contains("route \"west\": 30 left, 0 on their way") &&
                          Contains("route \"main entrance\": 0 left, 0 on their way") &&
                          Contains("ASET, RSET"));
  const Outcome walked =
      clear.place.luxodus("walk " + clear.place.scene + " --trajectories " + clear.file.string() +
                          " --out " + clear.place.out.string());
  INFO(walked.err << walked.out);
  REQUIRE(walked.code == 0);
  CHECK_THAT(walked.out, Contains("scenario fire: 30 people,") && Contains("\n0 % of ") &&
                             Contains("0 people never read a sign"));
}

TEST_CASE("smoke that hides the sign leaves people to the way by which they came in",
          "[program][people]") {
  const TwoExits smoky(6);
  const Outcome run = smoky.people(
      thirty + GENERATE(as<std::string>(), nearer, " --within \"side room\"") + " --until 400");
  INFO(run.err << run.out);
  REQUIRE(run.code == 0);
  CHECK_THAT(run.out, Contains("30 left, half of them by") &&
                          Contains("0 followed a sign, 30 the way that they remembered") &&
                          Contains("route \"west\": 0 left, 0 on their way") &&
                          Contains("route \"main entrance\": 30 left"));
  const Outcome walked =
      smoky.place.luxodus("walk " + smoky.place.scene + " --trajectories " + smoky.file.string() +
                          " --step 5 --out " + smoky.place.out.string());
  INFO(walked.err << walked.out);
  REQUIRE(walked.code == 0);
  CHECK_THAT(walked.out, Contains("\n0 % of ") && Contains("30 people never read a sign"));
}

TEST_CASE(
    "a file that is there is replaced with --overwrite only, and by the same bytes for the "
    "same seed",
    "[program][people]") {
  const TwoExits clear(0.05);
  const std::string few = "--count 3 --until 60 --seed 7";
  REQUIRE(clear.people(few).code == 0);
  const std::string first = slurp(clear.file);
  const Outcome again = clear.people(few);
  CHECK(again.code == 2);
  CHECK_THAT(again.err, Contains("people.sqlite: this file is there") && Contains("--overwrite"));
  CHECK(slurp(clear.file) == first);
  REQUIRE(clear.people(few + " --overwrite --threads 1").code == 0);
  CHECK(slurp(clear.file) == first);
  REQUIRE(clear.people("--count 3 --until 60 --seed 8 --overwrite").code == 0);
  CHECK(slurp(clear.file) != first);
}

TEST_CASE("people who cannot walk as asked are one clear error and no file", "[program][people]") {
  const TwoExits clear(0.05);
  const auto refused = [&](const std::string& options, const std::string& words) {
    const Outcome run = clear.people(options);
    INFO(run.err);
    CHECK(run.code == 2);
    CHECK_THAT(run.err, Contains(words));
    CHECK_FALSE(fs::exists(clear.file));
  };
  refused("--within attic", "no [[room]] and no open area \"attic\"");
  refused("--came-by roof", "there is no route \"roof\" on this floor");
  refused("--count 20000", "--count");
  refused("--leave-at 1,2,3", "--leave-at takes a time or a range");
  refused("--speed 0.5,0.4", "lets people stand still");
  refused("--count 10000", "give a smaller --count");
  refused("--floor-m 5", "no [[route]] lies on the floor at 5 m");
}
