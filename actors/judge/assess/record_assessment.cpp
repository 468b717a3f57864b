#include "actors/judge/assess/record_assessment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "actors/judge/assess/assessment_inputs.hpp"
#include "actors/judge/assess/state_words.hpp"

namespace luxodus {

namespace {

RulesRecord rules_of(const NamedRules& rules, const char* from) {
  RulesRecord out{rules.id, from, rules.edition, remark(rules.asks), rules.source, {}};
  if (rules.status) out.status = remark(*rules.status);
  return out;
}

/// Whether an eye gets light of the sign: it is neither hidden nor dark.
bool is_seen(const SightRow& row) {
  return row.sight.verdict != SightVerdict::hidden &&
         row.look.legend.value + row.look.face.value != 0;
}

std::optional<SmokeOnLinesRecord> smoke_on_lines(const std::vector<SightRow>& sights) {
  std::optional<SmokeOnLinesRecord> out;
  for (const SightRow& row : sights) {
    if (!is_seen(row)) continue;
    const double extinction = row.sight.extinction;
    if (!out) out = {extinction, extinction, 0};
    out->min = std::min(out->min, extinction);
    out->max = std::max(out->max, extinction);
    ++out->views;
  }
  return out;
}

/// Range over all media except flames; none without smoke. Extinctions add where media overlap.
std::optional<StateSmokeRecord> smoke_of(const AssessedState& state,
                                         const std::vector<SightRow>& sights) {
  if (!state.smoke) return std::nullopt;
  StateSmokeRecord out{{0, 0, stated_nm}, smoke_on_lines(sights), state.media};
  bool first = true;
  for (const StatedMedium& m : state.media) {
    if (m.kind == "flame") continue;
    out.extinction.min = first ? m.extinction_min : std::min(out.extinction.min, m.extinction_min);
    out.extinction.max = std::max(out.extinction.max, m.extinction_max);
    first = false;
  }
  return out;
}

StateRecord state_record(const Assessment& assessment, const AssessmentSettings& people) {
  const AssessedState& state = assessment.state;
  StateRecord out{.scenario = state.scenario,
                  .operation = state.operation,
                  .seconds_after_failure = state.seconds_after_failure,
                  .equivalent_background_cd_m2 = equivalent_background_of(
                      people, state.operation, state.seconds_after_failure),
                  .luminaires = {state.lit.size(), state.luminaires, state.lit},
                  .smoke = smoke_of(state, assessment.sights),
                  .rules = {},
                  .deviations = {},
                  .light = state.light,
                  .remarks = state.remarks};
  for (const CodeChoice& codes : state.codes) {
    out.rules.push_back(rules_of(named(codes.set), ""));
    for (const Deviation deviation : codes.deviations)
      out.deviations.push_back(rules_of(named(deviation), named(codes.set).id));
  }
  return out;
}

LookRecord look_of(const SignLook& look, const Sight& sight) {
  return {.legend_cd_m2 = look.legend,
          .ground_cd_m2 = look.ground,
          .surround_cd_m2 = look.surround,
          .transmission = look.transmission,
          .glare_veil_cd_m2 = look.veil_cd_m2,
          .visible_share = look.visible_share,
          .reading_level = sight.reading_level,
          .seeing_level = sight.seeing_level,
          .chromatic_difference = chromatic_difference(look.colours.legend, look.colours.ground)};
}

/// What follows from a view and its state besides its verdict.
struct Beside {
  Reach reach;
  ExperimentsRecord experiments;
};

/// The least albedo of the smoke that the state has; 1 without smoke.
double least_albedo(const SceneDescription& scene, const AssessedState& state) {
  double least = 1;
  for (const Medium& medium : scene.media) {
    const bool there =
        std::any_of(state.media.begin(), state.media.end(),
                    [&](const StatedMedium& one) { return one.name == medium.name; });
    if (!there || is_flame(medium)) continue;
    const auto take = [&](const SmokeOptics& optics) {
      least = std::min(least,
                       *std::min_element(optics.albedo.value.begin(), optics.albedo.value.end()));
    };
    if (medium.kind == MediumKind::layered)
      for (const Layer& layer : medium.layers) take(layer.optics);
    else
      take(medium.optics);
    for (const float albedo : medium.data.albedo) least = std::min(least, double{albedo});
  }
  return least;
}

StandingRecord record_of(const Standing& standing) {
  return {standing.observer, standing.untested};
}

ExperimentsRecord experiments_of(const SightRow& row, const SightRules& rules, double albedo) {
  const ObservedView view{.age_years = rules.eye.age_years,
                          .distance_m = row.view.distance_m,
                          .extinction = row.sight.extinction,
                          .albedo = albedo,
                          .irritant = rules.irritant_smoke,
                          .place_unknown = rules.place_unknown,
                          .reading_level = row.sight.reading_level.value,
                          .seeing_level = row.sight.seeing_level.value};
  return {record_of(standing_in_reading(view)), record_of(standing_in_seeing(view))};
}

/// None of a sign that is not seen.
std::optional<SeenRecord> seen_of(const SightRow& row, const Beside& beside,
                                  const AssessmentSettings& people) {
  if (!is_seen(row)) return std::nullopt;
  SeenRecord out{
      .in_new_light = row.in_new_light,
      .look = look_of(row.look, row.sight),
      .extinction_per_m = row.sight.extinction,
      .margin = {row.sight.reading_level.value / level_read, beside.reach.read_m,
                 beside.reach.seen_m},
      .eye_light = {row.eye_light.lux, row.eye_light.clear_air_lux},
      .experiments = beside.experiments,
      .jin = {row.sight.jin_m, row.sight.jin_legible},
      .viewing_distance = {row.sight.viewing.allowed_oblique_m, row.sight.viewing.within},
      .other_light = {},
      .other_eyes = {}};
  if (row.other)
    out.other_light = {!row.in_new_light, row.other->sight.verdict, row.other->sight.reason,
                       look_of(row.other->look, row.other->sight)};
  for (size_t e = 0; e < row.by_other_eyes.size(); ++e) {
    const Sight& sight = row.by_other_eyes[e];
    out.other_eyes.push_back(
        {people.other_eyes[e].name, sight.verdict, sight.reason, sight.reading_level});
  }
  return out;
}

SightRecord sight_of(const SightRow& row, const Beside& beside, const AssessmentSettings& people) {
  return {.from = row.from,
          .stands_for = {row.stands_for, row.from.kind == SubjectKind::route ? "m" : "m2"},
          .along_m = row.along_m,
          .eye_height_m = row.height_m,
          .eye = row.eye,
          .sign = row.sign,
          .back_face = row.back_face,
          .verdict = row.sight.verdict,
          .reason = row.sight.reason,
          .distance_m = row.view.distance_m,
          .from_normal_deg = row.view.angle_deg,
          .from_gaze_deg = row.gaze_deg,
          .height_arcmin = row.view.height_arcmin,
          .detail_arcmin = row.view.detail_arcmin,
          .line_of_sight = {row.line.distance_m, row.line.clear, row.line.extinction,
                            row.line.visibility_m, row.line.seen},
          .seen = seen_of(row, beside, people)};
}

/// A number that is not finite is none, as in JSON.
CheckRecord check_of(const Check& check) {
  CheckRecord out{check};
  for (std::optional<double>* number : {&out.value, &out.limit})
    if (*number && !std::isfinite(**number)) number->reset();
  return out;
}

/// Each group of checks and views once, the most frequent first.
std::vector<NotAssessedRecord> not_assessed_of(const Assessment& assessment) {
  std::vector<NotAssessedRecord> out;
  const auto count = [&](NotAssessedRecord group) {
    const auto known = std::find_if(out.begin(), out.end(), [&](const NotAssessedRecord& one) {
      return one.rule == group.rule && one.edition == group.edition &&
             one.undecided == group.undecided && one.why == group.why;
    });
    ++(known != out.end() ? *known : out.emplace_back(std::move(group))).count;
  };
  for (const Check& check : assessment.checks)
    if (check.verdict == CheckVerdict::not_assessed)
      count({check.rule.id, check.rule.edition, false, check.reasons});
  for (const SightRow& row : assessment.sights) {
    const bool undecided = row.sight.verdict == SightVerdict::undecided;
    if (!undecided && row.sight.verdict != SightVerdict::not_assessed) continue;
    Remarks reasons;
    if (row.sight.reason) reasons.push_back(*row.sight.reason);
    count({RuleId::none, "", undecided, std::move(reasons)});
  }
  if (!assessment.reality) count({RuleId::none, "", false, {remark(RemarkId::codes_alone)}});
  std::sort(out.begin(), out.end(), [](const NotAssessedRecord& a, const NotAssessedRecord& b) {
    if (a.count != b.count) return a.count > b.count;
    const std::string x = a.words(english()), y = b.words(english());
    if (x != y) return x < y;
    const std::string why = english().remarks(a.why), other = english().remarks(b.why);
    return why != other ? why < other : a.undecided < b.undecided;
  });
  return out;
}

WarningRecord warning_of(const StateWarning& one) {
  const std::string words = one.remark ? english().remark(*one.remark) : one.words;
  return {problem_in(one.place, words).text(), one.place.file, one.place.line, one.remark};
}

}  // namespace

AssessmentRecord record_of(const SceneDescription& scene, const Assessment& assessment,
                           const std::string& version) {
  AssessmentRecord out;
  out.version = version;
  out.scene = {scene.name, scene.title, scene.file, fmt::format("{:016x}", assessment.scene_hash),
               assessment.state.scenario};
  out.state = state_record(assessment, scene.assessment);
  const CheckCounts counts = counts_of(assessment.checks);
  for (const SightRow& row : assessment.sights) ++out.sight_counts[name_of(row.sight.verdict)];
  out.verdict = {first_sentence(out, words_of(counts)), words_of(counts), CountsRecord::of(counts)};
  out.not_assessed = not_assessed_of(assessment);
  out.people = {scene.assessment.age_years,
                scene.assessment.spacing_m,
                scene.assessment.luminance_before_cd_m2,
                scene.assessment.irritant_smoke,
                assessment.place_unknown,
                {}};
  for (const OtherEyes& eyes : scene.assessment.other_eyes)
    out.people.other_eyes.push_back(eyes.name);
  out.method = {.seed = assessment.seed,
                .eye_paths = assessment.paths,
                .seconds = assessment.seconds,
                .wrong_verdicts = limits::wrong_verdicts,
                .sure_errors = assessment.sure_errors};
  for (const Check& check : assessment.checks) out.checks.push_back(check_of(check));
  const Eye eye{.age_years = scene.assessment.age_years,
                .bleached_cd_m2 = out.state.equivalent_background_cd_m2};
  const SightRules rules{.eye = eye,
                         .irritant_smoke = scene.assessment.irritant_smoke.value_or(false),
                         .place_unknown = assessment.place_unknown};
  std::map<std::string_view, const Sign*> signs;
  for (const Sign& sign : scene.signs) signs[sign.name] = &sign;
  const double albedo = least_albedo(scene, assessment.state);
  for (const SightRow& row : assessment.sights) {
    const Beside beside{reach_of(*signs.at(row.sign), row.view, row.look, rules),
                        experiments_of(row, rules, albedo)};
    out.sights.push_back(sight_of(row, beside, scene.assessment));
  }
  out.sweep = assessment.sweep;
  out.over_time = assessment.over_time;
  for (const StateWarning& one : assessment.warnings) out.warnings.push_back(warning_of(one));
  add_inputs(scene, assessment, out);
  return out;
}

}  // namespace luxodus
