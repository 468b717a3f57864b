// Reads a scene file (TOML) with everything it names, and reports all mistakes at once, each in one
// sentence with its file and line. README.md of this folder describes the format, key by key; the
// same table drives the reader. Reads files only; any thread, one call per scene.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "runtime/core/result.hpp"
#include "scenes/light/world/description.hpp"
#include "scenes/light/world/fire_frames.hpp"

namespace luxodus {

class ReadingShare;

struct ReadScene {
  std::optional<SceneDescription> scene;  // set only if there is no problem
  Problems problems;
};

/// The file name in problems of changes that are in no file.
inline constexpr const char* named_changes = "changes";

/// Reads the file, the files it includes, and the meshes, pictures and photometric data that they
/// name. Warnings are in the scene. The content hash covers every byte of every file, and of the
/// changes.
/// `at_s`: time for its fire simulations, replacing the stated one; a problem where there is none.
/// `changes`: read as if a file that includes this one contained them; "" for none.
/// `frames`: the state of simulations between two of their frames.
/// `share`, where given, receives the progress of reading meshes and simulations.
ReadScene read_scene(const std::filesystem::path& path, std::optional<double> at_s = std::nullopt,
                     std::string_view changes = {}, FireFrames frames = FireFrames::between,
                     ReadingShare* share = nullptr);

}  // namespace luxodus
