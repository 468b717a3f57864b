// Shared by the tests of the inspection: a closed room without mistakes, and the findings after an
// addition.
#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "actors/judge/inspect/inspect.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/kit/described.hpp"
#include "tests/kit/replaced.hpp"
#include "tests/kit/room_texts.hpp"

namespace luxodus::inspection {

/// From one end of the furnished and of the closed room to the other.
inline const std::string long_way =
    "[[route]]\nname = \"way\"\npath = [[1, 0, 0], [11, 0, 0]]\nwidth = 1\n";

/// 12 m by 4 m by 3 m, closed: a lamp under the ceiling and an exit sign at the east end.
inline const std::string closed_room = R"(
[[object]]
name = "room"
shape = "room"
low = [0, -2, 0]
high = [12, 2, 3]
material = "grey50"
)";
inline const std::string lamp = test::middle_lamp;
inline const std::string exit_sign = test::exit_sign_at("[11.95, 0, 2.2]");
inline const std::string furnished_room = closed_room + lamp + exit_sign;

/// A wall of 0.2 m across the room, its faces at x = 8 and 8.2, with a doorway in the middle.
inline const std::string thick_wall = R"(
[[object]]
name = "partition"
shape = "wall"
from = [8.2, -2, 0]
to = [8.2, 2, 0]
height = 3
thickness = 0.2
material = "grey50"
opening = [{ at = 1, width = 2, height = 2.1 }]
)";

using test::described;

inline std::vector<Finding> inspected(const std::shared_ptr<const SceneDescription>& scene) {
  std::vector<Scenario> scenarios = scene->scenarios;
  if (scenarios.empty()) scenarios.push_back(find_scenario(*scene, "").value());
  auto found = inspect(scene, scenarios, 2);
  if (!found.ok()) FAIL(found.problem().text());
  for (const Finding& f : found.value()) UNSCOPED_INFO(f.text());
  return std::move(found).value();
}

/// All findings in a scene with this text. `files`: beside it, by name.
inline std::vector<Finding> found_in(
    const std::string& text, const std::vector<std::pair<std::string, std::string>>& files = {}) {
  const test::TemporaryFolder folder;
  for (const auto& [name, content] : files) folder.write(name, content);
  return inspected(described(folder.write("scene.toml", text)));
}

/// The findings whose message contains these words.
inline std::vector<Finding> that_say(const std::vector<Finding>& findings,
                                     const std::string& words) {
  std::vector<Finding> out;
  for (const Finding& f : findings)
    if (f.problem.what.find(words) != std::string::npos) out.push_back(f);
  return out;
}

/// One finding of this severity with these words and a line; and no other of that kind.
inline void check_found(const std::vector<Finding>& findings, Severity severity,
                        const std::string& words) {
  INFO("wanted: " << word_of(severity) << ": ... " << words);
  const auto matching = that_say(findings, words);
  REQUIRE(matching.size() == 1);
  CHECK(matching.front().severity == severity);
  CHECK(matching.front().problem.where.file.find("scene.toml") != std::string::npos);
}

/// No findings except notes.
inline void check_no_alarm(const std::vector<Finding>& findings) {
  for (const Finding& f : findings) {
    INFO(f.text());
    CHECK(f.severity == Severity::note);
  }
}

using test::replaced;

}  // namespace luxodus::inspection
