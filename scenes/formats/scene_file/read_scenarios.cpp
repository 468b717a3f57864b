// Reads scenarios, and the clock that changes them: mains failure, doors that open and close.
#include <fmt/format.h>

#include <algorithm>

#include "scenes/formats/scene_file/scene_readers.hpp"

namespace luxodus {

namespace {

std::vector<Scenario::Factor> named_factors(KeyReader& keys, std::string_view key,
                                            std::string_view kind) {
  std::vector<Scenario::Factor> out;
  for (const auto& f : keys.factors(key)) {
    keys.reading().require(kind, f.name, f.place);
    out.push_back({f.name, f.value});
  }
  return out;
}

std::vector<std::string> doors(KeyReader& keys, std::string_view key) {
  std::vector<std::string> names = keys.texts(key);
  for (const auto& name : names) keys.reading().require("door", name, keys.place(key));
  return names;
}

/// Before the mains fail everything is in mains operation, whatever happens later.
void follow_mains(KeyReader& keys, Scenario& s) {
  const SceneReading& reading = keys.reading();
  const auto& time = reading.scene.time;
  if (!time || !time->mains_fail_at_s || s.operation == Operation::mains) return;
  if (keys.has("seconds_after_failure") && keys.clean())
    keys.problem("seconds_after_failure",
                 "'seconds_after_failure' follows from 'mains_fail_at' of [time]; leave one out");
  const double since = reading.time_s().value_or(0) - *time->mains_fail_at_s;
  if (since < 0) {
    s.operation = Operation::mains;
    return;
  }
  s.seconds_after_failure = since;
  s.says_seconds = true;
}

/// For doors that have opened and closed before now the later of the two times counts.
void follow_doors(KeyReader& keys, Scenario& s) {
  struct Turn {
    double at_s;
    std::string door;
    bool opens;
  };
  std::vector<Turn> turns;
  for (const auto& [key, opens] : {std::pair{"doors_open_at", true}, {"doors_close_at", false}})
    for (const auto& door : keys.factors(key)) {
      keys.reading().require("door", door.name, door.place);
      turns.push_back({door.value, door.name, opens});
    }
  if (turns.empty()) return;
  keys.reading().changes_in_time = keys.reading().goes_by_clock = true;
  const auto now = keys.reading().time_s();
  if (!now) {
    keys.problem("doors open or close at times, and no time is said: give --at 60s, or add [time]");
    return;
  }
  std::stable_sort(turns.begin(), turns.end(),
                   [](const Turn& a, const Turn& b) { return a.at_s < b.at_s; });
  for (const Turn& turn : turns) {
    if (turn.at_s > *now) break;
    std::erase(turn.opens ? s.doors_closed : s.doors_open, turn.door);
    auto& there = turn.opens ? s.doors_open : s.doors_closed;
    if (std::find(there.begin(), there.end(), turn.door) == there.end()) there.push_back(turn.door);
  }
}

}  // namespace

void read_time(const toml::Table& table, SceneReading& reading) {
  KeyReader keys(table, {"time"}, reading);
  TimeSettings time;
  time.place = keys.place();
  time.from_s = keys.number("from");
  time.to_s = keys.number("to");
  time.step_s = keys.number("step");
  time.mains_fail_at_s = keys.maybe_number("mains_fail_at");
  time.walking_speed_m_s = keys.maybe_number("walking_speed");
  if (keys.clean() && time.to_s < time.from_s)
    keys.problem("to",
                 fmt::format("'to' is {:g} s, before 'from' ({:g} s)", time.to_s, time.from_s));
  if (keys.clean() && (time.to_s - time.from_s) / time.step_s > double{limits::max_states - 1})
    keys.problem("step", fmt::format("'step' makes more than {} states", limits::max_states));
  reading.goes_by_clock = true;
  reading.scene.time = time;
}

void read_scenario(const toml::Table& table, SceneReading& reading) {
  KeyReader keys(table, {"scenario"}, reading);
  Scenario s;
  s.name = read_name(keys, "scenario");
  s.place = keys.place();
  const std::string operation = keys.choice("operation");
  s.operation = operation == "dark"        ? Operation::dark
                : operation == "emergency" ? Operation::emergency
                                           : Operation::mains;
  s.seconds_after_failure = keys.number("seconds_after_failure");
  s.says_seconds = keys.has("seconds_after_failure");
  if (s.operation == Operation::mains && keys.has("seconds_after_failure") &&
      s.seconds_after_failure > 0 && keys.clean()) {
    keys.problem("seconds_after_failure",
                 "'seconds_after_failure' has no meaning while operation is \"mains\"");
  }
  s.circuits = named_factors(keys, "circuits", "circuit");
  s.media = named_factors(keys, "media", "medium");
  s.smoke_factor = keys.number("smoke_factor");
  s.emission_factor = keys.number("emission_factor");
  s.doors_open = doors(keys, "doors_open");
  s.doors_closed = doors(keys, "doors_closed");
  for (const auto& name : s.doors_open) {
    if (std::find(s.doors_closed.begin(), s.doors_closed.end(), name) != s.doors_closed.end()) {
      keys.problem("doors_closed", "the door '" + name + "' is said to be open and closed");
    }
  }
  s.written_operation = s.operation;
  follow_mains(keys, s);
  follow_doors(keys, s);
  reading.scene.scenarios.push_back(std::move(s));
}

}  // namespace luxodus
