// Light that is scattered, or emitted by glowing gas, into one line of sight: integrals along that
// line. Unlike a single lamp, a uniform field gives the same result for every phase function.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "actors/judge/validate/scene_kit.hpp"
#include "actors/judge/validate/veil.hpp"

namespace luxodus::light {

namespace {

constexpr double sign_x = 4;             // the eye is at the origin
constexpr double veil_extinction = 0.3;  // [1/m]
/// So little is scattered that nothing is scattered twice: the result is proportional to it, and
/// has no statistical error.
constexpr double albedo = 1e-5;

/// Simpson's rule.
double integral(double from, double to, const std::function<double(double)>& f) {
  constexpr int steps = 4000;
  const double h = (to - from) / steps;
  double sum = f(from) + f(to);
  for (int i = 1; i < steps; ++i) sum += (i % 2 == 1 ? 4 : 2) * f(from + i * h);
  return sum * h / 3;
}

}  // namespace

PreparedCase veil_plan(const VeilCase& veil) {
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  scene.run.max_bands = 1;
  scene.run.voxels = false;
  Emitter& lamp = add_point(scene, veil_lamp, 0);
  lamp.radiometric = false;
  lamp.mains_flux = veil.flux_lm;
  if (veil.web) {
    lamp.distribution = Distribution::web;
    lamp.web = veil.web;
  }
  add_eye(scene, {0, 0, 0});
  add_tiny_sign(scene, {sign_x, 0, 0}, 1);
  SmokeOptics optics = smoke(veil_extinction, albedo);
  optics.phase = veil.phase;
  add_homogeneous(scene, optics);
  double from = 0;
  if (veil.sheet) {
    // Horizontal, half-way down: it hides the lamp from everything nearer to the eye than `from`.
    constexpr double edge = 1.5, half = 0.5;
    add_quad(scene, "sheet", {-4, -4, half * veil_lamp.z}, {4 + edge, 0, 0}, {0, 8, 0},
             add_grey(scene, 0));
    from = veil_lamp.x + (edge - veil_lamp.x) / half;
  }
  const double veiled = integral(from, sign_x, [&](double x) {
    const glm::dvec3 way = glm::dvec3(x, 0, 0) - veil_lamp;
    const double d = glm::length(way);
    return veil_extinction * albedo * std::exp(-veil_extinction * (x + d)) / (d * d) *
           veil.candela(way / d) * veil.density(-way.x / d);
  });
  plan.look_rather(8);
  plan.add(
          "luminance of the path [cd/m2]", veiled,
          [](const Traced& run) { return first_view(run, EyeQuantity::path); },
          10 * albedo + veil.bias)
      .unit = veiled;
  Quantity& passed = plan.add(
      "transmission", std::exp(-veil_extinction * sign_x),
      [](const Traced& run) { return first_view(run, EyeQuantity::transmission); }, 1e-5);
  passed.certain = true;
  return plan;
}

namespace {

/// Gas that glows and absorbs without scattering, around all or part of the line.
PreparedCase glow_plan(double depth, double gas_from, double gas_to) {
  constexpr double power_w = 0.05, luminance = 20;
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  scene.run.max_bands = 1;
  scene.run.voxels = false;
  add_eye(scene, {0, 0, 0});
  add_tiny_sign(scene, {sign_x, 0, 0}, luminance);
  const double inside = std::min(gas_to, sign_x) - std::max(gas_from, 0.0);
  const double sigma = depth / inside;
  const glm::dvec3 low(gas_from, -1, -1.5), extent(gas_to - gas_from, 2, 3);
  Medium& gas = add_cells(
      scene, low, extent, 4, [&](const glm::dvec3&) { return sigma; }, 0);
  gas.data.emission = gas.data.extinction;
  gas.emission = MediumEmission{};
  gas.emission->power_w = power_w;
  const double lumens = power_w * efficacy_lm_per_w(gas.emission->spectrum);
  const double glow =
      lumens / (4 * pi * extent.x * extent.y * extent.z) * -std::expm1(-depth) / sigma;
  plan.look_rather(1);
  const auto add = [&](const std::string& name, double reference, EyeQuantity quantity) {
    Quantity& q = plan.add(
        name, reference, [quantity](const Traced& run) { return first_view(run, quantity); }, 2e-5);
    q.certain = true;  // places are in single precision
  };
  add("luminance of the path [cd/m2]", glow, EyeQuantity::path);
  add("luminance at the eye [cd/m2]", luminance * std::exp(-depth) + glow, EyeQuantity::at_eye);
  add("luminance of the sign [cd/m2]", luminance, EyeQuantity::own);
  add("transmission", std::exp(-depth), EyeQuantity::transmission);
  return plan;
}

Phase phase_of(PhaseKind kind, double g = 0) {
  Phase phase;
  phase.kind = kind;
  phase.g = g;
  return phase;
}

double henyey_greenstein(double g, double cosine) {
  return (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

}  // namespace

void add_veil_cases(Cases& cases) {
  const auto add = [&](const std::string& name, const Phase& phase,
                       const std::function<double(double)>& density, bool sheet = false) {
    VeilCase veil;
    veil.phase = phase;
    veil.density = density;
    veil.sheet = sheet;
    veil.flux_lm = 1000;
    veil.candela = [](const glm::dvec3&) { return 1000 / (4 * pi); };
    cases.push_back({"veil", "veil of a lamp, " + name, "integral along the line of sight",
                     [veil] { return veil_plan(veil); }});
  };
  const auto even = [](double) { return 1 / (4 * pi); };
  add("even scattering", phase_of(PhaseKind::isotropic), even);
  add("even scattering, half of it behind a sheet", phase_of(PhaseKind::isotropic), even, true);
  for (const double g : {-0.4, 0.7})
    add(fmt::format("g {}", g), phase_of(PhaseKind::henyey_greenstein, g),
        [g](double cosine) { return henyey_greenstein(g, cosine); });
  add("Rayleigh", phase_of(PhaseKind::rayleigh),
      [](double cosine) { return 3 / (16 * pi) * (1 + cosine * cosine); });
  Phase table = phase_of(PhaseKind::tabulated);
  table.table_cos = {-1, 0, 1};
  table.table_value = {1, 0.5, 2};
  add("phase function of a table", table, [](double cosine) {
    return (cosine < 0 ? 0.5 - 0.5 * cosine : 0.5 + 1.5 * cosine) / (4 * pi);
  });
  for (const double depth : {0.2, 1.0, 5.0})
    cases.push_back({"veil", fmt::format("sign seen through glowing gas, depth {}", depth),
                     "B exp(-tau) + J (1 - exp(-tau))", [=] { return glow_plan(depth, 1, 3); }});
  cases.push_back({"veil", "sign seen in glowing gas, depth 1", "B exp(-tau) + J (1 - exp(-tau))",
                   [] { return glow_plan(1, -1, 5); }});
}

}  // namespace luxodus::light
