// A scene for Python: its parts by name, and what can be computed from it. Called with the
// interpreter's lock, which is released while scenes are read and traced.
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scenes/light/world/description.hpp"
#include "scenes/light/world/timed_scenes.hpp"

namespace luxodus::python {

class OpenScene {
 public:
  /// Reads the file. `changes`: dicts of [[change]]. Errors (Refused): as open_scene.
  static OpenScene load(const std::filesystem::path& file, const pybind11::list& changes,
                        std::optional<double> at_s);

  const std::shared_ptr<const SceneDescription>& description() const { return description_; }
  /// As in the program's results.
  const std::string& file() const { return file_; }
  std::optional<double> at_s() const { return at_s_; }
  /// Reads the scene at other times, at frames of its simulations; refuses for a pack, which has
  /// one time.
  SceneAtTime reader() const;
  /// The scene for verdicts: at frames of its simulations; a pack unchanged. Errors (Refused): as
  /// reopen_scene.
  std::shared_ptr<const SceneDescription> at_frames() const;

 private:
  std::shared_ptr<const SceneDescription> description_;
  std::string file_;     // absolute
  std::string changes_;  // TOML
  std::optional<double> at_s_;
};

/// Adds Scene and load() to the module.
void add_scene(pybind11::module_& module);

}  // namespace luxodus::python
