#include "scenes/emergency/sign_geometry.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "scenes/emergency/smoke_laws.hpp"
#include "scenes/light/signs/sign_face.hpp"
#include "scenes/light/signs/sign_light.hpp"

using namespace luxodus;

namespace {

constexpr ColourIndex white_at = 0, green_at = 1;

/// 0.4 m by 0.2 m in the xz plane at the origin, facing +y (so x of the sign is -x).
Sign facing_y() {
  Sign sign;
  sign.frame.axes = glm::dmat3(glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0));
  sign.width_m = 0.4;
  sign.height_m = 0.2;
  sign.smallest_detail_m = 0.02;
  sign.colours = white_and_green({500, 50}, {100, 10});
  return sign;
}

double arcmin_of(double half_m, double distance_m) {
  return 2 * std::atan(half_m / distance_m) * 180 / std::numbers::pi * 60;
}

const std::vector<glm::dvec2> decay_like_1_over_t{{60, 1.0}, {600, 0.1}, {6000, 0.01}};

}  // namespace

TEST_CASE("a sign seen along its normal has the angular size of its edges",
          "[emergency][geometry]") {
  const SignView view = view_of_sign(facing_y(), {0, 10, 0});
  CHECK_FALSE(view.behind);
  CHECK_FALSE(view.back_face);
  CHECK(view.distance_m == Approx(10));
  CHECK(view.angle_deg == Approx(0).margin(1e-9));
  CHECK(view.width_arcmin == Approx(arcmin_of(0.2, 10)));
  CHECK(view.height_arcmin == Approx(arcmin_of(0.1, 10)));
  CHECK(view.detail_arcmin == Approx(arcmin_of(0.01, 10)));
}

TEST_CASE("at its viewing distance a sign has the angular size of one over the factor",
          "[emergency][geometry]") {
  // 1/200 is 17.2 arcmin, 1/100 is 34.4 arcmin.
  CHECK(view_of_sign(facing_y(), {0, 40, 0}).height_arcmin == Approx(17.19).epsilon(1e-3));
  CHECK(view_of_sign(facing_y(), {0, 20, 0}).height_arcmin == Approx(34.38).epsilon(1e-3));
}

TEST_CASE("an oblique view shortens a sign by the cosine, in the plane of the tilt only",
          "[emergency][geometry]") {
  const double far_m = 1000, angle = std::numbers::pi / 3;
  const SignView view =
      view_of_sign(facing_y(), {far_m * std::sin(angle), far_m * std::cos(angle), 0});
  CHECK(view.angle_deg == Approx(60));
  CHECK(view.width_arcmin == Approx(arcmin_of(0.1, far_m)).epsilon(1e-6));
  CHECK(view.height_arcmin == Approx(arcmin_of(0.1, far_m)).epsilon(1e-6));
  CHECK(view.detail_arcmin == Approx(arcmin_of(0.005, far_m)).epsilon(1e-6));
}

TEST_CASE("a sign seen from behind or edge-on has no angular size", "[emergency][geometry]") {
  for (const glm::dvec3& eye : {glm::dvec3(0, -5, 0), glm::dvec3(5, 0, 0)}) {
    const SignView view = view_of_sign(facing_y(), eye);
    CHECK(view.behind);
    CHECK(view.distance_m == Approx(5));
    CHECK(view.width_arcmin == 0);
    CHECK(view.detail_arcmin == 0);
  }
}

TEST_CASE(
    "a double-sided sign shows its second face to people behind it, and none to people beside it",
    "[emergency][geometry]") {
  Sign sign = facing_y();
  sign.double_sided = true;
  sign.thickness_m = 0.05;
  const SignView back = view_of_sign(sign, {0, -10, 0});
  CHECK_FALSE(back.behind);
  CHECK(back.back_face);
  CHECK(back.distance_m == Approx(9.95));
  CHECK(back.angle_deg == Approx(0).margin(1e-9));
  CHECK(back.normal.y == -1);
  CHECK(back.width_arcmin == Approx(arcmin_of(0.2, 9.95)));
  CHECK(view_of_sign(sign, {3, -0.02, 0}).behind);
  CHECK_FALSE(view_of_sign(sign, {0, 10, 0}).back_face);
}

TEST_CASE(
    "the viewing distance is the height times 200 or 100, times the cosine in an oblique view",
    "[emergency][geometry]") {
  Sign sign = facing_y();
  const auto rule_at = [&](const glm::dvec3& eye) {
    return viewing_distance(sign, view_of_sign(sign, eye));
  };
  CHECK(rule_at({0, 39.9, 0}).allowed_m == Approx(40));
  CHECK(rule_at({0, 39.9, 0}).within);
  CHECK_FALSE(rule_at({0, 40.1, 0}).within);
  CHECK_FALSE(rule_at({0, -5, 0}).within);
  const double d = 25 / std::numbers::sqrt2;  // 45 degrees: 28.3 m
  CHECK(rule_at({d, d, 0}).allowed_oblique_m == Approx(40 / std::numbers::sqrt2));
  CHECK(rule_at({d, d, 0}).within);
  for (SignLighting lighting : {SignLighting::external, SignLighting::photoluminescent}) {
    sign.lighting = lighting;
    CHECK(rule_at({0, 5, 0}).factor == 100);
    CHECK(rule_at({0, 5, 0}).allowed_m == Approx(20));
  }
}

TEST_CASE("decay between points follows a power of time exactly", "[emergency][decay]") {
  for (double t : {60.0, 100.0, 600.0, 1234.0, 6000.0})
    CHECK(decay_share(decay_like_1_over_t, t) == Approx(60 / t));
}

TEST_CASE("decay keeps its first share before the table and continues as a power of time after it",
          "[emergency][decay]") {
  CHECK(decay_share(decay_like_1_over_t, 0) == 1);
  CHECK(decay_share(decay_like_1_over_t, 60) == 1);
  CHECK(decay_share(decay_like_1_over_t, 60000) == Approx(0.001));
  CHECK(decay_share({{10, 0.5}, {20, 0.8}}, 40) == 0.8);  // never rises after the table
}

TEST_CASE("decay is linear at time 0 and at share 0, and never negative", "[emergency][decay]") {
  const std::vector<glm::dvec2> decay{{0, 1}, {10, 0.5}, {20, 0}};
  CHECK(decay_share(decay, 0) == 1);
  CHECK(decay_share(decay, 5) == Approx(0.75));
  CHECK(decay_share(decay, 15) == Approx(0.25));
  CHECK(decay_share(decay, 1000) == 0);
  CHECK(decay_share({}, 100) == 1);
  CHECK(decay_share({{5, 0.3}}, 100) == 0.3);
}

TEST_CASE(
    "each operating state has its luminance, and dark operation leaves photoluminescence only",
    "[emergency][luminance]") {
  Sign sign = facing_y();
  const auto white = [&](Operation operation, double seconds = 0) {
    return sign_luminance(sign, white_at, operation, seconds, 1.0);
  };
  CHECK(white(Operation::mains) == 500);
  CHECK(white(Operation::emergency) == 100);
  CHECK(white(Operation::dark) == 0);
  CHECK(sign_luminance(sign, green_at, Operation::emergency, 0, 1) == 10);
  CHECK(sign_luminance(sign, other_colour, Operation::mains, 0, 1) == 0);

  sign.decay = decay_like_1_over_t;
  CHECK(white(Operation::emergency, 600) == 100);  // lit from within: the decay table is not used
  sign.lighting = SignLighting::photoluminescent;
  CHECK(white(Operation::mains, 600) == 500);
  CHECK(white(Operation::emergency, 600) == Approx(10));
  CHECK(white(Operation::dark, 6000) == Approx(1));

  sign.lighting = SignLighting::external;
  CHECK(white(Operation::mains) == 0);
}

TEST_CASE(
    "luminance follows the cosine to the sign's exponent, and no light leaves a face backwards",
    "[emergency][luminance]") {
  Sign sign = facing_y();
  const auto white = [&](double cosine) {
    return sign_luminance(sign, white_at, Operation::mains, 0, cosine);
  };
  CHECK(white(0.3) == 500);
  CHECK(white(0.0) == 0);
  CHECK(white(-0.3) == 0);
  sign.angular_exponent = 2;
  CHECK(white(0.5) == Approx(125));
}

TEST_CASE("a face's flux is the integral of its luminance over area and half space",
          "[emergency][luminance]") {
  Sign sign = facing_y();
  sign.face = uniform_face(white_at, 0.4, 0.2, 8).value();
  // Half of the face green.
  for (size_t i = 0; i < sign.face.colour.size() / 2; ++i) sign.face.colour[i] = green_at;
  for (double n : {0.0, 0.5, 1.0, 3.0}) {
    sign.angular_exponent = n;
    for (const ColourIndex colour : {white_at, green_at}) {
      // Midpoint rule over the polar angle; 4000 steps leave an error under 1e-6.
      double flux_lm = 0;
      const int steps = 4000;
      for (int i = 0; i < steps; ++i) {
        const double theta = (i + 0.5) / steps * std::numbers::pi / 2;
        flux_lm += sign_luminance(sign, colour, Operation::mains, 0, std::cos(theta)) * 0.04 *
                   std::cos(theta) * std::sin(theta) * 2 * std::numbers::pi *
                   (std::numbers::pi / 2 / steps);
      }
      const double normal = sign_luminance(sign, colour, Operation::mains, 0, 1);
      CHECK(flux_lm == Approx(normal * 0.04 * 2 * std::numbers::pi / (n + 2)).epsilon(1e-5));
    }
  }
}

TEST_CASE(
    "in plan the distance to a sign is horizontal, and the angle of view is that seen from above",
    "[emergency][geometry]") {
  const Sign sign = facing_y();  // at the origin
  const glm::dvec3 eye(3, 4, -1.5);
  const PlanLine line = plan_line(view_of_sign(sign, eye), eye);
  CHECK(line.to.z == eye.z);
  CHECK(line.distance_m == Approx(5).margin(1e-3));
  CHECK(line.cosine == Approx(0.8));
  CHECK(line.to.y == Approx(1e-3));  // just in front of the wall that it hangs on
  const glm::dvec3 behind(0, -4, 0);
  CHECK(plan_line(view_of_sign(sign, behind), behind).cosine == 0);
  // A sign that lies flat under the ceiling is seen from all directions.
  Sign flat = sign;
  flat.frame.axes = glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, -1));
  CHECK(plan_line(view_of_sign(flat, eye), eye).cosine == 1);
}

TEST_CASE("the line-of-sight method gives C/K up to 30 m, and less in an oblique view",
          "[emergency]") {
  CHECK(line_of_sight_distance_m(8, 0, 1) == 30);
  CHECK(line_of_sight_distance_m(8, 0.1, 1) == 30);
  CHECK(line_of_sight_distance_m(3, 1, 0.5) == Approx(1.5));
  CHECK(line_of_sight_distance_m(3, 1, 0) == 0);
}
