// Path guiding towards the glow around emitters.
#include "scenes/light/transport/glow_guide.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "runtime/core/random.hpp"
#include "scenes/light/optics/sampling.hpp"
#include "scenes/light/transport/emitter_sight.hpp"

using namespace luxodus;

namespace {

std::vector<Glow> three_glows() {
  return {{Vec3(0, 0, 3), 0.5f, 10, 0.8},
          {Vec3(4, 0, 3), 0.3f, 40, 0.2},
          {Vec3(0.2f, 0.1f, 0), 1, 5, 0.5}};
}

/// Density of isotropic scattering.
constexpr double isotropic = 1 / (4 * std::numbers::pi);

}  // namespace

TEST_CASE("partly guided directions have a density that integrates to one", "[transport]") {
  GlowGuide guide(three_glows());
  // Outside all spheres, and inside one.
  for (const Vec3& place : {Vec3(2, 1, 1), Vec3(0.1f, 0.1f, 0.2f)}) {
    guide.stand_at(place, nullptr, CachedLight::nothing);
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

TEST_CASE("directions are sampled with the density that the guide states", "[transport]") {
  GlowGuide guide(three_glows());
  guide.stand_at(Vec3(2, 1, 1), nullptr, CachedLight::nothing);
  Random random(2, RandomStream::test);
  random.start(0);
  // The mean of 1/density over sampled directions is the whole sphere; over those of a hemisphere,
  // that hemisphere.
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

TEST_CASE("within a glow, lines are guided more densely the nearer they pass the emitter",
          "[transport]") {
  const Vec3 emitter(1, 2, 3);
  GlowGuide guide({{emitter, 0.5f, 10, 0.8, 0, 0.008f}});
  for (const Real distance : {2.0f, 0.6f, 0.4f, 0.01f}) {
    const Vec3 place = emitter + Vec3(0, distance, 0);
    guide.stand_at(place, nullptr, CachedLight::nothing);
    const auto aimed_at = [&](Real sine) {
      const Vec3 direction(sine, -std::sqrt(1 - sine * sine), 0);
      return guide.density(direction, isotropic) - (1 - guide.aimed()) * isotropic;
    };
    CHECK(aimed_at(0.01f) > 5 * isotropic);
    CHECK(aimed_at(0.001f) == Approx(10 * aimed_at(0.01f)).epsilon(0.01));
  }
  // At the emitter itself no direction leads to it.
  for (const Vec3& aside : {Vec3(0), Vec3(0, 0.007f, 0)}) {
    guide.stand_at(emitter + aside, nullptr, CachedLight::nothing);
    CHECK(guide.aimed() == 0);
  }
}

TEST_CASE("if scattered light is cached, paths are guided to surface reflections alone",
          "[transport]") {
  const Vec3 smoky(0, 0, 3), beside_a_wall(4, 0, 3);
  GlowGuide guide({{smoky, 0.5f, 10, 0.8, 0, 0.01f}, {beside_a_wall, 0.5f, 10, 0.5, 0.4, 0.01f}});
  const Vec3 place(2, 0, 0);
  const auto aimed_at = [&](const Vec3& glow) {
    return guide.density(glm::normalize(glow - place + Vec3(0, 0.05f, 0)), 0);
  };
  guide.stand_at(place, nullptr, CachedLight::nothing);
  CHECK(aimed_at(smoky) == Approx(1.6 * aimed_at(beside_a_wall)).epsilon(1e-3));
  guide.stand_at(place, nullptr, CachedLight::scattered);
  CHECK(aimed_at(smoky) == 0);
  CHECK(aimed_at(beside_a_wall) > 0);
}

TEST_CASE("a guide without glows leaves every density unchanged", "[transport]") {
  GlowGuide guide;
  CHECK(guide.empty());
  guide.stand_at(Vec3(1, 2, 3), nullptr, CachedLight::nothing);
  CHECK(guide.aimed() == 0);
  CHECK(guide.density(Vec3(0, 0, 1), 0.37) == 0.37);
}

TEST_CASE("without knowledge of emitters only the brightest glows are guided to", "[transport]") {
  std::vector<Glow> glows(limits::glows + 10);
  for (size_t i = 0; i < glows.size(); ++i) {
    const auto x = static_cast<float>(10 * i);
    glows[i] = {Vec3(x, 0, 0), 1, static_cast<double>(i), 0.5};
  }
  GlowGuide guide(glows);
  const auto aims_at = [&](size_t i) {
    const Vec3 place = glows[i].centre + Vec3(0, 2, 0);
    guide.stand_at(place, nullptr, CachedLight::nothing);
    return guide.density(glm::normalize(Vec3(0.1f, -1, 0)), isotropic) > isotropic;
  };
  CHECK_FALSE(aims_at(9));
  CHECK(aims_at(10));
  CHECK(aims_at(limits::glows + 9));
}

TEST_CASE("a glow is guided to by the light that arrives from its emitter", "[transport]") {
  GlowGuide guide(three_glows());
  const Vec3 place(2, 1, 1);
  const Vec3 first = glm::normalize(Vec3(-2.02f, -1, 2)), second = glm::normalize(Vec3(2, -1, 2));
  const auto above_isotropic = [&](const Vec3& direction) {
    return guide.density(direction, isotropic) / isotropic - (1 - guide.aimed());
  };
  CellSight seen;
  seen.bright = {{0, 0.5, 0.5}, {1, 0.5, 0.5}};
  guide.stand_at(place, &seen, CachedLight::nothing);
  CHECK(above_isotropic(first) > 1);
  CHECK(above_isotropic(second) > 1);
  // Emitters behind a wall, or reached by no ray of the cell, are not guided to.
  seen.bright = {{0, 0.5, 0.5}, {1, 1e-4, 1e-4}};
  guide.stand_at(place, &seen, CachedLight::nothing);
  CHECK(above_isotropic(first) > 1);
  CHECK(above_isotropic(second) == Approx(0).margin(1e-9));
  // A lamp without glow leaves a smaller share for those with glow.
  const double before = guide.aimed();
  std::vector<Glow> glows = three_glows();
  glows[2].share = 0;
  guide = GlowGuide(glows);
  seen.bright.push_back({2, 5, 5});
  guide.stand_at(place, &seen, CachedLight::nothing);
  CHECK(guide.aimed() > 0);
  CHECK(guide.aimed() < before / 2);
}
