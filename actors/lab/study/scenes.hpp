// The scene of a study, compiled once for each partition and batch size that it asks for. Thread
// rule: one thread.
#pragma once

#include <map>
#include <memory>

#include "actors/lab/study/study_file.hpp"
#include "scenes/light/transport/compiled_scene.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

class StudyScenes {
 public:
  /// `description`: as read from the file.
  StudyScenes(const Study& study, const SceneDescription& description);

  /// Errors: an unknown scenario; a scene that cannot be compiled.
  Result<std::shared_ptr<const CompiledScene>> get(int cells, int64_t batch_particles);

 private:
  const std::string scenario_;
  SceneDescription description_;
  std::map<std::pair<int, int64_t>, std::shared_ptr<const CompiledScene>> made_;
};

}  // namespace luxodus
