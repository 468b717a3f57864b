// The second stage of a design: what people on the routes read of the signs, in smoke, with each of
// several layouts. Layouts race: paths are spent where two cannot be told apart. Nothing here is
// allowed to go below the rules; layouts come here when they have passed them.
// Thread rule: one thread, which has rows run on others.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "actors/judge/assess/assessment.hpp"
#include "actors/judge/design/layout_guidance.hpp"
#include "actors/judge/design/low_signs.hpp"
#include "actors/judge/design/placed_layout.hpp"
#include "actors/judge/design/smoke_differences.hpp"
#include "actors/judge/design/smoke_verdicts.hpp"

namespace luxodus {

/// Signs of the best layout are tried so many times as bright.
inline constexpr double brighter_signs = 2;

struct SmokeVerdict {
  std::string scenario;
  std::vector<LegibleShare> by_height;  // of the scene's eye heights
  LegibleShare all;
  ShareDifference beyond_first = {};  // of `all`
};

struct JudgedLayout {
  std::string name;  // "A" is the best by the rules alone
  PlacedLayout layout;
  double objective = 0, cost = 0, watts = 0;  // of what it places
  size_t placed = 0;                          // luminaires
  double sign_factor = 1;                     // of the luminance of signs
  std::vector<LowSign> low_signs;             // beside those above
  int rounds = 0;                             // of paths that it was judged by; 0: it was not
  std::vector<SmokeVerdict> smoke;
  /// Places on routes from which a sign is read with "A" and not with this one; the other way.
  size_t lost = 0, won = 0;
  bool on_front = false;  // none is read more and costs no more
  bool is_open = false;   // more paths could change its place among the others
  /// Of each route and height of eyes, where the scene changes in time and signs lead along routes;
  /// in the scenario where signs are lost first.
  std::vector<GuidedUntil> guided;

  /// Whether its signs are those of the first layout, no brighter and no more.
  bool has_usual_signs() const { return sign_factor == 1 && low_signs.empty(); }
  /// In the scenario where it is worst.
  LegibleShare worst() const;
  /// Of that, by how much more is read than with the first layout. Where both are worst in
  /// different scenarios, it is what they differ by in any.
  ShareDifference beyond_first() const;
};

/// By how much more is read with one layout than with another: by their ranges, and by what both
/// differ from the first layout by.
ShareDifference difference_of(const JudgedLayout& from, const JudgedLayout& to);

/// What ended the race of layouts.
enum class RaceEnd {
  decided,      // no more paths could change their order
  rounds,       // there are no more of them
  time,         // it was up
  interrupted,  // by a person
};
/// "decided", ...
const char* name_of(RaceEnd end);

struct SmokeStage {
  std::vector<std::string> scenarios;
  std::vector<double> heights_m;
  std::vector<JudgedLayout> layouts;  // by name
  RaceEnd end = RaceEnd::decided;
  size_t traces = 0;            // of layouts together, or of each by itself
  std::vector<double> times_s;  // over which layouts were followed
  int64_t paths = 0;            // from eyes
  double seconds = 0;

  /// Of the layouts with signs as they are: the first, unless with another one signs are surely
  /// read from more places, or surely from as many for less. Requires: a layout.
  const JudgedLayout& recommended() const;
  /// The one whose signs are brighter; null where there is none.
  const JudgedLayout* with_brighter_signs() const;
  /// The one with low-level signs beside the others; null where no wall has room for any.
  const JudgedLayout* with_low_signs() const;
};

struct SmokeStageOptions {
  std::vector<std::string> scenarios;
  uint64_t seed = 1;
  int threads = 1;
  int rounds = 4;        // of paths at most, each of four times as many
  double seconds = 600;  // until the race ends, decided or not
  bool together = true;  // layouts share paths where that pays; else each has its own
  /// The building at other times, to say until when layouts guide; empty: it does not change.
  SceneAtTime scene_at = {};
};

/// Judges layouts that pass the rules; the first is the best by them, of which a copy with brighter
/// signs, and one with low-level signs, are judged as well. The end of the time and `interrupt`
/// keep what was judged so far. Errors: no such scenario; one without smoke; as assess_sights.
Result<SmokeStage> judge_in_smoke(std::vector<JudgedLayout> layouts,
                                  const SmokeStageOptions& options,
                                  const std::atomic<bool>& interrupt,
                                  const std::function<void(const std::string&)>& progress);

/// Sees which scenarios there are, before anything is computed.
/// Errors: no such scenario; one without smoke; no route, or no sign.
Result<void> check_smoke_stage(const SceneDescription& scene,
                               const std::vector<std::string>& scenarios);

}  // namespace luxodus
