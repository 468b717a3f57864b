// The light sampler of pictures, with what cells of space have learned about emitters.
#include "scenes/light/transport/emitter_choice.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/unit/scenes/light/transport/seen_scene.hpp"

using namespace luxodus;

namespace {

/// Two adjacent rooms, a lamp in the first, and a far brighter one behind the wall between them.
const std::string two_rooms = R"(
[[object]]
name = "lit room"
shape = "room"
low = [0, 0, 0]
high = [10, 10, 3]
material = "grey50"

[[object]]
name = "next room"
shape = "room"
low = [10.2, 0, 0]
high = [20, 10, 3]
material = "grey50"

[[emitter]]
name = "lamp"
shape = "point"
distribution = "isotropic"
position = [3, 5, 2.8]
flux_lm = 100

[[emitter]]
name = "weak lamp"
shape = "point"
distribution = "isotropic"
position = [8.2, 1.3, 2.8]
flux_lm = 20

[[emitter]]
name = "hidden lamp"
shape = "point"
distribution = "isotropic"
position = [14, 5, 2.8]
flux_lm = 600
)";
constexpr size_t lamp = 0, weak_lamp = 1, hidden_lamp = 2;

struct TwoRooms : test::SeenScene {
  TwoRooms() : SeenScene(two_rooms) {}
  using SeenScene::SeenScene;
};

const Vec3 in_the_air(0), up(0, 0, 1);

}  // namespace

TEST_CASE("a visible lamp is chosen before a brighter one behind a wall", "[transport]") {
  TwoRooms rooms;
  EmitterChoice choice(*rooms.scene);
  const Vec3 place = rooms.at(8.5, 5, 1);
  REQUIRE(choice.weigh_at(place, in_the_air, all_bands, nullptr));
  CHECK(choice.probability_at(hidden_lamp) > 0.75);  // by power and distance alone
  const CellSight& seen = rooms.sight.at(place, in_the_air, rooms.resolver);
  REQUIRE(choice.weigh_at(place, in_the_air, all_bands, &seen));
  CHECK(choice.probability_at(lamp) > choice.probability_at(hidden_lamp));
  // An emitter that a few rays have not reached may still be visible.
  CHECK(choice.probability_at(hidden_lamp) > 0.01);
}

TEST_CASE("emitters are sampled with their stated probabilities, which sum to one", "[transport]") {
  TwoRooms rooms;
  EmitterChoice choice(*rooms.scene);
  for (const Vec3& normal : {in_the_air, up, -up}) {
    const Vec3 place = rooms.at(6, 4, 1);
    REQUIRE(choice.weigh_at(place, normal, all_bands,
                            &rooms.sight.at(place, in_the_air, rooms.resolver)));
    const double probability[] = {choice.probability_at(lamp), choice.probability_at(weak_lamp),
                                  choice.probability_at(hidden_lamp)};
    CHECK(probability[0] + probability[1] + probability[2] == Approx(1).margin(1e-6));
    constexpr int draws = 100'000;
    int drawn[3] = {};
    for (int i = 0; i < draws; ++i) {
      const EmitterSample sample = choice.choose_at((i + 0.5) / draws);
      CHECK(sample.probability == probability[sample.emitter]);
      ++drawn[sample.emitter];
    }
    for (const size_t e : {lamp, weak_lamp, hidden_lamp})
      CHECK(drawn[e] == Approx(probability[e] * draws).margin(draws * 1e-4));
  }
}

TEST_CASE("near a line, the light sampler chooses the emitters that light it", "[transport]") {
  TwoRooms rooms;
  EmitterChoice choice(*rooms.scene);
  const auto seen_at = [&](const Vec3& place) -> const CellSight& {
    return rooms.sight.at(place, in_the_air, rooms.resolver);
  };
  // Passes both lamps of the lit room, and runs along the wall that hides the third.
  const Vec3 from = rooms.at(1, 7, 2.5), to = rooms.at(9.5, 0.5, 2.5);
  const Real length = glm::distance(from, to);
  REQUIRE(choice.weigh_near({from, (to - from) / length}, length, all_bands, seen_at));
  const double of_lamp = choice.probability_along(lamp);
  const double of_weak = choice.probability_along(weak_lamp);
  CHECK(of_lamp > 0.05);
  CHECK(of_weak > 0.05);
  CHECK(choice.probability_along(hidden_lamp) == 0);
  CHECK(of_lamp + of_weak == Approx(1));
  Random random(4, RandomStream::test);
  random.start(0);
  constexpr int draws = 20'000;
  int lamps = 0;
  for (int i = 0; i < draws; ++i) {
    const EmitterSample drawn = choice.choose_along(random.uniform_double());
    REQUIRE(drawn.probability == choice.probability_along(drawn.emitter));
    if (drawn.emitter == lamp) ++lamps;
  }
  const double error = std::sqrt(of_lamp * of_weak / draws);
  CHECK(std::abs(lamps / double{draws} - of_lamp) < 4 * error);
}

TEST_CASE("a line far from all emitters samples no point near one", "[transport]") {
  TwoRooms rooms;
  EmitterChoice choice(*rooms.scene);
  const Ray along_the_floor{rooms.at(0.5, 9.5, 0.1), Vec3(1, 0, 0)};
  CHECK_FALSE(
      choice.weigh_near(along_the_floor, 9, all_bands, [&](const Vec3& place) -> const CellSight& {
        return rooms.sight.at(place, in_the_air, rooms.resolver);
      }));
}

TEST_CASE("a surface does not sample emitters behind it", "[transport]") {
  TwoRooms rooms;
  EmitterChoice choice(*rooms.scene);
  const Vec3 place = rooms.at(6, 4, 1);
  const CellSight& seen = rooms.sight.at(place, in_the_air, rooms.resolver);
  const auto chance_of_lamp = [&](const Vec3& normal) {
    REQUIRE(choice.weigh_at(place, normal, all_bands, &seen));
    return choice.probability_at(lamp);
  };
  const double facing = chance_of_lamp(glm::normalize(Vec3(-1, 0, 0)));
  CHECK(facing > 5 * chance_of_lamp(Vec3(1, 0, 0)));
  CHECK(chance_of_lamp(Vec3(1, 0, 0)) > 0);
}

TEST_CASE("cells learn the same in any order of use", "[transport]") {
  TwoRooms first, second;
  std::vector<Vec3> places;
  for (int i = 0; i < 40; ++i)
    places.push_back(first.at(0.5 * i + 0.2, 0.2 * i + 0.3, 0.07 * i + 0.1));
  std::vector<const CellSight*> forwards, backwards(places.size());
  for (const Vec3& place : places)
    forwards.push_back(&first.sight.at(place, in_the_air, first.resolver));
  for (size_t i = places.size(); i-- > 0;)
    backwards[i] = &second.sight.at(places[i], in_the_air, second.resolver);
  for (size_t i = 0; i < places.size(); ++i) {
    CHECK(&first.sight.at(places[i], in_the_air, first.resolver) == forwards[i]);
    CHECK(forwards[i]->asked == backwards[i]->asked);
    CHECK(forwards[i]->cumulative == backwards[i]->cumulative);
    REQUIRE(forwards[i]->bright.size() == backwards[i]->bright.size());
    for (size_t k = 0; k < forwards[i]->bright.size(); ++k)
      CHECK(forwards[i]->bright[k].arriving == backwards[i]->bright[k].arriving);
  }
}

TEST_CASE("in a scene with more emitters than cells test, any of them can be chosen",
          "[transport]") {
  std::string text = two_rooms;
  for (size_t i = 0; i < limits::asked_emitters; ++i)
    text += "[[emitter]]\nname = \"lamp " + std::to_string(i) +
            "\"\nshape = \"point\"\ndistribution = \"isotropic\"\nposition = [" +
            std::to_string(0.5 + 0.03 * static_cast<double>(i)) + ", 9, 2.5]\nflux_lm = 10\n";
  TwoRooms rooms(test::described_text(text));
  EmitterChoice choice(*rooms.scene);
  const Vec3 place = rooms.at(6, 4, 1);
  const CellSight& seen = rooms.sight.at(place, in_the_air, rooms.resolver);
  CHECK(seen.asked.size() == limits::asked_emitters);
  REQUIRE(choice.weigh_at(place, in_the_air, all_bands, &seen));
  double sum = 0;
  for (size_t i = 0; i < rooms.scene->emitters.size(); ++i) {
    if (!(choice.probability_at(i) > 0)) FAIL("emitter " << i << " is never chosen");
    sum += choice.probability_at(i);
  }
  CHECK(sum == Approx(1).margin(1e-5));
}
