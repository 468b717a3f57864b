// A round of paths from the eyes of those who still have to look, as a state of the scene: those
// who trace it elsewhere know the scene's file, and make what they trace from a text.
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
/// Particles of a batch of a round: paths from the eye cost far more, of which a run traces some
/// beside its particles.
inline constexpr int64_t round_batch_particles = 256;
}  // namespace limits

/// Other smoke than the scene and the scenario state.
struct OtherSmoke {
  double factor = 1;             // of all extinctions, beside the scenario's own
  std::optional<double> albedo;  // of all smoke
  bool by_errors = false;        // denser by the largest error of its source
};

/// What a round has beside the scene.
struct RoundState {
  std::string scenario;        // by name
  std::optional<double> at_s;  // of a scene that changes in time: the state that it is of
  OtherSmoke smoke;
  double eye_path_factor = 0;       // as in RunSettings
  std::vector<Observer> observers;  // each with the signs that it is asked about
};

/// JSON, whose numbers read back to the same bits.
std::string round_text(const RoundState& round);
/// Errors: a text that is none; more observers than limits::sights.
Result<RoundState> parse_round(const std::string& text);

/// Calls `work` with the optics of all smoke; flames are none.
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

/// A light that a scene is judged in: aged, and as when its luminaires were new.
struct JudgedLight {
  GroupMixture aged, as_new;
};

/// The scene of a judged state, which measures nothing but what eyes look at.
struct JudgedScene {
  Scenario scenario;
  SceneDescription scene;
  AgeingShares ageing;              // by which its sources are grouped
  std::vector<JudgedLight> lights;  // at least one

  /// Of all lights: the aged one, and the new one where luminaires age. Then what each light but
  /// the first has more than the first, in the same order: paths that all lights share err alike.
  std::vector<GroupMixture> mixtures() const;
  size_t lights_mixtures() const { return per_light() * lights.size(); }
  size_t aged_mixture(size_t light) const { return per_light() * light; }
  /// Requires: luminaires age.
  size_t new_mixture(size_t light) const { return per_light() * light + 1; }
  /// Requires: not the first light, and luminaires age where the new light is asked for.
  size_t mixture_beyond_first(size_t light, bool as_new) const {
    return lights_mixtures() + per_light() * (light - 1) + (as_new ? 1 : 0);
  }
  size_t per_light() const { return ageing.any() ? 2 : 1; }
};

/// A scenario with the extinctions of all media times a factor, named ones too.
Scenario thickened(Scenario scenario, double factor);

/// In the one light that it has. Errors: as group_by_ageing.
Result<JudgedScene> judged_scene(const SceneDescription& scene, const Scenario& scenario,
                                 const OtherSmoke& smoke = {});

/// What a round traces: BatchTracer's particles and its paths from the eyes.
/// Errors: as compile_scene.
Result<std::shared_ptr<const CompiledScene>> compile_round(const JudgedScene& judged,
                                                           const RoundState& round);

/// Rounds as nodes make them. The nodes of a process share the last that any of them was asked for.
/// Any thread.
class RoundStates final : public StateMaker {
 public:
  /// `read`: the scene at other times, where it has a clock; may be empty.
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
