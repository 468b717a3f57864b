#include "actors/judge/assess/assessment_files.hpp"

#include "actors/judge/assess/bcf_issues.hpp"
#include "actors/judge/assess/guid_results.hpp"
#include "actors/judge/assess/guidance_words.hpp"
#include "actors/judge/assess/threshold_words.hpp"
#include "actors/results/formats/csv.hpp"
#include "runtime/core/atomic_file.hpp"
#include "runtime/core/regular_file.hpp"

namespace luxodus {

namespace {

namespace fs = std::filesystem;

/// English sentences; none where there are no remarks.
std::optional<std::string> said(const Remarks& remarks) {
  return remarks.empty() ? std::nullopt : std::optional(english().remarks(remarks));
}

std::optional<std::string> said(const std::optional<Remark>& remark) {
  return remark ? said(Remarks{*remark}) : std::nullopt;
}

CsvTable checks_csv(const AssessmentRecord& assessment) {
  CsvTable table({"rule", "rule_set", "deviation", "edition", "clause", "status", "title",
                  "subject", "condition", "verdict", "value", "unit", "sense", "limit", "margin",
                  "reason"});
  const Texts t = english();
  for (const Check& check : assessment.checks) {
    const Rule& rule = check.rule;
    table.row(name_of(rule.id), rule.set, rule.deviation, rule.edition, t.clause(rule),
              said(rule.status), t.rule_title(name_of(rule.id)), t.subject(check.subject),
              t.remarks(check.conditions), name_of(check.verdict), check.value, check.unit,
              check.at_least ? "at least" : "at most", check.limit, check.margin(),
              said(check.reasons));
  }
  return table;
}

/// "75: legible; protan: invisible".
std::string by_other_eyes(const SeenRecord& seen) {
  std::string out;
  for (const OtherEyesRecord& one : seen.other_eyes)
    out += (out.empty() ? "" : "; ") + one.eyes + ": " + name_of(one.verdict);
  return out;
}

/// From the luminances on.
void add_seen(const SightRecord& sight, CsvTable& table) {
  const bool seen = sight.line_of_sight.seen;
  if (!sight.seen) {
    for (int i = 0; i < 11; ++i) table.empty_cell();
    table.cell(seen);
    for (int i = 0; i < 10; ++i) table.empty_cell();
    return;
  }
  const LookRecord& look = sight.seen->look;
  table.cells(look.legend_cd_m2.value, look.legend_cd_m2.error, look.ground_cd_m2.value,
              look.ground_cd_m2.error, look.surround_cd_m2.value, look.transmission,
              look.reading_level.value, look.reading_level.error, look.seeing_level.value,
              sight.seen->extinction_per_m, sight.seen->jin.legible, seen,
              sight.seen->viewing_distance.within, sight.seen->margin.luminance,
              sight.seen->margin.read_within_m, sight.seen->margin.seen_within_m,
              look.chromatic_difference, by_other_eyes(*sight.seen), sight.seen->eye_light.lux,
              sight.seen->eye_light.clear_air_lux, name_of(sight.seen->experiments.read.observer),
              name_of(sight.seen->experiments.seen.observer));
}

CsvTable sights_csv(const AssessmentRecord& assessment) {
  CsvTable table({"from",
                  "along.value",
                  "stands_for.value",
                  "eye_height.value",
                  "eye.0",
                  "eye.1",
                  "eye.2",
                  "sign",
                  "verdict",
                  "light",
                  "other_light.verdict",
                  "reason",
                  "distance.value",
                  "angle_from_normal.value",
                  "angle_from_gaze.value",
                  "legend.value",
                  "legend.standard_error",
                  "ground.value",
                  "ground.standard_error",
                  "surround.value",
                  "transmission.value",
                  "reading_level.value",
                  "reading_level.standard_error",
                  "seeing_level.value",
                  "extinction.value",
                  "jin.legible",
                  "line_of_sight.seen",
                  "viewing_distance.within",
                  "margin.luminance",
                  "margin.read_within.value",
                  "margin.seen_within.value",
                  "chromatic_difference.value",
                  "other_eyes.verdict",
                  "eye_illuminance.direct.value",
                  "eye_illuminance.direct_in_clear_air.value",
                  "experiments.read.mean_observer",
                  "experiments.seen.mean_observer"});
  for (const SightRecord& sight : assessment.sights) {
    table.cells(english().subject(sight.from), sight.along_m, sight.stands_for.value,
                sight.eye_height_m, sight.eye.x, sight.eye.y, sight.eye.z, sight.sign,
                name_of(sight.verdict));
    std::optional<std::string> light, other;
    if (sight.seen) light = sight.seen->in_new_light ? "new" : "aged";
    if (sight.seen && sight.seen->other_light) other = name_of(sight.seen->other_light->verdict);
    table.cells(light, other, said(sight.reason), sight.distance_m, sight.from_normal_deg,
                sight.from_gaze_deg);
    add_seen(sight, table);
    table.end_row();
  }
  return table;
}

}  // namespace

Result<void> write_assessment(const fs::path& folder, const AssessmentRecord& assessment) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) return system_problem(folder, "cannot make this folder", failed.value());
  if (auto ok = write_json(folder / "assessment.json", assessment_json(assessment)); !ok) return ok;
  if (auto ok = write_csv(folder / "checks.csv", checks_csv(assessment)); !ok) return ok;
  if (auto ok = write_csv(folder / "sights.csv", sights_csv(assessment)); !ok) return ok;
  if (auto ok = write_or_remove(folder / "by_guid.csv", results_by_guid(assessment)); !ok)
    return ok;
  if (auto ok = write_or_remove(folder / "property_sets.csv", property_sets_by_guid(assessment));
      !ok)
    return ok;
  if (auto ok = write_or_remove(folder / "issues.bcf", bcf_issues(assessment)); !ok) return ok;
  std::optional<CsvTable> thresholds;
  if (!assessment.thresholds.empty()) thresholds = thresholds_csv(assessment.thresholds);
  if (auto ok = write_or_remove(folder / "thresholds.csv", thresholds); !ok) return ok;
  std::optional<CsvTable> guided;
  if (assessment.over_time) guided = guidance_csv(*assessment.over_time);
  return write_or_remove(folder / "guided.csv", guided);
}

Result<void> refuse_files_of_others(const fs::path& folder, const std::vector<std::string>& files) {
  const auto text = read_regular_file(folder / "assessment.json", limits::assessment_bytes);
  const Json old = text ? Json::parse(text.value()) : Json();
  if (old.is_object() && old.value("format", Json()) == assessment_format) return {};
  std::error_code error;
  for (const std::string& file : files) {
    if (!fs::exists(fs::symlink_status(folder / file, error))) continue;
    return problem_in(folder / file,
                      "this file is there and no assessment has written it: move it away, give "
                      "another folder, or add --overwrite to luxodus assess to replace it");
  }
  return {};
}

Result<AssessmentRecord> read_assessment(const fs::path& folder) {
  const fs::path path = folder / "assessment.json";
  auto text = read_regular_file(path, limits::assessment_bytes);
  if (!text)
    return problem_in(text.problem().where.file, text.problem().what + "; luxodus assess makes it",
                      text.problem().kind);
  const Json json = Json::parse(text.value());
  if (!json.is_object() || json.value("format", Json()) != assessment_format)
    return problem_in(path, std::string("is not a \"") + assessment_format + "\": make it anew");
  auto read = assessment_of(json);
  if (!read)
    return problem_in(path,
                      read.problem().what +
                          ": this assessment is damaged or of another version; make it anew by "
                          "luxodus assess");
  return read;
}

}  // namespace luxodus
