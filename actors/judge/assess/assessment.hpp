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
#include "actors/judge/inspect/inspect.hpp"
#include "actors/results/run/run_executor.hpp"
#include "scenes/emergency/guidance.hpp"
#include "scenes/emergency/legibility.hpp"
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
  std::vector<double> smoke_factors = {};  // for a sweep: factors on the extinction of all smoke
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
  bool in_new_light = false;  // `look` and `sight` are those of new light
  /// Result in the other of the two lights; none if lit luminaires do not age, or if light does not
  /// decide the verdict.
  struct Other {
    SignLook look;
    Sight sight;
  };
  std::optional<Other> other;
};

/// A point of calculation on a plan, with all emergency luminaires lit [lx].
struct PlanPoint {
  glm::dvec3 place;
  double lux = 0;
};

/// Direct light of all emergency luminaires on a grid over a floor, without furniture [lx].
struct LightMap {
  glm::dvec2 corner{0};  // of the first grid point
  double spacing_m = 0;
  int columns = 0, rows = 0;  // along x, along y
  std::vector<double> lux;    // row by row, columns times rows values
};

/// One floor of the building, for its plan.
struct PlanLevel {
  double floor_m = 0;
  std::vector<std::pair<glm::dvec2, glm::dvec2>> walls, furniture;  // sections at breast height
  std::vector<PlanPoint> points;  // points of calculation on its routes and open areas
  LightMap map;
};

/// For one sign and one smoke density: from how many of the places that it faces it is legible.
struct SweepRow {
  double factor = 1;  // on all extinctions
  std::string sign;
  int64_t places = 0, legible = 0, undecided = 0;
};

/// A state of an assessment over time.
struct TimedState {
  double at_s = 0;
  Operation operation = Operation::mains;
  std::optional<double> seconds_after_failure;
  size_t lit = 0;  // number of lit luminaires
  struct Frame {
    std::string medium;
    double time_s = 0;
  };
  std::vector<Frame> frames;  // times whose smoke the fire simulations give
};

/// How one route guides people of one eye height, over all states.
struct RouteOverTime {
  std::string route;
  double eye_height_m = 0;
  GuidedRoute guided;
  GuidedRoute by_jin;   // verdict of Jin's law on the same signs
  GuidedRoute by_line;  // verdict of the line-of-sight method
  /// Verdict of FDS's VISIBILITY: a sign is seen if it is no farther away than VISIBILITY at the
  /// place. Has no states if the case has no slices of it.
  GuidedRoute by_fds;
  std::vector<std::vector<std::optional<double>>> visibility_m;  // by FDS; by state and place
  /// By state and place: the sign that guides, or would guide if it were read; "" if there is none.
  std::vector<std::vector<std::string>> signs;
  std::vector<Walk> walks;  // one walker starts at each state; empty without a walking speed
};

struct OverTime {
  std::vector<TimedState> states;
  std::vector<RouteOverTime> routes;
  std::optional<double> walking_speed_m_s;
  double low_albedo = 0, high_albedo = 0;  // albedos for which verdicts hold; both 0: no smoke
  double depth_error = 0;                  // largest error of smoke sources
  std::vector<std::string> warnings;       // comparisons that could not be made
  int64_t paths = 0;                       // number of paths from eyes
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
  std::vector<PlanLevel> levels;  // from below; at least one
  std::vector<StateWarning> warnings;
  std::vector<Finding> findings;  // of the inspection; its warnings are in `warnings` as well
  int64_t paths = 0;              // number of paths from eyes in all rounds
  double seconds = 0;
  uint64_t scene_hash = 0;
  uint64_t seed = 1;
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
