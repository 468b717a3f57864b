// The scene that a command is about, with all its problems told.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {
struct Scenario;
struct SceneDescription;
}  // namespace luxodus

namespace luxodus::cli {

/// Who tells the warnings of reading: load_scene, or the inspection, whose findings they are, too.
enum class ReadingWarnings { told, left_to_inspection };

/// The scene of a scene file or a pack, or null after every problem was told.
std::shared_ptr<const SceneDescription> load_scene(
    const std::string& file, ReadingWarnings warnings = ReadingWarnings::told);

/// The scenarios that a name stands for: one, all of them for "all", the first for "".
Result<std::vector<Scenario>> chosen_scenarios(const SceneDescription& scene,
                                               const std::string& name);

}  // namespace luxodus::cli
