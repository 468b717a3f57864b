// A round of paths from the eyes whose views are undecided, as a state of the scene. Nodes that
// know the scene's file make what they trace from a text. Plain values and pure functions for any
// thread; RoundStates states its own rule.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "actors/judge/assess/aged_light.hpp"
#include "actors/results/run/scene_state.hpp"
#include "scenes/light/transport/compile.hpp"
#include "scenes/light/world/timed_scenes.hpp"

namespace luxodus {

namespace limits {
/// Particles of a batch of a round. They are few, since a batch also traces paths from eyes, which
/// cost far more.
inline constexpr int64_t round_batch_particles = 256;
}  // namespace limits

/// Smoke that differs from that of the scene and the scenario.
struct OtherSmoke {
  double factor = 1;             // on all extinctions, besides the scenario's own factors
  std::optional<double> albedo;  // replaces that of all smoke
  bool by_errors = false;        // extinction raised by the largest error of its source
};

/// Parts of a round that are not in the scene.
struct RoundState {
  std::string scenario;        // by name
  std::optional<double> at_s;  // the state of a scene that changes in time
  OtherSmoke smoke;
  bool signs_apart = false;         // as in JudgedScene
  double eye_path_factor = 0;       // as in RunSettings
  std::vector<Observer> observers;  // each with the signs to look at
};

/// JSON; its numbers are read back to the same bits.
std::string round_text(const RoundState& round);
/// Errors: no valid text; more observers than limits::sights.
Result<RoundState> parse_round(const std::string& text);

/// Calls `work` with the optics of all media except flames.
template <class Scene, class Work>
void for_each_smoke(Scene& scene, const Work& work) {
  for (auto& medium : scene.media) {
    if (is_flame(medium)) continue;
    if (medium.kind == MediumKind::layered)
      for (auto& layer : medium.layers) work(layer.optics);
    else
      work(medium.optics);
  }
}

/// A light in which a scene is judged: as its luminaires have aged, and as when they were new.
struct JudgedLight {
  GroupMixture aged, as_new;
};

/// The scene of a judged state; only views of signs are tallied.
struct JudgedScene {
  Scenario scenario;
  SceneDescription scene;
  AgeingShares ageing;              // defines the source groups
  std::vector<JudgedLight> lights;  // at least one
  bool signs_apart = false;         // the second light is the first without that of all signs

  /// Mixtures of all lights: the aged one, and the new one if luminaires age. Then, in the same
  /// order, the difference of each further light from the first one: estimated from the same paths,
  /// it has a smaller error than either light.
  std::vector<GroupMixture> mixtures() const;
  size_t lights_mixtures() const { return per_light() * lights.size(); }
  size_t aged_mixture(size_t light) const { return per_light() * light; }
  /// Requires: luminaires age.
  size_t new_mixture(size_t light) const { return per_light() * light + 1; }
  /// Requires: not the first light; luminaires age if `as_new`.
  size_t mixture_beyond_first(size_t light, bool as_new) const {
    return lights_mixtures() + per_light() * (light - 1) + (as_new ? 1 : 0);
  }
  size_t per_light() const { return ageing.any() ? 2 : 1; }
};

/// A scenario in which the extinctions of all media are multiplied by a factor, also of media that
/// it names.
Scenario thickened(Scenario scenario, double factor);

/// The scene in a single light. Errors: as group_by_ageing.
Result<JudgedScene> judged_scene(const SceneDescription& scene, const Scenario& scenario,
                                 const OtherSmoke& smoke = {});
/// With a second light, in which no sign gives light.
Result<JudgedScene> judged_with_signs_apart(const SceneDescription& scene, const Scenario& scenario,
                                            const OtherSmoke& smoke = {});

/// Gives all signs a source group of their own, and its light a factor in each light. Requires: a
/// factor for each light.
void scale_signs(JudgedScene& judged, const std::vector<double>& factors);

/// The compiled scene of a round: particles, and paths from the round's eyes. Errors: as
/// compile_scene.
Result<std::shared_ptr<const CompiledScene>> compile_round(const JudgedScene& judged,
                                                           const RoundState& round);

/// Makes rounds on nodes. The nodes of a process share the last round that was made. Any thread.
class RoundStates final : public StateMaker {
 public:
  /// `read`: reads the scene at other times; empty for a scene without a clock.
  explicit RoundStates(std::shared_ptr<const SceneDescription> scene, SceneAtTime read = {})
      : scenes_(std::move(scene), std::move(read)) {}
  /// Errors: as parse_round, TimedScenes::at, find_scenario, judged_scene and
  /// compile_round.
  Result<std::shared_ptr<const TracedState>> make(const std::string& text) override;

 private:
  TimedScenes scenes_;
  std::mutex mutex_;
  std::string text_;
  std::shared_ptr<const TracedState> state_;
};

}  // namespace luxodus
