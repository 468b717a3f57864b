// The second stage of a design: what people on the routes read of the signs, in smoke, with each of
// several layouts. Layouts race: paths are spent where two cannot be told apart. Nothing here is
// allowed to go below the rules; layouts come here when they have passed them.
// Thread rule: one thread, which has rows run on others.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "actors/assess/assessment.hpp"
#include "actors/design/low_signs.hpp"
#include "actors/design/placed_layout.hpp"

namespace luxodus {

/// A sign is ahead of a walker within this angle of the way [deg].
inline constexpr double ahead_deg = 60;
/// Signs of the best layout are tried so many times as bright.
inline constexpr double brighter_signs = 2;

/// Of the length of all routes: the share from which a sign ahead is read. What is undecided counts
/// as not read in `least`, and as read in `most`.
struct LegibleShare {
  double least = 0, most = 0;  // [1]
};

struct SmokeVerdict {
  std::string scenario;
  std::vector<LegibleShare> by_height;  // of the scene's eye heights
  LegibleShare all;
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

  /// Whether its signs are those of the first layout, no brighter and no more.
  bool has_usual_signs() const { return sign_factor == 1 && low_signs.empty(); }
  /// In the scenario where it is worst.
  LegibleShare worst() const;
};

struct SmokeStage {
  std::vector<std::string> scenarios;
  std::vector<double> heights_m;
  std::vector<JudgedLayout> layouts;  // by name
  bool interrupted = false;           // before all were judged
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
  int rounds = 3;  // of paths at most, each of four times as many
};

/// Judges layouts that pass the rules; the first is the best by them, of which a copy with brighter
/// signs, and one with low-level signs, are judged as well. `interrupt` keeps what was judged so
/// far. Errors: no such scenario; one without smoke; as assess_sights.
Result<SmokeStage> judge_in_smoke(std::vector<JudgedLayout> layouts,
                                  const SmokeStageOptions& options,
                                  const std::atomic<bool>& interrupt,
                                  const std::function<void(const std::string&)>& progress);

/// Sees which scenarios there are, before anything is computed.
/// Errors: no such scenario; one without smoke; no route, or no sign.
Result<void> check_smoke_stage(const SceneDescription& scene,
                               const std::vector<std::string>& scenarios);

}  // namespace luxodus
