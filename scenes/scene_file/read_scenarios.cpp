// Scenarios.
#include <algorithm>

#include "scenes/scene_file/scene_readers.hpp"

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

}  // namespace

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
  reading.scene.scenarios.push_back(std::move(s));
}

}  // namespace luxodus
