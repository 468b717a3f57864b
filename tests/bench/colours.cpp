// Gain of paths of all bands over paths of a single band: variance of luminance and colour error on
// the same pixels, by CPU time, alternating; and the colours of filtered pictures.
#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <numeric>
#include <stdexcept>

#include "actors/results/pictures/pictures.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/tables.hpp"

namespace luxodus::bench {

namespace {

constexpr int width = 96, height = 64;
constexpr int64_t all_particles = 1 << 24;
constexpr int all_paths = 8192;     // of a reference picture
constexpr int compared_paths = 16;  // per pixel, in each way
const int filtered_paths = PictureOptions{}.paths_per_pixel;
constexpr double wanted_colour = 0.005;

/// Coloured walls and soot for scenes of one colour.
void colour(SceneDescription& d) {
  d.run.max_bands = 6;
  for (Material& m : d.materials) m.reflectance = reflectance_from_linear_srgb(0.6, 0.42, 0.2);
  Medium soot;
  soot.name = "soot";
  soot.optics.extinction = {0.3, 633, 1, {}};
  soot.optics.albedo = Spectrum::constant(0.3);
  d.media.push_back(soot);
  for (Emitter& e : d.emitters) e.distribution = Distribution::lambertian;
}

struct ColourScene {
  const char* name;
  const char* file;  // in scenes/library
  const char* scenario;
  void (*change)(SceneDescription&);
};
const ColourScene colour_scenes[] = {
    {"office, clear", "office_floor", "clear_mains", [](SceneDescription&) {}},
    {"office, smoke", "office_floor", "smoke_emergency", [](SceneDescription&) {}},
    {"auditorium, haze", "auditorium", "emergency in smoke", [](SceneDescription&) {}},
    {"flame in soot", "fire_in_a_box", "flame", colour},
    {"tank of soot", "smoke_tank", "half the smoke", colour},
};

std::unique_ptr<LocalRun> traced_scene(const ColourScene& of, uint64_t seed, int64_t particles) {
  auto read = read_scene(std::string(LUX_SOURCE_DIR "/scenes/library/") + of.file + ".toml");
  if (!read.scene) throw std::runtime_error(std::string(of.file) + " cannot be read");
  SceneDescription d = *read.scene;
  of.change(d);
  d.run.eye_path_factor = 0;  // pictures trace their own paths
  d.cameras.resize(1);
  d.cameras[0].width = width;
  d.cameras[0].height = height;
  const Scenario found = find_scenario(d, of.scenario).value();
  auto scene = compile_scene(std::make_shared<const SceneDescription>(std::move(d)), found, {});
  if (!scene.ok()) throw std::runtime_error(scene.problem().text());
  auto run = std::make_unique<LocalRun>(scene.value(), seed, 1);
  const std::atomic<bool> never{false};
  StopRule stop;
  stop.particles = particles;
  run->run(stop, never, [](const Progress&) {});
  return run;
}

using Colour = std::array<double, 3>;  // X, Y, Z

void add_light(const Bands& bands, int band, double radiance, Colour& into) {
  into[0] += radiance * bands[band].x_per_w;
  into[1] += radiance * bands[band].lm_per_w;
  into[2] += radiance * bands[band].z_per_w;
}

/// Distance in CIE 1976 u', v'; 0 if either is dark.
double colour_distance(const Colour& a, const Colour& b) {
  const auto uv = [](const Colour& c) {
    const double sum = c[0] + 15 * c[1] + 3 * c[2];
    return std::array<double, 2>{4 * c[0] / sum, 9 * c[1] / sum};
  };
  if (!(a[1] > 0 && b[1] > 0)) return 0;
  return std::hypot(uv(a)[0] - uv(b)[0], uv(a)[1] - uv(b)[1]);
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<size_t>(share * static_cast<double>(values.size() - 1))];
}

/// Mean without the largest thousandth, which single bright paths would otherwise dominate.
double without_brightest(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.resize(values.size() - values.size() / 1000);
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Pixels of one tracing method.
struct Way {
  double seconds = 0;
  std::vector<Colour> pixels;
};

/// Light of each pixel without direct light of emitters, by the same number of paths: of one band
/// each, and of all bands.
std::array<Way, 2> trace_ways(const LocalRun& run, const RadianceCache* flux) {
  const CompiledScene& scene = run.scene();
  const Bands& bands = scene.bands;
  std::vector<double> cdf;
  for (int b = 0; b < bands.count(); ++b) {
    double power = 0;
    for (const Group& g : scene.groups) power += g.power_w[static_cast<size_t>(b)];
    cdf.push_back((cdf.empty() ? 0 : cdf.back()) +
                  power * (bands[b].lm_per_w + bands[b].x_per_w + bands[b].z_per_w));
  }
  std::array<Way, 2> ways;
  const Camera& camera = scene.description->cameras[0];
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
  const double half = std::tan(glm::radians(camera.vertical_fov_deg) / 2);
  const glm::dvec3 up = glm::cross(right, forward);
  run.rows().run(1, [&](const GeometryAccess& access) -> ParallelFor::Worker {
    const std::shared_ptr<PictureTracer> tracer =
        make_picture_tracer(scene, access, 5, make_emitter_sight(scene));
    return [&, tracer](int64_t) {
      for (uint64_t pixel = 0; pixel < uint64_t{width} * height; ++pixel) {
        for (const size_t way : {size_t{0}, size_t{1}}) {
          const double before = process_seconds();
          Colour sum{};
          for (uint32_t i = 0; i < compared_paths; ++i) {
            tracer->start((2 * pixel + way) << 17, compared_paths, i);
            const double x =
                static_cast<double>(pixel % width) + static_cast<double>(tracer->uniform());
            const double y =
                static_cast<double>(pixel / width) + static_cast<double>(tracer->uniform());
            const int band = tracer->choose_band(static_cast<double>(tracer->uniform()));
            const glm::dvec3 d = forward + right * (half * width / height * (2 * x / width - 1)) +
                                 up * (half * (1 - 2 * y / height));
            const Ray ray{glm::vec3(camera.eye - scene.local_origin), glm::vec3(glm::normalize(d))};
            if (way == 0) {
              const auto b = static_cast<size_t>(band);
              const double share = (cdf[b] - (b > 0 ? cdf[b - 1] : 0)) / cdf.back();
              add_light(bands, band,
                        tracer->radiance_in_band(ray, band, flux) / share / compared_paths, sum);
              continue;
            }
            const auto light = tracer->radiance(ray, band, flux, nullptr);
            for (int b = 0; b < bands.count(); ++b)
              add_light(bands, b, light[static_cast<size_t>(b)] / compared_paths, sum);
          }
          ways[way].seconds += process_seconds() - before;
          ways[way].pixels.push_back(sum);
        }
      }
    };
  });
  return ways;
}

void print_colours_of(const ColourScene& of, int64_t particles, int reference_paths) {
  const auto run = traced_scene(of, 1, particles);
  const auto flux = flux_radiance(*run);
  PictureOptions options;
  options.paths_per_pixel = reference_paths;
  const TracedPicture wanted = trace_picture(*run, 0, options, flux.get());
  const auto colour_of = [](const std::vector<float>& xyz, size_t i) {
    return Colour{static_cast<double>(xyz[3 * i]), static_cast<double>(xyz[3 * i + 1]),
                  static_cast<double>(xyz[3 * i + 2])};
  };
  const auto ways = trace_ways(*run, flux.get());
  double mean = 0;
  const size_t n = wanted.light.pixels();
  std::vector<Colour> reference(n);
  for (size_t i = 0; i < n; ++i) {
    reference[i] = colour_of(wanted.light.xyz, i);
    for (size_t c = 0; c < 3; ++c)
      reference[i][c] -= static_cast<double>(wanted.emitted[light_channels * i + c]);
    mean += reference[i][1] / static_cast<double>(n);
  }
  double merit[2], means[2];
  double tail[2];
  for (const size_t way : {size_t{0}, size_t{1}}) {
    double sum = 0;
    std::vector<double> distances, squares;
    for (size_t i = 0; i < n; ++i) {
      const Colour& is = ways[way].pixels[i];
      squares.push_back(std::pow((is[1] - reference[i][1]) / (reference[i][1] + 0.01 * mean), 2));
      sum += is[1];
      distances.push_back(colour_distance(is, reference[i]));
    }
    means[way] = sum / static_cast<double>(n) / mean;
    merit[way] = 1 / (without_brightest(std::move(squares)) * ways[way].seconds);
    tail[way] = quantile(distances, 0.95);
  }
  options.paths_per_pixel = filtered_paths;
  const TracedPicture picture = trace_picture(*run, 0, options, flux.get());
  const FilteredView filtered = filter_traced(picture, 1);
  std::vector<double> distances;
  for (size_t i = 0; i < n; ++i)
    distances.push_back(
        colour_distance(colour_of(filtered.light.xyz, i), colour_of(wanted.light.xyz, i)));
  const auto within = std::count_if(distances.begin(), distances.end(),
                                    [](double d) { return d <= wanted_colour; });
  fmt::print(
      "{:<18} {:>5} {:>6.2f} {:>8.4f} {:>8.4f} {:>8.2f} {:>8.4f} {:>8.4f} {:>9.4f} {:>8.1f} %\n",
      of.name, run->scene().bands.count(), ways[1].seconds / ways[0].seconds, means[0], means[1],
      merit[1] / merit[0], tail[0], tail[1], quantile(distances, 0.95),
      100.0 * static_cast<double>(within) / static_cast<double>(n));
  std::fflush(stdout);
}

}  // namespace

void print_colours(double share) {
  const auto particles = static_cast<int64_t>(share * static_cast<double>(all_particles));
  const int reference = std::max(64, static_cast<int>(share * all_paths));
  fmt::print(
      "\nPaths of all bands beside paths of one, {} x {} pixels by {} paths, against {} paths of "
      "all bands;\ndistance: u', v' of 95 % of the pixels, one band, all bands, filtered ({} "
      "paths), and pixels within {}\n{:<18} {:>5} {:>6} {:>8} {:>8} {:>8} {:>8} {:>8} {:>9} "
      "{:>10}\n",
      width, height, compared_paths, reference, filtered_paths, wanted_colour, "scene", "bands",
      "time", "mean", "mean", "merit", "one", "all", "filtered", "within");
  for (const ColourScene& scene : colour_scenes) print_colours_of(scene, particles, reference);
}

}  // namespace luxodus::bench
