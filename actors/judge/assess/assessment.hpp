// What an assessment finds of a building: the codes' rules by direct light in clear air (code
// mode), and what people on the escape routes read of the signs with all light and smoke (reality
// mode). Plain values; any thread.
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
/// Pairs of a place and a sign that are looked at: each costs three tallies and their paths.
inline constexpr size_t sights = 200'000;
/// Rounds of paths from the eye; each has four times the paths of the one before.
inline constexpr int sight_rounds = 8;
/// Different shares of new light that aged luminaires have: each costs tallies of its own.
inline constexpr size_t ageings = 16;
}  // namespace limits

struct SightRow;

struct AssessOptions {
  /// Of the reality mode; its doors are the code mode's too. Empty: see judged_scenario.
  std::string scenario;
  std::vector<std::string> rules, deviations;  // by name; empty: those of the scene
  uint64_t seed = 1;
  int threads = 1;
  RunExecutor* executor = nullptr;  // who traces; null: the threads
  int rounds = 4;                   // until nothing is undecided, or so many
  bool reality = true;              // else the code mode alone
  std::string sign;                 // judged alone, by name; "": all are
  /// Which views are judged, before anything is known of their light; empty: all are.
  std::function<bool(const SightRow& view)> wanted = {};
  std::vector<double> smoke_factors = {};  // of a sweep over the density of all smoke
};

/// One sign from one place.
struct SightRow {
  Subject from;           // a route, an open area or an observer
  double stands_for = 0;  // metres of a route, or square metres of an area; 0 of an observer
  double along_m = 0;
  double height_m = 0;  // of the eye above the floor; of an observer above z = 0
  glm::dvec3 eye{0};
  std::string sign;
  bool back_face = false;
  double gaze_deg = 0;  // between the direction of walking and the sign; NaN in areas
  SignView view;
  /// As verdicts count: in the light, aged or new, that gives the worse one.
  SignLook look;
  Sight sight;
  LineOfSight line;
  bool in_new_light = false;  // they are of new light; else of aged
  /// In the other light; none where lit luminaires do not age, and where light does not matter.
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
  glm::dvec2 corner{0};  // of the first place
  double spacing_m = 0;
  int columns = 0, rows = 0;  // along x, along y
  std::vector<double> lux;    // row by row; as many as columns times rows
};

/// One floor of the building, for its plan.
struct PlanLevel {
  double floor_m = 0;
  std::vector<std::pair<glm::dvec2, glm::dvec2>> walls, furniture;  // cut at breast height
  std::vector<PlanPoint> points;  // of calculation on its routes and open areas
  LightMap map;
};

/// Of a sign, how many of the places that it faces it is legible from, in smoke of a density.
struct SweepRow {
  double factor = 1;  // of all extinctions
  std::string sign;
  int64_t places = 0, legible = 0, undecided = 0;
};

/// A state of an assessment over time.
struct TimedState {
  double at_s = 0;
  Operation operation = Operation::mains;
  std::optional<double> seconds_after_failure;
  size_t lit = 0;  // luminaires
  struct Frame {
    std::string medium;
    double time_s = 0;
  };
  std::vector<Frame> frames;  // of fire simulations: the time that they were computed for
};

/// How one route guides eyes of one height, over all states.
struct RouteOverTime {
  std::string route;
  double eye_height_m = 0;
  GuidedRoute guided;
  GuidedRoute by_jin;   // what Jin's law would say of the same signs
  GuidedRoute by_line;  // and the line-of-sight method
  /// What FDS's VISIBILITY would: a sign is seen that is no farther than it at the place. Without
  /// states where the case has no slices of it.
  GuidedRoute by_fds;
  std::vector<std::vector<std::optional<double>>> visibility_m;  // of FDS, by state and place
  /// By state and place: the sign that guides, or would if it were read; "" where there is none.
  std::vector<std::vector<std::string>> signs;
  std::vector<Walk> walks;  // who sets out at each state, where a speed is said
};

struct OverTime {
  std::vector<TimedState> states;
  std::vector<RouteOverTime> routes;
  std::optional<double> walking_speed_m_s;
  double low_albedo = 0, high_albedo = 0;  // for which verdicts hold; both 0: there was no smoke
  double depth_error = 0;                  // of sources of smoke, largest
  std::vector<std::string> warnings;       // what could not be shown beside them
  int64_t paths = 0;                       // from eyes
};

/// What a designer is warned of.
struct StateWarning {
  SourcePlace place;
  std::optional<Remark> remark;  // none: `words` say it
  std::string words = {};        // in English
  bool by_inspection = false;    // is among the findings, too
};

struct Assessment {
  AssessedState state;
  bool reality = true;  // views were judged
  std::vector<Check> checks;
  std::vector<SightRow> sights;
  std::vector<SweepRow> sweep;
  std::optional<OverTime> over_time;
  std::vector<PlanLevel> levels;  // from below; at least one
  std::vector<StateWarning> warnings;
  std::vector<Finding> findings;  // of the inspection; its warnings are among the above
  int64_t paths = 0;              // from eyes, of all rounds
  double seconds = 0;
  uint64_t scene_hash = 0;
  uint64_t seed = 1;
};

/// What is going on, and the share of it that is done.
using AssessProgress = std::function<void(const std::string& what, double share)>;

/// Errors: as judged_scenario, judged_codes, irritation_is_said; nothing to assess; an error that
/// `inspect` finds, such as routes outside the building or in walls; a pack; `interrupt`.
Result<Assessment> assess(const std::shared_ptr<const SceneDescription>& scene,
                          const AssessOptions& options, const std::atomic<bool>& interrupt,
                          const AssessProgress& progress);

}  // namespace luxodus
