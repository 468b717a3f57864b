// The record of a design: what design.json holds, and what its page and the console are made of.
// Each struct lists its fields beside its members (actors/results/formats/json_fields.hpp). Plain
// values and pure functions; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "actors/judge/design/design.hpp"
#include "actors/results/formats/json_fields.hpp"

namespace luxodus {

inline constexpr const char* design_format = "luxodus design 2";

const char* name_of(LayoutEnd end);
const char* name_of(DemandKind kind);

struct DesignedSceneRecord {
  std::string name, title;
  static constexpr void fields(auto&& field, auto& m) { field("name", m.name)("title", m.title); }
};

struct OutcomeRecord {
  LayoutEnd end = LayoutEnd::unknown;
  std::string words;  // English
  static constexpr void fields(auto&& field, auto& m) { field("end", m.end)("words", m.words); }
};

struct ObjectiveRecord {
  std::string kind;  // a word of objective_words
  double value = 0, bound = 0, gap = 0;
  std::optional<double> greedy;
  static constexpr void fields(auto&& field, auto& m) {
    field("kind", m.kind)("value", m.value)("bound", m.bound, {.or_null = true});
    field("gap", m.gap, {.or_null = true})("greedy", m.greedy, {.or_null = true});
  }
};

struct DesignSettingsRecord {
  double margin = 1;
  std::string failure;  // a word of failure_words
  double spacing_m = 0;
  std::vector<std::string> rules;
  static constexpr void fields(auto&& field, auto& m) {
    field("margin", m.margin)("failure", m.failure)("spacing_m", m.spacing_m)("rules", m.rules);
  }
};

struct CandidatesRecord {
  size_t places = 0, luminaires = 0, points = 0;
  LeftOut left_out;
  static constexpr void fields(auto&& field, auto& m) {
    field("places", m.places)("luminaires", m.luminaires)("points", m.points);
    field("left_out", m.left_out);
  }
};

struct PlacedLuminaireRecord {
  std::string name;
  std::string type;  // "" of one that the scene has
  bool is_new = false;
  std::optional<glm::dvec3> moved_from;
  glm::dvec3 position{0};
  std::string mount;  // "wall", "ceiling"; "" of one that stays
  double rotation_deg = 0;
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name)("type", m.type)("is_new", m.is_new);
    field("moved_from", m.moved_from, {.or_null = true});
    field("position", m.position)("mount", m.mount)("rotation_deg", m.rotation_deg);
  }
};

struct PlacedTypeRecord {
  std::string name;
  size_t count = 0;
  double cost = 0, watts = 0;
  std::string battery;
  double emergency_lm = 0;
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name)("count", m.count)("cost", m.cost)("watts", m.watts);
    field("battery", m.battery)("emergency_lm", m.emergency_lm);
  }
};

/// A group of demands that the rules make.
struct ConstraintRecord {
  DemandKind kind = DemandKind::minimum;
  RuleId rule = RuleId::none;
  Subject subject;
  double asked = 0;
  std::string words;       // English
  double least_share = 0;  // of the required value; NaN where there is none
  double share_of_bound = 0;
  static constexpr void fields(auto&& field, auto& m) {
    field("kind", m.kind)("rule", m.rule)("subject", m.subject)("asked", m.asked);
    field("words", m.words)("least_share", m.least_share, {.or_null = true});
    field("share_of_bound", m.share_of_bound);
  }
};

/// What is saved without a demand: a constraint, the failure of a luminaire, or else all failures.
struct BindingRecord {
  double saved = 0, objective_without = 0;
  int64_t fewer_luminaires = 0;
  bool exact = false;
  std::optional<size_t> constraint;  // index
  std::optional<std::string> luminaire;
  static constexpr void fields(auto&& field, auto& m) {
    field("what", derived([&m] {
            return std::string(m.constraint ? "constraint" : m.luminaire ? "failure" : "failures");
          }));
    field("saved", m.saved)("objective_without", m.objective_without);
    field("fewer_luminaires", m.fewer_luminaires)("exact", m.exact);
    field("constraint", m.constraint)("luminaire", m.luminaire);
  }
};

/// A failing check that no luminaire decides.
struct FailingRecord {
  RuleId rule = RuleId::none;
  Subject subject;
  Remarks reasons;
  static constexpr void fields(auto&& field, auto& m) {
    field("rule", m.rule)("subject", m.subject);
    field("title", derived([&m] { return english().rule_title(name_of(m.rule)); }));
    field("reasons", m.reasons);
  }
};

struct ShareOffPlaceRecord {
  DemandKind kind = DemandKind::minimum;
  RuleId rule = RuleId::none;
  Subject subject;
  double share = 0;
  glm::dvec3 place{0};
  static constexpr void fields(auto&& field, auto& m) {
    field("kind", m.kind)("rule", m.rule)("subject", m.subject)("share", m.share);
    field("place", m.place);
  }
};

/// Minima with luminaires off their places.
struct OffPlaceRecord {
  double distance_m = 0;
  bool holds = false;
  std::vector<ShareOffPlaceRecord> demands;  // the tightest first
  static constexpr void fields(auto&& field, auto& m) {
    field("distance_m", m.distance_m)("holds", m.holds)("demands", m.demands);
  }
};

// ---- signs -------------------------------------------------------------------------------------

struct LeadsToRecord {
  std::string route, arrow;
  static constexpr void fields(auto&& field, auto& m) { field("route", m.route)("arrow", m.arrow); }
};

struct PlacedSignRecord {
  std::string name;
  std::string type;  // "" of one that the scene has
  bool is_new = false;
  std::string mount;
  glm::dvec3 position{0}, facing{0};
  std::vector<LeadsToRecord> leads_to;
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name)("type", m.type)("is_new", m.is_new)("mount", m.mount);
    field("position", m.position)("facing", m.facing)("leads_to", m.leads_to);
  }
};

struct SignTypeRecord {
  std::string name;
  size_t count = 0;
  double cost = 0, watts = 0;
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name)("count", m.count)("cost", m.cost)("watts", m.watts);
  }
};

struct SignObjectiveRecord {
  double value = 0, bound = 0;
  static constexpr void fields(auto&& field, auto& m) {
    field("value", m.value)("bound", m.bound, {.or_null = true});
  }
};

struct SignCandidatesRecord {
  size_t places = 0, signs = 0;
  SignsLeftOut left_out;
  static constexpr void fields(auto&& field, auto& m) {
    field("places", m.places)("signs", m.signs)("left_out", m.left_out);
  }
};

struct SignPlanRecord {
  std::vector<PlacedSignRecord> placed;
  std::vector<std::string> removed;
  std::vector<SignTypeRecord> types;
  SignObjectiveRecord objective;
  SignCandidatesRecord candidates;
  std::vector<UnguidedPlaces> unguided;
  static constexpr void fields(auto&& field, auto& m) {
    field("placed", m.placed)("removed", m.removed)("types", m.types)("objective", m.objective);
    field("candidates", m.candidates)("unguided", m.unguided);
  }
};

// ---- layouts in smoke --------------------------------------------------------------------------

/// Until when one route guides people of one eye height; none: not in the first state.
struct GuidedUntilRecord {
  std::string route;
  double height_m = 0;
  std::optional<double> min_s, max_s;
  static constexpr void fields(auto&& field, auto& m) {
    field("route", m.route)("height_m", m.height_m);
    field("until_least_s", m.min_s, {.or_null = true})("until_most_s", m.max_s, {.or_null = true});
  }
};

/// Until when a layout guides on all routes.
struct GuidedRecord {
  std::optional<double> min_s, max_s;
  bool never_lost = false;
  std::vector<GuidedUntilRecord> routes;
  static constexpr void fields(auto&& field, auto& m) {
    field("until_least_s", m.min_s, {.or_null = true})("until_most_s", m.max_s, {.or_null = true});
    field("never_lost", m.never_lost)("routes", m.routes);
  }
};

struct ShareAtHeightRecord {
  LegibleShare share;
  double height_m = 0;
  static constexpr void fields(auto&& field, auto& m) {
    field(in_place, m.share)("height_m", m.height_m);
  }
};

struct SmokeScenarioRecord {
  std::string name;
  LegibleShare all;
  ShareDifference beyond_first;
  std::vector<ShareAtHeightRecord> by_height;
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name)("all", m.all)("beyond_first", m.beyond_first);
    field("by_height", m.by_height);
  }
};

/// Person-seconds without a sign that is read, from "undecided is read" to "undecided is not".
struct PeopleUnreadRecord {
  double least_s = 0, most_s = 0, all_s = 0;
  static constexpr void fields(auto&& field, auto& m) {
    field("unread_least_s", m.least_s)("unread_most_s", m.most_s)("all_s", m.all_s);
  }
};

struct SmokeLayoutRecord {
  std::string name;
  std::string file;  // in the folder of the design
  bool on_front = false;
  double objective = 0;
  size_t luminaires = 0;
  double cost = 0, watts = 0, sign_factor = 1;
  size_t low_signs = 0;
  int rounds = 0;
  bool open = false;                         // more paths could change its rank
  std::optional<GuidedRecord> guided;        // of a scene that changes in time
  std::optional<PeopleUnreadRecord> people;  // if people were followed
  size_t places_lost = 0, places_won = 0;
  LegibleShare worst;
  ShareDifference beyond_first;
  std::vector<SmokeScenarioRecord> scenarios;

  bool has_brighter_signs() const { return sign_factor != 1; }
  bool has_low_signs() const { return low_signs > 0; }
  bool has_other_signs() const { return has_brighter_signs() || has_low_signs(); }
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name)("file", m.file)("on_front", m.on_front)("objective", m.objective);
    field("luminaires", m.luminaires)("cost", m.cost)("watts", m.watts);
    field("sign_factor", m.sign_factor)("low_signs", m.low_signs)("rounds", m.rounds);
    field("open", m.open)("guided", m.guided, {.or_null = true});
    field("people", m.people, {.or_null = true});
    field("places_lost", m.places_lost)("places_won", m.places_won)("worst", m.worst);
    field("beyond_first", m.beyond_first)("scenarios", m.scenarios);
  }
};

struct SmokeRecord {
  std::vector<std::string> scenarios;
  std::vector<double> heights_m;
  double ahead_deg = 0;
  RaceEnd end = RaceEnd::decided;
  size_t traces = 0;
  int64_t paths = 0;
  std::string recommended;
  std::vector<SmokeLayoutRecord> layouts;  // at least one; the first is the best by the rules
  static constexpr void fields(auto&& field, auto& m) {
    field("scenarios", m.scenarios)("heights_m", m.heights_m)("ahead_deg", m.ahead_deg);
    field("end", m.end)("traces", m.traces)("paths", m.paths)("recommended", m.recommended);
    field("layouts", m.layouts);
  }
};

// ---- all of it ---------------------------------------------------------------------------------

struct DesignRecord {
  std::string program;  // and its version
  DesignedSceneRecord scene;
  OutcomeRecord outcome;
  ObjectiveRecord objective;
  DesignSettingsRecord settings;
  CandidatesRecord candidates;
  std::vector<HiddenByFurniture> hidden_by_furniture;
  std::vector<UnusedType> types_not_placed;
  std::vector<std::string> unlit_flights;
  std::vector<PlacedLuminaireRecord> luminaires;
  std::vector<std::string> removed;
  std::vector<PlacedTypeRecord> types;
  std::vector<ConstraintRecord> constraints;
  std::vector<BindingRecord> because;  // the costliest first
  CountsRecord checks;
  std::vector<FailingRecord> failing_otherwise;
  std::optional<Refined> refined;
  BetweenPoints between_points;
  std::optional<OffPlaceRecord> off_place;
  std::optional<SignPlanRecord> signs;
  std::optional<SmokeRecord> smoke;
  static constexpr void fields(auto&& field, auto& m) {
    field("format", derived([] { return std::string(design_format); }));
    field("program", m.program)("scene", m.scene)("outcome", m.outcome)("objective", m.objective);
    field("settings", m.settings)("candidates", m.candidates);
    field("hidden_by_furniture", m.hidden_by_furniture)("types_not_placed", m.types_not_placed);
    field("unlit_flights", m.unlit_flights)("luminaires", m.luminaires)("removed", m.removed);
    field("types", m.types)("constraints", m.constraints)("because", m.because);
    field("checks", m.checks)("failing_otherwise", m.failing_otherwise)("refined", m.refined);
    field("between_points", m.between_points)("off_place", m.off_place)("signs", m.signs);
    field("smoke", m.smoke);
  }
};

/// design.json.
Json design_json(const DesignRecord& record);
/// Errors: the first fault with its place.
Result<DesignRecord> design_of(const Json& json);

}  // namespace luxodus
