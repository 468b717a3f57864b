// People followed through a scene over time: places are checked against walls, what signs give to
// their eyes is estimated (visibility_map), and smoke is measured at their eyes. Thread rule: one
// thread, which has rows and batches traced by others.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "actors/judge/assess/over_time.hpp"
#include "actors/judge/walk/follow.hpp"
#include "actors/judge/walk/wall_check.hpp"

namespace luxodus {

struct WalkRequest {
  StatesToAssess states;  // the scene over time, or its only state
  AssessOptions options;  // as of SignEstimates
  WalkOptions walk;
  std::vector<PlacedPerson> people;  // at least one
};

struct WalkOfScene {
  std::string scenario;
  std::vector<double> times_s;  // of the states; empty: one state
  WallCheck walls;
  std::vector<WalkedPerson> walks;
  double sure_errors = 0;  // as in SignEstimates; the largest of all groups
};

/// What walk_scene checks before it traces anything. Errors: no such scenario; a scene without
/// signs; a person at a time outside of the states; as check_steps and check_walls.
Result<WallCheck> check_walk(const WalkRequest& request);

/// Errors: as check_walk and SignEstimates::make; `interrupt`.
Result<WalkOfScene> walk_scene(const WalkRequest& request, const std::atomic<bool>& interrupt,
                               const AssessProgress& progress);

}  // namespace luxodus
