// Variance of paths of pictures and the time that they take, of the views that tables compare.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "actors/results/pictures/pictures.hpp"

namespace luxodus::bench {

/// A view of a scene that ships.
struct ScenarioView {
  const char* file;  // of scenes/library
  const char* scenario;
  const char* view;
};
/// Those of the office floor and of the auditorium, in smoke and in clear air.
std::span<const ScenarioView> compared_views();

/// After so many particles.
std::unique_ptr<LocalRun> traced_run(const ScenarioView& of, int64_t particles);

/// What the paths of a view's pixels have found.
struct PathVariance {
  double path_s = 0;  // processor time of a path
  double mean = 0, error_of_mean = 0;
  /// Relative, of one path; means over the pixels.
  double variance = 0, without_brightest = 0;

  double merit() const { return 1 / (variance * path_s); }
};

/// So many paths of each pixel of the picture of a run. `flux`: where they end, or null. `learned`:
/// whether emitters are chosen by what cells of space have learned; learning is in the time.
PathVariance variance_of_paths(const LocalRun& run, const KnownRadiance* flux, bool learned,
                               int paths);

}  // namespace luxodus::bench
