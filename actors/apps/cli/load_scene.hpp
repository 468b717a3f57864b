// Loads the scene of a command, and prints all its problems. One thread.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "actors/apps/cli/options.hpp"
#include "actors/results/run/open_scene.hpp"
#include "runtime/core/result.hpp"
#include "scenes/light/world/timed_scenes.hpp"

namespace luxodus::cli {

/// Who prints the warnings of reading: load_scene, or the inspection, whose findings include them.
enum class ReadingWarnings { told, left_to_inspection };

/// A scene, or null after every problem was told.
struct LoadedScene {
  std::shared_ptr<const SceneDescription> scene;
  ProblemKind told = ProblemKind::bad_input;  // of the problems together
};

/// The scene of a scene file or a pack. `at_s`: time of its fire simulations instead of the one
/// that it states; a pack has one time. `frames`: what simulations have between two of theirs.
LoadedScene load_scene(const std::string& file, ReadingWarnings warnings = ReadingWarnings::told,
                       std::optional<double> at_s = std::nullopt,
                       FireFrames frames = FireFrames::between);

/// Reads a scene file at other times, if the scene has a clock; otherwise, and for a pack, empty.
SceneAtTime reader_of_times(const std::string& file, const SceneDescription& scene,
                            FireFrames frames);

/// The option --at, whose value goes to `at`.
Option at_option(std::string& at);
/// The option --at with several times.
Option times_option(std::vector<std::string>& at);
/// The given times, each once, ascending. Requires: they were read by times_option.
std::vector<double> times_asked(const std::vector<std::string>& at);
/// The given time; none if it is empty. Requires: it was read by at_option.
std::optional<double> time_asked(const std::string& at);

}  // namespace luxodus::cli
