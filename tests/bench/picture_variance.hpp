// Variance and time of picture paths, for the views that tables compare. One thread.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "actors/results/pictures/pictures.hpp"

namespace luxodus::bench {

/// A view of a shipped scene.
struct ScenarioView {
  const char* file;  // in scenes/library
  const char* scenario;
  const char* view;
};
/// Views of the office floor and of the auditorium, in smoke and in clear air.
std::span<const ScenarioView> compared_views();

/// A run of this many particles.
std::unique_ptr<LocalRun> traced_run(const ScenarioView& of, int64_t particles);

/// Statistics of the paths of a view's pixels.
struct PathVariance {
  double path_s = 0;  // CPU time per path
  double mean = 0, error_of_mean = 0;
  /// Relative variance of one path; means over the pixels.
  double variance = 0, without_brightest = 0;

  double merit() const { return 1 / (variance * path_s); }
};

/// Traces `paths` paths for each pixel of the run's picture. `flux`: where they end, or null.
/// `learned`: whether emitters are chosen by learned importance; the time includes learning.
PathVariance variance_of_paths(const LocalRun& run, const RadianceCache* flux, bool learned,
                               int paths);

}  // namespace luxodus::bench
