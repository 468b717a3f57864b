// Pictures of steady flames at moments: their mean over time is the picture of the mean.
#include "scenes/light/transport/flame_moment.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "scenes/light/transport/trace.hpp"
#include "tests/unit/scenes/light/transport/seen_scene.hpp"

using namespace luxodus;

namespace {

/// A flame in smoke before a wall that a lamp lights.
const std::string flame_before_a_wall = R"(
[run]
max_bands = 3
[[material]]
name = "grey"
reflectance = 0.6
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [4, 4, 3]
material = "grey"
[[emitter]]
name = "lamp"
shape = "rectangle"
size = [0.4, 0.4]
position = [1, 2, 2.98]
flux_lm = 20000
[[medium]]
name = "smoke"
kind = "homogeneous"
extinction = 0.05
albedo = 0.5
[[medium]]
name = "flame"
kind = "bounded"
body = "cone"
position = [2, 2, 0]
radius = 0.4
height = 1.5
extinction = 1.5
albedo = 0
smoke = "flaming"
emission = { power_w = 2000, temperature_k = 1400 }
)";

constexpr int moment_paths = 20'000;

struct SeenMoment {
  double emitted = 0, reflected = 0;  // summed over bands
};

}  // namespace

TEST_CASE("pictures of moments have the mean of the picture of the mean", "[transport][flames]") {
  test::SeenScene s(flame_before_a_wall);
  REQUIRE(steady_flames(*s.scene).size() == 1);
  const auto make = [&] {
    return make_picture_tracer(*s.scene, GeometryAccess::resident(s.index), 7,
                               make_emitter_sight(*s.scene));
  };
  // Low through the flame, higher up, and past it.
  for (const glm::dvec3 target :
       {glm::dvec3(4, 2, 0.2), glm::dvec3(4, 2.1, 0.8), glm::dvec3(4, 3.6, 0.8)}) {
    const glm::dvec3 eye(0.2, 2, 1);
    const Ray ray{s.at(eye.x, eye.y, eye.z),
                  glm::normalize(s.at(target.x, target.y, target.z) - s.at(eye.x, eye.y, eye.z))};
    FirstHit first;
    const auto look = [&](PictureTracer& tracer, int path) {
      tracer.start(uint64_t{static_cast<uint32_t>(path)} << 20, 1, 0);
      SeenMoment seen;
      for (const double v : tracer.radiance(ray, 1, nullptr, &first)) seen.reflected += v;
      for (const double v : first.emitted) seen.emitted += v;
      return seen;
    };
    const auto mean_of = [&](bool moments, SeenMoment& mean, SeenMoment& error) {
      const auto tracer = make();
      SeenMoment sum, squares;
      for (int k = 0; k < moment_paths; ++k) {
        if (moments) tracer->show_flames_at(0.37 * k);
        const SeenMoment one = look(*tracer, k);
        sum.emitted += one.emitted;
        sum.reflected += one.reflected;
        squares.emitted += one.emitted * one.emitted;
        squares.reflected += one.reflected * one.reflected;
      }
      const auto error_of = [](double total, double square) {
        const double m = total / moment_paths;
        return std::sqrt(std::max(0.0, square / moment_paths - m * m) / moment_paths);
      };
      mean = SeenMoment{sum.emitted / moment_paths, sum.reflected / moment_paths};
      error = SeenMoment{error_of(sum.emitted, squares.emitted),
                         error_of(sum.reflected, squares.reflected)};
    };
    SeenMoment mean, mean_error, moments, moments_error;
    mean_of(false, mean, mean_error);
    mean_of(true, moments, moments_error);
    INFO("towards " << target.x << ", " << target.y << ", " << target.z);
    CHECK(std::abs(moments.emitted - mean.emitted) <=
          4 * std::hypot(mean_error.emitted, moments_error.emitted) + 1e-9 * mean.emitted);
    CHECK(std::abs(moments.reflected - mean.reflected) <=
          4 * std::hypot(mean_error.reflected, moments_error.reflected));
    const bool through = target.y < 3;
    CHECK((mean.emitted > 0) == through);
    CHECK((moments_error.emitted > 1e-3 * mean.emitted) == through);  // moments differ
    CHECK(moments_error.emitted < 0.02 * std::max(mean.emitted, 1e-9));
    CHECK(moments_error.reflected < 0.05 * mean.reflected);
  }
}

TEST_CASE("light from behind a flame at a moment has what its light leaves", "[transport]") {
  test::SeenScene s(flame_before_a_wall);
  FlameMoment moment(*s.scene, 0.4);
  const std::vector<double> even(static_cast<size_t>(s.scene->bands.count()),
                                 1.0 / s.scene->bands.count());
  const PathBands bands = PathBands::all(even, 0);
  const Ray ray{s.at(0.2, 2, 0.3), Vec3(1, 0, 0)};
  moment.meet(ray, 3.8f, bands);
  int flame = 0;
  for (size_t m = 0; m < s.scene->description->media.size(); ++m)
    if (s.scene->description->media[m].name == "flame") flame = static_cast<int>(m);
  // The cone is 0.64 m wide at 0.3 m; nothing is behind before its far side, at 2.32 m.
  for (size_t i = 0; i < bands.count(); ++i) {
    CHECK(moment.on_light_from(2.0, i) == 1);
    const double through = std::exp(
        -optical_depth<MediaNeed::general>(s.scene->media, bands.band(i), s.at(1.5, 2, 0.3),
                                           Vec3(1, 0, 0), 1, s.resolver) +
        optical_depth<MediaNeed::general>(s.scene->media, bands.band(i), s.at(0.2, 2, 0.3),
                                          Vec3(1, 0, 0), 1, s.resolver));
    const double kept = moment.on_light_from(3, i) * through;
    CHECK(kept == Approx(1 - moment.on_emission(flame, i) * (1 - through)).epsilon(1e-4));
  }
  // A line beside it has no factor.
  moment.meet({s.at(0.2, 3.5, 0.3), Vec3(1, 0, 0)}, 3.8f, bands);
  CHECK(moment.on_light_from(3, 0) == 1);
  CHECK(moment.on_emission(flame, 0) == 1);
}
