#include "scenes/light/optics/phase_function.hpp"

#include <catch2/catch.hpp>
#include <functional>
#include <limits>
#include <numbers>

#include "tests/unit/scenes/light/optics/sampler_checks.hpp"

using namespace luxodus;
using namespace luxodus::checks;

namespace {

constexpr int phase_draws = 200000;
constexpr float phase_last_unit = 1.0F - 0x1p-24F;
const SourcePlace place{"scene.toml", 12};

PhaseFunction henyey_greenstein(double g) {
  return PhaseFunction::make({PhaseKind::henyey_greenstein, g, {}, {}}, place).value();
}
PhaseFunction rayleigh() {
  return PhaseFunction::make({PhaseKind::rayleigh, 0, {}, {}}, place).value();
}
PhaseFunction tabulated(std::vector<double> cosines, std::vector<double> values) {
  return PhaseFunction::make({PhaseKind::tabulated, 0, std::move(cosines), std::move(values)},
                             place)
      .value();
}
std::string fault_of(const Phase& phase) {
  const Result<PhaseFunction> made = PhaseFunction::make(phase, place);
  return made.ok() ? "none" : made.problem().text();
}

/// 1 - cos and 1 + cos of Henyey-Greenstein in double, by formulas without cancellation, for g >=
/// 0.
struct Parts {
  double minus, plus;
};
Parts exact_henyey_greenstein(double g, double u) {
  const double s = 2 * u - 1;
  const double d = 2 * (1 + g * s) * (1 + g * s);
  return {(1 - g) * (1 - g) * (1 - s) * (2 + g * (1 + s)) / d,
          (1 + g) * (1 + g) * (1 + s) * (2 - g * (1 - s)) / d};
}

/// Integral over the sphere, substituting 1 - cos = 2 s^3, which resolves a forward peak.
double over_sphere(const PhaseFunction& phase) {
  constexpr int cells = 400000;
  double sum = 0;
  for (int i = 0; i < cells; ++i) {
    const double s = (i + 0.5) / cells;
    const float cos_theta = static_cast<float>(1 - 2 * s * s * s);
    sum +=
        2 * std::numbers::pi * static_cast<double>(evaluate(phase, cos_theta)) * 6 * s * s / cells;
  }
  return sum;
}

/// Deviations of the sampled cosines from a distribution function, and of the azimuths from a
/// uniform one.
struct Fit {
  double cosine, azimuth;
};
Fit fit(const PhaseFunction& phase, uint32_t seed, const std::function<double(double)>& below) {
  Uniform next(seed);
  Histogram share(64), turn(32);
  for (int i = 0; i < phase_draws; ++i) {
    const float u = next();
    const float v = next();
    const glm::vec3 d = sample(phase, {0, 0, 1}, u, v);
    share.add(below(static_cast<double>(d.z)));
    turn.add(turn_share(d.x, d.y));
  }
  return {share.deviations(), turn.deviations()};
}

}  // namespace

TEST_CASE("Henyey-Greenstein has mean cosine g and cosines from -1 to 1 for every g up to 0.999",
          "[optics][phase]") {
  for (const double g :
       {0.0, 1e-7, -1e-7, 1e-3, -1e-3, 0.3, 0.5, 0.9, -0.9, 0.99, -0.99, 0.999, -0.999}) {
    const uint32_t seed = seed_or(21);
    CAPTURE(seed, g);
    const PhaseFunction phase = henyey_greenstein(g);
    CHECK(static_cast<double>(phase.mean_cosine()) == Approx(g).epsilon(1e-6));
    Uniform next(seed);
    const glm::vec3 before = glm::normalize(glm::vec3(0.3F, -0.8F, 0.5F));
    Mean cosine;
    Mean component[3];
    bool in_range = true;
    double worst_length = 0;
    for (int i = 0; i < 1000000; ++i) {
      const float u = next();
      const float v = next();
      const float c = phase.deflection(u).cos;
      in_range = in_range && c >= -1.0F && c <= 1.0F;
      cosine.add(c);
      const glm::vec3 after = sample(phase, before, u, v);
      worst_length = std::max(worst_length, length_error(after));
      for (int k = 0; k < 3; ++k) component[k].add(after[k]);
    }
    CHECK(in_range);
    CHECK(worst_length < 3e-7);
    // Variance of the cosine: (1 + 2 g^2) / 3 - g^2. Rounding may add 1e-8.
    const double standard_error = std::sqrt((1 - g * g) / 3 / 1e6);
    CHECK(std::fabs(cosine.value() - g) < allowed * standard_error + 1e-8);
    for (int k = 0; k < 3; ++k) {
      const double expected = g * static_cast<double>(before[k]);
      CHECK(std::fabs(component[k].value() - expected) <
            allowed * component[k].standard_error() + 3e-8);
    }
  }
}

TEST_CASE("Henyey-Greenstein in float inverts as in double: cosine to 5e-7, sine to 1e-6 relative",
          "[optics][phase]") {
  for (const double g : {1e-7, 1e-5, 1e-3, 0.1, 0.5, 0.9, 0.99, 0.999, 0.99999}) {
    CAPTURE(g);
    const PhaseFunction forward = henyey_greenstein(g);
    const PhaseFunction backward = henyey_greenstein(-g);
    double worst_cos = 0, worst_sin = 0;
    bool mirrored = true;
    for (uint32_t i = 0; i < (1U << 24); i += i < 4096 || i > (1U << 24) - 4096 ? 1 : 997) {
      const float u = static_cast<float>(i) * 0x1p-24F;
      const Parts exact = exact_henyey_greenstein(g, static_cast<double>(u));
      const PhaseFunction::Deflection a = forward.deflection(u);
      const double sin = std::sqrt(exact.minus * exact.plus);
      worst_cos = std::max(worst_cos, std::fabs(static_cast<double>(a.cos) - (1 - exact.minus)));
      if (sin > 0) worst_sin = std::max(worst_sin, std::fabs(static_cast<double>(a.sin) / sin - 1));
      const PhaseFunction::Deflection b = backward.deflection(u);
      mirrored = mirrored && b.cos == -a.cos && b.sin == a.sin;
    }
    CAPTURE(worst_cos, worst_sin);
    CHECK(worst_cos < 5e-7);
    CHECK(worst_sin < 1e-6);
    CHECK(mirrored);
  }
}

TEST_CASE("Henyey-Greenstein samples follow its distribution and its density integrates to 1",
          "[optics][phase]") {
  for (const double g : {1e-3, -0.4, 0.6, 0.9, -0.95}) {
    const uint32_t seed = seed_or(22);
    CAPTURE(seed, g);
    const PhaseFunction phase = henyey_greenstein(g);
    const Fit off = fit(phase, seed, [g](double c) {
      return (1 - g * g) / (2 * g) * (1 / std::sqrt(1 + g * g - 2 * g * c) - 1 / (1 + g));
    });
    CHECK(off.cosine < allowed);
    CHECK(off.azimuth < allowed);
  }
  for (const double g : {0.0, 1e-7, -0.4, 0.6, 0.9, 0.99}) {
    CAPTURE(g);
    CHECK(over_sphere(henyey_greenstein(g)) == Approx(1.0).epsilon(1e-3));
  }
  for (const double g : {-0.999, -0.5, 1e-7, 0.3, 0.99, 0.999}) {
    for (const float c : {-1.0F, -0.75F, 0.0F, 0.5F, 0.9375F, 1.0F}) {
      CAPTURE(g, c);
      const double square = 1 + g * g - 2 * g * static_cast<double>(c);
      const double exact = (1 - g * g) / (4 * std::numbers::pi * std::pow(square, 1.5));
      CHECK(static_cast<double>(evaluate(henyey_greenstein(g), c)) == Approx(exact).epsilon(2e-6));
    }
  }
}

TEST_CASE("g = 1 scatters straight forward and g = -1 straight back for every random number",
          "[optics][phase]") {
  const glm::vec3 before = glm::normalize(glm::vec3(-0.2F, 0.4F, 0.7F));
  for (const float u : {0.0F, 0x1p-24F, 0.5F, phase_last_unit}) {
    CHECK(glm::length(sample(henyey_greenstein(1), before, u, 0.3F) - before) < 3e-7F);
    CHECK(glm::length(sample(henyey_greenstein(-1), before, u, 0.3F) + before) < 3e-7F);
    CHECK(glm::length(sample(henyey_greenstein(1 - 1e-12), before, u, 0.3F) - before) < 3e-7F);
  }
  for (const float c : {-1.0F, 0.0F, 1.0F}) {
    CHECK(evaluate(henyey_greenstein(1), c) == 0.0F);
    CHECK(evaluate(henyey_greenstein(-1), c) == 0.0F);
    CHECK(std::isfinite(evaluate(henyey_greenstein(1 - 2e-9), c)));
  }
}

TEST_CASE("isotropic scattering is uniform and g = 0 is the same function", "[optics][phase]") {
  const PhaseFunction phase;
  CHECK(evaluate(phase, 0.3F) == Approx(1 / (4 * std::numbers::pi)));
  CHECK(phase.mean_cosine() == 0.0F);
  CHECK(henyey_greenstein(0).kind() == PhaseKind::isotropic);
  const Fit off = fit(phase, seed_or(23), [](double c) { return 0.5 * (1 + c); });
  CHECK(off.cosine < allowed);
  CHECK(off.azimuth < allowed);
}

TEST_CASE(
    "Rayleigh scattering is normalised, sampled by exact inversion, with mean 0 and <cos^2> 2/5",
    "[optics][phase]") {
  const PhaseFunction phase = rayleigh();
  CHECK(over_sphere(phase) == Approx(1.0).epsilon(1e-5));
  CHECK(phase.mean_cosine() == 0.0F);
  const auto below = [](double c) { return (c * c * c + 3 * c + 4) / 8; };
  const uint32_t seed = seed_or(24);
  INFO("seed " << seed);
  const Fit off = fit(phase, seed, below);
  CHECK(off.cosine < allowed);
  CHECK(off.azimuth < allowed);
  double worst = 0;
  for (int i = 0; i <= 4096; ++i) {
    const float u = std::min(phase_last_unit, static_cast<float>(i) / 4096.0F);
    const double q = 4 * static_cast<double>(u) - 2;  // Cardano: c = a - 1 / a
    const double a = std::cbrt(q + std::sqrt(q * q + 1));
    worst = std::max(worst, std::fabs(static_cast<double>(phase.deflection(u).cos) - (a - 1 / a)));
  }
  CAPTURE(worst);
  CHECK(worst < 3e-7);
  Uniform next(seed);
  Mean z, zz;
  for (int i = 0; i < phase_draws; ++i) {
    const double c = phase.deflection(next()).cos;
    z.add(c);
    zz.add(c * c);
  }
  CHECK(z.distance(0) < allowed);
  CHECK(zz.distance(0.4) < allowed);
}

TEST_CASE(
    "a tabulated phase function is normalised, sampled by its density, with its own mean cosine",
    "[optics][phase]") {
  struct Table {
    std::vector<double> cosines, values;
  };
  std::vector<double> mie_cos, mie_value;  // a smoke-like peak over nine decades of 1 - cos
  for (int i = 0; i <= 200; ++i) {
    const double c = i == 200 ? 1.0 : 1 - 2 * std::pow(10.0, -i / 40.0);
    mie_cos.push_back(c);
    mie_value.push_back(std::pow(1.81 - 1.8 * c, -1.5));
  }
  const std::vector<Table> tables = {
      {{-1, 1}, {3, 3}},       {{-1, 1}, {0, 1}},
      {{-1, 1}, {1, 0}},       {{-1, -0.5, 0.2, 0.4, 1}, {0, 2, 0, 0, 7}},
      {{-1, 0, 1}, {5, 1, 5}}, {mie_cos, mie_value}};
  for (std::size_t t = 0; t < tables.size(); ++t) {
    const std::vector<double>& c = tables[t].cosines;
    const std::vector<double>& f = tables[t].values;
    const uint32_t seed = seed_or(25);
    CAPTURE(seed, t);
    const PhaseFunction phase = tabulated(c, f);
    CHECK(over_sphere(phase) == Approx(1.0).epsilon(1e-4));
    std::vector<double> below(c.size(), 0.0);
    for (std::size_t i = 1; i < c.size(); ++i) {
      below[i] = below[i - 1] + 0.5 * (f[i] + f[i - 1]) * (c[i] - c[i - 1]);
    }
    const auto distribution = [&](double x) {
      std::size_t i = 1;
      while (i + 1 < c.size() && x > c[i]) ++i;
      const double w = x - c[i - 1];
      const double slope = (f[i] - f[i - 1]) / (c[i] - c[i - 1]);
      return (below[i - 1] + f[i - 1] * w + 0.5 * slope * w * w) / below.back();
    };
    const Fit off = fit(phase, seed, distribution);
    CHECK(off.cosine < allowed);
    CHECK(off.azimuth < allowed);
    Uniform next(seed + 1);
    Mean cosine;
    bool where_none = false;
    double worst = 0;
    for (int i = 0; i < phase_draws; ++i) {
      const float u = next();
      const float x = phase.deflection(u).cos;
      cosine.add(x);
      where_none = where_none || (t == 3 && x > 0.2001F && x < 0.3999F);
      worst = std::max(worst, std::fabs(distribution(x) - static_cast<double>(u)));
    }
    CAPTURE(worst);
    CHECK(cosine.distance(phase.mean_cosine()) < allowed);
    CHECK_FALSE(where_none);
    // Table 5 rises so steeply that half an ulp of a cosine near 1 is 3e-6 of its distribution
    // function.
    CHECK(worst < (t == 5 ? 4e-6 : 1e-6));
  }
  const PhaseFunction ramp = tabulated({-1, 1}, {0, 1});
  CHECK(ramp.mean_cosine() == Approx(1.0 / 3));
  CHECK(evaluate(ramp, 1.0F) == Approx(1 / (2 * std::numbers::pi)));
  CHECK(evaluate(ramp, 0.0F) == Approx(0.5 / (2 * std::numbers::pi)));
  CHECK(evaluate(ramp, -1.0F) == 0.0F);
  for (const float u : {0.0F, phase_last_unit})
    CHECK(length_error(sample(ramp, {0, 1, 0}, u, 0)) < 3e-7);
}

TEST_CASE("an invalid phase function is refused with its place and the remedy", "[optics][phase]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto table = [](std::vector<double> c, std::vector<double> f) {
    return Phase{PhaseKind::tabulated, 0, std::move(c), std::move(f)};
  };
  CHECK_THAT(fault_of({PhaseKind::henyey_greenstein, 1.01, {}, {}}),
             Catch::StartsWith("scene.toml:12: ") && Catch::Contains("between -1 and 1"));
  CHECK_THAT(fault_of({PhaseKind::henyey_greenstein, nan, {}, {}}), Catch::Contains("-1 and 1"));
  CHECK_THAT(fault_of(table({-1, 1}, {1})), Catch::Contains("as many values as cosines"));
  CHECK_THAT(fault_of(table({}, {})), Catch::Contains("2 to 4096 entries"));
  CHECK_THAT(fault_of(table(std::vector<double>(5000, 0.0), std::vector<double>(5000, 1.0))),
             Catch::Contains("has 5000"));
  CHECK_THAT(fault_of(table({-0.9, 1}, {1, 1})), Catch::Contains("from -1 to 1"));
  CHECK_THAT(fault_of(table({-1, 0.5, 0.5, 1}, {1, 1, 1, 1})), Catch::Contains("ascend"));
  CHECK_THAT(fault_of(table({-1, nan, 1}, {1, 1, 1})), Catch::Contains("ascend"));
  CHECK_THAT(fault_of(table({-1, 0, 1}, {1, -1, 1})), Catch::Contains("entry 2 is negative"));
  CHECK_THAT(fault_of(table({-1, 0, 1}, {1, nan, 1})), Catch::Contains("not a number"));
  CHECK_THAT(fault_of(table({-1, 1}, {0, 0})), Catch::Contains("above 0"));
}

TEST_CASE("a beam scatters by the phase function, and isotropic light stays isotropic", "[phase]") {
  constexpr double even = 1 / (4 * std::numbers::pi);
  for (const PhaseFunction& phase : {PhaseFunction(), rayleigh(), henyey_greenstein(0.7),
                                     henyey_greenstein(-0.4), tabulated({-1, 0, 1}, {1, 0, 3})}) {
    for (const float cosine : {-1.0f, -0.6f, 0.0f, 0.3f, 1.0f}) {
      const float second = 1.5f * cosine * cosine - 0.5f;  // of a beam
      const auto own = static_cast<double>(evaluate(phase, cosine));
      CHECK(evaluate_spread(phase, cosine, 1) == Approx(own).margin(1e-7));
      CHECK(evaluate_spread(phase, cosine, 1, second) == Approx(own).margin(1e-7));
      CHECK(evaluate_spread(phase, cosine, 0) == Approx(even).epsilon(1e-5));
      CHECK(evaluate_spread(phase, cosine, 0, 0) == Approx(even).epsilon(1e-5));
    }
  }
}

TEST_CASE(
    "light spread by Henyey and Greenstein's law keeps such a spread when scattered by that law",
    "[phase]") {
  const PhaseFunction product = henyey_greenstein(0.6 * 0.5);
  for (const float cosine : {-1.0f, -0.2f, 0.5f, 1.0f}) {
    const auto exact = static_cast<double>(evaluate(product, cosine));
    CHECK(evaluate_spread(henyey_greenstein(0.6), cosine, 0.5f) == Approx(exact).epsilon(1e-5));
    const float second = 0.25f * (1.5f * cosine * cosine - 0.5f);
    CHECK(evaluate_spread(henyey_greenstein(0.6), cosine, 0.5f, second) ==
          Approx(exact).epsilon(1e-5));
  }
}

TEST_CASE("two crossing beams are distinguished from isotropic light by their second moment",
          "[phase]") {
  // Rayleigh's function has no moments beyond the second, and is symmetric.
  for (const float cosine : {-0.9f, 0.0f, 0.4f}) {
    const float second = 1.5f * cosine * cosine - 0.5f;
    CHECK(evaluate_spread(rayleigh(), cosine, 0, second) ==
          Approx(static_cast<double>(evaluate(rayleigh(), cosine))).epsilon(1e-5));
  }
  // A table close to 3 (1 + cos^2) / 8.
  std::vector<double> cosines, values;
  for (int i = -100; i <= 100; ++i) {
    cosines.push_back(i / 100.0);
    values.push_back(1 + cosines.back() * cosines.back());
  }
  CHECK(tabulated(cosines, values).mean_second() == Approx(0.1).epsilon(1e-3));
  CHECK(henyey_greenstein(0.6).mean_second() == Approx(0.36));
}

TEST_CASE("scattered light is never negative", "[phase]") {
  const PhaseFunction phase = henyey_greenstein(0.9);
  for (const float cosine : {-1.0f, 0.0f, 1.0f})
    for (const float mean : {0.0f, 0.5f, 1.0f})
      for (const float second : {-0.5f, 0.0f, 1.0f})
        CHECK(evaluate_spread(phase, cosine, mean, second) >= 0);
}
