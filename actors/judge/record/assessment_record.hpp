// The record of an assessment: what assessment.json holds. It stands alone: reports, comparisons,
// the console and Python take it, and none of them needs the scene. Each struct lists its fields
// beside its members (actors/results/formats/json_fields.hpp); names and forms of keys stand
// nowhere else. Lengths are in metres, other units in the names of members or beside their values.
// Plain values and pure functions; any thread.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "actors/judge/record/guidance_record.hpp"
#include "actors/judge/record/inputs_record.hpp"
#include "actors/judge/record/plan_record.hpp"
#include "actors/judge/record/sheet_record.hpp"
#include "actors/judge/record/threshold_record.hpp"
#include "actors/judge/texts/texts.hpp"
#include "scenes/emergency/legibility.hpp"
#include "scenes/emergency/mean_observer.hpp"

namespace luxodus {

inline constexpr const char* assessment_format = "luxodus assessment 4";

struct SceneRecord {
  std::string name, title, file;
  std::string content_hash;  // 16 hexadecimal digits
  std::string scenario;
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name)("title", m.title)("file", m.file)("content_hash", m.content_hash);
    field("scenario", m.scenario);
  }
};

// ---- the judged state --------------------------------------------------------------------------

struct LitRecord {
  size_t lit = 0, of = 0;
  std::vector<std::string> names;  // of those that are lit
  static constexpr void fields(auto&& field, auto& m) {
    field("lit", m.lit)("of", m.of)("lit_names", m.names);
  }
};

/// Range of the extinction of all smoke, without flames [1/m]; its `max` is 0 where the smoke lies
/// outside the building or the heights at which people look.
struct ExtinctionRecord {
  double min = 0, max = 0;
  double wavelength_nm = 0;
  static constexpr void fields(auto&& field, auto& m) {
    field("min", m.min)("max", m.max);
    field("unit", derived([] { return std::string("1/m"); }));
    field("wavelength_nm", m.wavelength_nm);
  }
};

/// Range of the extinction of a medium at one wavelength, with the factors of the scenario [1/m];
/// of a data set in the building, from the lowest eye to the highest sign or eye.
struct StatedMedium {
  std::string name;
  std::string kind;   // "layered", "flame"
  std::string place;  // "office.toml:22"
  Remarks notes;      // such as 6 layers, times 0.5 in this scenario
  double extinction_min = 0, extinction_max = 0;
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name)("kind", m.kind)("place", m.place)("notes", m.notes);
    field("extinction_min", m.extinction_min)("extinction_max", m.extinction_max);
  }
};

/// Mean extinctions for visible light along the lines from eyes to the signs that they look at,
/// from the least to the most [1/m].
struct SmokeOnLinesRecord {
  double min = 0, max = 0;
  size_t views = 0;
  static constexpr void fields(auto&& field, auto& m) {
    field("min", m.min)("max", m.max);
    field("unit", derived([] { return std::string("1/m"); }));
    field("views", m.views);
  }
};

struct StateSmokeRecord {
  ExtinctionRecord extinction;
  std::optional<SmokeOnLinesRecord> on_lines;  // none if nobody looks at a sign
  std::vector<StatedMedium> media;
  static constexpr void fields(auto&& field, auto& m) {
    field("extinction", m.extinction);
    field("on_lines", m.on_lines, {.or_null = true});
    field("media", m.media);
  }
};

/// A rule set, or a deviation from one.
struct RulesRecord {
  std::string id;
  std::string from;  // the rule set that a deviation belongs to; "" for a rule set
  std::string edition;
  Remark what;
  std::string source;
  std::optional<Remark> status;
  static constexpr void fields(auto&& field, auto& m) {
    field("id", m.id);
    field("from", m.from, {.or_left_out = true});
    field("edition", m.edition)("what", m.what)("source", m.source);
    field("status", m.status, {.or_null = true});
  }
};

struct StateRecord {
  std::string scenario;
  Operation operation = Operation::mains;
  std::optional<double> seconds_after_failure;
  double equivalent_background_cd_m2 = 0;  // of what eyes have bleached
  LitRecord luminaires;
  std::optional<StateSmokeRecord> smoke;
  std::vector<RulesRecord> rules, deviations;
  Remark light;  // by which views were judged
  Remarks remarks;
  static constexpr void fields(auto&& field, auto& m) {
    field("scenario", m.scenario)("operation", m.operation);
    field("seconds_after_failure", m.seconds_after_failure, {.unit = "s", .or_null = true});
    field("equivalent_background", m.equivalent_background_cd_m2, {.unit = "cd/m2"});
    field("luminaires", m.luminaires);
    field("smoke", m.smoke, {.or_null = true});
    field("rules", m.rules)("deviations", m.deviations)("light", m.light)("remarks", m.remarks);
  }
};

// ---- verdicts ----------------------------------------------------------------------------------

/// Checks by their verdicts.
struct CountsRecord {
  size_t pass = 0, fail = 0, not_assessed = 0, not_verified = 0;
  static CountsRecord of(const CheckCounts& counts);
  static constexpr void fields(auto&& field, auto& m) {
    field("pass", m.pass)("fail", m.fail)("not_assessed", m.not_assessed);
    field("not_verified", m.not_verified);
  }
};

struct VerdictRecord {
  std::string first;  // the sentence that every output shows first
  std::string words;
  CountsRecord counts;
  static constexpr void fields(auto&& field, auto& m) {
    field("first", m.first)("words", m.words)("fail", m.counts.fail);
    field("not_assessed", m.counts.not_assessed)("not_verified", m.counts.not_verified);
    field("pass", m.counts.pass);
  }
};

/// Checks of one rule that were not assessed, or views of signs where it is of no rule.
struct NotAssessedRecord {
  RuleId rule = RuleId::none;
  std::string edition;
  bool undecided = false;  // views are undecided within their standard errors
  Remarks why;
  size_t count = 0;

  /// "E8, EN 1838:2013: Disability glare: intensity of a luminaire".
  std::string words(const Texts& texts) const;
  static constexpr void fields(auto&& field, auto& m) {
    field("rule", m.rule)("edition", m.edition);
    field("what", derived([&m] { return m.words(english()); }));
    field("undecided", m.undecided)("why", m.why)("count", m.count);
  }
};

struct PeopleRecord {
  double age_years = 0, spacing_m = 0;
  double luminance_before_cd_m2 = 0;  // of the view before the failure of the mains
  std::optional<bool> irritant_smoke;
  bool place_unknown = false;           // they do not know where the signs are
  std::vector<std::string> other_eyes;  // names
  static constexpr void fields(auto&& field, auto& m) {
    field("age", m.age_years, {.unit = "years"});
    field("spacing", m.spacing_m, {.unit = "m"});
    field("luminance_before", m.luminance_before_cd_m2, {.unit = "cd/m2"});
    field("irritant_smoke", m.irritant_smoke, {.or_null = true});
    field("place_of_signs", either(m.place_unknown, "unknown", "known"));
    field("other_eyes", m.other_eyes, {.or_left_out = true});
  }
};

struct MethodRecord {
  uint64_t seed = 0;
  int64_t eye_paths = 0;
  double seconds = 0;
  double wrong_verdicts = 0;  // expected number that noise makes wrong, at most
  double sure_errors = 0;     // a verdict's distance from its limit, in standard errors
  static constexpr void fields(auto&& field, auto& m) {
    field("seed", m.seed)("eye_paths", m.eye_paths);
    field("wrong_verdicts_at_most", m.wrong_verdicts)("sure_errors", m.sure_errors);
    field("seconds", m.seconds, {.unit = "s"});
  }
};

struct CheckRecord : Check {
  static constexpr void fields(auto&& field, auto& m) {
    field("rule", m.rule.id)("rule_set", m.rule.set)("deviation", m.rule.deviation);
    field("edition", m.rule.edition);
    field("clause", derived([&m] { return english().clause(m.rule); }));
    field("clause_number", m.rule.clause);
    field("title", derived([&m] { return english().rule_title(name_of(m.rule.id)); }));
    field("quoted_from", m.rule.sources);
    field("status", m.rule.status, {.or_null = true});
    field("subject", m.subject)("conditions", m.conditions)("verdict", m.verdict);
    field("value", m.value, {.or_null = true});
    field("unit", m.unit);
    field("limit", m.limit, {.or_null = true});
    field("sense", either(m.at_least, "at least", "at most"));
    field("margin", derived([&m] { return m.margin(); }), {.or_null = true});
    field("worst_place", m.worst);
    field("reasons", m.reasons, {.or_left_out = true});
  }
};

// ---- views of signs ----------------------------------------------------------------------------

/// Luminances at the eye and visibility levels in one light; NaN where they are not known.
struct LookRecord {
  Uncertain legend_cd_m2, ground_cd_m2, surround_cd_m2;
  double transmission = 0, glare_veil_cd_m2 = 0, visible_share = 0;
  Uncertain reading_level, seeing_level;
  double chromatic_difference = 0;  // of legend and ground at the eye, CIE 1976 u'v'; NaN: unknown
  static constexpr void fields(auto&& field, auto& m) {
    field("legend", m.legend_cd_m2, {.unit = "cd/m2"});
    field("ground", m.ground_cd_m2, {.unit = "cd/m2"});
    field("surround", m.surround_cd_m2, {.unit = "cd/m2"});
    field("transmission", m.transmission, {.unit = "1", .or_null = true});
    field("glare_veil", m.glare_veil_cd_m2, {.unit = "cd/m2", .or_null = true});
    field("visible_share", m.visible_share, {.unit = "1", .or_null = true});
    field("reading_level", m.reading_level, {.unit = "1"});
    field("seeing_level", m.seeing_level, {.unit = "1"});
    field("chromatic_difference", m.chromatic_difference, {.unit = "1", .or_null = true});
  }
};

/// The line-of-sight method of FDSVismap.
struct LineOfSightRecord {
  double distance_m = 0;
  bool clear = false;
  double extinction_per_m = 0, visible_within_m = 0;  // NaN: as far as one likes
  bool seen = false;
  static constexpr void fields(auto&& field, auto& m) {
    field("distance", m.distance_m, {.unit = "m", .or_null = true});
    field("clear", m.clear);
    field("extinction", m.extinction_per_m, {.unit = "1/m", .or_null = true});
    field("visible_within", m.visible_within_m, {.unit = "m", .or_null = true});
    field("seen", m.seen);
  }
};

struct JinRecord {
  double legible_within_m = 0;  // NaN: as far as one likes
  bool legible = false;
  static constexpr void fields(auto&& field, auto& m) {
    field("legible_within", m.legible_within_m, {.unit = "m", .or_null = true});
    field("legible", m.legible);
  }
};

/// How far a view is from its limits: legend minus ground over what reading requires, and the
/// distances on its line within which the legend is read and the face is seen.
struct MarginRecord {
  double luminance = 0;
  double read_within_m = 0, seen_within_m = 0;
  static constexpr void fields(auto&& field, auto& m) {
    field("luminance", m.luminance, {.unit = "1", .or_null = true});
    field("read_within", m.read_within_m, {.unit = "m", .or_null = true});
    field("seen_within", m.seen_within_m, {.unit = "m", .or_null = true});
  }
};

struct ViewingDistanceRecord {
  double allowed_m = 0;
  bool within = false;
  static constexpr void fields(auto&& field, auto& m) {
    field("allowed", m.allowed_m, {.unit = "m", .or_null = true});
    field("within", m.within);
  }
};

/// The verdict in the other of aged and new light.
struct OtherLightRecord {
  bool in_new_light = false;
  SightVerdict verdict = SightVerdict::not_assessed;
  std::optional<Remark> reason;
  LookRecord look;
  static constexpr void fields(auto&& field, auto& m) {
    field("light", either(m.in_new_light, "new", "aged"))("verdict", m.verdict);
    field("reason", m.reason)(in_place, m.look);
  }
};

/// The verdict for other eyes than those of the stated age.
struct OtherEyesRecord {
  std::string eyes;  // as the scene names them
  SightVerdict verdict = SightVerdict::not_assessed;
  std::optional<Remark> reason;
  Uncertain reading_level;
  static constexpr void fields(auto&& field, auto& m) {
    field("eyes", m.eyes)("verdict", m.verdict)("reason", m.reason);
    field("reading_level", m.reading_level, {.unit = "1"});
  }
};

/// Illuminance of the eye straight from all emitters but the sign, in the smoke and without it.
struct EyeLightRecord {
  double lux = 0, clear_air_lux = 0;
  static constexpr void fields(auto&& field, auto& m) {
    field("direct", m.lux, {.unit = "lx"});
    field("direct_in_clear_air", m.clear_air_lux, {.unit = "lx"});
  }
};

/// How the view stands to the mean observer of measured experiments.
struct StandingRecord {
  MeanObserver observer = MeanObserver::not_known;
  Untested untested = Untested::nothing;
  static constexpr void fields(auto&& field, auto& m) {
    field("mean_observer", m.observer)("untested", m.untested);
  }
};
struct ExperimentsRecord {
  StandingRecord read, seen;
  static constexpr void fields(auto&& field, auto& m) { field("read", m.read)("seen", m.seen); }
};

/// What is known of a view whose sign is neither hidden nor dark.
struct SeenRecord {
  bool in_new_light = false;
  LookRecord look;
  double extinction_per_m = 0;  // mean along the line of sight
  MarginRecord margin;
  EyeLightRecord eye_light;
  ExperimentsRecord experiments;
  JinRecord jin;
  ViewingDistanceRecord viewing_distance;
  std::optional<OtherLightRecord> other_light;
  std::vector<OtherEyesRecord> other_eyes;
  static constexpr void fields(auto&& field, auto& m) {
    field("light", either(m.in_new_light, "new", "aged"))(in_place, m.look);
    field("extinction", m.extinction_per_m, {.unit = "1/m", .or_null = true});
    field("margin", m.margin)("eye_illuminance", m.eye_light)("experiments", m.experiments);
    field("jin", m.jin)("viewing_distance", m.viewing_distance);
    field("other_light", m.other_light)("other_eyes", m.other_eyes, {.or_left_out = true});
  }
};

/// The view of a sign from a place.
struct SightRecord {
  Subject from;               // a route, an open area or an observer
  QuantityRecord stands_for;  // "m" of a route or "m2" of an area
  double along_m = 0, eye_height_m = 0;
  glm::dvec3 eye{0};
  std::string sign;
  bool back_face = false;
  SightVerdict verdict = SightVerdict::not_assessed;
  std::optional<Remark> reason;
  double distance_m = 0, from_normal_deg = 0;
  double from_gaze_deg = 0;  // NaN in areas, where nobody is known to look anywhere
  double height_arcmin = 0, detail_arcmin = 0;
  LineOfSightRecord line_of_sight;
  std::optional<SeenRecord> seen;

  bool by_observer() const { return from.kind == SubjectKind::observer; }
  static constexpr void fields(auto&& field, auto& m) {
    field("from", m.from)("stands_for", m.stands_for);
    field("along", m.along_m, {.unit = "m"});
    field("eye_height", m.eye_height_m, {.unit = "m"});
    field("eye", m.eye)("sign", m.sign)("back_face", m.back_face)("verdict", m.verdict);
    field("reason", m.reason);
    field("distance", m.distance_m, {.unit = "m", .or_null = true});
    field("angle_from_normal", m.from_normal_deg, {.unit = "deg", .or_null = true});
    field("angle_from_gaze", m.from_gaze_deg, {.unit = "deg", .or_null = true});
    field("angular_height", m.height_arcmin, {.unit = "arcmin", .or_null = true});
    field("angular_detail", m.detail_arcmin, {.unit = "arcmin", .or_null = true});
    field("line_of_sight", m.line_of_sight)(in_place, m.seen);
  }
};

/// For one sign and one smoke density: from how many of the places that it faces it is legible.
struct SweepRow {
  double factor = 1;  // on all extinctions
  std::string sign;
  int64_t places = 0, legible = 0, undecided = 0;
  static constexpr void fields(auto&& field, auto& m) {
    field("smoke_factor", m.factor)("sign", m.sign)("places", m.places)("legible", m.legible);
    field("undecided", m.undecided);
  }
};

struct WarningRecord {
  std::string text;  // English, with its place
  std::string file;
  int line = 0;
  std::optional<Remark> remark;  // none: `text` is all that is known
  static constexpr void fields(auto&& field, auto& m) {
    field("text", m.text)("file", m.file)("line", m.line);
    field("remark", m.remark, {.or_null = true});
  }
};

// ---- all of it ---------------------------------------------------------------------------------

struct AssessmentRecord {
  std::string version;  // of the program
  SceneRecord scene;
  StateRecord state;
  VerdictRecord verdict;
  std::vector<NotAssessedRecord> not_assessed;  // the most frequent first
  PeopleRecord people;
  MethodRecord method;
  std::map<std::string, size_t> sight_counts;  // by the name of a verdict
  std::vector<CheckRecord> checks;
  std::vector<SightRecord> sights;
  std::vector<SweepRow> sweep;
  std::vector<ThresholdRecord> thresholds;
  std::optional<OverTime> over_time;
  std::vector<WarningRecord> warnings;
  ProjectRecord project;
  ScenarioRecord scenario;
  std::vector<LuminaireRecord> luminaires;
  std::vector<SheetRecord> sheets;
  std::vector<SignRecord> signs;
  PlacesRecord places;
  std::vector<RoomRecord> rooms;
  std::vector<SurfaceRecord> surfaces;
  std::vector<MaterialRecord> materials;
  std::vector<MediumRecord> media;
  std::vector<std::string> cameras;
  PlanRecord plan;
  static constexpr void fields(auto&& field, auto& m) {
    field("format", derived([] { return std::string(assessment_format); }));
    field("version", m.version)("scene", m.scene)("state", m.state)("verdict", m.verdict);
    field("not_assessed", m.not_assessed)("people", m.people)("method", m.method);
    field("counts", derived([&m] { return m.verdict.counts; }));
    field("sight_counts", m.sight_counts)("checks", m.checks);
    field("sights", m.sights)("sweep", m.sweep);
    field("thresholds", m.thresholds, {.or_left_out = true});
    field("over_time", m.over_time)("warnings", m.warnings);
    field("project", m.project)("scenario", m.scenario)("luminaires", m.luminaires);
    field("sheets", m.sheets)("signs", m.signs)("places", m.places)("rooms", m.rooms);
    field("surfaces", m.surfaces)("materials", m.materials)("media", m.media);
    field("cameras", m.cameras)("plan", m.plan);
  }
};

/// assessment.json.
Json assessment_json(const AssessmentRecord& record);

/// Reads assessment.json. Errors: another format; the first fault with its place: "checks[3] has no
/// \"verdict\""; a check by a rule set or a deviation that the state does not name; counts that are
/// not those of the checks; maps and tables that have not a value for each of their places.
Result<AssessmentRecord> assessment_of(const Json& json);

}  // namespace luxodus
