// Bias of the default picture method against paths traced to their end, by voxel size, in scenes
// with smoke.
#include <fmt/core.h>

#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

#include "actors/results/pictures/pictures.hpp"
#include "scenes/formats/fields/fds_building.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/geometry/primitives.hpp"
#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/readout.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/tables.hpp"
#include "tests/kit/temporary_folder.hpp"

namespace luxodus::bench {

namespace {

constexpr int width = 96, height = 64;
constexpr int veil_pixels = 24;  // edge length of the picture of the black plate
constexpr int64_t all_particles = 1 << 23;
constexpr int all_paths = 4096;    // per pixel, traced to their end
constexpr int gathered_part = 16;  // fraction of these paths in a picture of the default method
constexpr uint64_t seeds = 4;
/// Edge of the plate in front of the camera, where the veil is measured [m].
constexpr double plate_edge = 0.4;
/// Pixels darker than this share of the mean are weighted as if they were that bright.
constexpr double dark = 0.05;

struct BiasScene {
  const char* name;
  SceneDescription (*read)();
  const char* scenario;
  int camera;            // index in the scene
  double plate_m;        // distance from the camera
  double widest_voxels;  // edge [m]; then a half and a quarter of it
};

SceneDescription read_or_throw(const std::filesystem::path& file,
                               std::optional<double> at_s = std::nullopt) {
  auto read = read_scene(file, at_s);
  if (!read.scene) throw std::runtime_error(read.problems.list().front().text());
  return *std::move(read.scene);
}

SceneDescription of_library(const char* name) {
  return read_or_throw(std::string(LUX_SOURCE_DIR "/scenes/library/") + name + ".toml");
}

SceneDescription of_text(const std::string& toml, std::optional<double> at_s = std::nullopt) {
  const test::TemporaryFolder folder;
  return read_or_throw(folder.write("scene.toml", toml), at_s);
}

/// A lit room in smoke, and next to it, behind 0.1 m of wall, one with a lamp of a hundredth of the
/// flux.
SceneDescription dark_room() {
  std::string toml = "[run]\nmax_bands = 1\n[[material]]\nname = \"grey\"\nreflectance = 0.5\n";
  const auto add = [&](const std::string& name, double x, double flux) {
    toml += fmt::format(
        "[[object]]\nname = \"{0}\"\nshape = \"room\"\nlow = [{1}, 0, 0]\nhigh = [{2}, 4, 2.5]\n"
        "material = \"grey\"\npatch_edge_m = 0.5\n[[emitter]]\nname = \"lamp, {0}\"\n"
        "shape = \"rectangle\"\nsize = [0.6, 0.3]\nposition = [{3}, 2, 2.4]\nflux_lm = {4}\n",
        name, x, x + 4, x + 2, flux);
  };
  add("lit", 0, 10'000);
  add("dark", 4.1, 100);
  return of_text(toml +
                 "[[medium]]\nname = \"smoke\"\nkind = \"homogeneous\"\nextinction = 0.5\n"
                 "albedo = 0.8\nphase = \"hg\"\ng = 0.6\n"
                 "[[camera]]\nname = \"view\"\neye = [7.8, 2.2, 1.2]\ntarget = [4.1, 2, 1.1]\n");
}

std::filesystem::path fire_index() {
  return std::filesystem::path(LUX_SHARED_DATA) / "fds_results/corridor/corridor.smv";
}

/// A corridor full of smoke, by FDS after 90 s, under three ceiling lamps.
SceneDescription fire_corridor() {
  constexpr double at_s = 90;
  const auto building = read_fire_building(fire_index(), at_s);
  if (!building) throw std::runtime_error(building.problem().text());
  std::string toml = "[run]\nmax_bands = 3\n";
  for (const FireMaterial& m : building->tables.materials()) toml += material_table(m) + "\n";
  toml += building->tables.text();
  toml += fmt::format(
      "\n[[medium]]\nname = \"smoke\"\nkind = \"fds\"\nfile = \"{}\"\nat_s = 90\nalbedo = 0.3\n"
      "g = 0.6\nangstrom = 1\n",
      fire_index().string());
  for (const int x : {2, 6, 9})
    toml += fmt::format(
        "[[emitter]]\nname = \"lamp {0}\"\nshape = \"rectangle\"\nsize = [0.6, 0.3]\n"
        "position = [{0}, 1.2, 2.95]\nflux_lm = 3000\n",
        x);
  return of_text(toml + "[[camera]]\nname = \"view\"\neye = [0.5, 1, 1]\ntarget = [11, 1.4, 1.4]\n",
                 at_s);
}

SceneDescription office() {
  return of_library("office_floor");
}
SceneDescription auditorium() {
  return of_library("auditorium");
}
/// Eye paths cannot hit a collimated beam: an isotropic lamp instead.
SceneDescription tank() {
  SceneDescription d = of_library("smoke_tank");
  for (Emitter& e : d.emitters) e.distribution = Distribution::lambertian;
  return d;
}

const BiasScene bias_scenes[] = {
    {"office corridor", office, "smoke_emergency", 0, 8, 1},
    {"auditorium", auditorium, "emergency in smoke", 0, 8, 1},
    {"kitchen, flame", office, "smoke_emergency", 2, 3, 1},
    {"smoke tank", tank, "half the smoke", 0, 1.6, 0.4},
    {"FDS corridor", fire_corridor, "", 0, 5, 0.8},
    {"dark room", dark_room, "", 0, 2, 1},
};

/// Adds a black plate facing the camera, and a camera that sees only the plate.
void add_plate(SceneDescription& d, const Camera& camera, double distance) {
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
  const glm::dvec3 u = plate_edge * right, v = plate_edge * glm::cross(right, forward);
  const glm::dvec3 middle = camera.eye + distance * forward;
  Object plate;
  plate.name = "black plate";
  plate.mesh = shapes::quad(middle - 0.5 * (u + v), u, v).value().mesh;
  plate.material = plate.back_material = static_cast<int>(d.materials.size());
  d.objects.push_back(std::move(plate));
  Material black;
  black.name = "black of the plate";
  black.reflectance = Spectrum::constant(0);
  d.materials.push_back(black);
  Camera narrow = camera;
  narrow.name = "veil";
  narrow.target = middle;
  narrow.width = narrow.height = veil_pixels;
  narrow.vertical_fov_deg = glm::degrees(2 * std::atan(0.25 * plate_edge / distance));
  d.cameras = {camera, narrow};
  d.cameras[0].width = width;
  d.cameras[0].height = height;
}

std::unique_ptr<LocalRun> traced_scene(const BiasScene& of, double voxel_edge, uint64_t seed,
                                       int64_t particles) {
  SceneDescription d = of.read();
  d.run.voxels = true;
  d.run.voxel_edge_m = voxel_edge;
  d.run.eye_path_factor = 0;  // pictures trace their own paths
  const Camera camera = d.cameras.at(static_cast<size_t>(of.camera));
  add_plate(d, camera, of.plate_m);
  const Scenario found = find_scenario(d, of.scenario).value();
  auto scene = compile_scene(std::make_shared<const SceneDescription>(std::move(d)), found, {});
  if (!scene.ok()) throw std::runtime_error(scene.problem().text());
  auto run = std::make_unique<LocalRun>(scene.value(), seed, 2);
  const std::atomic<bool> never{false};
  StopRule stop;
  stop.particles = particles;
  run->run(stop, never, [](const Progress&) {});
  return run;
}

/// Luminance without direct light of emitters, which is equal in both methods.
struct Luminances {
  std::vector<double> values;
  double mean = 0;
  double standard_error = 0;  // of the mean, from the paths of the pixels
};

Luminances luminances_of(const TracedPicture& p) {
  Luminances out;
  const size_t n = p.light.pixels();
  double variance = 0;
  for (size_t i = 0; i < n; ++i) {
    out.values.push_back(static_cast<double>(p.light.xyz[3 * i + 1]) -
                         static_cast<double>(p.emitted[light_channels * i + 1]));
    out.mean += out.values.back() / static_cast<double>(n);
    variance += std::pow(static_cast<double>(p.standard_error_y[i]), 2);
  }
  out.standard_error = std::sqrt(variance) / static_cast<double>(n);
  return out;
}

/// Pictures of both cameras of a run.
struct TwoViews {
  TracedPicture view, veil;
};

TwoViews draw_both(const LocalRun& run, int paths, bool gather) {
  PictureOptions options;
  options.gather = gather;
  options.raw = true;  // unfiltered for the measurement
  const auto flux = gather ? flux_radiance(run) : nullptr;
  const auto draw = [&](size_t camera) {
    options.paths_per_pixel = std::max(2, paths);
    return trace_picture(run, camera, options, flux.get());
  };
  return {draw(0), draw(1)};
}

/// Whether every feature is nearly constant around a pixel, so that an edge there is one of light.
bool even_features(const NoisyPicture& noisy, int x, int y) {
  constexpr double alike = 0.02;
  const auto at = [&](int column, int row) {
    return &noisy.features[noisy.feature_count * static_cast<size_t>(row * width + column)];
  };
  const float* own = at(x, y);
  for (int row = y - 1; row <= y + 1; ++row)
    for (int column = x - 1; column <= x + 1; ++column)
      for (size_t k = 0; k < noisy.feature_count; ++k) {
        const double off = static_cast<double>(at(column, row)[k] - own[k]);
        if (std::abs(off) > alike * (1 + std::abs(static_cast<double>(own[k])))) return false;
      }
  return true;
}

/// Shift of shadow edges in pixels, to the right and downwards: least squares of the difference
/// over the reference's level and slopes (B. Lucas, T. Kanade, IJCAI 1981).
struct Shift {
  double x = std::numeric_limits<double>::quiet_NaN(), y = x;
};

Shift shift_of(const std::vector<double>& is, const Luminances& wanted, const NoisyPicture& noisy) {
  glm::dmat3 normal(0);
  glm::dvec3 right_side(0);
  const auto at = [&](int x, int y) { return wanted.values[static_cast<size_t>(y * width + x)]; };
  for (int y = 1; y + 1 < height; ++y)
    for (int x = 1; x + 1 < width; ++x) {
      if (!even_features(noisy, x, y)) continue;
      const glm::dvec3 row(at(x, y), (at(x - 1, y) - at(x + 1, y)) / 2,
                           (at(x, y - 1) - at(x, y + 1)) / 2);
      const double weight = 1 / std::pow(at(x, y) + dark * wanted.mean, 2);
      normal += weight * glm::outerProduct(row, row);
      right_side += weight * (is[static_cast<size_t>(y * width + x)] - at(x, y)) * row;
    }
  if (!(glm::determinant(normal) > 0)) return {};
  const glm::dvec3 found = glm::inverse(normal) * right_side;
  return {found.y, found.z};
}

Estimate over_seeds(const std::array<double, seeds>& values) {
  double sum = 0, squares = 0;
  for (const double v : values) {
    sum += v;
    squares += v * v;
  }
  const double mean = sum / seeds;
  return {mean, std::sqrt(std::max(0.0, squares / seeds - mean * mean) / (seeds - 1))};
}

/// Relative bias, with the errors of both.
Estimate bias_of(const std::array<double, seeds>& means, const Luminances& full) {
  const Estimate is = over_seeds(means);
  return {is.value / full.mean - 1,
          std::hypot(is.standard_error / full.mean, full.standard_error / full.mean)};
}

void print_bias_of(const BiasScene& of, int64_t particles, int paths) {
  const double before = process_seconds();
  // Paths traced to their end need no flux; another seed, so that the two are independent.
  const TwoViews full = draw_both(*traced_scene(of, of.widest_voxels, 77, 1 << 12), paths, false);
  const Luminances view = luminances_of(full.view), veil = luminances_of(full.veil);
  fmt::print(
      "{:<16} full paths: {:.4g} cd/m2 +- {:.2f} %, veil {:.4g} cd/m2 +- {:.2f} %, {:.0f} s\n",
      of.name, view.mean, 100 * view.standard_error / view.mean, veil.mean,
      100 * veil.standard_error / veil.mean, process_seconds() - before);
  for (const double edge : {of.widest_voxels, of.widest_voxels / 2, of.widest_voxels / 4}) {
    const double start = process_seconds();
    std::array<double, seeds> means{}, veils{}, right{}, down{};
    for (uint64_t seed = 1; seed <= seeds; ++seed) {
      const auto run = traced_scene(of, edge, seed, particles);
      const TwoViews is = draw_both(*run, std::max(1, paths / gathered_part), true);
      const Luminances own = luminances_of(is.view);
      const Shift shift = shift_of(own.values, view, full.view.noisy);
      means[seed - 1] = own.mean;
      veils[seed - 1] = luminances_of(is.veil).mean;
      right[seed - 1] = shift.x;
      down[seed - 1] = shift.y;
    }
    const Estimate mean = bias_of(means, view), veiled = bias_of(veils, veil);
    const Estimate x = over_seeds(right), y = over_seeds(down);
    fmt::print(
        "{:<16} {:>6.3f} {:>7.2f} +- {:<5.2f} {:>7.2f} +- {:<5.2f} {:>6.2f} +- {:<5.2f} {:>6.2f} "
        "+- {:<5.2f} {:>6.0f}\n",
        "", edge, 100 * mean.value, 100 * mean.standard_error, 100 * veiled.value,
        100 * veiled.standard_error, x.value, x.standard_error, y.value, y.standard_error,
        process_seconds() - start);
    std::fflush(stdout);
  }
}

}  // namespace

void print_bias(double share, const std::string& scene) {
  const auto particles = static_cast<int64_t>(share * static_cast<double>(all_particles));
  const int paths = std::max(2 * gathered_part, static_cast<int>(share * all_paths));
  fmt::print(
      "\nBias of pictures that end in patches and voxels, against {} paths a pixel traced to their "
      "end: {} x {}\npixels, {} seeds of {} particles and {} paths; light straight from emitters "
      "is "
      "left out\n{:<16} {:>6} {:>16} {:>16} {:>15} {:>15} {:>6}\n",
      paths, width, height, seeds, particles, paths / gathered_part, "scene", "edge", "mean [%]",
      "veil [%]", "right [px]", "down [px]", "cpu[s]");
  for (const BiasScene& of : bias_scenes) {
    if (std::string(of.name).rfind(scene, 0) != 0) continue;
    if (of.read == fire_corridor && !std::filesystem::exists(fire_index())) {
      fmt::print("{:<16} skipped: the results of FDS are not there ({})\n", of.name,
                 fire_index().string());
      continue;
    }
    print_bias_of(of, particles, paths);
  }
}

}  // namespace luxodus::bench
