#include "actors/judge/walk/walk_files.hpp"

#include <fmt/format.h>

#include <cmath>

#include "actors/judge/assess/plan_cut.hpp"
#include "actors/results/formats/csv.hpp"
#include "actors/results/formats/json_out.hpp"
#include "actors/results/formats/svg_plot.hpp"
#include "runtime/core/atomic_file.hpp"

namespace luxodus {

namespace {

std::string names_of(const WalkToWrite& w, const WalkStep& step, SignAnswer answer) {
  std::string out;
  for (const SignOnWay& one : step.signs)
    if (one.answer == answer) out += (out.empty() ? "" : "; ") + w.scene.signs[one.sign].name;
  return out;
}

CsvTable people_csv(const WalkToWrite& w) {
  CsvTable table({"group", "person", "from_s", "to_s", "read_s", "undecided_s", "unread_s",
                  "longest_without_s", "first_read_s", "last_read_s", "signs_read",
                  "mean_extinction_per_m", "largest_extinction_per_m",
                  "largest_equivalent_background_cd_m2"});
  for (size_t i = 0; i < w.walk.walks.size(); ++i) {
    const PlacedPerson& one = w.people[w.walk.walks[i].person];
    const PersonSummary& s = w.summaries.people[i];
    table.row(one.group, one.id, s.from_s, s.to_s, s.read_s, s.undecided_s, s.unread_s,
              s.longest_unread_s, s.first_read_s, s.last_read_s, static_cast<int64_t>(s.signs_read),
              s.mean_extinction, s.max_extinction, s.max_bleached_cd_m2);
  }
  return table;
}

CsvTable signs_csv(const WalkToWrite& w) {
  std::vector<std::string> columns{"sign", "in_view_s"};
  for (size_t a = 0; a < sign_answers; ++a)
    columns.push_back(std::string(name_of(static_cast<SignAnswer>(a))) + "_s");
  columns.insert(columns.end(), {"hidden_by_people_s", "readers"});
  CsvTable table(columns);
  const std::vector<SignSummary>& signs = w.summaries.signs;
  for (size_t i = 0; i < signs.size(); ++i) {
    table.cells(w.scene.signs[i].name, signs[i].in_view_s);
    for (const double seconds : signs[i].by_answer_s) table.cell(seconds);
    table.row(signs[i].hidden_by_people_s, static_cast<int64_t>(signs[i].readers));
  }
  return table;
}

/// Direction from +x counter-clockwise; NaN where it is unknown.
double facing_deg(const glm::dvec2& facing) {
  if (facing == glm::dvec2(0)) return std::nan("");
  return glm::degrees(std::atan2(facing.y, facing.x));
}

CsvTable steps_csv(const WalkToWrite& w) {
  CsvTable table({"group", "person", "time_s", "x_m", "y_m", "eye_z_m", "facing_deg",
                  "extinction_per_m", "equivalent_background_cd_m2", "unread_s", "read", "seen",
                  "invisible", "hidden", "undecided"});
  for (const WalkedPerson& walked : w.walk.walks)
    for (const WalkStep& step : walked.steps) {
      const PlacedPerson& one = w.people[walked.person];
      table.row(one.group, one.id, step.time_s, step.eye.x, step.eye.y, step.eye.z,
                facing_deg(step.facing), step.extinction_per_m, step.bleached_cd_m2, step.unread_s,
                names_of(w, step, SignAnswer::read), names_of(w, step, SignAnswer::seen),
                names_of(w, step, SignAnswer::invisible), names_of(w, step, SignAnswer::hidden),
                names_of(w, step, SignAnswer::undecided));
    }
  return table;
}

CsvTable curve_csv(const std::vector<CurvePoint>& curve) {
  CsvTable table({"time_s", "people", "reading", "undecided", "reading_share"});
  for (const CurvePoint& point : curve)
    table.row(point.time_s, static_cast<int64_t>(point.present),
              static_cast<int64_t>(point.reading), static_cast<int64_t>(point.undecided),
              point.reading_share());
  return table;
}

SvgPlot curve_plot(const WalkToWrite& w) {
  SvgPlot plot;
  plot.title = "People who have a sign that they read";
  plot.subtitle =
      fmt::format("{}, scenario {}: {} people", w.scene.name, w.walk.scenario, w.people.size());
  plot.label_x = "time [s]";
  plot.label_y = "share of the people in the building [%]";
  PlotSeries read{.name = "surely read", .x = {}, .y = {}, .error = {}, .markers = false};
  PlotSeries perhaps{.name = "read or undecided", .x = {}, .y = {}, .error = {}, .markers = false};
  for (const CurvePoint& point : w.summaries.curve) {
    if (point.present == 0) continue;
    const double all = static_cast<double>(point.present);
    read.x.push_back(point.time_s);
    read.y.push_back(100 * *point.reading_share());
    perhaps.x.push_back(point.time_s);
    perhaps.y.push_back(100 * static_cast<double>(point.reading + point.undecided) / all);
  }
  plot.series = {std::move(perhaps), std::move(read)};  // the last one is drawn on top
  return plot;
}

Json json_or_null(const std::optional<double>& value) {
  return value ? number_json(*value) : Json();
}

Json person_json(const PlacedPerson& one, const PersonSummary& s) {
  Json out = Json::object();
  out["group"] = one.group;
  out["person"] = one.id;
  out["from_s"] = s.from_s;
  out["to_s"] = s.to_s;
  out["read_s"] = s.read_s;
  out["undecided_s"] = s.undecided_s;
  out["unread_s"] = s.unread_s;
  out["longest_without_s"] = s.longest_unread_s;
  out["first_read_s"] = json_or_null(s.first_read_s);
  out["last_read_s"] = json_or_null(s.last_read_s);
  out["signs_read"] = s.signs_read;
  out["mean_extinction_per_m"] = s.mean_extinction;
  out["largest_extinction_per_m"] = s.max_extinction;
  out["largest_equivalent_background_cd_m2"] = s.max_bleached_cd_m2;
  return out;
}

Json walk_json(const WalkToWrite& w) {
  Json out = Json::object();
  out["program"] = w.version;
  out["scene"] = w.scene.name;
  out["scenario"] = w.walk.scenario;
  out["states_s"] = w.walk.times_s;
  out["forms"] = w.forms;
  out["step_s"] = w.options.step_s;
  out["field_of_view_deg"] = w.options.field_of_view_deg;
  out["crowd_hides"] = w.options.crowd_hides;
  out["steps_through_walls"] = w.walk.walls.share();
  out["sure_errors"] = w.walk.sure_errors;
  out["people"] = Json::array();
  for (size_t i = 0; i < w.walk.walks.size(); ++i)
    out["people"].push_back(person_json(w.people[w.walk.walks[i].person], w.summaries.people[i]));
  out["signs"] = Json::array();
  const std::vector<SignSummary>& signs = w.summaries.signs;
  for (size_t i = 0; i < signs.size(); ++i) {
    Json sign = Json::object();
    sign["name"] = w.scene.signs[i].name;
    sign["in_view_s"] = signs[i].in_view_s;
    for (size_t a = 0; a < sign_answers; ++a)
      sign[std::string(name_of(static_cast<SignAnswer>(a))) + "_s"] = signs[i].by_answer_s[a];
    sign["hidden_by_people_s"] = signs[i].hidden_by_people_s;
    sign["readers"] = signs[i].readers;
    out["signs"].push_back(std::move(sign));
  }
  out["curve"] = Json::array();
  for (const CurvePoint& point : w.summaries.curve) {
    Json one = Json::object();
    one["time_s"] = point.time_s;
    one["people"] = point.present;
    one["reading"] = point.reading;
    one["undecided"] = point.undecided;
    one["reading_share"] = json_or_null(point.reading_share());
    out["curve"].push_back(std::move(one));
  }
  return out;
}

Result<void> write_levels(const std::filesystem::path& folder, const WalkToWrite& w) {
  const auto counts = floor_counts(w.levels, w.people, w.walk.walks, w.options.step_s);
  std::vector<std::vector<const WalkedPerson*>> begun(w.levels.size());
  for (const WalkedPerson& walked : w.walk.walks) {
    const PlacedPerson& one = w.people[walked.person];
    begun[level_of(w.levels, walked.steps.front().eye.z - one.eye_height_m)].push_back(&walked);
  }
  const auto maps = level_files("map", w.levels.size()),
             animations = level_files("animation", w.levels.size());
  for (size_t i = 0; i < w.levels.size(); ++i) {
    std::optional<std::string> map, animation;
    if (!counts[i].empty()) map = walk_map(w.levels[i], counts[i]);
    if (!begun[i].empty()) animation = walk_animation(w.levels[i], begun[i], w.options.step_s);
    if (auto ok = write_or_remove(folder / maps[i], map); !ok) return ok;
    if (auto ok = write_or_remove(folder / animations[i], animation); !ok) return ok;
  }
  return {};
}

}  // namespace

std::vector<std::string> level_files(const std::string& what, size_t levels) {
  if (levels == 1) return {what + ".svg"};
  std::vector<std::string> out;
  for (size_t i = 1; i <= levels; ++i) out.push_back(fmt::format("{}_{}.svg", what, i));
  return out;
}

Result<void> write_walk(const std::filesystem::path& folder, const WalkToWrite& walk) {
  if (auto ok = write_csv(folder / "people.csv", people_csv(walk)); !ok) return ok;
  if (auto ok = write_csv(folder / "signs.csv", signs_csv(walk)); !ok) return ok;
  if (auto ok = write_csv(folder / "steps.csv", steps_csv(walk)); !ok) return ok;
  if (auto ok = write_csv(folder / "curve.csv", curve_csv(walk.summaries.curve)); !ok) return ok;
  if (auto ok = write_svg_plot(folder / "curve.svg", curve_plot(walk)); !ok) return ok;
  if (auto ok = write_levels(folder, walk); !ok) return ok;
  return write_json(folder / "walk.json", walk_json(walk));
}

}  // namespace luxodus
