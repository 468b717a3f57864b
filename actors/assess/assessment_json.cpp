#include "actors/assess/assessment_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "actors/assess/assessment_inputs.hpp"
#include "scenes/format/csv.hpp"

namespace luxodus {

namespace {

namespace fs = std::filesystem;

Json place_json(const glm::dvec3& p) {
  return {p.x, p.y, p.z};
}

Json uncertain_json(const Uncertain& u, const char* unit) {
  return measured_json(u.value, u.error, unit);
}

Json optional_json(const std::optional<double>& value) {
  return value ? number_json(*value) : Json();
}

Json check_json(const Check& check) {
  Json out = {{"rule", check.rule.id},
              {"edition", check.rule.edition},
              {"clause", check.rule.clause},
              {"title", check.rule.title},
              {"quoted_from", check.rule.source},
              {"subject", check.subject},
              {"condition", check.condition},
              {"verdict", name_of(check.verdict)},
              {"value", optional_json(check.value)},
              {"unit", check.unit},
              {"limit", optional_json(check.limit)},
              {"sense", check.at_least ? "at least" : "at most"},
              {"margin", optional_json(check.margin())}};
  if (check.worst) out["worst_place"] = place_json(*check.worst);
  if (!check.reason.empty()) out["reason"] = check.reason;
  return out;
}

Json sight_json(const SightRow& row) {
  Json out = {{"from", row.from},
              {"stands_for", exact_json(row.stands_for, row.from[0] == 'r' ? "m" : "m2")},
              {"along", exact_json(row.along_m, "m")},
              {"eye_height", exact_json(row.height_m, "m")},
              {"eye", place_json(row.eye)},
              {"sign", row.sign},
              {"back_face", row.back_face},
              {"verdict", name_of(row.sight.verdict)}};
  if (!row.sight.reason.empty()) out["reason"] = row.sight.reason;
  out["distance"] = exact_json(row.view.distance_m, "m");
  out["angle_from_normal"] = exact_json(row.view.angle_deg, "deg");
  out["angle_from_gaze"] = exact_json(row.gaze_deg, "deg");
  out["angular_height"] = exact_json(row.view.height_arcmin, "arcmin");
  out["angular_detail"] = exact_json(row.view.detail_arcmin, "arcmin");
  if (row.sight.verdict == SightVerdict::hidden || row.look.legend.value + row.look.face.value == 0)
    return out;
  out["legend"] = uncertain_json(row.look.legend, "cd/m2");
  out["ground"] = uncertain_json(row.look.ground, "cd/m2");
  out["surround"] = uncertain_json(row.look.surround, "cd/m2");
  out["transmission"] = exact_json(row.look.transmission, "1");
  out["glare_veil"] = exact_json(row.look.veil_cd_m2, "cd/m2");
  out["visible_share"] = exact_json(row.look.visible_share, "1");
  out["reading_level"] = uncertain_json(row.sight.reading_level, "1");
  out["seeing_level"] = uncertain_json(row.sight.seeing_level, "1");
  out["extinction"] = exact_json(row.sight.extinction, "1/m");
  out["jin"] = {{"legible_within", exact_json(row.sight.jin_m, "m")},
                {"legible", row.sight.jin_legible}};
  out["viewing_distance"] = {{"allowed", exact_json(row.sight.viewing.allowed_oblique_m, "m")},
                             {"within", row.sight.viewing.within}};
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

/// The value at "a.b" or "a.0" of an object; null where there is none.
const Json* value_at(const Json& row, std::string path) {
  std::replace(path.begin(), path.end(), '.', '/');
  const Json::json_pointer pointer("/" + path);
  return row.contains(pointer) ? &row[pointer] : nullptr;
}

/// A row of every entry, with the values at these paths.
CsvTable csv_of(const Json& rows, const std::vector<std::string>& columns) {
  CsvTable table(columns);
  for (const Json& row : rows) {
    for (const std::string& column : columns) {
      const Json* value = value_at(row, column);
      if (value == nullptr || value->is_null())
        table.empty_cell();
      else if (value->is_boolean())
        table.cell(value->get<bool>());
      else if (value->is_number())
        table.cell(value->get<double>());
      else
        table.cell(value->get<std::string>());
    }
    table.end_row();
  }
  return table;
}

}  // namespace

Json assessment_json(const SceneDescription& scene, const Assessment& assessment,
                     const std::string& version) {
  const CheckCounts counts = counts_of(assessment.checks);
  std::map<std::string, size_t> sight_counts;
  for (const SightRow& row : assessment.sights) ++sight_counts[name_of(row.sight.verdict)];
  Json out = {{"format", assessment_format},
              {"version", version},
              {"scene",
               {{"name", scene.name},
                {"title", scene.title},
                {"file", scene.file},
                {"content_hash", fmt::format("{:016x}", assessment.scene_hash)},
                {"scenario", assessment.scenario}}},
              {"people",
               {{"age", exact_json(scene.assessment.age_years, "years")},
                {"spacing", exact_json(scene.assessment.spacing_m, "m")},
                {"irritant_smoke", scene.assessment.irritant_smoke.value_or(false)}}},
              {"method",
               {{"seed", assessment.seed},
                {"eye_paths", assessment.paths},
                {"seconds", exact_json(assessment.seconds, "s")}}},
              {"counts", {{"pass", counts[0]}, {"fail", counts[1]}, {"not_assessed", counts[2]}}},
              {"sight_counts", sight_counts}};
  Json& checks = out["checks"] = Json::array();
  for (const Check& check : assessment.checks) checks.push_back(check_json(check));
  Json& sights = out["sights"] = Json::array();
  for (const SightRow& row : assessment.sights) sights.push_back(sight_json(row));
  out["sweep"] = sweep_json(assessment);
  Json& warnings = out["warnings"] = Json::array();
  for (const Problem& warning : assessment.warnings) warnings.push_back(warning.text());
  out["project"] = project_json(scene.project);
  out["scenario"] = scenario_json(scene, assessment.scenario);
  out["luminaires"] = luminaires_json(scene);
  out["signs"] = signs_json(scene);
  out["places"] = places_json(scene);
  out["materials"] = materials_json(scene);
  out["media"] = media_json(scene);
  Json& cameras = out["cameras"] = Json::array();
  for (const Camera& camera : scene.cameras) cameras.push_back(camera.name);
  out["plan"] = plan_json(assessment);
  return out;
}

Result<Done> write_assessment(const fs::path& folder, const Json& assessment) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) return Problem{{folder.string(), 0}, "cannot make this folder: " + failed.message()};
  if (auto ok = write_json(folder / "assessment.json", assessment); !ok.ok()) return ok;
  const auto checks = csv_of(assessment["checks"],
                             {"rule", "edition", "clause", "title", "subject", "condition",
                              "verdict", "value", "unit", "sense", "limit", "margin", "reason"});
  if (auto ok = write_csv(folder / "checks.csv", checks); !ok.ok()) return ok;
  const auto sights = csv_of(assessment["sights"], {"from",
                                                    "along.value",
                                                    "stands_for.value",
                                                    "eye_height.value",
                                                    "eye.0",
                                                    "eye.1",
                                                    "eye.2",
                                                    "sign",
                                                    "verdict",
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
                                                    "viewing_distance.within"});
  if (auto ok = write_csv(folder / "sights.csv", sights); !ok.ok()) return ok;
  return Done{};
}

Result<Json> read_assessment(const fs::path& folder) {
  const fs::path path = folder / "assessment.json";
  std::error_code failed;
  const auto size = fs::file_size(path, failed);
  if (failed)
    return Problem{{path.string(), 0},
                   "cannot be read (" + failed.message() + "): make it by luxodus assess"};
  if (size > limits::assessment_bytes)
    return Problem{{path.string(), 0}, "is larger than any assessment"};
  std::ifstream file(path);
  Json read = Json::parse(file, nullptr, false);
  if (!read.is_object() || read.value("format", "") != assessment_format)
    return Problem{{path.string(), 0},
                   std::string("is not a \"") + assessment_format + "\": make it anew"};
  return read;
}

}  // namespace luxodus
