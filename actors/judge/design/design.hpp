// Places emergency luminaires: finds candidates, derives demands from the rules of the scene,
// solves for the best layout with a lower bound, and assesses it. A returned layout has passed
// every check of the code mode that luminaires decide. Nothing here says that a building complies
// with a code. Thread rule: one thread, which has rows computed by others; one design at a time in
// a process.
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
  std::string scenario;                        // gives doors and circuits; "": as in an assessment
  std::vector<std::string> rules, deviations;  // by name; empty: those of the scene
  uint64_t seed = 1;
  int threads = 1;
  double seconds = 120;    // of the search
  bool refine = false;     // as [design] refine
  double gap = 0;          // stop when the objective is within this share of the bound
  bool what_binds = true;  // solve again without single demands, to find what each costs
  /// Scenarios in whose smoke layouts are judged; empty: those of [design].
  std::vector<std::string> in_smoke;
  double smoke_seconds = 600;  // largest time for judging in smoke
  SceneAtTime scene_at = {};   // reads the scene at other times; empty: it has no clock
  /// Who are followed with the layouts that are judged in smoke, which are then ranked by how long
  /// they are without a sign that they read; empty: by the routes.
  std::vector<PlacedPerson> people = {};
};

/// A rule required without furniture only, since no layout passes it with furniture.
struct HiddenByFurniture {
  std::string rule;  // "E6", or several: "E6, E6d"
  Subject subject;
  size_t points = 0;  // points that furniture hides from all candidates
  static constexpr void fields(auto&& field, auto& m) {
    field("rule", m.rule)("subject", m.subject)("points", m.points);
  }
};

/// Effect of moving luminaires.
struct Refined {
  size_t moved = 0;              // number of luminaires
  double before = 0, after = 0;  // least share of the planned value over all minima
  static constexpr void fields(auto&& field, auto& m) {
    field("moved", m.moved)("least_before", m.before, {.or_null = true});
    field("least_after", m.after, {.or_null = true});
  }
};

/// Saving without one demand, with what a sentence needs.
struct BindingDemand {
  Relaxed relaxed;
  std::string luminaire;  // the luminaire whose failure is the demand, if it is one
};

/// The base is the best layout by the rules.
struct DesignResult : PlacedLayout {
  size_t places = 0, candidates = 0;  // places of new luminaires; candidates with existing ones
  LeftOut left_out;
  std::vector<UnusedType> unused;  // types whose battery does not last long enough
  size_t points = 0;               // number of points of calculation
  std::vector<HiddenByFurniture> hidden;
  std::vector<std::string> unlit_stair_flights;  // flights of stairs that no candidate lights
  std::optional<SignPlan> signs;                 // set if signs were placed
  std::vector<ConstraintGroup> groups;
  std::vector<double> tightest;  // for each group, the least share of the required value
  LayoutAnswer answer;
  std::vector<BindingDemand> because;       // demands that cost luminaires
  std::optional<PlaceTolerance> tolerance;  // of the layout off its places
  BetweenPoints between;           // all added points; least share between points in this layout
  std::optional<Refined> refined;  // set if luminaires were moved
  Conflict conflict;               // set if no layout exists
  Assessment assessment;
  std::vector<Check> others;    // failing checks that no luminaire of the layout decides
  bool added_scenario = false;  // the variant adds one, in emergency operation
  std::vector<std::string> rules, deviations;  // given by options, missing in the scene
  int verifications = 0;
  std::optional<SmokeStage> smoke;  // set if layouts were judged in smoke
  double prepared_seconds = 0;      // until the search began
};

/// Errors: as assess; no place for a luminaire; the assessment rejects the layout for a reason that
/// no constraint can express.
Result<DesignResult> design(const std::shared_ptr<const SceneDescription>& scene,
                            const DesignOptions& options, const std::atomic<bool>& interrupt,
                            const SolveProgress& progress);

}  // namespace luxodus
