// Scattering layers between perfect mirrors, which make them infinite, compared with discrete
// ordinates of many streams: reflected, transmitted and unscattered light, and absorption and path
// length by layer. The scenes are those of actors/judge/validate.
#include "tests/optics/light_kit.hpp"

namespace luxodus::light {
namespace {

double depth_of(const Case& stack) {
  return std::stod(stack.name.substr(stack.name.find("of depth ") + 9));
}

/// A history collides about twice as often as the stack is deep, so rare shares are not resolved.
void check_stacks(double min_depth, double max_depth, const std::string& incidence) {
  int cases = 0;
  for (const Case& c : all_cases()) {
    if (c.group != "stack" || c.name.find(", " + incidence) == std::string::npos) continue;
    const double depth = depth_of(c);
    if (depth < min_depth || depth > max_depth) continue;
    CaseOptions options;
    options.min_share = depth <= 1 ? 0.002 : depth <= 10 ? 0.005 : 0.01;
    options.max_particles = depth >= 100 ? 1 << 19 : 1 << 25;
    check_case(c, options);
    ++cases;
  }
  CHECK(cases >= 4);
}

}  // namespace

TEST_CASE("thin layers reflect, transmit and absorb a beam as the transport equation states") {
  check_stacks(0, 1, "normal");
}
TEST_CASE(
    "thin layers reflect, transmit and absorb diffuse light as the transport equation states") {
  check_stacks(0, 1, "lambert");
}
TEST_CASE("thick layers reflect, transmit and absorb a beam as the transport equation states") {
  check_stacks(2, 10, "normal");
}
TEST_CASE(
    "thick layers reflect, transmit and absorb diffuse light as the transport equation states") {
  check_stacks(2, 10, "lambert");
}
TEST_CASE("deep layers reflect, transmit and absorb a beam as the transport equation states") {
  check_stacks(15, 50, "normal");
}
TEST_CASE(
    "deep layers reflect, transmit and absorb diffuse light as the transport equation states") {
  check_stacks(15, 50, "lambert");
}
TEST_CASE("a hundred free paths of layers treat a beam as the transport equation states") {
  check_stacks(100, 100, "normal");
}
TEST_CASE("a hundred free paths of layers treat diffuse light as the transport equation states") {
  check_stacks(100, 100, "lambert");
}

TEST_CASE("a half space of gas reflects as Chandrasekhar's H function states") {
  CaseOptions options;
  options.min_particles = 1 << 16;
  check_cases("half space", 36, options);
}

}  // namespace luxodus::light
