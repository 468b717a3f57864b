#include "scenes/light/optics/sampling.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "tests/unit/scenes/light/optics/sampler_checks.hpp"

using namespace luxodus;
using namespace luxodus::checks;

namespace {

constexpr int draws = 200000;
constexpr float last_unit = 1.0F - 0x1p-24F;

}  // namespace

TEST_CASE("sine and cosine of a turn are within 1.2e-7 of double for all 2^24 + 1 inputs",
          "[optics][sampling]") {
  double worst = 0;
  double worst_norm = 0;
  for (uint32_t i = 0; i <= (1U << 24); ++i) {
    const float u = static_cast<float>(i) * 0x1p-24F;
    const SinCos a = sin_cos_two_pi(u);
    const double angle = 2 * std::numbers::pi * static_cast<double>(u);
    worst =
        std::max({worst, std::fabs(a.sin - std::sin(angle)), std::fabs(a.cos - std::cos(angle))});
    const double norm = static_cast<double>(a.sin) * a.sin + static_cast<double>(a.cos) * a.cos;
    worst_norm = std::max(worst_norm, std::fabs(norm - 1));
  }
  CAPTURE(worst, worst_norm);
  CHECK(worst < 1.2e-7);
  CHECK(worst_norm < 2.4e-7);
  CHECK(sin_cos_two_pi(0.25F).sin == 1.0F);
  CHECK(sin_cos_two_pi(0.5F).cos == -1.0F);
  CHECK(sin_cos_two_pi(0.75F).sin == -1.0F);
}

TEST_CASE("logarithm and powers of two keep their stated relative errors, next to 1 and 0 too",
          "[optics][sampling]") {
  double worst_log = 0, worst_exp = 0, worst_minus_one = 0;
  for (int i = 1; i < (1 << 20); ++i) {
    const float x = static_cast<float>(i) * 0x1p-20F;
    const double log = std::log2(static_cast<double>(x));
    worst_log = std::max(worst_log, std::fabs(static_cast<double>(log2_of(x)) / log - 1));
    const float power = -126.0F * x * x * x;
    const double exact = std::exp2(static_cast<double>(power));
    worst_exp = std::max(worst_exp, std::fabs(static_cast<double>(exp2_of(power)) / exact - 1));
    const double less = std::expm1(static_cast<double>(power) * std::numbers::ln2);
    worst_minus_one =
        std::max(worst_minus_one, std::fabs(static_cast<double>(exp2_minus_one(power)) / less - 1));
  }
  for (float x = 0x1p-126F; x < 1.0F; x *= 1.37F) {
    const double log = std::log2(static_cast<double>(x));
    worst_log = std::max(worst_log, std::fabs(static_cast<double>(log2_of(x)) / log - 1));
  }
  const float just_below = log2_of(last_unit);
  CAPTURE(worst_log, worst_exp, worst_minus_one);
  CHECK(worst_log < 4e-7);
  CHECK(worst_exp < 3e-7);
  CHECK(worst_minus_one < 4e-7);
  CHECK(just_below == Approx(std::log2(1.0 - 0x1p-24)).epsilon(4e-7));
  CHECK(log2_of(1.0F) == 0.0F);
  CHECK(exp2_of(0.0F) == 1.0F);
  CHECK(exp2_minus_one(0.0F) == 0.0F);
  CHECK(exp2_of(log2_of(0.0F)) == 0.0F);
}

TEST_CASE("sphere samples are uniform in height and azimuth, with second moment 1/3",
          "[optics][sampling]") {
  const uint32_t seed = seed_or(11);
  INFO("seed " << seed);
  Uniform next(seed);
  std::vector<double> counts(64, 0.0);
  Mean z, zz;
  for (int i = 0; i < draws; ++i) {
    const float u = next();
    const float v = next();
    const glm::vec3 d = uniform_sphere(u, v);
    const double height = std::min(0.999999, 0.5 * (d.z + 1.0));
    const double turn = std::min(0.999999, turn_share(d.x, d.y));
    ++counts[static_cast<std::size_t>(height * 8) * 8 + static_cast<std::size_t>(turn * 8)];
    z.add(d.z);
    zz.add(static_cast<double>(d.z) * d.z);
  }
  CHECK(chi_square_deviations(counts, std::vector<double>(64, 1.0 / 64)) < allowed);
  CHECK(z.distance(0) < allowed);
  CHECK(zz.distance(1.0 / 3) < allowed);
}

TEST_CASE(
    "hemisphere samples follow the cosine, with mean cosine 2/3, and always leave the surface",
    "[optics][sampling]") {
  const uint32_t seed = seed_or(12);
  INFO("seed " << seed);
  Uniform next(seed);
  Histogram squared(32), turn(32);
  Mean z;
  float least = 1;
  for (int i = 0; i < draws; ++i) {
    const float u = next();
    const float v = next();
    const glm::vec3 d = cosine_hemisphere(u, v);
    squared.add(static_cast<double>(d.z) *
                d.z);  // distribution function of cosine-weighted heights
    turn.add(turn_share(d.x, d.y));
    z.add(d.z);
    least = std::min(least, d.z);
  }
  CHECK(squared.deviations() < allowed);
  CHECK(turn.deviations() < allowed);
  CHECK(z.distance(2.0 / 3) < allowed);
  CHECK(least > 0.0F);
  CHECK(cosine_hemisphere(last_unit, 0.3F).z >= 0x1p-12F);
}

TEST_CASE("disc samples are uniform in area", "[optics][sampling]") {
  const uint32_t seed = seed_or(13);
  INFO("seed " << seed);
  Uniform next(seed);
  Histogram area(32), turn(32);
  Mean x, y;
  for (int i = 0; i < draws; ++i) {
    const float u = next();
    const float v = next();
    const glm::dvec2 p(uniform_disc(u, v));
    area.add(glm::dot(p, p));
    turn.add(turn_share(p.x, p.y));
    x.add(p.x * p.x);
    y.add(p.y);
  }
  CHECK(area.deviations() < allowed);
  CHECK(turn.deviations() < allowed);
  CHECK(x.distance(0.25) < allowed);
  CHECK(y.distance(0) < allowed);
}

TEST_CASE("triangle samples are uniform in area and never outside", "[optics][sampling]") {
  const uint32_t seed = seed_or(14);
  INFO("seed " << seed);
  Uniform next(seed);
  Histogram towards_corner[3] = {Histogram(32), Histogram(32), Histogram(32)};
  Histogram along_edge(32);
  Mean product;
  bool inside = true;
  for (int i = 0; i < draws; ++i) {
    const float u = next();
    const float v = next();
    const glm::vec3 b = uniform_triangle(u, v);
    inside = inside && b.x >= 0 && b.y >= 0 && b.z >= 0 && std::fabs(b.x + b.y + b.z - 1) < 2e-7F;
    for (int c = 0; c < 3; ++c) {
      // The part of the triangle whose barycentric exceeds b is (1 - b)^2 of its area.
      towards_corner[c].add(std::pow(1.0 - static_cast<double>(b[c]), 2));
    }
    along_edge.add(b.x / std::max(1e-12, 1.0 - static_cast<double>(b.z)));
    product.add(static_cast<double>(b.x) * b.y);
  }
  CHECK(inside);
  for (const Histogram& corner : towards_corner) CHECK(corner.deviations() < allowed);
  CHECK(along_edge.deviations() < allowed);
  CHECK(product.distance(1.0 / 12) < allowed);
}

TEST_CASE("cosine-power samples follow their density for every n, also as narrow as n = 1e6",
          "[optics][sampling]") {
  for (const double n : {0.0, 1.0, 2.5, 80.0, 1e6}) {
    const uint32_t seed = seed_or(16);
    CAPTURE(seed, n);
    Uniform next(seed);
    Histogram share(32), turn(32);
    Mean sin_square_mean;
    for (int i = 0; i < draws; ++i) {
      const float u = next();
      const float v = next();
      const glm::dvec3 d(cosine_power(static_cast<float>(n), u, v));
      const double sin_square = d.x * d.x + d.y * d.y;
      const double log_cos =
          d.z > 0.5 ? 0.5 * std::log1p(-sin_square) : std::log(std::max(1e-12, d.z));
      share.add(std::exp((n + 1) * log_cos));
      turn.add(turn_share(d.x, d.y));
      sin_square_mean.add(sin_square);
    }
    CHECK(share.deviations() < allowed);
    CHECK(turn.deviations() < allowed);
    CHECK(sin_square_mean.distance(2 / (n + 3)) < allowed);
    double worst = 0;
    for (int i = 1; i <= 1000; ++i) {
      // Evenly spaced in the logarithm, from 1 down to where a cosine itself keeps no digit of it.
      const float x = std::pow(10.0F, -10 * static_cast<float>(i) / 1000.0F);
      const double exact =
          (n + 1) / (2 * std::numbers::pi) * std::exp(n * std::log1p(-static_cast<double>(x)));
      const double got = static_cast<double>(cosine_power_pdf(static_cast<float>(n), x));
      if (exact > 1e-30) worst = std::max(worst, std::fabs(got / exact - 1));
    }
    CHECK(worst < 4e-5);  // the exponent, up to 100, is rounded in float
    CHECK(cosine_power_pdf(static_cast<float>(n), 1.1F) == 0.0F);
  }
}

TEST_CASE("a spot's solid angle is the integral of its intensity, and its samples follow it",
          "[optics][sampling]") {
  struct Angles {
    double inner, outer;
  };
  for (const Angles angles : {Angles{0, 0.5}, Angles{0.2, 0.5}, Angles{0.5, 0.5},
                              Angles{0.01, 0.012}, Angles{1e-4, 2e-4}, Angles{1.0, 2.5}}) {
    const uint32_t seed = seed_or(17);
    CAPTURE(seed, angles.inner, angles.outer);
    const SpotLobe spot = SpotLobe::from_half_angles(angles.inner, angles.outer);
    // Distribution function of 1 - cos on a fine grid, by midpoints in double.
    const double in = 1 - std::cos(angles.inner), out = 1 - std::cos(angles.outer);
    const auto intensity = [&](double x) {
      if (x <= in) return 1.0;
      if (x >= out) return 0.0;
      const double t = (out - x) / (out - in);
      return t * t * (3 - 2 * t);
    };
    constexpr int cells = 20000;
    std::vector<double> below(cells + 1, 0.0);
    for (int i = 0; i < cells; ++i) {
      const auto k = static_cast<std::size_t>(i);
      below[k + 1] = below[k] + intensity((i + 0.5) * out / cells) * out / cells;
    }
    CHECK(static_cast<double>(spot.solid_angle()) ==
          Approx(2 * std::numbers::pi * below.back()).epsilon(2e-4));
    Uniform next(seed);
    Histogram share(32), turn(32);
    for (int i = 0; i < draws; ++i) {
      const float u = next();
      const float v = next();
      const glm::dvec3 d(spot.sample(u, v));
      const double sin_square = d.x * d.x + d.y * d.y;
      const double x = d.z > 0 ? sin_square / (1 + d.z) : 1 - d.z;
      const double at = std::clamp(x / out * cells, 0.0, cells - 1e-9);
      const auto k = static_cast<std::size_t>(at);
      const double f = at - std::floor(at);
      share.add((below[k] + f * (below[k + 1] - below[k])) / below.back());
      turn.add(turn_share(d.x, d.y));
    }
    CHECK(share.deviations() < allowed);
    CHECK(turn.deviations() < allowed);
    for (const double x : {0.0, 0.3, 0.7, 0.95}) {
      CHECK(static_cast<double>(spot.relative_intensity(static_cast<float>(x * out))) ==
            Approx(intensity(x * out)).margin(1e-5));
    }
  }
}

TEST_CASE("a basis is orthonormal and right-handed about any unit vector, the poles included",
          "[optics][sampling]") {
  const uint32_t seed = seed_or(18);
  INFO("seed " << seed);
  Uniform next(seed);
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const float u = next();
    const float v = next();
    glm::vec3 z = uniform_sphere(u, v);
    if (i < 8) {  // the poles and their closest neighbours
      const float tilt = (i & 2) != 0 ? 1e-7F : 0.0F;
      z = glm::vec3((i & 4) != 0 ? -tilt : tilt, tilt, (i & 1) != 0 ? -1.0F : 1.0F);
    }
    const Basis b = basis_around(z);
    const glm::dvec3 x(b.x), y(b.y), zz(b.z);
    worst = std::max({worst, std::fabs(glm::dot(x, y)), std::fabs(glm::dot(x, zz)),
                      std::fabs(glm::dot(y, zz)), std::fabs(glm::length(x) - 1),
                      std::fabs(glm::length(y) - 1), glm::length(glm::cross(x, y) - zz)});
    const glm::vec3 local(0.6F, 0.0F, 0.8F);
    worst =
        std::max(worst, static_cast<double>(glm::length(b.to_local(b.to_world(local)) - local)));
  }
  CAPTURE(worst);
  CHECK(worst < 1e-6);
}

TEST_CASE("every sampler is finite and unit at the ends of its range", "[optics][sampling]") {
  for (const float u : {0.0F, 0x1p-24F, 0.5F, last_unit}) {
    for (const float v : {0.0F, 0x1p-24F, 0.125F, 0.5F, last_unit}) {
      CAPTURE(u, v);
      CHECK(length_error(uniform_sphere(u, v)) < 3e-7);
      CHECK(length_error(cosine_hemisphere(u, v)) < 3e-7);
      CHECK(length_error(cosine_power(0.0F, u, v)) < 3e-7);
      CHECK(length_error(cosine_power(1e8F, u, v)) < 3e-7);
      CHECK(length_error(SpotLobe::from_half_angles(0.1, 0.2).sample(u, v)) < 3e-7);
      CHECK(length_error(SpotLobe::from_half_angles(0.0, std::numbers::pi).sample(u, v)) < 3e-7);
      CHECK(glm::length(uniform_disc(u, v)) <= 1.0F);
    }
  }
}

TEST_CASE("a direction rotated a million times stays unit", "[optics][sampling]") {
  Uniform next(19);
  glm::vec3 d(0, 0, 1);
  double worst = 0;
  for (int i = 0; i < 1000000; ++i) {
    const float u = next();
    const float v = next();
    d = to_world(d, uniform_sphere(u, v));
    worst = std::max(worst, length_error(d));
  }
  CAPTURE(worst);
  CHECK(worst < 3e-7);
}

TEST_CASE("elementary functions in double equal those in float within float's stated errors",
          "[optics][sampling]") {
  double worst = 0;
  for (int i = 0; i < (1 << 16); ++i) {
    const float x = (static_cast<float>(i) + 0.5F) * 0x1p-16F;
    const double exact = static_cast<double>(x);
    const auto single = sin_cos_two_pi(x);
    const auto twice = sin_cos_two_pi(exact);
    worst =
        std::max({worst, std::fabs(static_cast<double>(single.sin) - twice.sin),
                  std::fabs(static_cast<double>(single.cos) - twice.cos),
                  std::fabs(static_cast<double>(log2_of(x)) / log2_of(exact) - 1),
                  std::fabs(static_cast<double>(exp2_of(-x)) / exp2_of(-exact) - 1),
                  std::fabs(static_cast<double>(exp2_minus_one(-x)) / exp2_minus_one(-exact) - 1)});
  }
  CHECK(worst < 5e-7);
  CHECK(log2_of(0.0) == -1000.0);
  CHECK(exp2_of(-127.0) == 0.0);
  CHECK(exp2_minus_one(-127.0) == -1.0);
  CHECK(choose(true, 1.0, 2.0) == 1.0);
}
