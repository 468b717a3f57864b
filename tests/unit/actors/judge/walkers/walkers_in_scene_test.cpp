// People in a scene: their floor, the room in which they start, and what is refused.
#include "actors/judge/walkers/walkers_in_scene.hpp"

#include "tests/unit/actors/judge/walkers/walkers_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;
using Catch::Contains;

namespace {

const std::string area =
    "\n[[open_area]]\nname = \"foyer\"\noutline = [[12, 1], [16, 1], [16, 5], [12, 5]]\nz = 0\n";
const std::string foyer_hall =
    room_text(20, 6) + route_text("out", "[[1, 3, 0], [19, 3, 0]]") + area;

Result<WalkersWalked> in_scene(const std::string& text,
                               const std::function<void(WalkersRequest&)>& change = {}) {
  WalkersRequest request;
  request.states.last = described_text(text + mains_text);
  request.options.scenario = "mains";
  request.people.count = 20;
  request.people.until_s = 60;
  if (change) change(request);
  const std::atomic<bool> interrupt{false};
  return walk_in_scene(request, interrupt, [](const std::string&, double) {});
}

std::string refusal(const std::string& text,
                    const std::function<void(WalkersRequest&)>& change = {}) {
  const auto out = in_scene(text, change);
  REQUIRE_FALSE(out.ok());
  return out.problem().text();
}

}  // namespace

TEST_CASE("people start in the named room and leave by the end of the route", "[walkers]") {
  const auto out = in_scene(foyer_hall, [](WalkersRequest& r) { r.within = "foyer"; });
  REQUIRE(out.ok());
  CHECK(out->start_m2 == Approx(16).margin(0.1));
  CHECK(out->signs == 0);
  REQUIRE(out->routes.size() == 1);
  CHECK(out->routes[0].left == 20);
  CHECK(out->routes[0].inside == 0);
  CHECK(out->low == glm::dvec2(0));
  CHECK(out->high.x == Approx(20));
  size_t begins = 0;
  for (const WrittenPlace& one : out->walked.places) {
    if (one.frame != 0) continue;
    ++begins;
    CHECK(glm::all(glm::greaterThanEqual(one.place, glm::dvec2(12, 1))));
    CHECK(glm::all(glm::lessThanEqual(one.place, glm::dvec2(16, 5))));
  }
  CHECK(begins == 20);
}

TEST_CASE("a scene in which nobody can walk as asked is one clear error", "[walkers]") {
  CHECK_THAT(refusal(room_text(20, 6)), Contains("no [[route]] says how people leave"));
  CHECK_THAT(refusal(foyer_hall, [](WalkersRequest& r) { r.within = "attic"; }),
             Contains("no [[room]] and no open area \"attic\""));
  CHECK_THAT(refusal(foyer_hall, [](WalkersRequest& r) { r.people.came_by = "in"; }),
             Contains("there is no route \"in\" on this floor; there are \"out\""));
  CHECK_THAT(refusal(foyer_hall, [](WalkersRequest& r) { r.people.count = 0; }),
             Contains("--count"));
  CHECK_THAT(refusal(foyer_hall,
                     [](WalkersRequest& r) {
                       r.within = "foyer";
                       r.people.count = 100;
                     }),
             Contains("100 people do not fit on the 16 m2 of \"foyer\"") && Contains("at most 64"));
  CHECK_THAT(refusal(foyer_hall + box_text("wall", {17, 0, 0}, {17.2, 6, 3}),
                     [](WalkersRequest& r) { r.within = "foyer"; }),
             Contains("from nowhere on \"foyer\" at 0 m can people walk to the end of a route"));
  CHECK_THAT(refusal(foyer_hall + route_text("above", "[[1, 3, 3], [19, 3, 3]]")),
             Contains("lie on 2 storeys, from 0 to 3 m") && Contains("--floor-m"));
  CHECK_THAT(refusal(foyer_hall, [](WalkersRequest& r) { r.floor_m = 1; }),
             Contains("no [[route]] lies on the floor at 1 m"));
}
