// People who choose their way out of one floor: each walks the remembered way in until a sign is
// read, and then where it leads. Nobody avoids anybody, and nobody uses stairs. What eyes
// read and how dense the smoke is at them is asked of others. It is no simulation of an
// evacuation. Model and sources: docs/decisions/0098-people-who-choose.md. One thread.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "actors/judge/visibility_map/sign_answer.hpp"
#include "actors/judge/walkers/ways_out.hpp"
#include "scenes/formats/trajectories/write_trajectories.hpp"

namespace luxodus {

namespace limits {
/// People of one command.
inline constexpr int walkers = 10'000;
/// People on a square metre of the floor on which they start: a packed crowd.
inline constexpr double walkers_per_m2 = 4;
}  // namespace limits

/// Frames of trajectories in a second: a walker goes some 0.13 m in one.
inline constexpr int walker_fps = 10;

struct PeopleOptions {
  int count = 100;
  std::string came_by;                      // name of the route; "": that whose end is nearest
  double leave_from_s = 0, leave_to_s = 0;  // drawn evenly between them; times of the clock
  /// Of the speed in clear air: mean and standard deviation of a normal distribution, cut off at
  /// two deviations on both sides [m/s]. Weidmann, "Transporttechnik der Fußgänger" (ETH Zürich,
  /// 1993).
  double speed_m_s = 1.34, speed_deviation_m_s = 0.26;
  double look_s = 1;  // time between two looks; a whole number of frames counts
  double field_of_view_deg = 120;
  uint64_t seed = 1;
  double from_s = 0, until_s = 600;  // of the clock
};

/// Errors: a number of people, a time or a speed that nobody can have; more rows than
/// limits::written_rows. Nothing is allocated.
Result<void> check_people(const PeopleOptions& options);

/// What the eyes of people find, all at one time of the clock. Times do not descend.
struct FoundByEyes {
  std::vector<SignAnswer> answers;  // element eye * signs + sign
  std::vector<double> extinctions;  // at the eyes [1/m]
};
using AskEyes =
    std::function<Result<FoundByEyes>(double time_s, const std::vector<glm::dvec3>& eyes)>;

/// The floor on which people walk, and the signs that they may follow.
struct PeopleFloor {
  const SceneDescription& scene;
  const FreeSpace& space;
  double floor_m = 0, eye_height_m = 0;
  std::vector<uint32_t> signs;          // of the scene
  std::vector<CellNumber> start_cells;  // each once; from each an end of a route can be reached
};

struct WalkerOutcome {
  size_t way = 0;                // of WaysOut, at the end
  std::optional<uint32_t> sign;  // of the scene, the last one followed; none: remembered way
  std::optional<double> left_s;  // of the clock; none: still inside
};

struct PeopleWalked {
  std::vector<WalkerOutcome> people;  // in the order of their ids, from 1
  std::vector<WrittenPlace> places;   // by frame, then by id
  /// Looks of all people on their way, and those in which nothing new was read, but perhaps could
  /// be: a sign in view that leads was undecided.
  size_t looks = 0, undecided_looks = 0;
};

/// Moves all people. Requires: check_people; enough start cells. Errors: as `ask`; a named way in
/// that is not on this floor or cannot be reached from a start.
Result<PeopleWalked> walk_people(const PeopleFloor& floor, const PeopleOptions& options,
                                 WaysOut& ways, const AskEyes& ask,
                                 const std::function<void(double share)>& progress);

}  // namespace luxodus
