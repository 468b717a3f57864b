// The model: who sets out when, what people follow, how fast they walk. What eyes read is stated by
// the tests.
#include "actors/judge/walkers/people.hpp"

#include <map>
#include <set>

#include "actors/judge/walkers/smoke_speed.hpp"
#include "tests/unit/actors/judge/walkers/walkers_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;
using Catch::Contains;

namespace {

/// A sign on a wall, over the way to an end of a hall.
std::string sign_text(const std::string& name, const std::string& position,
                      const std::string& facing, const std::string& route) {
  return fmt::format(
      "\n[[sign]]\nname = \"{}\"\nplain = \"green\"\nsmallest_detail = 0.02\nwidth = 0.4\n"
      "height = 0.2\nposition = {}\nfacing = {}\nmains_white = 500\nmains_green = 60\n"
      "emergency_white = 200\nemergency_green = 30\n[[sign.leads_to]]\nroute = \"{}\"\n"
      "arrow = \"ahead\"\n",
      name, position, facing, route);
}

/// A hall of 20 m with an end in the west and one in the east, and a sign over each.
const std::string hall = room_text(20, 6) + route_text("west", "[[19, 3, 0], [1, 3, 0]]") +
                         route_text("east", "[[1, 3, 0], [19, 3, 0]]") +
                         sign_text("exit west", "[0.05, 3, 2.3]", "[1, 0, 0]", "west") +
                         sign_text("exit east", "[19.95, 3, 2.3]", "[-1, 0, 0]", "east");

/// What is read and the smoke, by the time, the eye and the sign.
struct Stated {
  std::function<bool(double time_s, const glm::dvec3& eye, size_t sign)> reads =
      [](double, const glm::dvec3&, size_t) { return false; };
  double extinction_per_m = 0;
};

struct Hall {
  explicit Hall(const std::string& text = hall) : floor(text) {
    auto made = WaysOut::make(*floor.scene, *floor.space, 0, 2);
    REQUIRE(made.ok());
    ways.emplace(std::move(made).value());
  }
  Result<PeopleWalked> walk(const PeopleOptions& options, const Stated& stated,
                            const std::vector<CellNumber>& starts) {
    PeopleFloor where{*floor.scene, *floor.space, 0, 1.6, {0, 1}, starts};
    return walk_people(
        where, options, *ways,
        [&](double time_s, const std::vector<glm::dvec3>& eyes) -> Result<FoundByEyes> {
          FoundByEyes out;
          for (const glm::dvec3& eye : eyes) {
            for (size_t sign = 0; sign < 2; ++sign)
              out.answers.push_back(stated.reads(time_s, eye, sign) ? SignAnswer::read
                                                                    : SignAnswer::undecided);
            out.extinctions.push_back(stated.extinction_per_m);
          }
          return out;
        },
        [](double) {});
  }
  Floor floor;
  std::optional<WaysOut> ways;
};

/// One person with a constant speed of 1 m/s.
PeopleOptions one_person() {
  PeopleOptions out;
  out.count = 1;
  out.speed_m_s = 1;
  out.speed_deviation_m_s = 0;
  out.until_s = 60;
  return out;
}

}  // namespace

TEST_CASE("smoke slows people by the law of Frantzich and Nilsson", "[walkers]") {
  CHECK(speed_in_smoke(1.34, 0) == 1.34);
  CHECK(speed_in_smoke(1, 2) == Approx(1 - 0.114 / 0.706));
  CHECK(speed_in_smoke(1, 8) == Approx((0.706 - 0.456) / 0.706));
  CHECK(speed_in_smoke(1.2, 20) == Approx(0.12));
  CHECK(speed_in_smoke(1.2, 1e6) == Approx(0.12));
}

TEST_CASE("people who read no sign leave along the way they came in", "[walkers]") {
  Hall here;
  const std::vector<CellNumber> start{here.floor.cell(5.05, 3.05)};
  PeopleOptions options = one_person();
  const auto nearest = here.walk(options, {}, start);
  REQUIRE(nearest.ok());
  CHECK(nearest->people[0].way == 0);  // 4 m to the west end, 14 m to the east
  CHECK_FALSE(nearest->people[0].sign);
  REQUIRE(nearest->people[0].left_s);
  CHECK(*nearest->people[0].left_s == Approx(4).margin(0.3));
  options.came_by = "east";
  const auto remembered = here.walk(options, {}, start);
  REQUIRE(remembered.ok());
  CHECK(remembered->people[0].way == 1);
  REQUIRE(remembered->people[0].left_s);
  CHECK(*remembered->people[0].left_s == Approx(14).margin(0.3));
  CHECK(glm::distance(remembered->places.back().place, glm::dvec2(19, 3)) < 0.1);
  CHECK(remembered->places.back().facing.x == Approx(1));
}

TEST_CASE("people who read a sign go where it leads until they read another", "[walkers]") {
  Hall here;
  PeopleOptions options = one_person();
  options.came_by = "east";
  const std::vector<CellNumber> start{here.floor.cell(10.05, 3.05)};
  // The sign in the west is behind the walker, but people who set out look around.
  const auto at_once = here.walk(
      options, {[](double, const glm::dvec3&, size_t sign) { return sign == 0; }, 0}, start);
  REQUIRE(at_once.ok());
  CHECK(at_once->people[0].way == 0);
  CHECK(at_once->people[0].sign == 0U);
  // Later it is behind the walker, who does not see it.
  CHECK(at_once->looks > 5);
  const auto later = here.walk(
      options,
      {[](double time_s, const glm::dvec3&, size_t sign) { return sign == 0 && time_s > 1.5; }, 0},
      start);
  REQUIRE(later.ok());
  CHECK(later->people[0].way == 1);
  CHECK_FALSE(later->people[0].sign);
  // On the way east the walker reads the sign there, and follows it; nothing else changes.
  const auto ahead = here.walk(
      options,
      {[](double, const glm::dvec3& eye, size_t sign) { return sign == 1 && eye.x > 12; }, 0},
      start);
  REQUIRE(ahead.ok());
  CHECK(ahead->people[0].sign == 1U);
  CHECK(*ahead->people[0].left_s == Approx(9).margin(0.3));
  // The one in the west counts though it may be read no more.
  const auto keeps = here.walk(
      options,
      {[](double time_s, const glm::dvec3&, size_t sign) { return sign == 0 && time_s < 0.5; }, 0},
      start);
  REQUIRE(keeps.ok());
  CHECK(keeps->people[0].way == 0);
  CHECK(*keeps->people[0].left_s == Approx(9).margin(0.3));
}

TEST_CASE("of two signs that are read at once the nearer one leads, and no sign leads twice",
          "[walkers]") {
  Hall here;
  PeopleOptions options = one_person();
  const Stated all{[](double, const glm::dvec3&, size_t) { return true; }, 0};
  for (const double x : {4.05, 15.05}) {
    const auto walked = here.walk(options, all, {here.floor.cell(x, 3.05)});
    REQUIRE(walked.ok());
    CHECK(walked->people[0].sign == (x < 10 ? 0U : 1U));
    CHECK(walked->people[0].way == (x < 10 ? 0U : 1U));
    REQUIRE(walked->people[0].left_s);
  }
}

TEST_CASE("looks at signs that lead and are undecided are counted, and nobody follows them",
          "[walkers]") {
  Hall here;
  PeopleOptions options = one_person();
  options.came_by = "east";
  const auto walked = here.walk(options, {}, {here.floor.cell(10.05, 3.05)});
  REQUIRE(walked.ok());
  // The sign in the east is ahead of the walker until the end of its route.
  CHECK(walked->looks == 9);
  CHECK(walked->undecided_looks == 9);
  CHECK_FALSE(walked->people[0].sign);
}

TEST_CASE("in smoke people are slower by the law, and who does not arrive is inside", "[walkers]") {
  Hall here;
  PeopleOptions options = one_person();
  options.came_by = "east";
  const std::vector<CellNumber> start{here.floor.cell(10.05, 3.05)};
  Stated smoke;
  smoke.extinction_per_m = 2;
  const auto slow = here.walk(options, smoke, start);
  REQUIRE(slow.ok());
  CHECK(*slow->people[0].left_s == Approx(9 / speed_in_smoke(1, 2)).margin(0.3));
  smoke.extinction_per_m = 20;
  const auto stuck = here.walk(options, smoke, start);
  REQUIRE(stuck.ok());
  CHECK_FALSE(stuck->people[0].left_s);
  CHECK(stuck->places.size() == 601);  // each frame from 0 to 60 s
  CHECK(glm::distance(stuck->places.back().place, stuck->places.front().place) ==
        Approx(6).margin(0.15));
}

TEST_CASE("the same seed gives the same people, another seed others", "[walkers]") {
  Hall here;
  std::vector<CellNumber> starts;
  for (CellNumber cell = 0; cell < here.floor.space->cells(); ++cell)
    if (here.floor.space->is_free(cell)) starts.push_back(cell);
  PeopleOptions options;
  options.count = 40;
  options.leave_from_s = 5;
  options.leave_to_s = 15;
  options.until_s = 120;
  const auto run = [&](uint64_t seed) {
    options.seed = seed;
    auto walked = here.walk(options, {}, starts);
    REQUIRE(walked.ok());
    return std::move(walked).value();
  };
  const PeopleWalked a = run(1), b = run(1), c = run(2);
  REQUIRE(a.places.size() == b.places.size());
  for (size_t i = 0; i < a.places.size(); ++i) {
    REQUIRE(a.places[i].frame == b.places[i].frame);
    REQUIRE(a.places[i].id == b.places[i].id);
    REQUIRE(a.places[i].place == b.places[i].place);
    REQUIRE(a.places[i].facing == b.places[i].facing);
  }
  CHECK(a.places[0].place != c.places[0].place);
  // Everybody stands until the first look in their time, then walks within the drawn speeds, and
  // begins in another cell.
  std::map<int64_t, std::vector<WrittenPlace>> by_person;
  for (const WrittenPlace& one : a.places) by_person[one.id].push_back(one);
  REQUIRE(by_person.size() == 40);
  std::set<std::pair<double, double>> begins;
  for (const auto& [id, places] : by_person) {
    begins.emplace(places[0].place.x, places[0].place.y);
    size_t first = 1;
    while (first < places.size() && places[first].place == places[0].place) ++first;
    CHECK(first > 50);
    CHECK(first <= 161);
    for (size_t i = first; i + 1 < places.size(); ++i) {
      const double m = glm::distance(places[i].place, places[i - 1].place);
      CHECK(m <= (1.34 + 0.52) / walker_fps + 1e-9);
      const auto cell = here.floor.space->cell_of(places[i].place);
      REQUIRE(cell);
      CHECK(here.floor.space->is_free(*cell));
    }
  }
  CHECK(begins.size() == 40);
}

TEST_CASE("people whom nobody could follow are refused before anything is made", "[walkers]") {
  const auto told = [](const std::function<void(PeopleOptions&)>& change) {
    PeopleOptions options;
    change(options);
    const auto ok = check_people(options);
    REQUIRE_FALSE(ok.ok());
    return ok.problem().text();
  };
  CHECK(check_people(PeopleOptions{}).ok());
  CHECK_THAT(told([](PeopleOptions& o) { o.count = 0; }), Contains("--count from 1 to 10000"));
  CHECK_THAT(told([](PeopleOptions& o) { o.count = 10'001; }), Contains("--count from 1 to 10000"));
  CHECK_THAT(told([](PeopleOptions& o) { o.speed_m_s = 0.5; }),
             Contains("lets people stand still"));
  CHECK_THAT(told([](PeopleOptions& o) { o.until_s = 0; }),
             Contains("give an --until that is later"));
  CHECK_THAT(told([](PeopleOptions& o) { o.leave_to_s = 700; }),
             Contains("give another --leave-at"));
  CHECK_THAT(told([](PeopleOptions& o) { o.count = 1000; }), Contains("6e+06 rows"));
}

TEST_CASE("what keeps people from asking or from a route ends the walk with its problem",
          "[walkers]") {
  Hall here;
  PeopleOptions options = one_person();
  const std::vector<CellNumber> start{here.floor.cell(5.05, 3.05)};
  PeopleFloor where{*here.floor.scene, *here.floor.space, 0, 1.6, {}, start};
  const auto failed = walk_people(
      where, options, *here.ways,
      [](double, const std::vector<glm::dvec3>&) -> Result<FoundByEyes> {
        return problem("interrupted");
      },
      [](double) {});
  REQUIRE_FALSE(failed.ok());
  CHECK(failed.problem().what == "interrupted");
  options.came_by = "north";
  CHECK_THAT(here.walk(options, {}, start).problem().text(), Contains("no route \"north\""));
  Hall closed(hall + box_text("wall", {12, 0, 0}, {12.2, 6, 3}));
  options.came_by = "east";
  const std::vector<CellNumber> beside{closed.floor.cell(5.05, 3.05)};
  CHECK_THAT(closed.walk(options, {}, beside).problem().text(), Contains("its line is closed off"));
}
