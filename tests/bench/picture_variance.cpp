#include "tests/bench/picture_variance.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/bench/measure.hpp"

namespace luxodus::bench {

namespace {

constexpr int picture_width = 96, picture_height = 54;
/// Pixels darker than this share of the mean are weighted as if they were that bright.
constexpr double darkest_share = 0.01;

constexpr ScenarioView scenario_views[] = {
    {"office_floor", "smoke_emergency", "corridor"},
    {"office_floor", "smoke_emergency", "open plan"},
    {"office_floor", "smoke_emergency", "kitchen"},
    {"office_floor", "smoke_emergency", "stairwell"},
    {"office_floor", "clear_emergency", "corridor"},
    {"office_floor", "clear_mains", "open plan"},
    {"auditorium", "emergency in smoke", "from the back"},
};

std::shared_ptr<const CompiledScene> scene_of(const ScenarioView& of) {
  auto read = read_scene(std::string(LUX_SOURCE_DIR "/scenes/library/") + of.file + ".toml");
  if (!read.scene) throw std::runtime_error(std::string(of.file) + " cannot be read");
  SceneDescription d = *read.scene;
  d.run.eye_path_factor = 0;  // pictures trace their own paths
  std::erase_if(d.cameras, [&](const Camera& c) { return c.name != of.view; });
  if (d.cameras.empty()) throw std::runtime_error(std::string("there is no view ") + of.view);
  d.cameras[0].width = picture_width;
  d.cameras[0].height = picture_height;
  const Scenario found = find_scenario(d, of.scenario).value();
  auto scene = compile_scene(std::make_shared<const SceneDescription>(std::move(d)), found, {});
  if (!scene.ok()) throw std::runtime_error(scene.problem().text());
  return scene.value();
}

}  // namespace

std::span<const ScenarioView> compared_views() {
  return scenario_views;
}

std::unique_ptr<LocalRun> traced_run(const ScenarioView& of, int64_t particles) {
  auto run = std::make_unique<LocalRun>(scene_of(of), 1, 1);
  const std::atomic<bool> never{false};
  StopRule stop;
  stop.particles = particles;
  run->run(stop, never, [](const Progress&) {});
  return run;
}

PathVariance variance_of_paths(const LocalRun& run, const RadianceCache* flux, bool learned,
                               int paths) {
  const CompiledScene& scene = run.scene();
  const Pinhole pinhole(scene.description->cameras[0], scene.local_origin);
  constexpr size_t pixels = size_t{picture_width} * picture_height;
  std::vector<double> sums(pixels), squares(pixels);
  PathVariance out;
  run.rows().run(1, [&](const GeometryAccess& access) -> ParallelFor::Worker {
    const double before = process_seconds();
    const auto sight = learned ? make_emitter_sight(scene) : nullptr;
    const std::shared_ptr<PictureTracer> tracer = make_picture_tracer(scene, access, 5, sight);
    return [&, tracer, before](int64_t) {
      for (size_t p = 0; p < pixels; ++p) {
        for (int i = 0; i < paths; ++i) {
          tracer->start(uint64_t{p} << 17, static_cast<uint32_t>(paths), static_cast<uint32_t>(i));
          const auto x =
              static_cast<double>(p % picture_width) + static_cast<double>(tracer->uniform());
          const auto y =
              static_cast<double>(p / picture_width) + static_cast<double>(tracer->uniform());
          const int hero = tracer->choose_band(static_cast<double>(tracer->uniform()));
          const auto light = tracer->radiance(pinhole.ray(x, y), hero, flux, nullptr);
          double luminance = 0;
          for (int b = 0; b < scene.bands.count(); ++b)
            luminance += light[static_cast<size_t>(b)] * scene.bands[b].lm_per_w;
          sums[p] += luminance / paths;
          squares[p] += luminance * luminance / paths;
        }
      }
      out.path_s = (process_seconds() - before) / (static_cast<double>(pixels) * paths);
    };
  });
  constexpr auto count = static_cast<double>(pixels);
  double variances = 0;
  for (const double sum : sums) out.mean += sum / count;
  std::vector<double> relative;
  for (size_t p = 0; p < pixels; ++p) {
    const double variance = std::max(0.0, squares[p] - sums[p] * sums[p]) * paths / (paths - 1.0);
    variances += variance / paths;
    relative.push_back(variance / std::pow(sums[p] + darkest_share * out.mean, 2));
  }
  out.error_of_mean = std::sqrt(variances) / count;
  std::sort(relative.begin(), relative.end());
  for (size_t p = 0; p < pixels; ++p) {
    out.variance += relative[p] / count;
    if (p < pixels - pixels / 1000) out.without_brightest += relative[p] / count;
  }
  return out;
}

}  // namespace luxodus::bench
