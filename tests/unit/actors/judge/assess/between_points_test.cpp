// Tests that minima and ratios are judged between the points of the grid as well: under a narrow
// beam, in a dark ring of a luminaire's light, and where two cones of light do not meet.
#include <cmath>
#include <numbers>

#include "tests/unit/actors/judge/assess/assessed_room.hpp"

namespace luxodus {
namespace {

using test::check_of;
using test::TemporaryFolder;

constexpr double degrees = std::numbers::pi / 180;

/// The value at the points of the grid, where the check states it.
std::optional<double> on_grid(const Check& check) {
  for (const Remark& reason : check.reasons)
    if (reason.id == RemarkId::value_on_grid) return std::get<double>(reason.arguments.front());
  return std::nullopt;
}

/// A black room of 12 m by 4 m by 3 m with points of a route 0.25 m apart, from x = 1 to `end`.
std::string corridor(double end) {
  return fmt::format(R"(
[[object]]
name = "room"
shape = "room"
low = [0, -2, 0]
high = [12, 2, 3]
material = "black5"
[[route]]
name = "way"
path = [[1, 0, 0], [{}, 0, 0]]
width = 0.8
[[scenario]]
name = "failed"
operation = "emergency"
)",
                     end);
}

std::string spot(const char* name, double x, double half_angle_deg, double lumens) {
  return fmt::format(R"(
[[emitter]]
name = "{}"
shape = "point"
distribution = "spot"
spot_inner_deg = {}
spot_outer_deg = {}
position = [{}, 0, 2.97]
flux_lm = {}
emergency = "non-maintained"
emergency_flux = {}
maintenance_factor = 1
emergency_flux_is = "rated"
)",
                     name, half_angle_deg, half_angle_deg, x, lumens, lumens);
}

}  // namespace

TEST_CASE("a beam that falls between the points of the grid counts for the ratio", "[assess]") {
  // 300 lm of the lamp are left at the end of its duration: I cos^3 / h^2 at the ends of the route.
  const double lamp = 300 / (4 * std::numbers::pi), h = 2.48;
  const auto of_lamp = [&](double aside) {
    return lamp * h / std::pow(h * h + aside * aside, 1.5);
  };
  // Its radius is 0.103 m, and points are 0.125 m away.
  const double half_angle = 2, below = 2.95, beam_lx = 12;
  const double solid_angle = 2 * std::numbers::pi * (1 - std::cos(half_angle * degrees));
  const Assessment a =
      test::assessed(corridor(11) + test::middle_lamp +
                         spot("beam", 6.125, half_angle, beam_lx * below * below * solid_angle),
                     test::codes_alone());
  const Check& ratio = check_of(a, RuleId::E4);
  const double on_points = of_lamp(0) / of_lamp(5), peak = of_lamp(0.125) + beam_lx;
  REQUIRE(on_grid(ratio));
  CHECK(*on_grid(ratio) == Approx(on_points).epsilon(1e-3));
  CHECK(on_points < 40);
  CHECK(*ratio.value == Approx(peak / of_lamp(5)).epsilon(1e-3));
  CHECK(ratio.verdict == CheckVerdict::fail);
  // The smallest illuminance is at a point of the grid.
  CHECK_FALSE(on_grid(check_of(a, RuleId::E1)));
}

TEST_CASE("a dark ring of a luminaire's light between points counts for the minimum", "[assess]") {
  // An even floor up to 60 degrees, 100 cd / cos^3, with a ring from 28.5 to 30.5 degrees.
  const double h = 2.95, dark_cd = 5;
  std::string angles, candela;
  int count = 0;
  const auto add = [&](double polar, double cd) {
    angles += fmt::format("{} ", polar);
    candela += fmt::format("{:.4f} ", cd);
    ++count;
  };
  for (double polar = 0; polar <= 61; polar += 0.25) {
    const bool in_ring = polar > 28.4 && polar < 30.6;
    add(polar, in_ring ? dark_cd : 100 / std::pow(std::cos(polar * degrees), 3));
  }
  add(62, 0);
  add(90, 0);
  const TemporaryFolder folder;
  folder.write("ring.ies", fmt::format("IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n1 -1 1 {} 1 1 2 "
                                       "0 0 0\n1 1 10\n{}\n0\n{}\n",
                                       count, angles, candela));
  // Points are 1.55 m and 1.80 m away, the ring is at 1.60 m to 1.74 m.
  const auto file = folder.write("scene.toml", corridor(5) + R"(
[[luminaire]]
name = "ring"
file = "ring.ies"
position = [0.95, 0, 2.97]
emergency = "non-maintained"
emergency_flux = 100
maintenance_factor = 1
emergency_flux_is = "rated"
)");
  static const std::atomic<bool> nobody{false};
  AssessOptions options = test::codes_alone();
  options.rules = {"en1838-2013"};
  const auto a = assess(test::described(file), options, nobody, [](const std::string&, double) {});
  INFO((a.ok() ? "" : a.problem().text()));
  REQUIRE(a.ok());
  const Check& least = check_of(a.value(), RuleId::E1);
  REQUIRE(on_grid(least));
  const double ring = dark_cd * std::pow(std::cos(30.5 * degrees), 3) / 100;
  CHECK(*least.value / *on_grid(least) == Approx(ring).epsilon(0.01));
  CHECK(std::abs(least.worst->x - 0.95 - h * std::tan(30.5 * degrees)) < 0.01);
  const Check& ratio = check_of(a.value(), RuleId::E4);
  CHECK(*on_grid(ratio) == Approx(1).margin(0.02));
  CHECK(*ratio.value == Approx(1 / ring).epsilon(0.02));
}

TEST_CASE("a gap between two cones of light fails the minimum though all points are lit",
          "[assess]") {
  // Cones of 45 degrees reach 2.95 m: dark from 5.95 m to 6.05 m, between points at 5.875 m and
  // 6.125 m.
  const std::string text = test::replaced(corridor(11.625), "[[1, 0, 0]", "[[0.625, 0, 0]");
  const Assessment a = test::assessed(text + spot("west", 3, 45, 300) + spot("east", 9, 45, 300),
                                      test::codes_alone());
  const Check& least = check_of(a, RuleId::E1);
  CHECK(least.verdict == CheckVerdict::fail);
  CHECK(*least.value == 0);
  REQUIRE(on_grid(least));
  CHECK(*on_grid(least) > 1);
  CHECK(std::abs(least.worst->x - 6) < 0.05);
}

TEST_CASE("smooth light has one value, that of the grid", "[assess]") {
  const Assessment a = test::assessed(corridor(11) + test::middle_lamp, test::codes_alone());
  for (const Check& check : a.checks) CHECK_FALSE(on_grid(check));
}

}  // namespace luxodus
