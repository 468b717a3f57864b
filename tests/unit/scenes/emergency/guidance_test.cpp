// Tests which signs guide people on a route, until when, and how far a walker gets.
#include "scenes/emergency/guidance.hpp"

#include <catch2/catch.hpp>

namespace luxodus {
namespace {

EscapeRoute route_along(std::vector<glm::dvec3> path) {
  EscapeRoute route;
  route.name = "way";
  route.path = std::move(path);
  route.width_m = 1.6;
  return route;
}

/// A sign with its centre at `centre`, facing `facing` (horizontal), its top up.
Sign sign_at(const glm::dvec3& centre, const glm::dvec3& facing, SignArrow arrow) {
  Sign sign;
  sign.name = "exit";
  const glm::dvec3 up(0, 0, 1);
  sign.frame.origin = centre;
  sign.frame.axes = glm::dmat3(glm::cross(up, facing), up, facing);
  sign.width_m = 0.4;
  sign.height_m = 0.2;
  sign.leads_to = {{"way", arrow}};
  return sign;
}

Walker walker_at(const glm::dvec3& foot, const glm::dvec3& ahead, double along_m) {
  return {foot, ahead, along_m};
}

bool guides(const EscapeRoute& route, const Walker& walker, const Sign& sign) {
  return can_guide(route, walker, sign, view_of_sign(sign, walker.foot + glm::dvec3(0, 0, 1.65)));
}

/// Each row is one state, from 0 s in steps of 10 s, with a letter for each place: g guided, u
/// undecided, any other letter not guided.
GuidedRoute table(std::vector<std::string> rows) {
  GuidedRoute out;
  for (size_t t = 0; t < rows.size(); ++t) {
    out.times_s.push_back(10 * static_cast<double>(t));
    std::vector<Guidance> row;
    for (const char c : rows[t])
      row.push_back(c == 'g'   ? Guidance::guided
                    : c == 'u' ? Guidance::undecided
                               : Guidance::not_guided);
    out.at.push_back(row);
  }
  for (size_t i = 0; i < rows.front().size(); ++i)
    out.along_m.push_back(5 * static_cast<double>(i));
  out.length_m = 5 * static_cast<double>(rows.front().size());
  return out;
}

}  // namespace

TEST_CASE("the states of a scene begin at from and end at to", "[emergency][guidance]") {
  TimeSettings time;
  time.from_s = 10, time.to_s = 40, time.step_s = 10;
  CHECK(times_of(time) == std::vector<double>{10, 20, 30, 40});
  time.to_s = 35;
  CHECK(times_of(time) == std::vector<double>{10, 20, 30, 35});
  time.to_s = 10;
  CHECK(times_of(time) == std::vector<double>{10});
  time.from_s = 0, time.to_s = 1, time.step_s = 0.1;
  CHECK(times_of(time).size() == 11);
}

TEST_CASE(
    "a sign at the end of a route guides everybody who has it ahead, if it leads to this route",
    "[emergency][guidance]") {
  const EscapeRoute route = route_along({{0, 0, 0}, {10, 0, 0}});
  const Walker walker = walker_at({2, 0, 0}, {1, 0, 0}, 2);
  Sign sign = sign_at({10, 0, 2.2}, {-1, 0, 0}, SignArrow::ahead);
  CHECK(guides(route, walker, sign));
  CHECK(guides(route, walker_at({9.5, 0, 0}, {1, 0, 0}, 9.5), sign));  // steeply above the walker
  CHECK_FALSE(guides(route, walker_at({2, 0, 0}, {-1, 0, 0}, 2), sign));
  sign.leads_to = {{"another way", SignArrow::ahead}};
  CHECK_FALSE(guides(route, walker, sign));
}

TEST_CASE("a sign whose arrow points against the route does not guide", "[emergency][guidance]") {
  // The walker looks east; the route turns north, to the walker's left.
  const EscapeRoute route = route_along({{0, 0, 0}, {10, 0, 0}, {10, 8, 0}});
  const Walker walker = walker_at({2, 0, 0}, {1, 0, 0}, 2);
  CHECK(guides(route, walker, sign_at({10.8, 0, 2.2}, {-1, 0, 0}, SignArrow::left)));
  CHECK_FALSE(guides(route, walker, sign_at({10.8, 0, 2.2}, {-1, 0, 0}, SignArrow::right)));
  CHECK_FALSE(guides(route, walker, sign_at({10.8, 0, 2.2}, {-1, 0, 0}, SignArrow::ahead)));
}

TEST_CASE("a sign beside a route guides within 60 degrees, and no longer once it is passed",
          "[emergency][guidance]") {
  const EscapeRoute route = route_along({{0, 0, 0}, {20, 0, 0}});
  const Sign sign = sign_at({10, 3, 2.2}, {-1, 0, 0}, SignArrow::ahead);
  CHECK(guides(route, walker_at({8, 0, 0}, {1, 0, 0}, 8), sign));            // 56 degrees
  CHECK_FALSE(guides(route, walker_at({8.5, 0, 0}, {1, 0, 0}, 8.5), sign));  // 63 degrees
  // A route that turns back: the sign stands by its first leg, the walker is on its last.
  const EscapeRoute back = route_along({{0, 0, 0}, {10, 0, 0}, {10, 4, 0}, {0, 4, 0}});
  const Sign by_first = sign_at({2, 0, 2.2}, {1, 0, 0}, SignArrow::ahead);
  CHECK_FALSE(guides(back, walker_at({8, 4, 0}, {-1, 0, 0}, 16), by_first));
}

TEST_CASE("the back of a double-sided sign keeps left and right in the room and turns ahead round",
          "[emergency][guidance]") {
  const Sign sign = sign_at({5, 0, 2.4}, {-1, 0, 0}, SignArrow::ahead);
  CHECK(glm::length(arrow_direction(sign, SignArrow::ahead, false) - glm::dvec3(1, 0, 0)) < 1e-12);
  CHECK(glm::length(arrow_direction(sign, SignArrow::ahead, true) - glm::dvec3(-1, 0, 0)) < 1e-12);
  // North is to the left of a person who looks east.
  CHECK(glm::length(arrow_direction(sign, SignArrow::left, false) - glm::dvec3(0, 1, 0)) < 1e-12);
  CHECK(glm::length(arrow_direction(sign, SignArrow::left, true) - glm::dvec3(0, 1, 0)) < 1e-12);
}

TEST_CASE("the guided time of a route ends at the last state before the first gap",
          "[emergency][guidance]") {
  const GuidedTime some = guided_time(table({"ggg", "ggg", "gng", "ggg"}));
  CHECK(some.until_s == 10);
  CHECK(some.lost_by_s == 20);
  CHECK(some.lost_at_m == 5);
  const GuidedTime undecided = guided_time(table({"ggg", "ggu"}));
  CHECK(undecided.until_s == 0);
  CHECK(undecided.lost_by_s == 10);
  CHECK(undecided.lost_at_m == 10);
  const GuidedTime never = guided_time(table({"ngg", "ggg"}));
  CHECK_FALSE(never.until_s.has_value());
  CHECK(never.lost_by_s == 0);
  const GuidedTime always = guided_time(table({"gg", "gg"}));
  CHECK(always.until_s == 10);
  CHECK_FALSE(always.lost_by_s.has_value());
}

TEST_CASE(
    "a place guides a walker only if it is guided in the states before and after he passes it",
    "[emergency][guidance]") {
  // Places at 0, 5, 10 m; the route is 15 m long. The last place is not guided from 20 s on.
  const GuidedRoute route = table({"ggg", "ggg", "ggn", "gnn"});
  const GuidedWalk in_time = walk(route, 0, 1.5);  // arrives at 10 s, exactly at a state
  CHECK(in_time.end == GuidedWalk::End::arrives);
  CHECK(in_time.at_m == 15);
  CHECK(in_time.at_s == 10);
  const GuidedWalk caught = walk(route, 0, 1);  // between 10 and 15 m from 10 s to 15 s
  CHECK(caught.end == GuidedWalk::End::lost);
  CHECK(caught.at_m == 10);
  CHECK(caught.at_s == 10);
  const GuidedWalk late =
      walk(route, 1, 1);  // at 10 m at 11 s, between a guided and an unguided state
  CHECK(late.end == GuidedWalk::End::lost);
  CHECK(late.at_m == 10);
  CHECK(late.at_s == 11);
  const GuidedWalk later = walk(route, 20, 1);  // at 5 m at 25 s
  CHECK(later.end == GuidedWalk::End::lost);
  CHECK(later.at_m == 5);
  const GuidedWalk slow = walk(table({"ggg", "ggg"}), 0, 0.5);  // at 5 m at 10 s, the last state
  CHECK(slow.end == GuidedWalk::End::unknown);
  CHECK(slow.at_m == 5);
}

TEST_CASE("if guidance only decreases, a walker who sets out later gets no farther",
          "[emergency][guidance]") {
  const GuidedRoute route = table({"gggg", "gggn", "ggnn", "gnnn", "nnnn"});
  double last = 1e9;
  for (const double start : {0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0}) {
    const GuidedWalk one = walk(route, start, 1);
    CHECK(one.end != GuidedWalk::End::unknown);
    CHECK(one.at_m <= last);
    last = one.at_m;
  }
}

}  // namespace luxodus
