#include "actors/judge/assess/assessment_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "actors/judge/assess/assessment_check.hpp"
#include "actors/judge/assess/assessment_inputs.hpp"
#include "actors/judge/assess/bcf_issues.hpp"
#include "actors/judge/assess/guid_results.hpp"
#include "actors/judge/assess/over_time_json.hpp"
#include "actors/judge/assess/state_words.hpp"
#include "actors/judge/texts/remark_json.hpp"
#include "actors/results/formats/csv.hpp"
#include "runtime/core/atomic_file.hpp"
#include "runtime/core/regular_file.hpp"

namespace luxodus {

namespace {

namespace fs = std::filesystem;

Json uncertain_json(const Uncertain& u, const char* unit) {
  return measured_json(u.value, u.error, unit);
}

Json optional_json(const std::optional<double>& value) {
  return value ? number_json(*value) : Json();
}

Json check_json(const Check& check) {
  Json out = {{"rule", name_of(check.rule.id)},
              {"rule_set", check.rule.set},
              {"deviation", check.rule.deviation},
              {"edition", check.rule.edition},
              {"clause", english().clause(check.rule)},
              {"clause_number", check.rule.clause},
              {"title", english().rule_title(name_of(check.rule.id))},
              {"quoted_from", remarks_json(check.rule.sources)},
              {"status", check.rule.status ? remark_json(*check.rule.status) : Json()},
              {"subject", subject_json(check.subject)},
              {"conditions", remarks_json(check.conditions)},
              {"verdict", name_of(check.verdict)},
              {"value", optional_json(check.value)},
              {"unit", check.unit},
              {"limit", optional_json(check.limit)},
              {"sense", check.at_least ? "at least" : "at most"},
              {"margin", optional_json(check.margin())}};
  if (check.worst) out["worst_place"] = vector_json(*check.worst);
  if (!check.reasons.empty()) out["reasons"] = remarks_json(check.reasons);
  return out;
}

/// Luminances at the eye and the verdict in one light.
Json look_json(const SignLook& look, const Sight& sight) {
  return {{"legend", uncertain_json(look.legend, "cd/m2")},
          {"ground", uncertain_json(look.ground, "cd/m2")},
          {"surround", uncertain_json(look.surround, "cd/m2")},
          {"transmission", exact_json(look.transmission, "1")},
          {"glare_veil", exact_json(look.veil_cd_m2, "cd/m2")},
          {"visible_share", exact_json(look.visible_share, "1")},
          {"reading_level", uncertain_json(sight.reading_level, "1")},
          {"seeing_level", uncertain_json(sight.seeing_level, "1")}};
}

Json sight_json(const SightRow& row) {
  Json out = {
      {"from", subject_json(row.from)},
      {"stands_for", exact_json(row.stands_for, row.from.kind == SubjectKind::route ? "m" : "m2")},
      {"along", exact_json(row.along_m, "m")},
      {"eye_height", exact_json(row.height_m, "m")},
      {"eye", vector_json(row.eye)},
      {"sign", row.sign},
      {"back_face", row.back_face},
      {"verdict", name_of(row.sight.verdict)}};
  if (row.sight.reason) out["reason"] = remark_json(*row.sight.reason);
  out["distance"] = exact_json(row.view.distance_m, "m");
  out["angle_from_normal"] = exact_json(row.view.angle_deg, "deg");
  out["angle_from_gaze"] = exact_json(row.gaze_deg, "deg");
  out["angular_height"] = exact_json(row.view.height_arcmin, "arcmin");
  out["angular_detail"] = exact_json(row.view.detail_arcmin, "arcmin");
  out["line_of_sight"] = {{"distance", exact_json(row.line.distance_m, "m")},
                          {"clear", row.line.clear},
                          {"extinction", exact_json(row.line.extinction, "1/m")},
                          {"visible_within", exact_json(row.line.visibility_m, "m")},
                          {"seen", row.line.seen}};
  if (row.sight.verdict == SightVerdict::hidden || row.look.legend.value + row.look.face.value == 0)
    return out;
  out["light"] = row.in_new_light ? "new" : "aged";
  out.update(look_json(row.look, row.sight));
  out["extinction"] = exact_json(row.sight.extinction, "1/m");
  out["jin"] = {{"legible_within", exact_json(row.sight.jin_m, "m")},
                {"legible", row.sight.jin_legible}};
  out["viewing_distance"] = {{"allowed", exact_json(row.sight.viewing.allowed_oblique_m, "m")},
                             {"within", row.sight.viewing.within}};
  if (!row.other) return out;
  Json& other = out["other_light"] = {{"light", row.in_new_light ? "aged" : "new"},
                                      {"verdict", name_of(row.other->sight.verdict)}};
  if (row.other->sight.reason) other["reason"] = remark_json(*row.other->sight.reason);
  other.update(look_json(row.other->look, row.other->sight));
  return out;
}

/// A rule that was not assessed, or views of signs if `rule` is empty, with the reasons.
struct NotAssessed {
  std::string rule, edition;
  bool undecided = false;  // views are undecided within their standard errors
  Remarks reasons;

  friend auto operator<=>(const NotAssessed&, const NotAssessed&) = default;
  /// "E8, EN 1838:2013: Disability glare: intensity of a luminaire"
  std::string words() const {
    return rule.empty() ? english()("views.of_signs")
                        : rule + ", " + edition + ": " + english().rule_title(rule);
  }
};

/// Each group once, the most frequent first.
Json not_assessed_json(const Assessment& assessment) {
  std::map<NotAssessed, size_t> groups;
  for (const Check& check : assessment.checks)
    if (check.verdict == CheckVerdict::not_assessed)
      ++groups[{std::string(name_of(check.rule.id)), check.rule.edition, false, check.reasons}];
  for (const SightRow& row : assessment.sights) {
    const bool undecided = row.sight.verdict == SightVerdict::undecided;
    if (!undecided && row.sight.verdict != SightVerdict::not_assessed) continue;
    Remarks reasons;
    if (row.sight.reason) reasons.push_back(*row.sight.reason);
    ++groups[{"", "", undecided, std::move(reasons)}];
  }
  if (!assessment.reality) groups[{"", "", false, {remark(RemarkId::codes_alone)}}] = 1;
  std::vector<std::pair<NotAssessed, size_t>> rows(groups.begin(), groups.end());
  std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    if (a.second != b.second) return a.second > b.second;
    const std::string x = a.first.words(), y = b.first.words();
    if (x != y) return x < y;
    return english().remarks(a.first.reasons) < english().remarks(b.first.reasons);
  });
  Json out = Json::array();
  for (const auto& [what, count] : rows)
    out.push_back({{"rule", what.rule},
                   {"edition", what.edition},
                   {"what", what.words()},
                   {"undecided", what.undecided},
                   {"why", remarks_json(what.reasons)},
                   {"count", count}});
  return out;
}

Json sweep_json(const Assessment& assessment) {
  Json out = Json::array();
  for (const SweepRow& row : assessment.sweep)
    out.push_back({{"smoke_factor", row.factor},
                   {"sign", row.sign},
                   {"places", row.places},
                   {"legible", row.legible},
                   {"undecided", row.undecided}});
  return out;
}

/// The value at "a.b" or "a.0"; null if there is none.
const Json* value_at(const Json& row, std::string path) {
  std::replace(path.begin(), path.end(), '.', '/');
  return row.at_path(path);
}

/// A row for every entry with the values at these paths; remarks and subjects are written as
/// English sentences. "name=path" gives a column another name than its path.
CsvTable csv_of(const Json& rows, const std::vector<std::string>& columns) {
  std::vector<std::string> names, paths;
  for (const std::string& column : columns) {
    names.push_back(column.substr(0, column.find('=')));
    paths.push_back(column.substr(column.find('=') + 1));
  }
  CsvTable table(names);
  for (const Json& row : rows) {
    for (const std::string& path : paths) {
      const Json* value = value_at(row, path);
      if (value == nullptr || value->is_null())
        table.empty_cell();
      else if (value->is_boolean())
        table.cell(value->get<bool>());
      else if (value->is_number())
        table.cell(value->get<double>());
      else if (value->is_string())
        table.cell(value->text());
      else if (const std::string words = english_in(row, path.c_str());
               !words.empty() || path == "conditions")
        table.cell(words);
      else
        table.empty_cell();
    }
    table.end_row();
  }
  return table;
}

/// Without issues, those of an earlier assessment are removed.
Result<void> write_issues(const fs::path& file, const std::optional<std::string>& issues) {
  if (issues) return write_file_atomically(file, std::string_view(*issues));
  std::error_code failed;
  fs::remove(file, failed);
  if (failed)
    return system_problem(file, "cannot remove what an earlier run has left", failed.value());
  return {};
}

}  // namespace

Json assessment_json(const SceneDescription& scene, const Assessment& assessment,
                     const std::string& version) {
  const CheckCounts counts = counts_of(assessment.checks);
  std::map<std::string, size_t> sight_counts;
  for (const SightRow& row : assessment.sights) ++sight_counts[name_of(row.sight.verdict)];
  Json out = {
      {"format", assessment_format},
      {"version", version},
      {"scene",
       {{"name", scene.name},
        {"title", scene.title},
        {"file", scene.file},
        {"content_hash", fmt::format("{:016x}", assessment.scene_hash)},
        {"scenario", assessment.state.scenario}}},
      {"state", state_json(assessment.state)},
      {"verdict", verdict_json(assessment.state, counts, sight_counts)},
      {"not_assessed", not_assessed_json(assessment)},
      {"people",
       {{"age", exact_json(scene.assessment.age_years, "years")},
        {"spacing", exact_json(scene.assessment.spacing_m, "m")},
        {"irritant_smoke",
         scene.assessment.irritant_smoke ? Json(*scene.assessment.irritant_smoke) : Json()}}},
      {"method",
       {{"seed", assessment.seed},
        {"eye_paths", assessment.paths},
        {"seconds", exact_json(assessment.seconds, "s")}}},
      {"counts",
       {{"pass", count_of(counts, CheckVerdict::pass)},
        {"fail", count_of(counts, CheckVerdict::fail)},
        {"not_assessed", count_of(counts, CheckVerdict::not_assessed)},
        {"not_verified", count_of(counts, CheckVerdict::not_verified)}}},
      {"sight_counts", sight_counts}};
  Json& checks = out["checks"] = Json::array();
  for (const Check& check : assessment.checks) checks.push_back(check_json(check));
  Json& sights = out["sights"] = Json::array();
  for (const SightRow& row : assessment.sights) sights.push_back(sight_json(row));
  out["sweep"] = sweep_json(assessment);
  if (assessment.over_time) out["over_time"] = over_time_json(*assessment.over_time);
  Json& warnings = out["warnings"] = Json::array();
  for (const StateWarning& one : assessment.warnings) {
    const std::string words = one.remark ? english().remark(*one.remark) : one.words;
    warnings.push_back({{"text", problem_in(one.place, words).text()},
                        {"file", one.place.file},
                        {"line", one.place.line},
                        {"remark", one.remark ? remark_json(*one.remark) : Json()}});
  }
  out["project"] = project_json(scene.project);
  out["scenario"] = scenario_json(scene, assessment.state.scenario);
  out["luminaires"] = luminaires_json(scene);
  out["signs"] = signs_json(scene);
  out["places"] = places_json(scene);
  out["materials"] = materials_json(scene);
  out["media"] = media_json(scene);
  Json& cameras = out["cameras"] = Json::array();
  for (const Camera& camera : scene.cameras) cameras.push_back(camera.name);
  out["plan"] = plan_json(assessment);
  if (!scene.backdrops.empty()) out["plan"]["backdrops"] = backdrops_json(scene);
  return out;
}

Result<void> write_assessment(const fs::path& folder, const Json& assessment) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) return system_problem(folder, "cannot make this folder", failed.value());
  if (auto ok = write_json(folder / "assessment.json", assessment); !ok) return ok.problem();
  const auto checks =
      csv_of(assessment["checks"], {"rule", "rule_set", "deviation", "edition", "clause", "status",
                                    "title", "subject", "condition=conditions", "verdict", "value",
                                    "unit", "sense", "limit", "margin", "reason=reasons"});
  if (auto ok = write_csv(folder / "checks.csv", checks); !ok) return ok.problem();
  const auto sights = csv_of(assessment["sights"], {"from",
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
                                                    "viewing_distance.within"});
  if (auto ok = write_csv(folder / "sights.csv", sights); !ok) return ok.problem();
  if (auto ok = write_or_remove(folder / "by_guid.csv", results_by_guid(assessment)); !ok)
    return ok.problem();
  if (auto ok = write_or_remove(folder / "property_sets.csv", property_sets_by_guid(assessment));
      !ok)
    return ok.problem();
  if (auto ok = write_issues(folder / "issues.bcf", bcf_issues(assessment)); !ok)
    return ok.problem();
  const auto over = assessment.find("over_time");
  return write_or_remove(folder / "guided.csv", over == assessment.end()
                                                    ? std::nullopt
                                                    : std::optional(guidance_csv(*over)));
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

Result<Json> read_assessment(const fs::path& folder) {
  const fs::path path = folder / "assessment.json";
  auto text = read_regular_file(path, limits::assessment_bytes);
  if (!text)
    return problem_in(text.problem().where.file, text.problem().what + "; luxodus assess makes it",
                      text.problem().kind);
  Json read = Json::parse(text.value());
  if (!read.is_object() || read.value("format", "") != assessment_format)
    return problem_in(path, std::string("is not a \"") + assessment_format + "\": make it anew");
  if (auto ok = check_assessment(read); !ok)
    return problem_in(path,
                      ok.problem().what +
                          ": this assessment is damaged or of another version; make it anew by "
                          "luxodus assess");
  return read;
}

}  // namespace luxodus
