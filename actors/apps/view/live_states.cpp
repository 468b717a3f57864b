#include "actors/apps/view/live_states.hpp"

#include "actors/apps/view/edits_text.hpp"
#include "actors/apps/view/live_scene.hpp"

namespace luxodus {

Result<std::shared_ptr<const TracedState>> LiveStates::make(const std::string& edits) {
  const std::lock_guard lock(mutex_);
  if (state_ && edits == edits_) return state_;
  auto parsed = parse_edits(edits);
  if (!parsed) return parsed.problem();
  const auto described = scenes_.at(parsed->at_s);
  if (!described) return described.problem();
  auto scene = compile_live(*described.value(), parsed.value());
  if (!scene) return scene.problem();
  state_ = std::make_shared<ParticleState>(std::move(scene).value(), BatchNumbers::of_groups);
  edits_ = edits;
  return state_;
}

}  // namespace luxodus
