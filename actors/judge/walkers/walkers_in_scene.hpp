// People who choose their way, in a scene: where they can stand, which routes and signs are on
// their floor, what they read, and where they go. Thread rule: one thread, which has rows and
// batches traced by others.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "actors/judge/assess/over_time.hpp"
#include "actors/judge/walkers/people.hpp"

namespace luxodus {

struct WalkersRequest {
  StatesToAssess states;          // the scene over time, or its only state
  AssessOptions options;          // as of SignEstimates
  PeopleOptions people;           // from_s and until_s of a scene with a clock lie within it
  std::string within;             // room or open area in which people start; "": the whole floor
  std::optional<double> floor_m;  // none: that of `within`, or the only floor
  double cell_m = 0.1;
};

/// The routes by which people left, or are on their way.
struct RouteUse {
  std::string route;
  size_t left = 0, inside = 0;
};

struct WalkersWalked {
  std::string scenario;
  double floor_m = 0;
  double start_m2 = 0;  // of the floor on which people start
  size_t signs = 0;     // that lead along a route of this floor
  PeopleWalked walked;
  std::vector<RouteUse> routes;  // of this floor, in the order of the scene
  glm::dvec2 low{0}, high{0};    // box of the floor [m]
};

/// Errors: a floor that is not known; an unknown room; nowhere to stand, or less room than people;
/// as check_walkable, check_people, FreeSpace::make, WaysOut::make, SignEstimates::make and
/// walk_people; `interrupt`.
Result<WalkersWalked> walk_in_scene(const WalkersRequest& request,
                                    const std::atomic<bool>& interrupt,
                                    const AssessProgress& progress);

}  // namespace luxodus
