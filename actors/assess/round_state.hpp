// A round of paths from the eyes of those who still have to look, as a state of the scene: those
// who trace it elsewhere know the scene's file, and make what they trace from a text.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "actors/assess/aged_light.hpp"
#include "actors/run/scene_state.hpp"
#include "scenes/world/description.hpp"

namespace luxodus {

namespace limits {
/// Particles of a batch of a round: paths from the eye cost far more, of which a run traces some
/// beside its particles.
inline constexpr int64_t round_batch_particles = 256;
}  // namespace limits

/// What a round has beside the scene.
struct RoundState {
  std::string scenario;             // by name
  double smoke_factor = 1;          // of all extinctions, beside the scenario's own
  double eye_path_factor = 0;       // as in RunSettings
  std::vector<Observer> observers;  // each with the signs that it is asked about
};

/// JSON, whose numbers read back to the same bits.
std::string round_text(const RoundState& round);
/// Errors: a text that is none; more observers than limits::sights.
Result<RoundState> parse_round(const std::string& text);

/// The scene of a judged state, which measures nothing but what eyes look at.
struct JudgedScene {
  Scenario scenario;
  SceneDescription scene;
  Ageing ageing;  // by which its sources are grouped
};

/// A scenario with the extinctions of all media times a factor, named ones too.
Scenario thickened(Scenario scenario, double factor);

/// Errors: as group_by_ageing.
Result<JudgedScene> judged_scene(const SceneDescription& scene, const Scenario& scenario);

/// What a round traces: BatchTracer's particles and its paths from the eyes.
/// Errors: as compile_scene.
Result<std::shared_ptr<const CompiledScene>> compile_round(const JudgedScene& judged,
                                                           const RoundState& round);

/// Rounds as nodes make them. The nodes of a process share the last that any of them was asked for.
/// Any thread.
class RoundStates final : public StateMaker {
 public:
  explicit RoundStates(std::shared_ptr<const SceneDescription> scene) : scene_(std::move(scene)) {}
  /// Errors: as parse_round, find_scenario, judged_scene and compile_round.
  Result<std::shared_ptr<const TracedState>> make(const std::string& text) override;

 private:
  const std::shared_ptr<const SceneDescription> scene_;
  std::mutex mutex_;
  std::string text_;
  std::shared_ptr<const TracedState> state_;
};

}  // namespace luxodus
