// Turns that are aimed at the glow around emitters.
#include "scenes/transport/glow_guide.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "runtime/core/random.hpp"
#include "scenes/optics/sampling.hpp"

using namespace luxodus;

namespace {

std::vector<Glow> three_glows() {
  return {{Vec3(0, 0, 3), 0.5f, 10, 0.8},
          {Vec3(4, 0, 3), 0.3f, 40, 0.2},
          {Vec3(0.2f, 0.1f, 0), 1, 5, 0.5}};
}

/// Of turns that are isotropic by themselves.
constexpr double isotropic = 1 / (4 * std::numbers::pi);

}  // namespace

TEST_CASE("turns that are partly aimed have a density of one in all", "[transport]") {
  GlowGuide guide(three_glows());
  // Outside of all spheres, and inside of one.
  for (const Vec3& place : {Vec3(2, 1, 1), Vec3(0.1f, 0.1f, 0.2f)}) {
    guide.stand_at(place);
    CHECK(guide.aimed() > 0);
    CHECK(guide.aimed() <= limits::max_aimed);
    Random random(1, RandomStream::test);
    random.start(0);
    double sum = 0;
    constexpr int directions = 400'000;
    for (int i = 0; i < directions; ++i) {
      const Real u = random.uniform(), v = random.uniform();
      sum += guide.density(uniform_sphere(u, v), isotropic) / isotropic;
    }
    CHECK(sum / directions == Approx(1).epsilon(0.02));
  }
}

TEST_CASE("directions are aimed as densely as the guide says", "[transport]") {
  GlowGuide guide(three_glows());
  guide.stand_at(Vec3(2, 1, 1));
  Random random(2, RandomStream::test);
  random.start(0);
  // The mean of 1/density over drawn directions is the whole sphere, whatever is drawn; over those
  // of a half of it, that half.
  double whole = 0, upper = 0;
  constexpr int turns = 400'000;
  for (int i = 0; i < turns; ++i) {
    const double choice = random.uniform_double();
    const Real u = random.uniform(), v = random.uniform();
    const Vec3 d = choice < guide.aimed() ? guide.direction(choice, u, v) : uniform_sphere(u, v);
    if (std::abs(glm::length(d) - 1) > 1e-5f) FAIL("not of unit length");
    const double share = 1 / guide.density(d, isotropic) / turns;
    whole += share;
    if (d.z > 0) upper += share;
  }
  CHECK(whole == Approx(4 * std::numbers::pi).epsilon(0.005));
  CHECK(upper == Approx(2 * std::numbers::pi).epsilon(0.005));
}

TEST_CASE("a guide without glows leaves every density as it is", "[transport]") {
  GlowGuide guide;
  CHECK(guide.empty());
  guide.stand_at(Vec3(1, 2, 3));
  CHECK(guide.aimed() == 0);
  CHECK(guide.density(Vec3(0, 0, 1), 0.37) == 0.37);
}

TEST_CASE("only the brightest glows are aimed at where there are many", "[transport]") {
  std::vector<Glow> glows(limits::glows + 10);
  for (size_t i = 0; i < glows.size(); ++i) glows[i] = {Vec3(0), 1, static_cast<double>(i), 0.5};
  keep_brightest(glows);
  CHECK(glows.size() == limits::glows);
  CHECK(glows.front().power == static_cast<double>(limits::glows + 9));
  CHECK(glows.back().power == 10);
}
