// The second stage of a design: judges what people on the routes read of the signs in smoke, with
// each of several layouts. Elimination rounds give more paths to layouts that cannot be ranked yet.
// All layouts have passed the rules before; nothing here relaxes them.
// Thread rule: one thread, which has rows computed by others.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "actors/judge/assess/assessment.hpp"
#include "actors/judge/design/layout_guidance.hpp"
#include "actors/judge/design/layout_people.hpp"
#include "actors/judge/design/low_signs.hpp"
#include "actors/judge/design/placed_layout.hpp"
#include "actors/judge/design/smoke_differences.hpp"
#include "actors/judge/design/smoke_verdicts.hpp"

namespace luxodus {

/// Factor on the luminance of signs in the variant with brighter signs.
inline constexpr double brighter_signs = 2;

struct SmokeVerdict {
  std::string scenario;
  std::vector<LegibleShare> by_height;  // for each of the scene's eye heights
  LegibleShare all;
  ShareDifference beyond_first = {};  // difference of `all` from the first layout
};

struct JudgedLayout {
  std::string name;  // "A" is the best layout by the rules
  PlacedLayout layout;
  double objective = 0, cost = 0, watts = 0;  // of what the layout places
  size_t placed = 0;                          // number of luminaires
  double sign_factor = 1;                     // on the luminance of signs
  std::vector<LowSign> low_signs;             // added to the high signs
  int rounds = 0;                             // of paths; 0: not judged
  std::vector<SmokeVerdict> smoke;
  /// Places on routes from which a sign is read with "A" but not with this layout, and the reverse.
  size_t lost = 0, won = 0;
  bool on_front = false;  // no other layout is read more at no higher cost
  bool is_open = false;   // more paths could change its rank
  /// For each route and eye height, in the scenario where guidance is lost first. Empty unless the
  /// scene changes in time and signs lead along routes.
  std::vector<GuidedUntil> guided;
  std::optional<PeopleUnread> people;  // none unless people were followed with every layout

  /// Whether it has the signs of the first layout, neither brighter nor more.
  bool has_usual_signs() const { return sign_factor == 1 && low_signs.empty(); }
  /// Legible share in the worst scenario.
  LegibleShare worst() const;
  /// Difference of that share from the first layout. If the worst scenarios differ, an interval
  /// over the differences in all scenarios.
  ShareDifference beyond_first() const;
};

/// Difference of two layouts: by their ranges, and by the differences of both from the first
/// layout.
ShareDifference difference_of(const JudgedLayout& from, const JudgedLayout& to);

/// What ended the elimination rounds.
enum class RaceEnd {
  decided,      // more paths could not change the ranking
  rounds,       // the last round was traced
  time,         // time was up
  interrupted,  // by the user
};
/// "decided", ...
const char* name_of(RaceEnd end);

struct SmokeStage {
  std::vector<std::string> scenarios;
  std::vector<double> heights_m;
  std::vector<JudgedLayout> layouts;  // by name
  RaceEnd end = RaceEnd::decided;
  size_t traces = 0;            // number of groups
  std::vector<double> times_s;  // of the states over which guidance was followed
  int64_t paths = 0;            // number of paths from eyes
  double seconds = 0;

  /// Among layouts with unchanged signs: the first, unless signs are certainly read from more
  /// places with another one, or certainly from as many at a lower objective. Where people were
  /// followed, unless they are certainly without a sign for a shorter time with another one, or
  /// certainly not longer at a lower objective. Requires: a layout.
  const JudgedLayout& recommended() const;
  /// The layout with brighter signs; null if there is none.
  const JudgedLayout* with_brighter_signs() const;
  /// The layout with low-level signs; null if no wall has room for any.
  const JudgedLayout* with_low_signs() const;
};

struct SmokeStageOptions {
  std::vector<std::string> scenarios;
  uint64_t seed = 1;
  int threads = 1;
  int rounds = 4;  // largest number of rounds; each has four times the paths of the one before
  double seconds = 600;  // until the elimination rounds end, decided or not
  bool together = true;  // share paths between layouts if possible
  /// Reads the building at other times, to find until when layouts guide; empty: it does not
  /// change.
  SceneAtTime scene_at = {};
  std::vector<PlacedPerson> people = {};  // who are followed with each layout
};

/// Judges layouts that pass the rules. The first is the best of them; copies of it with brighter
/// signs and with low-level signs are judged as well. When time is up or at `interrupt`, results so
/// far are kept. Errors: no such scenario; a scenario without smoke; as assess_sights.
Result<SmokeStage> judge_in_smoke(std::vector<JudgedLayout> layouts,
                                  const SmokeStageOptions& options,
                                  const std::atomic<bool>& interrupt,
                                  const std::function<void(const std::string&)>& progress);

/// Checks the scenarios and the people before anything is computed. Errors: no such scenario; a
/// scenario without smoke; no route, or no sign; as check_followed_people.
Result<void> check_smoke_stage(const std::shared_ptr<const SceneDescription>& scene,
                               const SmokeStageOptions& options);

}  // namespace luxodus
