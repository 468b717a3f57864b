// A room with one luminaire and one sign, for tests of what an assessment says of it.
#pragma once

#include <catch2/catch.hpp>
#include <memory>
#include <string>

#include "actors/assess/assessment.hpp"
#include "scenes/scene_file/scene_file.hpp"
#include "tests/kit/temporary_folder.hpp"

namespace luxodus::test {

/// 12 m by 4 m by 3 m, black; a point of 300 lm above the middle, a sign at the end.
inline const std::string room = R"(
[[object]]
name = "room"
shape = "room"
low = [0, -2, 0]
high = [12, 2, 3]
material = "black5"

[[object]]
name = "table"
shape = "box"
low = [8.6, -0.4, 0.7]
high = [9.4, 0.4, 0.75]
material = "grey50"
tags = ["furniture"]

[[emitter]]
name = "lamp"
shape = "point"
distribution = "isotropic"
position = [6, 0, 2.5]
flux_lm = 1000
emergency = "non-maintained"
emergency_flux = 500
maintenance_factor = 0.8
end_of_duration_factor = 0.75

[[sign]]
name = "exit"
position = [11.95, 0, 2.2]
facing = [-1, 0, 0]
width = 0.4
height = 0.2
text = "EXIT"
letter_height = 0.15
lighting = "internal"
mains_white = 500
mains_green = 50
emergency_white = 100
emergency_green = 10

[assessment]
irritant_smoke = false
spacing_m = 4
eye_heights_m = [1.65]

[[route]]
name = "way"
path = [[1, 0, 0], [11, 0, 0]]
width = 1.6

[[scenario]]
name = "failed"
operation = "emergency"
)";

inline std::shared_ptr<const SceneDescription> scene_of(const std::string& text) {
  const TemporaryFolder folder;
  auto read = read_scene(folder.write("scene.toml", text));
  for (const Problem& problem : read.problems.list()) UNSCOPED_INFO(problem.text());
  REQUIRE(read.scene);
  return std::make_shared<SceneDescription>(std::move(*read.scene));
}

inline Result<Assessment> tried(const std::string& text, AssessOptions options = {}) {
  static const std::atomic<bool> nobody{false};
  if (options.rules.empty()) options.rules = {"en1838-2013"};
  return assess(scene_of(text), options, nobody, [](const std::string&, double) {});
}

inline Assessment assessed(const std::string& text, const AssessOptions& options = {}) {
  auto result = tried(text, options);
  INFO((result.ok() ? "" : result.problem().text()));
  REQUIRE(result.ok());
  return std::move(result).value();
}

inline std::string with_smoke(double extinction, double albedo) {
  return room + "[[medium]]\nname = \"smoke\"\nkind = \"homogeneous\"\nextinction = " +
         std::to_string(extinction) + "\nalbedo = " + std::to_string(albedo) + "\n";
}

inline AssessOptions codes_alone() {
  AssessOptions options;
  options.reality = false;
  return options;
}

/// A text with every `from` replaced. Requires: there is one.
inline std::string changed(std::string text, const std::string& from, const std::string& to) {
  REQUIRE(text.find(from) != std::string::npos);
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

}  // namespace luxodus::test
