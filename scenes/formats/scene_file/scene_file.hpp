// Reads a scene file (TOML) with everything it names, and says all that is wrong with it at once,
// each mistake in one sentence with its file and line. The format is described in README.md of this
// folder, key by key; the same table drives the reader. Reads files only; any thread, one call per
// scene.
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
  std::optional<SceneDescription> scene;  // only where there is no problem
  Problems problems;
};

/// What problems call changes that are in no file.
inline constexpr const char* named_changes = "changes";

/// Reads the file, the files it includes, and the meshes, pictures and photometric data that they
/// name. Warnings that do not hinder are in the scene. The content hash covers every byte of every
/// file, and of the changes.
/// `at_s`: time of its fire simulations instead of the one that they state; a problem where there
/// is none.
/// `changes`: read as if they stood in a file that includes this one; "" for none.
/// `frames`: what simulations have between two of their frames.
/// `share`, where given, hears how far the reading of meshes and simulations is.
ReadScene read_scene(const std::filesystem::path& path, std::optional<double> at_s = std::nullopt,
                     std::string_view changes = {}, FireFrames frames = FireFrames::between,
                     ReadingShare* share = nullptr);

}  // namespace luxodus
