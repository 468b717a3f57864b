// Gain of picture paths that choose emitters by learned importance of cells of space over the
// choice by power and distance alone: variance of luminance by CPU time, on the same pixels,
// alternating. And the absolute values for each view, for comparing programs.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/bench/picture_variance.hpp"
#include "tests/bench/tables.hpp"

namespace luxodus::bench {

namespace {

constexpr int64_t max_particles = 1 << 24;
constexpr int max_paths = 2048;

int64_t particles_of(double share) {
  return static_cast<int64_t>(share * static_cast<double>(max_particles));
}
int paths_of(double share) {
  return std::max(16, static_cast<int>(share * max_paths));
}

void print_choice_of(const ScenarioView& of, int64_t particles, int paths) {
  const auto run = traced_run(of, particles);
  const auto flux = flux_radiance(*run);
  for (const bool gather : {true, false}) {
    const RadianceCache* ends = gather ? flux.get() : nullptr;
    const PathVariance old = variance_of_paths(*run, ends, false, paths);
    const PathVariance now = variance_of_paths(*run, ends, true, paths);
    fmt::print(
        "{:<16} {:<10} {:<7} {:>7.2f} {:>7.2f} {:>7.2f} {:>7.2f} {:>7.2f} {:>7.2f} {:>7.2f} "
        "{:>8.4f} +- {:.4f}\n",
        of.scenario, of.view, gather ? "gather" : "full", 1e6 * old.path_s, 1e6 * now.path_s,
        old.variance, now.variance, old.without_brightest, now.without_brightest,
        now.merit() / old.merit(), now.mean / old.mean,
        std::hypot(now.error_of_mean / now.mean, old.error_of_mean / old.mean));
    std::fflush(stdout);
  }
}

}  // namespace

void print_choice(double share) {
  const int paths = paths_of(share);
  fmt::print(
      "\nEmitters chosen by power and distance, and by what cells have learned; {} paths a "
      "pixel:\ntime of a path [us], relative variance of its luminance (also without the worst "
      "thousandth of\nthe pixels), gain in merit, mean over mean\n{:<16} {:<10} {:<7} {:>7} {:>7} "
      "{:>7} {:>7} {:>7} {:>7} {:>7} {:>8}\n",
      paths, "scenario", "view", "paths", "us", "learned", "var", "learned", "var'", "learned",
      "merit", "mean");
  for (const ScenarioView& view : compared_views())
    print_choice_of(view, particles_of(share), paths);
}

void print_views(double share) {
  const int paths = paths_of(share);
  fmt::print(
      "\nViews by final gather, {} paths a pixel: time of a path [us], relative variance of its\n"
      "luminance (also without the worst thousandth of the pixels), merit of a path, mean "
      "luminance\n{:<16} {:<14} {:>7} {:>7} {:>7} {:>9} {:>9}\n",
      paths, "scenario", "view", "us", "var", "var'", "merit", "mean");
  for (const ScenarioView& view : compared_views()) {
    const auto run = traced_run(view, particles_of(share));
    const auto flux = flux_radiance(*run);
    const PathVariance found = variance_of_paths(*run, flux.get(), true, paths);
    fmt::print("{:<16} {:<14} {:>7.2f} {:>7.3f} {:>7.3f} {:>9.0f} {:>9.5f} +- {:.5f}\n",
               view.scenario, view.view, 1e6 * found.path_s, found.variance,
               found.without_brightest, found.merit(), found.mean, found.error_of_mean);
    std::fflush(stdout);
  }
}

}  // namespace luxodus::bench
