#include "actors/judge/assess/over_time_json.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace luxodus {

namespace {

constexpr const char* what_it_is =
    "Whether signs are read that lead on. No analysis of available and required safe egress time "
    "(ASET/RSET): heat, gases, and when people set out are not in it. Between two states the worse "
    "holds.";

char letter_of(Guidance guidance) {
  constexpr char letters[] = {'g', 'u', 'n'};
  return letters[static_cast<size_t>(guidance)];
}

const char* word_of(char letter) {
  return name_of(letter == 'g'   ? Guidance::guided
                 : letter == 'u' ? Guidance::undecided
                                 : Guidance::not_guided);
}

Json letters_json(const GuidedRoute& route) {
  Json out = Json::array();
  for (const std::vector<Guidance>& row : route.at) {
    std::string text;
    for (const Guidance one : row) text += letter_of(one);
    out.push_back(text);
  }
  return out;
}

Json optional_seconds(const std::optional<double>& seconds) {
  return seconds ? exact_json(*seconds, "s") : Json();
}

Json visibility_json(const RouteOverTime& route) {
  Json out = Json::array();
  for (const auto& state : route.visibility_m) {
    Json row = Json::array();
    for (const auto& metres : state) row.push_back(metres ? Json(*metres) : Json());
    out.push_back(std::move(row));
  }
  return out;
}

bool has_fds(const Json& route) {
  const auto at = route.find("fds");
  return at != route.end() && !at->is_null();
}

Json time_json(const GuidedRoute& route) {
  const GuidedTime time = guided_time(route);
  Json out = {{"until", optional_seconds(time.until_s)},
              {"lost_by", optional_seconds(time.lost_by_s)}};
  out["lost_at"] = time.lost_by_s ? exact_json(time.lost_at_m, "m") : Json();
  return out;
}

Json state_json(const TimedState& state) {
  Json frames = Json::array();
  for (const TimedState::Frame& frame : state.frames)
    frames.push_back({{"medium", frame.medium}, {"time", exact_json(frame.time_s, "s")}});
  return {{"at", exact_json(state.at_s, "s")},
          {"operation", name_of(state.operation)},
          {"after_failure", optional_seconds(state.seconds_after_failure)},
          {"lit_luminaires", state.lit},
          {"frames", frames}};
}

Json walks_json(const std::vector<Walk>& walks) {
  Json out = Json::array();
  for (const Walk& walk : walks)
    out.push_back({{"start", exact_json(walk.start_s, "s")},
                   {"end", name_of(walk.end)},
                   {"at", exact_json(walk.at_m, "m")},
                   {"at_time", exact_json(walk.at_s, "s")}});
  return out;
}

Json route_json(const RouteOverTime& route) {
  Json out = {{"route", route.route},
              {"eye_height", exact_json(route.eye_height_m, "m")},
              {"length", exact_json(route.guided.length_m, "m")}};
  Json& places = out["places"] = Json::array();
  for (const double along : route.guided.along_m) places.push_back(along);
  out["guided"] = letters_json(route.guided);
  out["jin"] = letters_json(route.by_jin);
  out["line_of_sight"] = letters_json(route.by_line);
  Json& signs = out["signs"] = Json::array();
  for (const std::vector<std::string>& row : route.signs) {
    Json names = Json::array();
    for (const std::string& name : row) names.push_back(name);
    signs.push_back(std::move(names));
  }
  out["time"] = time_json(route.guided);
  out["time_by_jin"] = time_json(route.by_jin);
  out["time_by_line_of_sight"] = time_json(route.by_line);
  if (!route.by_fds.at.empty()) {
    out["fds"] = letters_json(route.by_fds);
    out["time_by_fds"] = time_json(route.by_fds);
    out["fds_visibility"] = visibility_json(route);
  }
  out["walks"] = walks_json(route.walks);
  return out;
}

/// "up to 30 s, lost by 60 s at 4 m", "never", "up to the last state, 90 s".
std::string time_words(const Json& time) {
  const auto seconds = [](const Json& value) { return value["value"].get<double>(); };
  if (!time["until"].is_object())
    return fmt::format("not from the first state on (at {:.3g} m)", seconds(time["lost_at"]));
  if (!time["lost_by"].is_object())
    return fmt::format("up to the last state, {:g} s", seconds(time["until"]));
  return fmt::format("up to {:g} s, lost by {:g} s (at {:.3g} m)", seconds(time["until"]),
                     seconds(time["lost_by"]), seconds(time["lost_at"]));
}

std::string walk_words(const Json& walk, double speed) {
  const auto number = [](const Json& value) { return value["value"].get<double>(); };
  const std::string end = walk["end"].get<std::string>();
  std::string out = fmt::format("sets out at {:g} s with {:g} m/s: ", number(walk["start"]), speed);
  if (end == name_of(Walk::End::arrives))
    return out + fmt::format("guided to the end, at {:.3g} s", number(walk["at_time"]));
  out += end == name_of(Walk::End::lost) ? "guidance is lost"
                                         : "still on the way after the last state,";
  return out +
         fmt::format(" at {:.3g} m, at {:.3g} s", number(walk["at"]), number(walk["at_time"]));
}

/// FDS's visibility at a place in a state, and its verdict there.
void fds_cells(const Json& route, size_t state, size_t place, CsvTable& table) {
  const Json& metres = route["fds_visibility"][state][place];
  if (metres.is_number())
    table.cell(metres.get<double>());
  else
    table.empty_cell();
  table.cell(word_of(route["fds"][state].text()[place]));
}

}  // namespace

Json over_time_json(const OverTime& over_time) {
  Json out = {
      {"what", what_it_is},
      {"walking_speed",
       over_time.walking_speed_m_s ? exact_json(*over_time.walking_speed_m_s, "m/s") : Json()},
      {"guiding_angle", exact_json(guiding_angle_deg, "deg")},
      {"eye_paths", over_time.paths}};
  out["holds_for"] = {{"albedo_min", over_time.low_albedo},
                      {"albedo_max", over_time.high_albedo},
                      {"optical_depth_error", over_time.depth_error}};
  Json& states = out["states"] = Json::array();
  for (const TimedState& state : over_time.states) states.push_back(state_json(state));
  Json& routes = out["routes"] = Json::array();
  for (const RouteOverTime& route : over_time.routes) routes.push_back(route_json(route));
  return out;
}

CsvTable guidance_csv(const Json& over_time) {
  CsvTable table({"route", "eye_height_m", "at_s", "along_m", "guidance", "sign", "jin",
                  "line_of_sight", "fds_visibility_m", "fds"});
  for (const Json& route : over_time["routes"])
    for (size_t t = 0; t < over_time["states"].size(); ++t)
      for (size_t i = 0; i < route["places"].size(); ++i) {
        table.cell(text_in(route, "route"))
            .cell(route["eye_height"]["value"].get<double>())
            .cell(over_time["states"][t]["at"]["value"].get<double>())
            .cell(route["places"][i].get<double>())
            .cell(word_of(route["guided"][t].text()[i]))
            .cell(route["signs"][t][i].text())
            .cell(word_of(route["jin"][t].text()[i]))
            .cell(word_of(route["line_of_sight"][t].text()[i]));
        if (has_fds(route))
          fds_cells(route, t, i, table);
        else
          table.empty_cell().empty_cell();
        table.end_row();
      }
  return table;
}

std::string guidance_text(const Json& over_time) {
  std::string out = fmt::format("guided routes over {} states. {}\n", over_time["states"].size(),
                                text_in(over_time, "what"));
  const Json& speed = over_time["walking_speed"];
  for (const Json& route : over_time["routes"]) {
    out += fmt::format("  route \"{}\", eyes at {:g} m: guided {}; by Jin's law {}\n",
                       text_in(route, "route"), route["eye_height"]["value"].get<double>(),
                       time_words(route["time"]), time_words(route["time_by_jin"]));
    out += fmt::format("    by lines of sight {}\n", time_words(route["time_by_line_of_sight"]));
    if (has_fds(route))
      out += fmt::format("    by FDS's VISIBILITY {}\n", time_words(route["time_by_fds"]));
    for (const Json& walk : route["walks"])
      out += "    " + walk_words(walk, speed["value"].get<double>()) + "\n";
  }
  return out;
}

}  // namespace luxodus
