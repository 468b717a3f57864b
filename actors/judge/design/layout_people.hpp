// How long people who walk are without a sign that they read, with each of several layouts: in a
// scene that changes in time at its states, else in its only one. Thread rule: one thread, which
// has batches traced by others.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "actors/judge/assess/assessment.hpp"
#include "actors/judge/walk/follow.hpp"
#include "scenes/light/world/timed_scenes.hpp"

namespace luxodus {

/// Person-seconds without a sign that is read. Undecided ones count in `most_s` alone.
struct PeopleUnread {
  double least_s = 0, most_s = 0;
  double all_s = 0;  // person-seconds of everybody
  /// Whether people are surely longer without a sign than with another layout.
  bool surely_more_than(const PeopleUnread& other) const { return least_s > other.most_s; }
  bool surely_no_more_than(const PeopleUnread& other) const { return most_s <= other.least_s; }
};

struct PeopleQuestion {
  std::vector<PlacedPerson> people;  // empty: nobody is followed
  WalkOptions walk;
  std::vector<std::string> scenarios;  // names; the worst one counts
  SceneAtTime scene_at;                // reads the scene without a layout; empty: it has no clock
  uint64_t seed = 1;
  int threads = 1;
};

/// What people_unread checks before it traces anything: the people do not depend on the layout, so
/// a design asks this of the scene before it searches. Errors: as check_walk.
Result<void> check_followed_people(const std::shared_ptr<const SceneDescription>& scene,
                                   const PeopleQuestion& question);

/// For a layout, as the scene that contains it. Requires: people, a scenario. Errors: as
/// walk_scene; `interrupt`.
Result<PeopleUnread> people_unread(const std::shared_ptr<const SceneDescription>& variant,
                                   const PeopleQuestion& question,
                                   const std::atomic<bool>& interrupt,
                                   const AssessProgress& progress);

}  // namespace luxodus
