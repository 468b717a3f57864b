// People of files in the scene's coordinates, clock and floors.
#include "scenes/formats/trajectories/placed_people.hpp"

#include <catch2/catch.hpp>

#include "tests/kit/walkers.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

Trajectories one_person(bool has_heights) {
  return {.form = "test",
          .has_heights = has_heights,
          .fps = 1,
          .people = {{.id = 4,
                      .times_s = {0, 1},
                      .places = {{1, 0, 2}, {2, 0, 2}},
                      .facing = {{1, 0}, {0, 1}}}}};
}

}  // namespace

TEST_CASE("people are turned, then shifted, in place and time", "[trajectories]") {
  PeopleSettings settings;
  settings.turn_deg = 90;
  settings.shift = {10, 20, 0};
  settings.time_shift_s = 30;
  settings.floor_m = 7;
  const auto flat = place_people(settings, one_person(false), {});
  REQUIRE(flat.ok());
  const PlacedPerson& one = flat->front();
  CHECK(one.times_s == std::vector<double>{30, 31});
  CHECK(glm::distance(one.feet[1], glm::dvec3(10, 22, 7)) < 1e-12);
  CHECK(glm::distance(one.facing[0], glm::dvec2(0, 1)) < 1e-12);
  CHECK(one.eye_height_m == 1.65);
  CHECK(one.luminance_before_cd_m2 == 100);
  // Heights of the file are shifted, too.
  settings.floor_m.reset();
  settings.shift.z = 5;
  const auto high = place_people(settings, one_person(true), {});
  CHECK(high->front().feet[1].z == 7);
  settings.eye_height_m = 1.2;
  settings.luminance_before_cd_m2 = 3;
  const auto seated = place_people(settings, one_person(true), {});
  CHECK(seated->front().eye_height_m == 1.2);
  CHECK(seated->front().luminance_before_cd_m2 == 3);
}

TEST_CASE("heights are stated for files without them, and shifted in files with them",
          "[trajectories]") {
  PeopleSettings settings;
  settings.file = "people.sqlite";
  CHECK(place_people(settings, one_person(false), {})->front().feet[1].z == 0);
  settings.floor_m = 0;
  CHECK_THAT(place_people(settings, one_person(true), {}).problem().text(),
             Catch::Contains("\"people.sqlite\" has heights, which 'floor_m' contradicts"));
  settings.shift.z = 5;
  CHECK_THAT(place_people(settings, one_person(false), {}).problem().text(),
             Catch::Contains("has no heights that the z of 'shift' could be added to"));
}

TEST_CASE("storeys that a file draws beside each other lie above each other", "[trajectories]") {
  PeopleSettings settings;
  settings.name = "guests";
  settings.storeys = {{{0, -1}, {1.5, 1}, 0, {0, 0}}, {{1.5, -1}, {9, 1}, 3.2, {-1.5, 0}}};
  const auto placed = place_people(settings, one_person(false), {});
  REQUIRE(placed.ok());
  CHECK(placed->front().feet == std::vector<glm::dvec3>{{1, 0, 0}, {0.5, 0, 3.2}});
  settings.storeys.pop_back();
  CHECK_THAT(place_people(settings, one_person(false), {}).problem().text(),
             Catch::Contains("person 4 of \"guests\" is at (2, 0) m in the file at 1 s"));
  CHECK_THAT(place_people(settings, one_person(true), {}).problem().text(),
             Catch::Contains("has heights"));
}

TEST_CASE("people look where they walk, and while they stand where they walked", "[trajectories]") {
  PlacedPerson one = walker_from({0, 0, 0}, {4, 0, 0}, 4);
  one.times_s = {0, 4, 10, 14};
  one.feet = {{0, 0, 0}, {4, 0, 0}, {4, 0, 0}, {4, 4, 0}};
  CHECK(person_at(one, 2).foot == glm::dvec3(2, 0, 0));
  CHECK(person_at(one, 2).facing == glm::dvec2(1, 0));
  CHECK(person_at(one, 8).facing == glm::dvec2(1, 0));
  CHECK(person_at(one, 12).facing == glm::dvec2(0, 1));
  // Who waits first looks where he will go.
  one.times_s = {0, 5, 9};
  one.feet = {{0, 0, 0}, {0, 0, 0}, {-4, 0, 0}};
  CHECK(person_at(one, 1).facing == glm::dvec2(-1, 0));
  // Who never moves looks nowhere in particular.
  one.feet = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  CHECK(person_at(one, 1).facing == glm::dvec2(0, 0));
  // What the file states counts, at the nearest time.
  one.facing = {{1, 0}, {0, 1}, {0, -1}};
  CHECK(person_at(one, 2).facing == glm::dvec2(1, 0));
  CHECK(person_at(one, 3).facing == glm::dvec2(0, 1));
  CHECK(person_at(one, 9).facing == glm::dvec2(0, -1));
}

TEST_CASE("people who stand look the same way, alone and at all their steps", "[trajectories]") {
  // Waits, walks north-east, waits while swaying, walks back, waits.
  PlacedPerson one = walker_from({0, 0, 0}, {0, 0, 0}, 0);
  one.times_s = {0.2, 7.1, 9.4, 11, 30, 31.3, 34, 60.7};
  one.feet = {{0, 0, 0},    {0, 0, 0}, {2, 2, 0},   {3, 4, 0},
              {3.05, 4, 0}, {3, 4, 0}, {0.5, 3, 0}, {0.5, 3, 0}};
  for (const double step_s : {0.05, 0.1, 0.3, 0.5, 0.7, 1.0, 2.5}) {
    std::vector<double> times;
    for (double at = one.times_s.front(); at <= one.times_s.back(); at += step_s)
      times.push_back(at);
    const std::vector<PersonAt> all = person_at_each(one, times);
    REQUIRE(all.size() == times.size());
    for (size_t i = 0; i < times.size(); ++i) {
      INFO("step " << step_s << ", " << times[i] << " s");
      const PersonAt alone = person_at(one, times[i]);
      CHECK(all[i].foot == alone.foot);
      CHECK(glm::distance(all[i].facing, alone.facing) < 1e-9);
      CHECK(glm::length(alone.facing) == Approx(1));
    }
  }
}
