// Where to put emergency luminaires: candidates, what must hold of them by the rules of the scene,
// the best layout with its proof, and the verdict of an assessment on it. Whatever is returned with
// a layout has passed every check of the code mode that luminaires decide. Nothing here says that a
// building complies with a code. Thread rule: one thread, which has rows run on others; one design
// at a time in a process.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "actors/judge/assess/assessment.hpp"
#include "actors/judge/design/candidates.hpp"
#include "actors/judge/design/demands.hpp"
#include "actors/judge/design/place_tolerance.hpp"
#include "actors/judge/design/placed_layout.hpp"
#include "actors/judge/design/sign_plan.hpp"
#include "actors/judge/design/smoke_stage.hpp"
#include "actors/judge/design/solve_layout.hpp"
#include "actors/judge/design/what_binds.hpp"

namespace luxodus {

struct DesignOptions {
  std::string scenario;                        // gives the doors and the circuits; "": as assess
  std::vector<std::string> rules, deviations;  // by name; empty: those of the scene
  uint64_t seed = 1;
  int threads = 1;
  double seconds = 120;    // of the search
  bool refine = false;     // as [design] refine
  double gap = 0;          // it ends within this share of the best possible
  bool what_binds = true;  // solve again without single demands, to say what each takes
  /// Scenarios in whose smoke layouts are judged; empty: those of the scene's [design].
  std::vector<std::string> in_smoke;
  double smoke_seconds = 600;  // of judging layouts there, at most
  SceneAtTime scene_at = {};   // the scene at other times, where it has a clock
};

/// A rule that is asked for without furniture alone: with it no layout passes.
struct HiddenByFurniture {
  std::string rule;
  Subject subject;
  size_t points = 0;  // that furniture hides from all candidates
};

/// What moving luminaires has brought.
struct Refined {
  size_t moved = 0;              // luminaires
  double before = 0, after = 0;  // least share of what is planned for, over all minima
};

/// What a layout could do without if one demand were not there; as words need it.
struct BindingDemand {
  Relaxed relaxed;
  std::string luminaire;  // whose failure it is, if one's
};

/// The layout is the best by the rules alone.
struct DesignResult : PlacedLayout {
  size_t places = 0, candidates = 0;  // of new luminaires; of these and those that are there
  LeftOut left_out;
  std::vector<UnusedType> unused;  // types that last too short
  size_t points = 0;               // of calculation
  std::vector<HiddenByFurniture> hidden;
  std::vector<std::string> unlit_stair_flights;  // of stairs that no candidate lights
  std::optional<SignPlan> signs;                 // where signs were placed
  std::vector<ConstraintGroup> groups;
  std::vector<double> tightest;  // of each group: the least share of what it asks for that is there
  LayoutAnswer answer;
  std::vector<BindingDemand> because;  // what takes luminaires that would not be needed without
  std::optional<PlaceTolerance> tolerance;  // of the layout
  BetweenPoints between;  // all points that were added, and the least beside those of this layout
  std::optional<Refined> refined;  // where luminaires were moved
  Conflict conflict;               // where no layout exists
  Assessment assessment;
  std::vector<Check> others;    // checks that fail and that no luminaire of the layout decides
  bool added_scenario = false;  // the scene has none: the variant has one in emergency operation
  std::vector<std::string> rules, deviations;  // that were asked for and that the scene lacks
  int verifications = 0;
  std::optional<SmokeStage> smoke;  // where layouts were judged in smoke
  double prepared_seconds = 0;      // until the search began
};

/// Errors: as assess; no place for a luminaire; a layout that the assessment rejects for a reason
/// that no constraint can express.
Result<DesignResult> design(const std::shared_ptr<const SceneDescription>& scene,
                            const DesignOptions& options, const std::atomic<bool>& interrupt,
                            const SolveProgress& progress);

}  // namespace luxodus
