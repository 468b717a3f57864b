// Errors of pictures against a long run, by paths and by seconds; and the effect of the patch size.
#include <fmt/core.h>

#include <atomic>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "actors/results/pictures/pictures.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/detectors.hpp"
#include "scenes/light/transport/eye_paths.hpp"
#include "tests/bench/bench_scenes.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/tables.hpp"

namespace luxodus::bench {

namespace {

constexpr int width = 96, height = 64;
constexpr int long_paths = 2048;
constexpr int64_t all_particles = 1 << 24;
/// Pixels darker than this share of the mean are weighted as if they were that bright.
constexpr double dark = 0.05;
/// Cap of luminance in mean errors: otherwise a luminaire in a few pixels, and paths that happen to
/// hit one, would dominate [cd/m2].
constexpr double max_counted = 10;
/// Cap of mean luminances: above everything lit, so it removes nothing.
constexpr double max_mean = 100;
constexpr int seeds = 8;  // of pictures whose own error is measured

std::shared_ptr<const CompiledScene> compiled(SceneDescription d, const char* scenario) {
  const Scenario found = find_scenario(d, scenario).value();
  auto scene = compile_scene(std::make_shared<const SceneDescription>(std::move(d)), found, {});
  if (!scene.ok()) throw std::runtime_error(scene.problem().text());
  return scene.value();
}

std::shared_ptr<const CompiledScene> office(const char* scenario, bool stratified,
                                            double patch_edge) {
  auto read = read_scene(LUX_SOURCE_DIR "/scenes/library/office_floor.toml");
  if (!read.scene) throw std::runtime_error("scenes/library/office_floor.toml cannot be read");
  SceneDescription d = *read.scene;
  d.run.stratified = stratified;
  d.run.eye_path_factor = 0;  // pictures trace their own paths
  d.cameras.resize(1);
  d.cameras[0].width = width;
  d.cameras[0].height = height;
  for (Object& o : d.objects) o.patch_edge_m = patch_edge > 0 ? patch_edge : o.patch_edge_m;
  return compiled(std::move(d), scenario);
}

std::unique_ptr<LocalRun> traced(std::shared_ptr<const CompiledScene> scene, uint64_t seed,
                                 int64_t particles) {
  auto run = std::make_unique<LocalRun>(std::move(scene), seed, 2);
  const std::atomic<bool> never{false};
  StopRule stop;
  stop.particles = particles;
  run->run(stop, never, [](const Progress&) {});
  return run;
}

double luminance(const TracedPicture& p, size_t pixel) {
  return static_cast<double>(p.light.xyz[3 * pixel + 1]);
}

struct Deviation {
  double luminance = 0;  // relative, root mean square
  double counted = 0;    // the same with pixels capped at `max_counted`
  double colour = 0;     // of x and y together, root mean square
};

Deviation deviation(const TracedPicture& is, const TracedPicture& wanted) {
  const size_t n = wanted.light.pixels();
  double mean = 0;
  for (size_t i = 0; i < n; ++i) mean += luminance(wanted, i) / static_cast<double>(n);
  double squares = 0, counted = 0, colours = 0;
  for (size_t i = 0; i < n; ++i) {
    const double to = std::max(luminance(wanted, i), dark * mean);
    const double off = (luminance(is, i) - luminance(wanted, i)) / to;
    squares += off * off;
    const double seen =
        std::min(luminance(is, i), max_counted) - std::min(luminance(wanted, i), max_counted);
    counted += seen * seen / (to * to);
    const auto share = [&](const TracedPicture& p, size_t k) {
      const float* c = &p.light.xyz[3 * i];
      const auto sum = static_cast<double>(c[0] + c[1] + c[2]);
      return sum > 0 ? static_cast<double>(c[k]) / sum : 1.0 / 3;
    };
    for (const size_t k : {size_t{0}, size_t{1}}) {
      const double d = share(is, k) - share(wanted, k);
      colours += d * d;
    }
  }
  const auto count = static_cast<double>(n);
  return {std::sqrt(squares / count), std::sqrt(counted / count), std::sqrt(colours / count)};
}

double mean_luminance(const TracedPicture& p) {
  double sum = 0;
  for (size_t i = 0; i < p.light.pixels(); ++i) sum += std::min(luminance(p, i), max_mean);
  return sum / static_cast<double>(p.light.pixels());
}

struct Timed {
  TracedPicture picture;
  double seconds;
};

/// Wall time of two threads, estimated from the process's CPU time.
Timed draw(const LocalRun& run, int paths, bool gather) {
  PictureOptions options;
  options.paths_per_pixel = paths;
  options.gather = gather;
  options.raw = true;  // unfiltered for the measurement
  const auto flux = gather ? flux_radiance(run) : nullptr;
  const double before = process_seconds();
  TracedPicture picture = trace_picture(run, 0, options, flux.get());
  return {std::move(picture), process_seconds() - before};
}

/// Amount of work: particles, and paths of the long picture.
struct Size {
  int64_t particles;
  int long_paths;
};

void print_course(const char* scenario, const Size& size) {
  // Seeds other than the pictures', so that the long run is independent.
  const auto long_run = traced(office(scenario, true, 0), 77, size.particles);
  for (const bool gather : {true, false}) {
    const TracedPicture wanted = draw(*long_run, size.long_paths, gather).picture;
    for (const bool stratified : {false, true}) {
      const auto run = traced(office(scenario, stratified, 0), 1, size.particles);
      for (const int paths : {4, 16, 64}) {
        const Timed timed = draw(*run, paths, gather);
        // Two pictures with these numbers of paths have independent errors; this is the share of
        // one.
        const double own =
            std::sqrt(size.long_paths / static_cast<double>(size.long_paths + paths));
        const Deviation d = deviation(timed.picture, wanted);
        const double counted = own * d.counted;
        fmt::print("{:<16} {:<7} {:<11} {:>5} {:>8.2f} {:>9.2f} % {:>9.2f} % {:>9.4f} {:>10.3g}\n",
                   scenario, gather ? "gather" : "full", stratified ? "stratified" : "independent",
                   paths, timed.seconds, 100 * own * d.luminance, 100 * counted, own * d.colour,
                   1 / (counted * counted * timed.seconds));
        std::fflush(stdout);
      }
    }
  }
}

/// Mean luminance of pictures over several seeds; `patch_edge` 0: paths to their end.
Estimate mean_of_pictures(const char* scenario, double patch_edge, const Size& size) {
  const bool gather = patch_edge > 0;
  const int64_t particles = gather ? size.particles : 1 << 16;
  double sum = 0, squares = 0;
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    const auto run = traced(office(scenario, true, patch_edge), seed, particles);
    const int paths = std::max(1, size.long_paths / 2);
    const double mean = mean_luminance(draw(*run, paths, gather).picture);
    sum += mean;
    squares += mean * mean;
  }
  const double mean = sum / seeds;
  return {mean, std::sqrt((squares / seeds - mean * mean) / (seeds - 1))};
}

void print_halving(const char* scenario, const Size& size) {
  const Estimate full = mean_of_pictures(scenario, 0, size);
  fmt::print("{:<16} {:>8} {:>11.4f} +- {:.4f}\n", scenario, "full", full.value,
             full.standard_error);
  for (const double edge : {4.0, 2.0, 1.0, 0.5, 0.25}) {
    const Estimate gathered = mean_of_pictures(scenario, edge, size);
    const double off = gathered.value / full.value - 1;
    const double error = std::hypot(gathered.relative_error(), full.relative_error());
    fmt::print("{:<16} {:>8.2f} {:>11.4f} +- {:.4f} {:>8.2f} +- {:.2f} %\n", scenario, edge,
               gathered.value, gathered.standard_error, 100 * off, 100 * error);
    std::fflush(stdout);
  }
}

// ---- the veil before a sign, by voxels ----------------------------------------------------------

constexpr double sigma = 0.1, albedo = 0.8;  // of bench_scenes' smoke, isotropic
constexpr glm::dvec3 eye{2, 7.5, 1.65}, sign_at{18, 7.5, 2.3};

SceneDescription room_with_sign(double voxel_edge) {
  SceneDescription d = furnished(Air::homogeneous, {false, true});
  d.run.voxel_edge_m = voxel_edge;
  d.run.eye_path_factor = 4;
  Sign sign;
  sign.name = "sign";
  sign.frame.origin = sign_at;
  sign.frame.axes = glm::dmat3(glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1), glm::dvec3(-1, 0, 0));
  sign.width_m = sign.height_m = sign.smallest_detail_m = 0.1;
  sign.face = {1, 1, {0}, {}};
  sign.colours = white_and_green({10, 0});
  d.signs.push_back(sign);
  Observer observer;
  observer.name = "eye";
  observer.eye = eye;
  d.observers.push_back(observer);
  return d;
}

/// Luminance that the smoke between eye and sign scatters to the eye, if its fluence is that of the
/// voxels [cd/m2].
double veil_by_voxels(const LocalRun& run) {
  constexpr int steps = 4000;
  const CompiledScene& scene = run.scene();
  const Readout readout(scene, run.totals());
  const auto edge = static_cast<double>(scene.voxels.edge);
  const double step = glm::length(sign_at - eye) / steps;
  double luminance = 0;
  for (int i = 0; i < steps; ++i) {
    const double along = (i + 0.5) * step;
    const glm::dvec3 at = eye + (sign_at - eye) * (along / (steps * step));
    const uint32_t voxel = voxel_of(scene.voxels, Vec3(at - scene.local_origin));
    const double fluence =
        readout.lumens(scene.blocks.voxels, voxel, 0).value / (edge * edge * edge);
    luminance +=
        sigma * albedo * fluence / (4 * std::numbers::pi) * std::exp(-sigma * along) * step;
  }
  return luminance;
}

void print_veil() {
  for (const double edge : {3.0, 1.5, 0.75, 0.375}) {
    const auto run = traced(compiled(room_with_sign(edge), ""), 1, 1 << 22);
    const auto path = static_cast<uint32_t>(EyeQuantity::path);
    const Estimate traced_veil =
        Readout(run->scene(), run->totals())
            .value(run->scene().blocks.views, run->scene().eye_targets[0].first_bin, path);
    const double by_voxels = veil_by_voxels(*run);
    fmt::print("{:>8.3f} {:>9} {:>10.4f} {:>10.4f} +- {:.4f} {:>9.2f} %\n", edge,
               run->scene().voxels.count(), by_voxels, traced_veil.value,
               traced_veil.standard_error, 100 * (by_voxels / traced_veil.value - 1));
  }
}

/// Room light reflected by a sign's face: from the bin that counts outgoing flux, and traced from
/// the eye.
void print_face() {
  SceneDescription d = room_with_sign(3);
  d.signs[0].width_m = d.signs[0].height_m = 0.6;  // so that its bin gets enough light
  const auto run = traced(compiled(std::move(d), ""), 1, 1 << 24);
  const CompiledScene& scene = run->scene();
  const Readout readout(scene, run->totals());
  // Front sides of two triangles: the back of a sign is an object's other side, and not quite
  // black.
  const CompiledSurface& face = scene.surfaces[scene.signs[0].surface];
  Estimate of_bin;
  for (const uint32_t patch : {face.first_patch, face.first_patch + 2}) {
    const Estimate out =
        readout.lumens(scene.blocks.patches, patch, 1) * (1 / (std::numbers::pi * face.area_m2));
    of_bin.value += out.value;
    of_bin.standard_error = std::hypot(of_bin.standard_error, out.standard_error);
  }
  const Estimate of_eye = readout.value(scene.blocks.views, scene.eye_targets[0].first_bin,
                                        static_cast<uint32_t>(EyeQuantity::reflected));
  fmt::print("by the bin {:.4f} +- {:.4f}, from the eye {:.4f} +- {:.4f}\n", of_bin.value,
             of_bin.standard_error, of_eye.value, of_eye.standard_error);
}

}  // namespace

void print_image_seeds(double share) {
  constexpr int paths = 64, all_reference_paths = 1 << 14, picture_seeds = 6;
  const auto particles = static_cast<int64_t>(share * static_cast<double>(all_particles));
  const int reference_paths = std::max(paths, static_cast<int>(share * all_reference_paths));
  fmt::print(
      "\nPictures of the office floor by final gather, {} x {} pixels of {} paths, of {} seeds, "
      "each "
      "against\none of {} paths; its chance taken off\n{:<16} {:>8} {:>11}\n",
      width, height, paths, picture_seeds, reference_paths, "scenario", "cpu [s]", "rms error");
  const double own = std::sqrt(reference_paths / static_cast<double>(reference_paths + paths));
  for (const char* scenario : {"smoke_emergency", "clear_emergency"}) {
    const auto long_run = traced(office(scenario, true, 0), 77, particles);
    const TracedPicture wanted = draw(*long_run, reference_paths, true).picture;
    double squares = 0, seconds = 0;
    for (uint64_t seed = 1; seed <= picture_seeds; ++seed) {
      const auto run = traced(office(scenario, true, 0), seed, particles);
      const Timed timed = draw(*run, paths, true);
      const double error = own * deviation(timed.picture, wanted).luminance;
      fmt::print("{:<16} {:>8.2f} {:>9.1f} %\n", scenario, timed.seconds, 100 * error);
      std::fflush(stdout);
      squares += error * error / picture_seeds;
      seconds += timed.seconds / picture_seeds;
    }
    fmt::print("{:<16} {:>8.2f} {:>9.1f} %, merit {:.2f} /s\n", "all", seconds,
               100 * std::sqrt(squares), 1 / (squares * seconds));
    std::fflush(stdout);
  }
}

void print_images(double share) {
  const Size size{static_cast<int64_t>(share * static_cast<double>(all_particles)),
                  std::max(1, static_cast<int>(share * long_paths))};
  fmt::print(
      "\nPictures of the office floor, {} x {} pixels, against one of {} paths a pixel in the same "
      "way,\nits own chance taken off; counted: where a pixel is {} cd/m2 at most, as the merit "
      "is\n"
      "{:<16} {:<7} {:<11} {:>5} {:>8} {:>11} {:>11} {:>9} {:>10}\n",
      width, height, size.long_paths, max_counted, "scenario", "paths", "numbers", "each",
      "cpu [s]", "rms error", "counted", "rms x, y", "merit [/s]");
  for (const char* scenario : {"clear_emergency", "smoke_emergency"}) print_course(scenario, size);
  fmt::print(
      "\nFinal gathers in patches of an edge, against paths traced to their end, {} seeds each: "
      "mean\n"
      "luminance [cd/m2] where a pixel counts {} at most\n{:<16} {:>8} {:>11} {:>18}\n",
      seeds, max_mean, "scenario", "edge [m]", "luminance", "off");
  for (const char* scenario : {"clear_emergency", "smoke_emergency"}) print_halving(scenario, size);
  fmt::print(
      "\nVeil before a sign in the room's homogeneous smoke, by voxels and traced from the eye\n"
      "{:>8} {:>9} {:>10} {:>10}    error {:>11}\n",
      "edge [m]", "voxels", "voxels", "eye", "off");
  print_veil();
  fmt::print("\nLight of the room that a sign's face of 60 cm reflects there [cd/m2]\n");
  print_face();
}

}  // namespace luxodus::bench
