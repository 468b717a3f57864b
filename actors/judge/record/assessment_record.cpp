#include "actors/judge/record/assessment_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "actors/judge/record/record_forms.hpp"

namespace luxodus {

template <>
inline constexpr size_t members_to_list<CheckRecord> = members_of<Check>() - 1 + members_of<Rule>();
template <>  // of the counts all four
inline constexpr size_t members_to_list<VerdictRecord> = members_of<VerdictRecord>() + 3;
template <>  // warnings are those of the assessment
inline constexpr size_t members_to_list<OverTime> = members_of<OverTime>() - 1;
template <>  // of the guided route its length, places and guidance
inline constexpr size_t members_to_list<RouteOverTime> = members_of<RouteOverTime>() + 2;
template <>
inline constexpr size_t members_to_list<WalkRecord> = members_of<GuidedWalk>();
template <>
inline constexpr size_t members_to_list<GuidedTimeRecord> = 3;

/// A letter for each place.
template <>
struct JsonForm<std::vector<Guidance>> {
  static constexpr std::string_view letters = "gun";
  static Json write(const std::vector<Guidance>& places, const FieldForm&) {
    std::string text;
    for (const Guidance one : places) text += letters[static_cast<size_t>(one)];
    return Json(text);
  }
  static Result<void> read(const Json& json, std::vector<Guidance>& out, const JsonPlace& at,
                           const FieldForm& form) {
    std::string text;
    if (auto ok = read_plain(json, text, at, form); !ok) return ok;
    out.clear();
    for (const char letter : text) {
      const size_t number = letters.find(letter);
      if (number == std::string_view::npos)
        return problem(at.text() + " has other letters than g, u and n");
      out.push_back(static_cast<Guidance>(number));
    }
    return {};
  }
};

template <>
struct JsonForm<DrawnLine> {
  static Json write(const DrawnLine& line, const FieldForm& form) {
    return json_of(glm::dvec4(line.first, line.second), form);
  }
  static Result<void> read(const Json& json, DrawnLine& out, const JsonPlace& at,
                           const FieldForm&) {
    glm::dvec4 ends(0);
    auto ok = read_plain(json, &ends[0], 4, at);
    out = {{ends.x, ends.y}, {ends.z, ends.w}};
    return ok;
  }
};

template <>
struct JsonForm<PlanPoint> {
  static Json write(const PlanPoint& point, const FieldForm& form) {
    return json_of(glm::dvec4(point.place, point.lux), form);
  }
  static Result<void> read(const Json& json, PlanPoint& out, const JsonPlace& at,
                           const FieldForm&) {
    glm::dvec4 values(0);
    auto ok = read_plain(json, &values[0], 4, at);
    out = {glm::dvec3(values), values.w};
    return ok;
  }
};

template <>
struct JsonForm<DrawnLux> {
  static Json write(const DrawnLux& drawn, const FieldForm&) {
    return drawn.lux == 0 ? Json(0) : number_json(drawn.lux);
  }
  static Result<void> read(const Json& json, DrawnLux& out, const JsonPlace& at, const FieldForm&) {
    return read_plain(json, out.lux, at, {.or_null = true});
  }
};

namespace {

// ---- what no list of fields says ---------------------------------------------------------------

Result<void> check_map(const LightMap& map, const char* where) {
  const double places = static_cast<double>(map.columns) * map.rows;
  if (map.columns < 0 || map.rows < 0 || places > static_cast<double>(limits::record_map) ||
      places != static_cast<double>(map.lux.size()))
    return problem(std::string(where) + ": a map has not as many values as it has places");
  if (map.columns > 0 && !(map.spacing_m >= 1e-3 && map.spacing_m <= limits::field_metres))
    return problem(std::string(where) + ": a map has no spacing");
  return {};
}

/// Checks what drawings of a report iterate over and divide by.
Result<void> check_plan(const AssessmentRecord& a) {
  if (a.plan.levels.empty()) return problem("plan.levels is empty");
  for (const PlanLevel& level : a.plan.levels) {
    if (auto ok = check_map(level.map, "plan.levels"); !ok) return ok;
    if (std::abs(level.floor_m) > limits::field_metres)
      return problem("plan.levels: a floor is farther off than any scene");
  }
  for (const RouteRecord& route : a.places.routes)
    if (route.path.size() < 2) return problem("places.routes: a path has less than two points");
  for (const AreaRecord& area : a.places.areas)
    if (area.outline.size() < 3)
      return problem("places.areas: an outline has less than three corners");
  return {};
}

/// Checks what sheets, rooms and charts iterate over and divide by.
Result<void> check_drawn(const AssessmentRecord& a) {
  for (const LuminaireRecord& one : a.luminaires)
    if (one.sheet >= a.sheets.size()) return problem("luminaires: one has no sheet");
  for (const SheetRecord& sheet : a.sheets)
    if (sheet.c0_c180.size() != sheet.c90_c270.size() ||
        (!sheet.c0_c180.empty() && sheet.c0_c180.size() % 2 == 0))
      return problem("sheets: a curve is not whole");
  for (const RoomRecord& room : a.rooms)
    if (room.outline.size() < 3) return problem("rooms: an outline has less than three corners");
  for (const SurfaceRecord& surface : a.surfaces) {
    if (auto ok = check_map(surface.map, "surfaces"); !ok) return ok;
    if (surface.grids.empty()) return problem("surfaces: one has no points");
    for (const SurfaceGridRecord& grid : surface.grids)
      if (grid.points.empty()) return problem("surfaces: one has no points");
  }
  return {};
}

/// Whether a text is base64, which a page may contain.
bool is_picture_text(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '+' ||
           c == '/' || c == '=';
  });
}

/// A backdrop has either lines, or a picture with its place.
Result<void> check_pictures(const AssessmentRecord& a) {
  for (const BackdropRecord& one : a.plan.backdrops) {
    if (one.png.empty() == !one.lines)
      return problem("plan.backdrops: one is neither lines nor a picture");
    if (one.png.empty()) continue;
    if (!one.corner || !one.across || !one.up)
      return problem("plan.backdrops: a picture has no place");
    if (!is_picture_text(one.png)) return problem("plan.backdrops: a picture is none");
  }
  return is_picture_text(a.project.logo_png) ? Result<void>()
                                             : problem("project.logo_png is no picture");
}

/// Every table has a row for each state and a column for each place, since maps index them by both.
/// Of each table the times of its states and the places of its route are completed.
Result<void> complete(RouteOverTime& route, const std::vector<double>& times_s) {
  const size_t places = route.guided.along_m.size();
  const auto is_whole = [&](const auto& table) {
    return table.size() == times_s.size() &&
           std::all_of(table.begin(), table.end(),
                       [&](const auto& row) { return row.size() == places; });
  };
  if (route.has_fds() == route.visibility_m.empty())
    return problem("over_time.routes: what FDS says is not whole");
  if (places == 0 || !is_whole(route.guided.at) || !is_whole(route.by_jin.at) ||
      !is_whole(route.by_line.at) || !is_whole(route.signs) ||
      (route.has_fds() && (!is_whole(route.by_fds.at) || !is_whole(route.visibility_m))))
    return problem("over_time.routes: a table has not as many values as states and places");
  for (GuidedRoute* one : {&route.guided, &route.by_jin, &route.by_line, &route.by_fds}) {
    one->length_m = route.guided.length_m;
    one->along_m = route.guided.along_m;
    one->times_s = times_s;
  }
  return {};
}

Result<void> complete(OverTime& over) {
  if (over.states.empty()) return problem("over_time.states is empty");
  std::vector<double> times_s;
  for (const TimedState& state : over.states) times_s.push_back(state.at_s);
  for (RouteOverTime& route : over.routes) {
    if (auto ok = complete(route, times_s); !ok) return ok;
    if (!route.walks.empty() && !over.walking_speed_m_s)
      return problem("over_time: people walk without a speed");
  }
  return {};
}

bool is_listed(const std::vector<RulesRecord>& rules, const std::string& id) {
  return id.empty() || std::any_of(rules.begin(), rules.end(),
                                   [&](const RulesRecord& one) { return one.id == id; });
}

/// Counts that a table of the file states are those of its checks.
Result<void> check_counts(const char* table, const CountsRecord& said,
                          const CountsRecord& counted) {
  const std::pair<const char*, size_t CountsRecord::*> keys[] = {
      {"fail", &CountsRecord::fail},
      {"not_assessed", &CountsRecord::not_assessed},
      {"not_verified", &CountsRecord::not_verified},
      {"pass", &CountsRecord::pass}};
  for (const auto& [key, count] : keys)
    if (said.*count != counted.*count)
      return problem(fmt::format("{}.{} is not the number of its checks", table, key));
  return {};
}

/// Every check is by a rule set that the judged state names, and counts are those of the checks.
/// Otherwise the verdict would be of something else. `table`: "counts" of the file.
Result<void> check_checks(const AssessmentRecord& a, const Json& table) {
  CheckCounts counts{};
  const auto stray = [](size_t check, const std::string& id, const char* list) {
    return problem(
        fmt::format("checks[{}] is by \"{}\", which is not among state.{}", check, id, list));
  };
  for (size_t i = 0; i < a.checks.size(); ++i) {
    const Rule& rule = a.checks[i].rule;
    ++counts[static_cast<size_t>(a.checks[i].verdict)];
    if (!is_listed(a.state.rules, rule.set)) return stray(i, rule.set, "rules");
    if (!is_listed(a.state.deviations, rule.deviation))
      return stray(i, rule.deviation, "deviations");
  }
  const CountsRecord counted = CountsRecord::of(counts);
  CountsRecord said;
  if (auto ok = read_fields(table, said); !ok) return ok;
  if (auto ok = check_counts("counts", said, counted); !ok) return ok;
  return check_counts("verdict", a.verdict.counts, counted);
}

}  // namespace

CountsRecord CountsRecord::of(const CheckCounts& counts) {
  return {.pass = count_of(counts, CheckVerdict::pass),
          .fail = count_of(counts, CheckVerdict::fail),
          .not_assessed = count_of(counts, CheckVerdict::not_assessed),
          .not_verified = count_of(counts, CheckVerdict::not_verified)};
}

GuidedTimeRecord::GuidedTimeRecord(const GuidedTime& time)
    : until_s(time.until_s), lost_by_s(time.lost_by_s) {
  if (time.lost_by_s) lost_at_m = time.lost_at_m;
}

const char* OverTime::what() {
  return "Whether signs are read that lead on. No analysis of available and required safe egress "
         "time (ASET/RSET): heat, gases, and when people set out are not in it. Between two states "
         "the worse holds.";
}

std::string NotAssessedRecord::words(const Texts& texts) const {
  const std::string id(name_of(rule));
  return id.empty() ? texts("views.of_signs") : id + ", " + edition + ": " + texts.rule_title(id);
}

DrawnLux drawn_lux(double lux) {
  if (!std::isfinite(lux)) return {std::nan("")};
  if (lux <= 0) return {0};
  const double step = std::pow(10.0, std::floor(std::log10(lux)) - 3);
  return {step >= 1e-9 ? std::stod(fmt::format("{:.4g}", lux)) : 0};
}

Json assessment_json(const AssessmentRecord& record) {
  return json_of(record);
}

Json backdrops_json(const std::vector<BackdropRecord>& backdrops) {
  return json_of(backdrops);
}

Result<AssessmentRecord> assessment_of(const Json& json) {
  if (text_in(json, "format") != assessment_format)
    return problem(std::string("its \"format\" is not \"") + assessment_format + "\"");
  AssessmentRecord out;
  if (auto ok = read_fields(json, out); !ok) return ok.problem();
  if (auto ok = check_plan(out); !ok) return ok.problem();
  if (auto ok = check_drawn(out); !ok) return ok.problem();
  if (auto ok = check_pictures(out); !ok) return ok.problem();
  if (out.over_time)
    if (auto ok = complete(*out.over_time); !ok) return ok.problem();
  if (auto ok = check_checks(out, json.at("counts")); !ok) return ok.problem();
  return out;
}

}  // namespace luxodus
