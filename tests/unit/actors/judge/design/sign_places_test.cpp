// Tests places for signs: obstacles and flatness of the wall, at every corner of a sign.
#include "actors/judge/design/sign_places.hpp"

#include <catch2/catch.hpp>

#include "actors/judge/assess/code_light.hpp"
#include "tests/kit/described.hpp"

namespace luxodus {
namespace {

constexpr double face_width_m = 0.4, face_height_m = 0.2, lower_edge_m = 2.2;

/// Places for a sign in a corridor of 10 m to the end wall, with a body in it.
std::vector<SignSpot> spots_with(const std::string& body) {
  const auto scene = test::described_text(
      "[[object]]\nname = \"room\"\nshape = \"room\"\nlow = [0, 0, 0]\nhigh = [10, 3, 3]\n"
      "material = \"white50\"\n[[emitter]]\nname = \"lamp\"\nshape = \"point\"\nposition = [5, "
      "1.5, 2.9]\nflux_lm = 100\n[[route]]\nname = \"way\"\npath = [[1, 1.5, 0], [9, 1.5, 0]]\n"
      "width = 1\n[design]\n" +
      body);
  Sign sign = scene->design->sign_types.front().sign;
  sign.width_m = face_width_m, sign.height_m = face_height_m;
  DesignSettings design = *scene->design;
  design.sign_height_m = lower_edge_m;
  const auto bare = Building::make(code_scene(*scene, false), code_scenario(*scene, {}), 1);
  const auto furnished = Building::make(code_scene(*scene, true), code_scenario(*scene, {}), 1);
  REQUIRE(bare);
  REQUIRE(furnished);
  SignsLeftOut left_out;
  return sign_spots(*scene, design, sign, *bare.value(), *furnished.value(), left_out);
}

std::string box(const char* low, const char* high, const char* tags) {
  return fmt::format(
      "[[object]]\nname = \"body\"\nshape = \"box\"\nlow = [{}]\nhigh = [{}]\nmaterial = "
      "\"white50\"\ntags = [{}]\n",
      low, high, tags);
}

size_t over_the_end(const std::vector<SignSpot>& spots) {
  return static_cast<size_t>(std::count_if(spots.begin(), spots.end(), [](const SignSpot& spot) {
    return spot.mount == SignMount::above && spot.position.x > 9;
  }));
}

}  // namespace

TEST_CASE("no corner of a sign is in furniture", "[design][signs]") {
  CHECK(over_the_end(spots_with("")) == 1);
  // The cupboard contains 0.1 m of the sign, from its left edge at y = 1.3.
  const std::string cupboard = box("9.8, 0.5, 0", "9.999, 1.4, 2.6", "\"furniture\"");
  CHECK(over_the_end(spots_with(cupboard)) == 0);
  const std::string narrow = box("9.8, 0.5, 0", "9.999, 1.2, 2.6", "\"furniture\"");
  CHECK(over_the_end(spots_with(narrow)) == 1);
}

TEST_CASE("a wall behind a sign must be flat to 1 cm from the lower to the upper edge of the sign",
          "[design][signs]") {
  // A ledge behind the upper half of the sign.
  CHECK(over_the_end(spots_with(box("9.985, 0, 2.3", "10, 3, 3", ""))) == 0);
  CHECK(over_the_end(spots_with(box("9.992, 0, 2.3", "10, 3, 3", ""))) == 1);
}

}  // namespace luxodus
