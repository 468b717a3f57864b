// Until when each layout guides, in a scene that changes in time. Each state is judged with every
// layout from the same paths, for the signs that lead along routes. Thread rule: one thread, which
// has batches traced by others.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "actors/judge/design/layout_groups.hpp"
#include "scenes/emergency/guidance.hpp"
#include "scenes/light/world/timed_scenes.hpp"

namespace luxodus {

/// Until when one route guides people of one eye height, with one layout. Undecided views do not
/// guide in `least`, and guide in `most`.
struct GuidedUntil {
  std::string route;
  double height_m = 0;
  GuidedTime least, most;
};

/// The earliest loss of guidance over all routes and eye heights.
struct FirstLoss {
  /// The last state with guidance everywhere [s]; none: not even the first.
  std::optional<double> min_s, max_s;
  bool never_lost = false;  // certainly guided in the last state as well
};
/// Requires: at least one route.
FirstLoss first_loss_of(const std::vector<GuidedUntil>& routes);

struct GuidanceOptions {
  std::vector<double> times_s;         // ascending; empty: nothing changes in time
  SceneAtTime scene_at;                // reads the scene without a layout
  std::vector<std::string> scenarios;  // names
  AssessOptions asked;
  int rounds = 3;
};

/// For each layout, its guidance for each route and eye height, in the scenario in which it is lost
/// first. Requires: a scenario.
/// Errors: as the reader, HeatState::make and SightsInLights::trace; `interrupt`.
Result<std::vector<std::vector<GuidedUntil>>> guidance_of(const std::vector<LayoutGroup>& groups,
                                                          size_t layouts,
                                                          const GuidanceOptions& options,
                                                          const std::atomic<bool>& interrupt,
                                                          const AssessProgress& progress);

}  // namespace luxodus
