// Light that smoke beside a lamp scatters to an eye, compared with integrals along the line of
// sight.
#include <cmath>
#include <numbers>

#include "scenes/light/transport/eye_paths.hpp"
#include "tests/optics/light_kit.hpp"

namespace luxodus::light {
namespace {

constexpr double four_pi = 4 * std::numbers::pi;
/// So small that multiple scattering is below the accuracy here.
constexpr double albedo = 1e-3;
constexpr double sigma = 0.2;  // [1/m]
constexpr double sight_m = 10;

/// An eye at the origin looks along x at a dark sign through smoke that is everywhere.
SceneDescription eye_in_smoke(double g) {
  SceneDescription scene;
  scene.run.voxels = false;
  scene.run.eye_path_factor = 1000;
  add_homogeneous(scene, smoke(sigma, albedo, g));
  Sign sign;
  sign.name = "sign";
  sign.frame.origin = {sight_m, 0, 0};
  sign.frame.axes = glm::dmat3(glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1), glm::dvec3(-1, 0, 0));
  // So small that all lines to it coincide.
  sign.width_m = sign.height_m = sign.smallest_detail_m = 1e-5;
  sign.face = {1, 1, {0}, {}};
  scene.signs.push_back(sign);
  Observer observer;
  observer.name = "eye";
  scene.observers.push_back(observer);
  return scene;
}

/// The radiance of the smoke before the sign [W/(m2 sr)].
Estimate veil(SceneDescription scene) {
  const Run run(std::move(scene), {.particles = 1 << 16, .batch_particles = 256});
  const uint32_t bin = run.scene().eye_targets.at(0).first_bin;
  return Readout(run.scene(), run.local().totals())
             .value(run.scene().blocks.views, bin, static_cast<uint32_t>(EyeQuantity::path)) *
         (1 / run.scene().bands[0].lm_per_w);
}

double henyey_greenstein(double g, double cosine) {
  return (1 - g * g) / (four_pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

/// Veil of a lamp of 1 W at (at, beside), a point or a Lambertian sphere: integrated over the angle
/// at the lamp, so that the integrand is smooth however near the lamp is.
double veil_of_lamp(double at, double beside, double g, double radius = 0) {
  constexpr int steps = 20000;
  const double low = std::atan2(-at, beside), high = std::atan2(sight_m - at, beside);
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double angle = low + (high - low) * (i + 0.5) / steps;
    const double t = at + beside * std::tan(angle), d = beside / std::cos(angle);
    // From the lamp to the line, and then back to the eye.
    const double cosine = -std::sin(angle);
    // A sphere is seen larger than its disc, and its surface is, averaged over the disc, two thirds
    // of its radius before its centre.
    const double q = std::pow(radius / d, 2);
    const double sphere = q > 0 ? 2 * (1 - std::sqrt(1 - q)) / q : 1;
    sum += henyey_greenstein(g, cosine) * sphere * std::exp(-sigma * (t + d - radius * 2 / 3));
  }
  return sigma * albedo / four_pi * sum * (high - low) / steps / beside;
}

}  // namespace

TEST_CASE("the veil of a lamp beside the line of sight is exact, however near the lamp is") {
  for (const double beside : {3.0, 0.3, 0.01, 1e-4}) {
    for (const double g : {0.0, 0.7, -0.5}) {
      INFO(beside << " m beside the line, g " << g);
      SceneDescription scene = eye_in_smoke(g);
      add_point(scene, {4, beside, 0}, 1);
      const Estimate found = veil(std::move(scene));
      check_within(found, veil_of_lamp(4, beside, g), half_percent, 2e-3);
    }
  }
}

TEST_CASE("the veils of a faint near lamp and of a bright far one add up") {
  SceneDescription scene = eye_in_smoke(0.5);
  add_point(scene, {4, 0.02, 0}, 1);
  add_point(scene, {-2, 6, 0}, 1000);
  check_within(veil(std::move(scene)), veil_of_lamp(4, 0.02, 0.5) + 1000 * veil_of_lamp(-2, 6, 0.5),
               half_percent, 2e-3);
}

TEST_CASE("the veil of a globe depends on its size") {
  for (const double beside : {0.15, 0.5, 3.0}) {
    INFO(beside << " m beside the line");
    SceneDescription scene = eye_in_smoke(0);
    add_emitter(scene, EmitterShape::sphere, {4, beside, 0}, {0, 0, 1}, 1).size = glm::dvec3(0.2);
    check_within(veil(std::move(scene)), veil_of_lamp(4, beside, 0, 0.1), half_percent, 3e-3);
  }
}

TEST_CASE("the veil of a large lamp is exact where the line of sight passes close under it") {
  // A square Lambertian lamp of 2 m, 1 W, that shines down on the line from `above` it.
  for (const double above : {0.02, 0.3, 2.0}) {
    INFO(above << " m above the line");
    SceneDescription scene = eye_in_smoke(0);
    add_emitter(scene, EmitterShape::rectangle, {4, 0, above}, {0, 0, -1}, 1).size =
        glm::dvec3(2, 2, 0);
    // Rows of the lamp by the angle at the line, places on the line by the angle at a point of the
    // lamp, so that the integrand is smooth however near the lamp is.
    constexpr int columns = 40, rows = 400, places = 200;
    const double row_span = 2 * std::atan(1 / above);
    double sum = 0;
    for (int i = 0; i < columns; ++i) {
      for (int j = 0; j < rows; ++j) {
        const double x = 4 - 1 + 2 * (i + 0.5) / columns;
        const double y = above * std::tan(row_span * ((j + 0.5) / rows - 0.5));
        const double beside = std::hypot(y, above);
        const double row_m = beside * beside / above * row_span / rows;
        const double low = std::atan2(-x, beside), high = std::atan2(sight_m - x, beside);
        for (int k = 0; k < places; ++k) {
          const double angle = low + (high - low) * (k + 0.5) / places;
          const double t = x + beside * std::tan(angle), d = beside / std::cos(angle);
          // cos / pi at the lamp; dt / d^2 is an angle over the distance beside.
          sum += row_m * above / d / std::numbers::pi * std::exp(-sigma * (t + d)) * (high - low) /
                 beside;
        }
      }
    }
    // The lamp's power is spread over 4 m2; a column is 2 m / columns wide.
    const double expected = sigma * albedo / four_pi * sum / (2 * columns * places);
    check_within(veil(std::move(scene)), expected, half_percent, 3e-3);
  }
}

TEST_CASE("the veil of a flame depends on its size, close to it and far from it") {
  constexpr double radius = 0.1;
  for (const double beside : {0.12, 0.5, 3.0}) {
    INFO(beside << " m beside the line");
    SceneDescription scene = eye_in_smoke(0);
    add_ball(scene, {4, beside, 0}, radius, smoke(0, 0)).emission.emplace().power_w = 1;
    // Points of the ball in equal volumes, each with its own lines to the places.
    constexpr int n = 24, steps = 400;
    double sum = 0;
    int inside = 0;
    for (int i = 0; i < n * n * n; ++i) {
      const glm::dvec3 p =
          radius * (2.0 * (glm::dvec3(i % n, i / n % n, i / (n * n)) + 0.5) / double(n) - 1.0);
      if (glm::length(p) > radius) continue;
      ++inside;
      const double x = 4 + p.x, apart = std::hypot(beside + p.y, p.z);
      const double low = std::atan2(-x, apart), high = std::atan2(sight_m - x, apart);
      for (int k = 0; k < steps; ++k) {
        const double angle = low + (high - low) * (k + 0.5) / steps;
        const double t = x + apart * std::tan(angle), d = apart / std::cos(angle);
        sum += std::exp(-sigma * (t + d)) * (high - low) / apart;
      }
    }
    const double expected = sigma * albedo / (four_pi * four_pi) * sum / (inside * steps);
    check_within(veil(std::move(scene)), expected, half_percent, 3e-3);
  }
}

}  // namespace luxodus::light
