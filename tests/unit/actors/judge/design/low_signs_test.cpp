// Tests low-level signs below high ones: on a wall if there is one, and nowhere else.
#include "actors/judge/design/low_signs.hpp"

#include <catch2/catch.hpp>

#include "actors/judge/assess/code_light.hpp"
#include "tests/kit/described.hpp"
#include "tests/kit/room_texts.hpp"

namespace luxodus {
namespace {

/// Low signs in a corridor of 16 m with its middle at y = 0, with `more` objects in it.
std::vector<LowSign> low_signs_in(const std::string& sign_at, const std::string& more = "") {
  const auto scene = test::described_text(
      "[[object]]\nname = \"corridor\"\nshape = \"room\"\nlow = [0, -2, 0]\nhigh = [16, 2, 3]\n"
      "material = \"white50\"\n[[emitter]]\nname = \"lamp\"\nshape = \"point\"\nposition = [5, "
      "0, 2.9]\nflux_lm = 100\n[[route]]\nname = \"way\"\npath = [[1, 0, 0], [15, 0, 0]]\n"
      "width = 1\n" +
      more + test::exit_sign_at(sign_at));
  const auto building = Building::make(code_scene(*scene, false), code_scenario(*scene, {}), 1);
  REQUIRE(building);
  return low_signs_of(*scene, *building.value());
}

}  // namespace

TEST_CASE("a sign on a wall gets a low sign below it", "[design][low]") {
  const auto low = low_signs_in("[15.97, 0, 2.2]");
  REQUIRE(low.size() == 1);
  CHECK(low[0].of == "exit");
  const glm::dvec3 at = low[0].sign.frame.origin;
  CHECK(at.z == Approx(0.3));
  CHECK(at.y == Approx(0).margin(1e-9));
  CHECK(16 - at.x - low[0].sign.thickness_m / 2 > 0);
  CHECK(16 - at.x - low[0].sign.thickness_m / 2 < 0.01);
  CHECK(glm::length(low[0].sign.frame.axes[2] - glm::dvec3(-1, 0, 0)) < 1e-9);
}

TEST_CASE("a sign over an opening gets a low sign beside the opening", "[design][low]") {
  // The wall at x = 12 is open between y = -0.5 and 0.5.
  const auto wall = [](const char* name, const char* low, const char* high) {
    return fmt::format(
        "[[object]]\nname = \"{}\"\nshape = \"box\"\nlow = [{}]\nhigh = [{}]\nmaterial = "
        "\"white50\"\n",
        name, low, high);
  };
  const auto low =
      low_signs_in("[11.97, 0, 2.3]", wall("south", "12, -2, 0", "12.2, -0.5, 3") +
                                          wall("north", "12, 0.5, 0", "12.2, 2, 3") +
                                          wall("lintel", "12, -0.5, 2.1", "12.2, 0.5, 3"));
  REQUIRE(low.size() == 1);
  const glm::dvec3 at = low[0].sign.frame.origin;
  CHECK(std::abs(at.y) - 0.2 >= 0.5);  // the edge, at half of 0.4 m, is beside the opening
  CHECK(std::abs(at.y) < 1);
  CHECK(at.x < 12);
}

TEST_CASE("a sign in the middle of a room and a sign near the floor get no low sign",
          "[design][low]") {
  CHECK(low_signs_in("[8, 0, 2.2]").empty());
  CHECK(low_signs_in("[15.97, 0, 0.35]").empty());
}

}  // namespace luxodus
