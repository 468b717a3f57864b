#include "scenes/light/optics/surface.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <numbers>

#include "tests/unit/scenes/light/optics/sampler_checks.hpp"

using namespace luxodus;
using namespace luxodus::checks;

namespace {

constexpr float surface_last_unit = 1.0F - 0x1p-24F;
const glm::vec3 up(0, 0, 1);

SurfaceModel lambertian(double rho) {
  return make_surface(SurfaceKind::lambertian, rho, 0, 0.3, 1, 1);
}
SurfaceModel glossy(double rho, double specular, double alpha) {
  return make_surface(SurfaceKind::glossy, rho, specular, alpha, 1, 1);
}
SurfaceModel mirror(double specular) {
  return make_surface(SurfaceKind::mirror, 0, specular, 0.3, 1, 1);
}
SurfaceModel pane(double ior, double internal) {
  return make_surface(SurfaceKind::glass_pane, 0, 0, 0.3, ior, internal);
}
SurfaceModel dielectric(double ior) {
  return make_surface(SurfaceKind::dielectric, 0, 0, 0.3, ior, 1);
}
SurfaceModel open_surface() {
  return make_surface(SurfaceKind::open, 0, 0, 0.3, 1, 1);
}

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}
glm::vec3 towards(double theta, double phi = 0) {
  return glm::vec3(glm::dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                              std::cos(theta)));
}

struct Power {
  double reflected, transmitted;
};
/// The pane in double, directly from the sums over its internal reflections.
Power exact_pane(double n, double internal, double theta) {
  const double c = std::cos(theta), b = std::sqrt(1 - std::pow(std::sin(theta) / n, 2));
  const double t = std::pow(internal, 1 / b);
  Power sum{0, 0};
  for (const double amplitude : {(c - n * b) / (c + n * b), (n * c - b) / (n * c + b)}) {
    const double r = amplitude * amplitude;
    const double many = 1 / (1 - r * r * t * t);
    sum.transmitted += 0.5 * (1 - r) * (1 - r) * t * many;
    sum.reflected += 0.5 * (r + (1 - r) * (1 - r) * r * t * t * many);
  }
  return sum;
}

/// GGX seen from cos_o: density of microfacet normals, and masking of wo alone, in double.
double ggx_density(double cos_m, double alpha) {
  const double spread = cos_m * cos_m * (alpha * alpha - 1) + 1;
  return alpha * alpha / (std::numbers::pi * spread * spread);
}
double smith_masking(double cos_o, double alpha) {
  const double tan_square = 1 / (cos_o * cos_o) - 1;
  return 2 / (1 + std::sqrt(1 + alpha * alpha * tan_square));
}

constexpr int height_bins = 8;
constexpr int turn_bins = 8;
std::size_t bin_of(const glm::dvec3& d) {
  const double height = std::clamp(d.z * d.z, 0.0, 0.999999);
  const double turn = std::min(0.999999, turn_share(d.x, d.y));
  return static_cast<std::size_t>(height * height_bins) * turn_bins +
         static_cast<std::size_t>(turn * turn_bins);
}
/// Integrals of f, given per solid angle, over the bins (equal steps of cos^2 and azimuth):
/// midpoint rule in cosine and azimuth with `fine` points of each per bin.
template <class F>
std::vector<double> integrals(int fine, F f) {
  std::vector<double> out(height_bins * turn_bins, 0.0);
  const double turn_step = 2 * std::numbers::pi / (turn_bins * fine);
  for (int i = 0; i < height_bins * fine; ++i) {
    const double low = std::sqrt(static_cast<double>(i / fine) / height_bins);
    const double high = std::sqrt(static_cast<double>(i / fine + 1) / height_bins);
    const double c = low + (i % fine + 0.5) * (high - low) / fine;
    const double s = std::sqrt(1 - c * c);
    for (int j = 0; j < turn_bins * fine; ++j) {
      const double phi = turn_step * (j + 0.5);
      const glm::dvec3 d(s * std::cos(phi), s * std::sin(phi), c);
      out[bin_of(d)] += f(d) * turn_step * (high - low) / fine;
    }
  }
  return out;
}

/// Share of unpolarised power that a smooth boundary reflects. `ior` = n behind / n in front.
Real fresnel_reflectance(Real cos_theta, Real ior) {
  const FresnelTerms terms = fresnel(cos_theta, ior);
  return 0.5_r * (terms.s.r + terms.p.r);
}

/// Reflected share of light that arrives at this angle from the front.
double directional_reflectance(const SurfaceModel& model, Real cos_theta) {
  switch (model.kind) {
    case SurfaceKind::lambertian:
      return model.reflectance;
    case SurfaceKind::mirror:
      return model.specular;
    case SurfaceKind::glass_pane:
      return pane_shares(model, cos_theta).reflected;
    case SurfaceKind::dielectric:
      return fresnel_reflectance(cos_theta, model.ior);
    case SurfaceKind::open:
      return 0.0;
    case SurfaceKind::glossy:
      break;
  }
  if (model.specular <= 0.0_r) return model.reflectance;
  constexpr int cells = 32;
  SurfaceModel lobe = model;
  lobe.reflectance = 0.0_r;
  const Vec3 normal(0.0_r, 0.0_r, 1.0_r);
  const Vec3 incoming(safe_sqrt(1.0_r - cos_theta * cos_theta), 0.0_r, -cos_theta);
  double sum = 0;
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      const Real u = (static_cast<Real>(i) + 0.5_r) / static_cast<Real>(cells);
      const Real v = (static_cast<Real>(j) + 0.5_r) / static_cast<Real>(cells);
      sum += static_cast<double>(sample_surface(lobe, incoming, normal, true, 0.0_r, u, v).weight);
    }
  }
  return static_cast<double>(model.reflectance) + sum / (cells * cells);
}

/// Reflectance for diffuse incident light from the front, by the tracer's sampler on a fixed grid:
/// accurate to 1e-3.
double mean_hemispherical_reflectance(const SurfaceModel& model) {
  if (model.kind == SurfaceKind::lambertian) return model.reflectance;
  // Midpoints in cos^2 theta have equal shares of the cosine-weighted hemisphere; Fresnel's steep
  // end needs many of them.
  const int rings = model.kind == SurfaceKind::glossy ? 64 : 4096;
  double sum = 0;
  for (int i = 0; i < rings; ++i) {
    const double square = (i + 0.5) / rings;
    sum += directional_reflectance(model, static_cast<Real>(std::sqrt(square)));
  }
  return sum / rings;
}

}  // namespace

TEST_CASE("a Lambertian surface sends its reflectance out in proportion to the cosine",
          "[optics][surface]") {
  const uint32_t seed = seed_or(41);
  INFO("seed " << seed);
  Uniform next(seed);
  const glm::vec3 normal = glm::normalize(glm::vec3(0.3F, 0.4F, -0.9F));
  const SurfaceModel model = lambertian(0.7);
  Histogram squared(32), turn(32);
  bool as_said = true;
  const Basis basis = basis_around(normal);
  for (int i = 0; i < 200000; ++i) {
    const float lobe = next();
    const float u = next();
    const float v = next();
    const SurfaceSample out = sample_surface(model, -normal, normal, true, lobe, u, v);
    as_said = as_said && out.weight == 0.7F && !out.transmitted && !out.specular;
    const glm::dvec3 local(basis.to_local(out.direction));
    squared.add(local.z * local.z);
    turn.add(turn_share(local.x, local.y));
  }
  CHECK(as_said);
  CHECK(squared.deviations() < allowed);
  CHECK(turn.deviations() < allowed);
  CHECK(evaluate_surface(model, normal, normal, normal) == Approx(0.7 / std::numbers::pi));
}

TEST_CASE("microfacet normals are sampled by their visibility, G1 max of 0 and wo.m times D / cos",
          "[optics][surface]") {
  for (const double alpha : {0.3, 1.0}) {
    for (const double degrees : {0.0, 40.0, 80.0}) {
      const uint32_t seed = seed_or(42);
      CAPTURE(seed, alpha, degrees);
      Uniform next(seed);
      const glm::dvec3 wo(towards(radians(degrees), 0.7));
      std::vector<double> counts(height_bins * turn_bins, 0.0);
      for (int i = 0; i < 200000; ++i) {
        const float u = next();
        const float v = next();
        ++counts[bin_of(
            glm::dvec3(sample_ggx_visible_normal(glm::vec3(wo), static_cast<float>(alpha), u, v)))];
      }
      const std::vector<double> shares = integrals(64, [&](const glm::dvec3& m) {
        return smith_masking(wo.z, alpha) * std::max(0.0, glm::dot(wo, m)) *
               ggx_density(m.z, alpha) / wo.z;
      });
      double total = 0;
      for (const double share : shares) total += share;
      CHECK(total == Approx(1.0).epsilon(2e-3));
      CHECK(chi_square_deviations(counts, shares) < allowed);
    }
  }
}

TEST_CASE(
    "the weighted samples of a glossy surface add up to its BRDF times the cosine, everywhere",
    "[optics][surface]") {
  constexpr int draws = 200000;
  for (const double alpha : {0.15, 0.3, 0.6, 1.0}) {
    for (const double degrees : {2.0, 45.0, 80.0}) {
      const uint32_t seed = seed_or(43);
      CAPTURE(seed, alpha, degrees);
      Uniform next(seed);
      const SurfaceModel model = glossy(0.3, 0.5, alpha);
      const glm::vec3 wo = towards(radians(degrees), 0.2);
      std::vector<double> sum(height_bins * turn_bins, 0.0), squares(sum);
      double most = 0;
      for (int i = 0; i < draws; ++i) {
        const float lobe = next();
        const float u = next();
        const float v = next();
        const SurfaceSample out = sample_surface(model, -wo, up, true, lobe, u, v);
        const double weight = out.weight;
        most = std::max(most, weight);
        sum[bin_of(glm::dvec3(out.direction))] += weight;
        squares[bin_of(glm::dvec3(out.direction))] += weight * weight;
      }
      const std::vector<double> expected = integrals(64, [&](const glm::dvec3& wi) {
        return static_cast<double>(evaluate_surface(model, wo, glm::vec3(wi), up)) * wi.z;
      });
      CHECK(most <= 0.8 + 1e-6);
      double chi = 0;
      for (std::size_t b = 0; b < sum.size(); ++b) {
        const double mean = sum[b] / draws;
        const double variance = (squares[b] / draws - mean * mean) / draws;
        chi += (mean - expected[b]) * (mean - expected[b]) / variance;
      }
      const double degrees_of_freedom = static_cast<double>(sum.size());
      CHECK((chi - degrees_of_freedom) / std::sqrt(2 * degrees_of_freedom) < allowed);
    }
  }
}

TEST_CASE("every surface that evaluates is reciprocal to the last bit, and 0 below its horizon",
          "[optics][surface]") {
  const uint32_t seed = seed_or(44);
  INFO("seed " << seed);
  Uniform next(seed);
  for (const SurfaceModel& model : {lambertian(0.9), glossy(0.3, 0.6, 0.05), glossy(0, 1, 0.3),
                                    glossy(0.5, 0.5, 1.0), glossy(0, 1, 0.0)}) {
    bool same = true, finite = true;
    for (int i = 0; i < 20000; ++i) {
      const float u = next();
      const float v = next();
      const float s = next();
      const float t = next();
      const float a = next();
      const float b = next();
      const glm::vec3 normal = uniform_sphere(a, b);
      const glm::vec3 wo = to_world(normal, direction_from_one_minus_cos(u, v));
      const glm::vec3 wi = to_world(normal, direction_from_one_minus_cos(s, t));
      const float forth = evaluate_surface(model, wo, wi, normal);
      same = same && forth == evaluate_surface(model, wi, wo, normal);
      finite = finite && std::isfinite(forth) && forth >= 0.0F;
    }
    CHECK(same);
    CHECK(finite);
    CHECK(evaluate_surface(model, towards(0.3), towards(2.0), up) == 0.0F);
    CHECK(evaluate_surface(model, towards(2.0), towards(0.3), up) == 0.0F);
  }
  for (const SurfaceModel& model : {mirror(1), pane(1.52, 0.9), dielectric(1.5), open_surface()}) {
    CHECK(evaluate_surface(model, towards(0.3), towards(0.3, std::numbers::pi), up) == 0.0F);
  }
}

TEST_CASE("a boundary reflects equally from both sides of a path, so Fresnel is reciprocal",
          "[optics][surface]") {
  for (const double n : {1.33, 1.52, 2.4}) {
    for (double degrees = 0; degrees < 90; degrees += 4.5) {
      const double outside = std::cos(radians(degrees));
      const double inside = std::sqrt(1 - std::pow(std::sin(radians(degrees)) / n, 2));
      CAPTURE(n, degrees);
      CHECK(fresnel_reflectance(static_cast<float>(outside), static_cast<float>(n)) ==
            Approx(fresnel_reflectance(static_cast<float>(inside), static_cast<float>(1 / n)))
                .epsilon(2e-5));
    }
  }
}

TEST_CASE("no surface returns more light than arrives, at any angle and roughness",
          "[optics][surface]") {
  for (const double alpha : {1e-3, 0.03, 0.1, 0.3, 0.5, 0.8, 1.0}) {
    for (const double degrees : {0.0, 20.0, 45.0, 60.0, 75.0, 85.0, 89.0, 89.99}) {
      const uint32_t seed = seed_or(45);
      CAPTURE(seed, alpha, degrees);
      Uniform next(seed);
      const glm::vec3 wo = towards(radians(degrees));
      const SurfaceModel model = glossy(0, 1, alpha);
      Mean weight;
      float most = 0;
      for (int i = 0; i < 20000; ++i) {
        const float u = next();
        const float v = next();
        const SurfaceSample out = sample_surface(model, -wo, up, true, 0.5F, u, v);
        most = std::max(most, out.weight);
        weight.add(out.weight);
      }
      CHECK(most <= 1.0F);
      CHECK(weight.value() > 0.3);
      // At alpha = 1 and normal incidence half of the facets reflect downwards, and the cosines of
      // the rest are uniform with masking 2 c / (1 + c): 1 - ln 2.
      if (alpha == 1.0 && degrees == 0.0) CHECK(weight.distance(1 - std::numbers::ln2) < allowed);
      if (alpha < 0.1 || degrees > 76) continue;  // a lobe too narrow for the grid below
      double albedo = 0;
      for (const double part : integrals(48, [&](const glm::dvec3& wi) {
             return static_cast<double>(evaluate_surface(model, wo, glm::vec3(wi), up)) * wi.z;
           })) {
        albedo += part;
      }
      CHECK(albedo <= 1.0 + 1e-4);
      CHECK(std::fabs(albedo - weight.value()) < allowed * weight.standard_error() + 1e-3);
    }
  }
  const SurfaceModel over = glossy(0.9, 0.3, 0.2);  // scaled to a sum of 1
  CHECK(over.reflectance + over.specular <= 1.0F);
  CHECK(over.reflectance == Approx(0.75));
}

TEST_CASE("sampled directions of a surface have the density that it states", "[optics][surface]") {
  const uint32_t seed = seed_or(43);
  INFO("seed " << seed);
  Uniform next(seed);
  for (const SurfaceModel& model : {lambertian(0.7), glossy(0.3, 0.5, 0.4), glossy(0, 1, 0.7)}) {
    for (const double degrees : {0.0, 40.0, 75.0}) {
      INFO("specular " << model.specular << ", " << degrees << " degrees");
      const glm::vec3 wo = towards(radians(degrees));
      constexpr int draws = 200000;
      std::vector<double> found(height_bins * turn_bins, 0.0);
      for (int i = 0; i < draws; ++i) {
        const float lobe = next();
        const float u = next();
        const float v = next();
        const SurfaceSample out = sample_surface(model, -wo, up, true, lobe, u, v);
        if (out.weight > 0) found[bin_of(glm::dvec3(out.direction))] += 1.0 / draws;
      }
      const std::vector<double> said = integrals(48, [&](const glm::dvec3& wi) {
        return static_cast<double>(surface_pdf(model, wo, glm::vec3(wi), up));
      });
      for (std::size_t bin = 0; bin < said.size(); ++bin) {
        INFO("bin " << bin);
        const double chance = std::sqrt(said[bin] / draws);
        CHECK(std::fabs(found[bin] - said[bin]) < 5 * chance + 2e-3 * said[bin]);
      }
    }
  }
  CHECK(surface_pdf(mirror(1), up, up, up) == 0.0F);
  CHECK(surface_pdf(lambertian(1), up, -up, up) == 0.0F);
}

TEST_CASE("at every angle and random number a sample is a unit direction with a weight in 0 to 1",
          "[optics][surface]") {
  const glm::vec3 normals[] = {up, -up, glm::normalize(glm::vec3(1, 2, 3)), glm::vec3(1, 0, 0)};
  for (const SurfaceModel& model :
       {lambertian(1), glossy(0.4, 0.6, 0.001), glossy(0.5, 0.5, 1), glossy(0, 0, 0.3), mirror(1),
        pane(1.52, 1), pane(1.52, 0), pane(1.0, 0.5), dielectric(1.5), dielectric(1.0),
        open_surface()}) {
    for (const glm::vec3& normal : normals) {
      for (const double degrees : {0.0, 1e-4, 30.0, 60.0, 89.0, 89.9999, 90.0}) {
        const glm::vec3 incoming = -to_world(normal, towards(radians(degrees), 1.1));
        for (const float a : {0.0F, 0.5F, surface_last_unit}) {
          for (const float u : {0.0F, 0x1p-24F, 0.5F, surface_last_unit}) {
            for (const float v : {0.0F, 0.3F, surface_last_unit}) {
              for (const bool front : {true, false}) {
                const SurfaceSample out = sample_surface(model, incoming, normal, front, a, u, v);
                const float side =
                    glm::dot(out.direction, normal) * (out.transmitted ? -1.0F : 1.0F);
                if (out.weight >= 0.0F && out.weight <= 1.0F && side > -1e-6F &&
                    length_error(out.direction) < 5e-7) {
                  continue;
                }
                CAPTURE(static_cast<int>(model.kind), degrees, a, u, v, front, out.weight, side,
                        out.direction.x, out.direction.y, out.direction.z);
                FAIL("not a surface sample");
              }
            }
          }
        }
      }
    }
  }
}

TEST_CASE("a mirror reflects into the mirrored direction with its reflectivity",
          "[optics][surface]") {
  const glm::vec3 incoming = glm::normalize(glm::vec3(1, 0, -1));
  const SurfaceSample out = sample_surface(mirror(0.9), incoming, up, true, 0.2F, 0.3F, 0.4F);
  CHECK(glm::length(out.direction - glm::normalize(glm::vec3(1, 0, 1))) < 3e-7F);
  CHECK(out.weight == 0.9F);
  CHECK(out.specular);
  CHECK_FALSE(out.transmitted);
}

TEST_CASE("a clear pane of n = 1.52 transmits the closed form averaged over polarisations",
          "[optics][surface]") {
  const double expected[][2] = {{0, .918318},  {30, .915957}, {45, .902528},
                                {60, .843471}, {70, .724713}, {80, .456043}};
  const SurfaceModel glass = pane(1.52, 1);
  for (const auto& row : expected) {
    CAPTURE(row[0]);
    const float c = static_cast<float>(std::cos(radians(row[0])));
    CHECK(std::fabs(static_cast<double>(pane_transmittance(glass, c)) - row[1]) < 2e-6);
    CHECK(pane_transmittance(glass, -c) == pane_transmittance(glass, c));
    const PaneShares shares = pane_shares(glass, c);
    CHECK(shares.reflected + shares.transmitted == Approx(1.0).margin(5e-7));
  }
}

TEST_CASE("an absorbing pane equals the sum of its internal reflections along the refracted path",
          "[optics][surface]") {
  double worst = 0;
  for (const double n : {1.1, 1.52, 2.0}) {
    for (const double internal : {1.0, 0.999, 0.8, 0.3, 1e-3, 0.0}) {
      for (double degrees = 0; degrees < 89.95; degrees += 0.9) {
        const Power exact = exact_pane(n, internal, radians(degrees));
        const PaneShares got =
            pane_shares(pane(n, internal), static_cast<float>(std::cos(radians(degrees))));
        worst =
            std::max({worst, std::fabs(static_cast<double>(got.transmitted) - exact.transmitted),
                      std::fabs(static_cast<double>(got.reflected) - exact.reflected)});
      }
    }
  }
  CAPTURE(worst);
  CHECK(worst < 3e-6);
  CHECK(pane_transmittance(pane(1.52, 1), 0.0F) < 1e-4F);
  CHECK(pane_transmittance(pane(1.0, 0.5), 1.0F) == Approx(0.5));
}

TEST_CASE("a pane divides light between transmission and reflection by its shares",
          "[optics][surface]") {
  const uint32_t seed = seed_or(46);
  INFO("seed " << seed);
  Uniform next(seed);
  const SurfaceModel glass = pane(1.52, 0.8);
  const glm::vec3 incoming = -towards(radians(65), 0.4);
  const Power exact = exact_pane(1.52, 0.8, radians(65));
  Mean straight, back;
  bool as_said = true;
  for (int i = 0; i < 200000; ++i) {
    const SurfaceSample out = sample_surface(glass, incoming, up, i % 2 == 0, next(), 0, 0);
    straight.add(out.transmitted ? static_cast<double>(out.weight) : 0.0);
    back.add(out.transmitted ? 0.0 : static_cast<double>(out.weight));
    as_said = as_said && out.specular &&
              (out.transmitted ? out.direction == incoming : out.direction.z > 0);
  }
  CHECK(as_said);
  CHECK(straight.distance(exact.transmitted) < allowed);
  CHECK(back.distance(exact.reflected) < allowed);
}

TEST_CASE(
    "a dielectric refracts by Snell, reflects by Fresnel and totally beyond the critical angle",
    "[optics][surface]") {
  const SurfaceModel glass = dielectric(1.5);
  CHECK(fresnel_reflectance(1.0F, 1.5F) == Approx(0.04));
  CHECK(fresnel_reflectance(0.0F, 1.5F) == Approx(1.0).margin(1e-4));
  for (const double degrees : {0.0, 10.0, 41.0, 60.0, 85.0}) {
    CAPTURE(degrees);
    const double sin = std::sin(radians(degrees));
    const SurfaceSample in =
        sample_surface(glass, -towards(radians(degrees)), up, true, surface_last_unit, 0, 0);
    CHECK(in.transmitted);
    CHECK(in.weight == 1.0F);
    CHECK(std::fabs(static_cast<double>(-in.direction.x) - sin / 1.5) < 3e-7);
    const SurfaceSample out =
        sample_surface(glass, -towards(radians(degrees)), up, false, surface_last_unit, 0, 0);
    if (1.5 * sin > 1) {
      CHECK_FALSE(out.transmitted);
      CHECK(out.direction.z > 0);
    } else {
      CHECK(out.transmitted);
      CHECK(std::fabs(static_cast<double>(-out.direction.x) - sin * 1.5) < 2e-6);
    }
    CHECK(out.weight == 1.0F);
  }
  const uint32_t seed = seed_or(47);
  INFO("seed " << seed);
  Uniform next(seed);
  Mean reflected;
  for (int i = 0; i < 200000; ++i) {
    const SurfaceSample out = sample_surface(glass, -towards(radians(70)), up, true, next(), 0, 0);
    reflected.add(out.transmitted ? 0.0 : 1.0);
  }
  const double c = std::cos(radians(70)),
               b = std::sqrt(1 - std::pow(std::sin(radians(70)) / 1.5, 2));
  const double rs = (c - 1.5 * b) / (c + 1.5 * b), rp = (1.5 * c - b) / (1.5 * c + b);
  CHECK(reflected.distance(0.5 * (rs * rs + rp * rp)) < allowed);
}

TEST_CASE("an open surface transmits everything unchanged", "[optics][surface]") {
  const glm::vec3 incoming = -towards(1.0, 0.3);
  const SurfaceSample out = sample_surface(open_surface(), incoming, up, true, 0.1F, 0.2F, 0.3F);
  CHECK(out.direction == incoming);
  CHECK(out.weight == 1.0F);
  CHECK(out.transmitted);
}

TEST_CASE("mean hemispherical reflectance equals the closed forms if there are any",
          "[optics][surface]") {
  CHECK(mean_hemispherical_reflectance(lambertian(0.6)) == Approx(0.6));
  CHECK(mean_hemispherical_reflectance(mirror(0.9)) == Approx(0.9));
  CHECK(mean_hemispherical_reflectance(open_surface()) == 0.0);
  CHECK(mean_hemispherical_reflectance(glossy(0.4, 0.5, 0.001)) == Approx(0.9).epsilon(1e-3));
  const double rough = mean_hemispherical_reflectance(glossy(0.4, 0.5, 1));
  CHECK(rough < 0.9);
  CHECK(rough > 0.6);
  // Walsh's closed form for Fresnel under diffuse light (1926), from the optically thinner side.
  for (const double n : {1.33, 1.5, 1.52}) {
    CAPTURE(n);
    const double s = n * n;
    const double walsh =
        0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
        s * (s - 1) * (s - 1) / std::pow(s + 1, 3) * std::log((n - 1) / (n + 1)) -
        2 * n * s * (s + 2 * n - 1) / ((s + 1) * (s * s - 1)) +
        8 * s * s * (s * s + 1) / ((s + 1) * (s * s - 1) * (s * s - 1)) * std::log(n);
    CHECK(mean_hemispherical_reflectance(dielectric(n)) == Approx(walsh).margin(2e-4));
  }
}

TEST_CASE("a surface is compiled within its limits for any input", "[optics][surface]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const SurfaceModel model = make_surface(SurfaceKind::glossy, nan, 2, nan, nan, nan);
  CHECK(model.reflectance == 0.0F);
  CHECK(model.specular == 1.0F);
  CHECK(model.alpha == static_cast<float>(surface_limits::min_alpha));
  CHECK(model.ior == static_cast<float>(surface_limits::min_ior));
  CHECK(pane_transmittance(model, 1.0F) == 0.0F);
}
