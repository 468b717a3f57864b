// Cost of a picture of a room: its error by paths, and the CPU time to an error of 10 %.
#include <fmt/core.h>

#include <atomic>
#include <cmath>
#include <memory>

#include "actors/results/pictures/pictures.hpp"
#include "tests/bench/bench_scenes.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/tables.hpp"

namespace luxodus::bench {

namespace {

constexpr int width = 96, height = 54;
constexpr int long_paths = 8192;
constexpr int64_t all_particles = 1 << 22;
constexpr double wanted_error = 0.1;
/// Pixels darker than this share of the mean are weighted as if they were that bright.
constexpr double dark = 0.01;

std::unique_ptr<LocalRun> traced(Air air, uint64_t seed, int64_t particles) {
  auto run = std::make_unique<LocalRun>(pictured_room(air, width, height), seed, 2);
  const std::atomic<bool> never{false};
  StopRule stop;
  stop.particles = particles;
  run->run(stop, never, [](const Progress&) {});
  return run;
}

/// Root mean square of the relative deviation of luminance.
double deviation(const XyzPicture& is, const XyzPicture& wanted) {
  const size_t n = wanted.pixels();
  const auto luminance = [](const XyzPicture& p, size_t i) {
    return static_cast<double>(p.xyz[3 * i + 1]);
  };
  double mean = 0;
  for (size_t i = 0; i < n; ++i) mean += luminance(wanted, i) / static_cast<double>(n);
  double squares = 0;
  for (size_t i = 0; i < n; ++i) {
    const double off =
        (luminance(is, i) - luminance(wanted, i)) / (luminance(wanted, i) + dark * mean);
    squares += off * off;
  }
  return std::sqrt(squares / static_cast<double>(n));
}

void print_room(const char* name, Air air, int64_t particles, int reference_paths) {
  // A seed other than the pictures', so that the long run is independent.
  const auto long_run = traced(air, 77, particles);
  const double before = process_seconds();
  const auto run = traced(air, 1, particles);
  const double tracing = process_seconds() - before;
  for (const bool gather : {false, true}) {
    const auto draw = [gather](const LocalRun& of, int paths) {
      PictureOptions options;
      options.paths_per_pixel = paths;
      options.gather = gather;
      options.raw = true;  // equal paths for all pixels
      const auto flux = gather ? flux_radiance(of) : nullptr;
      return trace_picture(of, 0, options, flux.get());
    };
    const TracedPicture wanted = draw(*long_run, reference_paths);
    for (const int paths : {4, 16, 64}) {
      const double start = process_seconds();
      const TracedPicture picture = draw(*run, paths);
      const double seconds = process_seconds() - start;
      // Two pictures with these numbers of paths have independent errors; this is the share of one.
      const double own = std::sqrt(reference_paths / static_cast<double>(reference_paths + paths));
      const double error = own * deviation(picture.light, wanted.light);
      const double filter_start = process_seconds();
      const FilteredView filtered = filter_traced(picture, 2);
      const double filtering = process_seconds() - filter_start;
      const double full_size = 320.0 * 180.0 / (width * height);
      const double needed = full_size * seconds * std::pow(error / wanted_error, 2);
      fmt::print("{:<12} {:<7} {:>5} {:>9.2f} {:>9.2f} % {:>12.1f} {:>12.1f} {:>9.2f} % {:>9.2f}\n",
                 name, gather ? "gather" : "full", paths, seconds, 100 * error, needed,
                 gather ? needed + tracing : needed, 100 * deviation(filtered.light, wanted.light),
                 filtering);
      std::fflush(stdout);
    }
  }
}

}  // namespace

void print_rooms(double share) {
  const auto particles = static_cast<int64_t>(share * static_cast<double>(all_particles));
  const int reference = std::max(64, static_cast<int>(share * long_paths));
  fmt::print(
      "\nPictures of a furnished room, {} x {} pixels, against one of {} paths a pixel in the same "
      "way;\nprocessor seconds to {:.0f} % are those of 320 x 180 pixels, without and with the "
      "particles'\n{:<12} {:<7} {:>5} {:>9} {:>11} {:>12} {:>12} {:>11} {:>9}\n",
      width, height, reference, 100 * wanted_error, "air", "paths", "each", "cpu [s]", "error",
      "to it [s]", "in all [s]", "filtered", "cpu [s]");
  print_room("clear", Air::clear, particles, reference);
  print_room("homogeneous", Air::homogeneous, particles, reference);
  print_room("layered", Air::layered, particles, reference);
}

}  // namespace luxodus::bench
