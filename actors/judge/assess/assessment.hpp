// Options and results of an assessment: the rules of the codes by direct light in clear air (code
// mode), and what people on the escape routes read of the signs with all light and smoke (reality
// mode). Results are plain values that any thread may read. `assess` runs on one thread, which has
// rows and batches traced by others.
#pragma once

#include <atomic>
#include <functional>
#include <memory>

#include "actors/judge/assess/judged_state.hpp"
#include "actors/judge/assess/line_of_sight.hpp"
#include "actors/judge/assess/wrong_verdicts.hpp"
#include "actors/judge/inspect/inspect.hpp"
#include "actors/judge/record/assessment_record.hpp"
#include "actors/results/run/run_executor.hpp"
#include "scenes/emergency/rules.hpp"

namespace luxodus {

namespace limits {
/// Pairs of a place and a sign; each costs three tallies and their paths.
inline constexpr size_t sights = 200'000;
/// Rounds of paths from eyes; each has four times the paths of the one before.
inline constexpr int sight_rounds = 8;
/// Distinct shares of new light that aged luminaires have; each costs tallies of its own.
inline constexpr size_t ageings = 16;
}  // namespace limits

struct SightRow;

struct AssessOptions {
  /// Judged in the reality mode; the code mode takes its doors. Empty: see judged_scenario.
  std::string scenario;
  std::vector<std::string> rules, deviations;  // by name; empty: those of the scene
  uint64_t seed = 1;
  int threads = 1;
  RunExecutor* executor = nullptr;  // traces the rounds; null: threads of this process
  int rounds = 4;                   // at most; fewer if nothing is undecided
  bool reality = true;              // false: code mode only
  std::string sign;                 // name of the only sign to judge; "": all signs
  /// Selects views to judge before their light is known; empty: all views.
  std::function<bool(const SightRow& view)> wanted = {};
  /// Whether the light of a view is known well enough to be traced no longer; empty: once its
  /// verdict is decided.
  std::function<bool(const SightRow& view)> enough = {};
  std::vector<double> smoke_factors = {};  // for a sweep: factors on the extinction of all smoke
  bool place_unknown = false;              // as in SightRules
  /// Expected number of verdicts on views that noise makes wrong, at most.
  double wrong_verdicts = limits::wrong_verdicts;
  /// Distance of a value from its limit at which a verdict is given, in standard errors; none: as
  /// small as wrong_verdicts allows.
  std::optional<double> sure_errors = {};

  /// The options of one of several parts of a report.
  AssessOptions one_of(size_t parts) const {
    AssessOptions out = *this;
    out.wrong_verdicts /= static_cast<double>(parts);
    return out;
  }
};

/// Illuminance of an eye that looks at a sign, straight from all emitters but that sign, by the
/// aged light [lx].
struct EyeLight {
  double lux = 0;
  double clear_air_lux = 0;  // without the smoke
};

/// The view of one sign from one place.
struct SightRow {
  Subject from;           // a route, an open area or an observer
  double stands_for = 0;  // metres of a route or square metres of an area; 0 for an observer
  double along_m = 0;
  double height_m = 0;  // of the eye above the floor; for an observer above z = 0
  glm::dvec3 eye{0};
  std::string sign;
  bool back_face = false;
  double gaze_deg = 0;  // between walking direction and sign; NaN in areas
  SignView view;
  /// The result that counts: in aged or new light, whichever gives the worse verdict.
  SignLook look;
  Sight sight;
  LineOfSight line;
  EyeLight eye_light;         // of a view that light decides
  bool in_new_light = false;  // `look` and `sight` are those of new light
  /// Result in the other of the two lights; none if lit luminaires do not age, or if light does not
  /// decide the verdict.
  struct Other {
    SignLook look;
    Sight sight;
  };
  std::optional<Other> other;
  /// What the other eyes of the scene read, in its order; empty where light does not decide.
  std::vector<Sight> by_other_eyes;
};

/// A warning for the designer.
struct StateWarning {
  SourcePlace place;
  std::optional<Remark> remark;  // none: `words` is the text
  std::string words = {};        // English
  bool by_inspection = false;    // also among the findings of the inspection
};

struct Assessment {
  AssessedState state;
  bool reality = true;  // whether views were judged
  std::vector<Check> checks;
  std::vector<SightRow> sights;
  std::vector<SweepRow> sweep;
  std::optional<OverTime> over_time;
  std::vector<PlanLevel> levels;        // from below; at least one
  std::vector<SurfaceRecord> surfaces;  // routes, open areas, task areas that have points
  /// Heights of the floors of their storeys, by luminaire and sign of the scene [m].
  std::vector<std::optional<double>> luminaire_floors, sign_floors;
  std::vector<StateWarning> warnings;
  std::vector<Finding> findings;  // of the inspection; its warnings are in `warnings` as well
  int64_t paths = 0;              // number of paths from eyes in all rounds
  double sure_errors = 0;         // as in SightRules, of `sights`
  double seconds = 0;
  uint64_t scene_hash = 0;
  uint64_t seed = 1;
  bool place_unknown = false;  // as in SightRules
};

/// Reports the current work and the share of it that is done.
using AssessProgress = std::function<void(const std::string& what, double share)>;

/// Assesses one state of a scene. Errors: as judged_scenario, judged_codes, irritation_is_said;
/// nothing to assess; a finding of severity error, such as a route outside the building or in a
/// wall; a pack instead of a scene file; `interrupt`.
Result<Assessment> assess(const std::shared_ptr<const SceneDescription>& scene,
                          const AssessOptions& options, const std::atomic<bool>& interrupt,
                          const AssessProgress& progress);

}  // namespace luxodus
