#include "scenes/light/world/timed_scenes.hpp"

#include <algorithm>

namespace luxodus {

Result<std::shared_ptr<const SceneDescription>> TimedScenes::at(std::optional<double> at_s) {
  if (!at_s || first_->at_s == at_s) return first_;
  const std::lock_guard lock(mutex_);
  const auto known = std::find_if(kept_.begin(), kept_.end(),
                                  [&](const auto& scene) { return scene->at_s == at_s; });
  if (known != kept_.end()) {
    std::rotate(kept_.begin(), known, known + 1);
    return kept_.front();
  }
  if (!read_) return problem_in(first_->file, "the scene has one state, and a time is asked for");
  auto read = read_(*at_s);
  if (!read) return read.problem();
  kept_.push_front(std::move(read).value());
  if (kept_.size() > limits::kept_scenes) kept_.pop_back();
  return kept_.front();
}

}  // namespace luxodus
