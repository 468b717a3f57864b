// Scenes for tests, read from a file or a text. A problem in them fails the test, with its message.
// Any thread.
#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "scenes/formats/scene_file/scene_file.hpp"
#include "tests/kit/temporary_folder.hpp"

namespace luxodus::test {

inline std::shared_ptr<const SceneDescription> described(const std::filesystem::path& file) {
  ReadScene read = read_scene(file);
  for (const Problem& problem : read.problems.list()) UNSCOPED_INFO(problem.text());
  REQUIRE(read.scene);
  return std::make_shared<const SceneDescription>(std::move(*read.scene));
}

/// A scene that needs no other file.
inline std::shared_ptr<const SceneDescription> described_text(const std::string& text) {
  const TemporaryFolder folder;
  return described(folder.write("scene.toml", text));
}

}  // namespace luxodus::test
