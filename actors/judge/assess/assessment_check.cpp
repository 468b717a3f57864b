#include "actors/judge/assess/assessment_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "actors/judge/texts/remark_json.hpp"

namespace luxodus {

namespace {

enum class Kind {
  text,
  number,
  number_or_null,
  flag,
  flag_or_null,
  object,
  object_or_null,
  list,
  place2,
  place3,
  place4,
  // Parts of sentences
  remark,
  remark_or_null,
  remarks,
  subject
};

/// A key that is read. "a.b" is b of a; "a[].b" is b of every entry of a. A trailing "?" marks a
/// key that may be absent; keys below it are required only if it is present.
struct RequiredKey {
  std::string_view path;
  Kind kind;
};

constexpr RequiredKey keys[] = {
    {"version", Kind::text},
    {"scene.name", Kind::text},
    {"scene.title", Kind::text},
    {"scene.file", Kind::text},
    {"scene.content_hash", Kind::text},
    {"scene.scenario", Kind::text},
    {"project.name", Kind::text},
    {"project.client", Kind::text},
    {"project.address", Kind::text},
    {"project.document", Kind::text},
    {"project.revision", Kind::text},
    {"project.date", Kind::text},
    {"project.author", Kind::text},
    {"project.checker", Kind::text},
    {"project.north_deg", Kind::number},
    {"project.logo_png?", Kind::text},
    {"people.age.value", Kind::number},
    {"people.spacing.value", Kind::number},
    {"people.irritant_smoke", Kind::flag_or_null},
    {"method.seed", Kind::number},
    {"method.eye_paths", Kind::number},
    {"method.seconds.value", Kind::number},
    {"counts.pass", Kind::number},
    {"counts.fail", Kind::number},
    {"counts.not_assessed", Kind::number},
    {"sight_counts", Kind::object},
    {"state.scenario", Kind::text},
    {"state.operation", Kind::text},
    {"state.seconds_after_failure", Kind::object_or_null},
    {"state.seconds_after_failure?.value", Kind::number},
    {"state.luminaires.lit", Kind::number},
    {"state.luminaires.of", Kind::number},
    {"state.luminaires.lit_names[]", Kind::text},
    {"state.smoke", Kind::object_or_null},
    {"state.smoke?.extinction.min", Kind::number},
    {"state.smoke?.extinction.max", Kind::number},
    {"state.smoke?.extinction.unit", Kind::text},
    {"state.smoke?.extinction.wavelength_nm", Kind::number},
    {"state.smoke?.media[].name", Kind::text},
    {"state.smoke?.media[].place", Kind::text},
    {"state.smoke?.media[].notes", Kind::remarks},
    {"state.smoke?.media[].extinction_min", Kind::number},
    {"state.smoke?.media[].extinction_max", Kind::number},
    {"state.rules[].id", Kind::text},
    {"state.rules[].edition", Kind::text},
    {"state.rules[].what", Kind::remark},
    {"state.rules[].status", Kind::remark_or_null},
    {"state.deviations[].id", Kind::text},
    {"state.deviations[].what", Kind::remark},
    {"state.deviations[].status", Kind::remark_or_null},
    {"state.light", Kind::remark},
    {"state.remarks", Kind::remarks},
    {"verdict.words", Kind::text},
    {"verdict.pass", Kind::number},
    {"verdict.fail", Kind::number},
    {"verdict.not_assessed", Kind::number},
    {"verdict.not_verified", Kind::number},
    {"not_assessed[].what", Kind::text},
    {"not_assessed[].rule", Kind::text},
    {"not_assessed[].edition", Kind::text},
    {"not_assessed[].undecided", Kind::flag},
    {"not_assessed[].why", Kind::remarks},
    {"not_assessed[].count", Kind::number},
    {"checks[].rule", Kind::text},
    {"checks[].edition", Kind::text},
    {"checks[].clause", Kind::text},
    {"checks[].title", Kind::text},
    {"checks[].clause_number", Kind::text},
    {"checks[].quoted_from", Kind::remarks},
    {"checks[].status", Kind::remark_or_null},
    {"checks[].subject", Kind::subject},
    {"checks[].conditions", Kind::remarks},
    {"checks[].reasons?", Kind::remarks},
    {"checks[].verdict", Kind::text},
    {"checks[].value", Kind::number_or_null},
    {"checks[].unit", Kind::text},
    {"checks[].limit", Kind::number_or_null},
    {"checks[].sense", Kind::text},
    {"checks[].margin", Kind::number_or_null},
    {"checks[].worst_place?", Kind::place3},
    {"sights[].from", Kind::subject},
    {"sights[].stands_for.value", Kind::number},
    {"sights[].stands_for.unit", Kind::text},
    {"sights[].along.value", Kind::number},
    {"sights[].eye_height.value", Kind::number},
    {"sights[].eye", Kind::place3},
    {"sights[].sign", Kind::text},
    {"sights[].verdict", Kind::text},
    {"sights[].reason?", Kind::remark},
    {"sights[].distance.value", Kind::number_or_null},
    {"sights[].legend?.value", Kind::number_or_null},
    {"sights[].ground?.value", Kind::number_or_null},
    {"sights[].jin?.legible", Kind::flag},
    {"sights[].line_of_sight.seen", Kind::flag},
    {"sights[].viewing_distance?.within", Kind::flag},
    {"sights[].reading_level?.value", Kind::number_or_null},
    {"sights[].transmission?.value", Kind::number_or_null},
    {"sweep[].smoke_factor", Kind::number},
    {"sweep[].sign", Kind::text},
    {"sweep[].places", Kind::number},
    {"sweep[].legible", Kind::number},
    {"over_time?.what", Kind::text},
    {"over_time?.walking_speed", Kind::object_or_null},
    {"over_time?.walking_speed?.value", Kind::number},
    {"over_time?.holds_for.albedo_min", Kind::number},
    {"over_time?.holds_for.albedo_max", Kind::number},
    {"over_time?.holds_for.optical_depth_error", Kind::number},
    {"over_time?.states[].at.value", Kind::number},
    {"over_time?.routes[].route", Kind::text},
    {"over_time?.routes[].eye_height.value", Kind::number},
    {"over_time?.routes[].length.value", Kind::number},
    {"over_time?.routes[].places[]", Kind::number},
    {"over_time?.routes[].guided[]", Kind::text},
    {"over_time?.routes[].jin[]", Kind::text},
    {"over_time?.routes[].line_of_sight[]", Kind::text},
    {"over_time?.routes[].signs[]", Kind::list},
    {"over_time?.routes[].time.until?.value", Kind::number},
    {"over_time?.routes[].time.lost_by?.value", Kind::number},
    {"over_time?.routes[].time.lost_at?.value", Kind::number},
    {"over_time?.routes[].time_by_jin.until?.value", Kind::number},
    {"over_time?.routes[].time_by_jin.lost_by?.value", Kind::number},
    {"over_time?.routes[].time_by_jin.lost_at?.value", Kind::number},
    {"over_time?.routes[].time_by_line_of_sight.until?.value", Kind::number},
    {"over_time?.routes[].time_by_line_of_sight.lost_by?.value", Kind::number},
    {"over_time?.routes[].time_by_line_of_sight.lost_at?.value", Kind::number},
    {"over_time?.routes[].fds?[]", Kind::text},
    {"over_time?.routes[].fds_visibility?[]", Kind::list},
    {"over_time?.routes[].time_by_fds?.until?.value", Kind::number},
    {"over_time?.routes[].time_by_fds?.lost_by?.value", Kind::number},
    {"over_time?.routes[].time_by_fds?.lost_at?.value", Kind::number},
    {"over_time?.routes[].walks[].start.value", Kind::number},
    {"over_time?.routes[].walks[].end", Kind::text},
    {"over_time?.routes[].walks[].at.value", Kind::number},
    {"over_time?.routes[].walks[].at_time.value", Kind::number},
    {"warnings[].text", Kind::text},
    {"warnings[].file", Kind::text},
    {"warnings[].line", Kind::number},
    {"warnings[].remark", Kind::remark_or_null},
    {"cameras[]", Kind::text},
    {"scenario.media[].name", Kind::text},
    {"scenario.media[].factor", Kind::number},
    {"scenario.circuits[].name", Kind::text},
    {"scenario.circuits[].factor", Kind::number},
    {"scenario.doors_open[]", Kind::text},
    {"scenario.doors_closed[]", Kind::text},
    {"luminaires[].name", Kind::text},
    {"luminaires[].file", Kind::text},
    {"luminaires[].product", Kind::text},
    {"luminaires[].shape", Kind::text},
    {"luminaires[].distribution", Kind::text},
    {"luminaires[].circuit", Kind::text},
    {"luminaires[].operation", Kind::text},
    {"luminaires[].position", Kind::place3},
    {"luminaires[].mains_flux.value", Kind::number},
    {"luminaires[].mains_flux.unit", Kind::text},
    {"luminaires[].emergency_flux.value", Kind::number},
    {"luminaires[].emergency_flux.unit", Kind::text},
    {"luminaires[].maintenance_factor", Kind::number},
    {"luminaires[].end_of_duration_factor", Kind::number},
    {"luminaires[].opening_m?", Kind::place3},
    {"signs[].name", Kind::text},
    {"signs[].position", Kind::place3},
    {"signs[].facing", Kind::place3},
    {"signs[].file", Kind::text},
    {"signs[].text", Kind::text},
    {"signs[].lighting", Kind::text},
    {"signs[].circuit", Kind::text},
    {"signs[].double_sided", Kind::flag},
    {"signs[].width.value", Kind::number},
    {"signs[].height.value", Kind::number},
    {"signs[].smallest_detail.value", Kind::number},
    {"signs[].mains_white?.value", Kind::number},
    {"signs[].mains_green?.value", Kind::number},
    {"signs[].emergency_white?.value", Kind::number},
    {"signs[].emergency_green?.value", Kind::number},
    {"places.routes[].name", Kind::text},
    {"places.routes[].width", Kind::number},
    {"places.routes[].path[]", Kind::place3},
    {"places.areas[].name", Kind::text},
    {"places.areas[].z", Kind::number},
    {"places.areas[].outline[]", Kind::place2},
    {"places.emphasis[].name", Kind::text},
    {"places.emphasis[].position", Kind::place3},
    {"materials[].name", Kind::text},
    {"materials[].kind", Kind::text},
    {"materials[].objects", Kind::number},
    {"media[].name", Kind::text},
    {"media[].kind", Kind::text},
    {"media[].flame_power?.value", Kind::number},
    {"media[].layers[].extinction.value", Kind::number_or_null},
    {"media[].layers[].extinction.unit", Kind::text},
    {"media[].layers[].wavelength.value", Kind::number_or_null},
    {"media[].layers[].angstrom", Kind::number_or_null},
    {"media[].layers[].albedo", Kind::number_or_null},
    {"media[].layers[].asymmetry", Kind::number_or_null},
    {"media[].layers[].z_low?", Kind::number},
    {"media[].layers[].z_high?", Kind::number},
    {"plan.route_grid.value", Kind::number},
    {"plan.area_grid.value", Kind::number},
    {"plan.height.value", Kind::number},
    {"plan.levels[].floor", Kind::number},
    {"plan.levels[].walls[]", Kind::place4},
    {"plan.levels[].furniture[]", Kind::place4},
    {"plan.levels[].points[]", Kind::place4},
    {"plan.levels[].map.corner", Kind::place2},
    {"plan.levels[].map.spacing", Kind::number},
    {"plan.levels[].map.columns", Kind::number},
    {"plan.levels[].map.rows", Kind::number},
    {"plan.levels[].map.lux", Kind::list},
    {"plan.backdrops?[].floors", Kind::place2},
    {"plan.backdrops?[].lines?[]", Kind::place4},
    {"plan.backdrops?[].png?", Kind::text},
    {"plan.backdrops?[].corner?", Kind::place2},
    {"plan.backdrops?[].across?", Kind::place2},
    {"plan.backdrops?[].up?", Kind::place2},
};

const char* type_word(Kind kind) {
  constexpr const char* words[] = {"a text",
                                   "a number",
                                   "a number or null",
                                   "true or false",
                                   "true, false or null",
                                   "a table",
                                   "a table or null",
                                   "a list",
                                   "a point of two coordinates",
                                   "a point of three coordinates",
                                   "a list of four numbers"};
  return words[static_cast<size_t>(kind)];
}

bool is_place(const Json& value, size_t count) {
  return value.is_array() && value.size() == count &&
         std::all_of(value.begin(), value.end(), [](const Json& v) {
           return v.is_number() && std::abs(v.get<double>()) <= limits::assessment_metres;
         });
}

bool is_kind(const Json& value, Kind kind) {
  switch (kind) {
    case Kind::text:
      return value.is_string();
    case Kind::number:
      return value.is_number();
    case Kind::number_or_null:
      return value.is_number() || value.is_null();
    case Kind::flag:
      return value.is_boolean();
    case Kind::flag_or_null:
      return value.is_boolean() || value.is_null();
    case Kind::object:
      return value.is_object();
    case Kind::object_or_null:
      return value.is_object() || value.is_null();
    case Kind::list:
      return value.is_array();
    case Kind::place2:
      return is_place(value, 2);
    case Kind::place3:
      return is_place(value, 3);
    case Kind::place4:
      return is_place(value, 4);
    case Kind::remark:
    case Kind::remark_or_null:
    case Kind::remarks:
    case Kind::subject:
      return false;  // check_words_of reports what is wrong with them
  }
  return false;
}

/// Checks remarks and subjects, of which sentences are made.
Result<void> check_words_of(const Json& value, Kind kind, const std::string& where) {
  const auto check = [&](const auto& read) -> Result<void> {
    if (read) return {};
    return problem(where + ": " + read.problem().what);
  };
  if (kind == Kind::remark_or_null && value.is_null()) return {};
  if (kind == Kind::remarks) return check(read_remarks(value));
  return kind == Kind::subject ? check(read_subject(value)) : check(read_remark(value));
}

Result<void> check_key(const Json& value, std::string_view path, Kind kind,
                       const std::string& where) {
  if (path.empty() && kind >= Kind::remark) return check_words_of(value, kind, where);
  if (path.empty())
    return is_kind(value, kind) ? Result<void>() : problem(where + " is not " + type_word(kind));
  if (path.starts_with("[]")) {
    if (!value.is_array()) return problem(where + " is not a list");
    path.remove_prefix(path.starts_with("[].") ? 3 : 2);
    for (size_t i = 0; i < value.size(); ++i)
      if (auto ok = check_key(value[i], path, kind, fmt::format("{}[{}]", where, i)); !ok)
        return ok.problem();
    return {};
  }
  const size_t end = std::min(path.find_first_of(".[?"), path.size());
  const std::string key(path.substr(0, end));
  path.remove_prefix(end);
  const bool optional = path.starts_with("?");
  if (optional) path.remove_prefix(1);
  if (path.starts_with(".")) path.remove_prefix(1);
  if (!value.is_object())
    return problem((where.empty() ? "it" : where) + std::string(" is not a table"));
  const auto at = value.find(key);
  if (optional && (at == value.end() || at->is_null())) return {};
  if (at == value.end()) return problem((where.empty() ? "it" : where) + " has no \"" + key + "\"");
  return check_key(*at, path, kind, where.empty() ? key : where + "." + key);
}

/// Checks the sizes of all texts and numbers, and the nesting depth.
Result<void> check_sizes(const Json& value, const std::string& where, int depth) {
  if (depth > limits::assessment_depth) return problem(where + " is nested too deep");
  if (value.is_string() && value.text().size() > limits::assessment_text &&
      where != "project.logo_png" && where != "plan.backdrops.png")
    return problem(where + fmt::format(" has more than {} characters", limits::assessment_text));
  if (value.is_number() && !(std::abs(value.get<double>()) <= limits::assessment_number))
    return problem(where + " is larger than any number of an assessment");
  if (value.is_object())
    for (const auto& [key, one] : value.items())
      if (auto ok = check_sizes(one, where.empty() ? key : where + "." + key, depth + 1); !ok)
        return ok.problem();
  if (value.is_array())
    for (size_t i = 0; i < value.size(); ++i)
      if (value[i].is_structured() || value[i].is_string() || value[i].is_number())
        if (auto ok = check_sizes(value[i], where, depth + 1); !ok) return ok.problem();
  return {};
}

/// Checks what drawings of a report iterate over and divide by.
Result<void> check_plan(const Json& a) {
  const Json& levels = a["plan"]["levels"];
  if (levels.empty()) return problem("plan.levels is empty");
  for (const Json& level : levels) {
    const Json& map = level["map"];
    const double columns = map["columns"].get<double>(), rows = map["rows"].get<double>();
    const bool whole = columns >= 0 && rows >= 0 && columns == std::floor(columns) &&
                       rows == std::floor(rows) &&
                       columns * rows <= static_cast<double>(limits::assessment_map);
    if (!whole || columns * rows != static_cast<double>(map["lux"].size()))
      return problem("plan.levels: a map has not as many values as it has places");
    if (columns > 0 && !(map["spacing"].get<double>() >= 1e-3 &&
                         map["spacing"].get<double>() <= limits::assessment_metres))
      return problem("plan.levels: a map has no spacing");
    if (std::abs(level["floor"].get<double>()) > limits::assessment_metres)
      return problem("plan.levels: a floor is farther off than any scene");
    for (const Json& lux : map["lux"])
      if (!lux.is_number() && !lux.is_null())
        return problem("plan.levels: a map holds what is no number");
  }
  for (const Json& route : a["places"]["routes"])
    if (route["path"].size() < 2) return problem("places.routes: a path has less than two points");
  for (const Json& area : a["places"]["areas"])
    if (area["outline"].size() < 3)
      return problem("places.areas: an outline has less than three corners");
  return {};
}

/// The values that FDS gives for a route are all present, or all absent.
template <class IsWhole>
Result<void> check_fds(const Json& route, const IsWhole& is_whole) {
  const auto said = [&](const char* key) {
    const auto at = route.find(key);
    return at != route.end() && !at->is_null();
  };
  if (said("fds") != said("time_by_fds") || said("fds") != said("fds_visibility"))
    return problem("over_time.routes: what FDS says is not whole");
  if (!said("fds")) return {};
  for (const char* key : {"until", "lost_by", "lost_at"})
    if (route["time_by_fds"].find(key) == route["time_by_fds"].end())
      return problem(std::string("over_time.routes: a time_by_fds has no \"") + key + "\"");
  if (!is_whole("fds") || !is_whole("fds_visibility"))
    return problem("over_time.routes: a table has not as many values as states and places");
  for (const Json& row : route["fds_visibility"])
    for (const Json& metres : row)
      if (!metres.is_number() && !metres.is_null())
        return problem("over_time.routes: a visibility is no number");
  return {};
}

/// Every table has a row for each state and a column for each place, since maps index them by both.
Result<void> check_over_time(const Json& a) {
  const auto over = a.find("over_time");
  if (over == a.end() || over->is_null()) return {};
  const size_t states = (*over)["states"].size();
  if (states == 0) return problem("over_time.states is empty");
  for (const char* key : {"until", "lost_by", "lost_at"})
    for (const Json& route : (*over)["routes"])
      for (const char* time : {"time", "time_by_jin", "time_by_line_of_sight"})
        if (route[time].find(key) == route[time].end())
          return problem(std::string("over_time.routes: a ") + time + " has no \"" + key + "\"");
  for (const Json& route : (*over)["routes"]) {
    const size_t places = route["places"].size();
    const auto is_whole = [&](const char* key) {
      return route[key].size() == states &&
             std::all_of(route[key].begin(), route[key].end(), [&](const Json& row) {
               return (row.is_string() ? row.text().size() : row.size()) == places;
             });
    };
    if (places == 0 || !is_whole("guided") || !is_whole("jin") || !is_whole("line_of_sight") ||
        !is_whole("signs"))
      return problem("over_time.routes: a table has not as many values as states and places");
    if (auto ok = check_fds(route, is_whole); !ok) return ok.problem();
    for (const Json& row : route["signs"])
      for (const Json& name : row)
        if (!name.is_string()) return problem("over_time.routes: a sign is no name");
    if (!route["walks"].empty() && !(*over)["walking_speed"].is_object())
      return problem("over_time: people walk without a speed");
  }
  return {};
}

bool is_listed(const Json& state, const char* key, const std::string& id) {
  const auto rows = state.find(key);
  return rows != state.end() && rows->is_array() &&
         std::any_of(rows->begin(), rows->end(),
                     [&](const Json& row) { return row.value("id", "") == id; });
}

/// Every check is by a rule set that the judged state names, and counts are those of the checks.
/// Otherwise the verdict would be of something else.
Result<void> check_checks(const Json& a) {
  const Json& state = a["state"];
  std::map<std::string, double> counts;
  for (size_t i = 0; i < a["checks"].size(); ++i) {
    const Json& check = a["checks"][i];
    ++counts[check["verdict"].get<std::string>()];
    for (const auto& [key, list] :
         {std::pair("rule_set", "rules"), std::pair("deviation", "deviations")}) {
      const std::string id = check.value(key, "");
      if (!id.empty() && !is_listed(state, list, id))
        return problem(
            fmt::format("checks[{}] is by \"{}\", which is not among state.{}", i, id, list));
    }
  }
  const std::pair<const char*, const char*> words[] = {{"fail", "fail"},
                                                       {"not_assessed", "not assessed"},
                                                       {"not_verified", "not verified"},
                                                       {"pass", "pass"}};
  for (const char* table : {"counts", "verdict"})
    for (const auto& [key, verdict] : words) {
      const Json said = a[table].value(key, Json());
      if (said.is_number() && said.get<double>() != counts[verdict])
        return problem(fmt::format("{}.{} is not the number of its checks", table, key));
    }
  return {};
}

/// Whether a text is base64, which a page may contain.
bool is_picture_text(const std::string& text) {
  return text.size() <= limits::assessment_picture &&
         std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                  c == '+' || c == '/' || c == '=';
         });
}

/// A backdrop has either lines, or a picture with its place.
Result<void> check_backdrops(const Json& a) {
  const auto all = a["plan"].find("backdrops");
  if (all == a["plan"].end() || all->is_null()) return {};
  for (const Json& one : *all) {
    const auto has = [&](const char* key) {
      return one.find(key) != one.end() && !one[key].is_null();
    };
    if (has("png") == has("lines"))
      return problem("plan.backdrops: one is neither lines nor a picture");
    if (!has("png")) continue;
    if (!has("corner") || !has("across") || !has("up"))
      return problem("plan.backdrops: a picture has no place");
    if (!is_picture_text(one["png"].text())) return problem("plan.backdrops: a picture is none");
  }
  return {};
}

Result<void> check_counts(const Json& a) {
  for (const auto& [word, count] : a["sight_counts"].items())
    if (!count.is_number()) return problem("sight_counts." + word + " is not a number");
  const auto logo = a["project"].find("logo_png");
  if (logo == a["project"].end()) return {};
  return is_picture_text(logo->text()) ? Result<void>() : problem("project.logo_png is no picture");
}

}  // namespace

Result<void> check_assessment(const Json& a) {
  if (auto ok = check_sizes(a, "", 0); !ok) return ok.problem();
  for (const RequiredKey& key : keys)
    if (auto ok = check_key(a, key.path, key.kind, ""); !ok) return ok.problem();
  if (auto ok = check_plan(a); !ok) return ok.problem();
  if (auto ok = check_backdrops(a); !ok) return ok.problem();
  if (auto ok = check_over_time(a); !ok) return ok.problem();
  if (auto ok = check_checks(a); !ok) return ok.problem();
  return check_counts(a);
}

}  // namespace luxodus
