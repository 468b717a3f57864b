// Until when each layout guides: the states of a scene that changes in time are judged with every
// layout, by the same paths, for the signs that lead along the routes. Thread rule: one thread,
// which has batches traced by others.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "actors/judge/design/layout_groups.hpp"
#include "scenes/emergency/guidance.hpp"
#include "scenes/light/world/timed_scenes.hpp"

namespace luxodus {

/// How long one route guides eyes of one height, with one layout. What is undecided does not guide
/// in `least`, and guides in `most`.
struct GuidedUntil {
  std::string route;
  double height_m = 0;
  GuidedTime least, most;
};

/// The route and height that are lost first, over all of them.
struct FirstLoss {
  std::optional<double> min_s, max_s;  // the last state that guides everywhere; none: not one
  bool never_lost = false;             // surely guided in the last state, too
};
/// Requires: at least one route.
FirstLoss first_loss_of(const std::vector<GuidedUntil>& routes);

struct GuidanceOptions {
  std::vector<double> times_s;         // ascending; empty: nothing changes in time
  SceneAtTime scene_at;                // of the scene without any layout
  std::vector<std::string> scenarios;  // by name
  AssessOptions asked;
  int rounds = 3;
};

/// Of each layout of the groups, for each route and height of eyes, in the scenario in which it is
/// lost first. Requires: a scenario.
/// Errors: as the reader; as LayoutGroupState::make and SightsInLights::trace; `interrupt`.
Result<std::vector<std::vector<GuidedUntil>>> guidance_of(const std::vector<LayoutGroup>& groups,
                                                          size_t layouts,
                                                          const GuidanceOptions& options,
                                                          const std::atomic<bool>& interrupt,
                                                          const AssessProgress& progress);

}  // namespace luxodus
