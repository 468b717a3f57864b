// Layouts of luminaires in one building as lights of one scene: light adds, so what one set of
// paths finds of each luminaire tells of every layout. Luminaires that the same layouts have and
// that age alike are one source group. Pure; any thread.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "actors/judge/assess/round_state.hpp"
#include "actors/judge/design/placed_layout.hpp"

namespace luxodus {

/// A layout as light of the building.
struct LayoutLight {
  const PlacedLayout* layout = nullptr;
  double sign_factor = 1;  // of the luminance of signs, beside those of the first
};

/// The luminaires of several layouts, each once at each of its places.
class LayoutLights {
 public:
  /// Requires: at least one; their variants differ in nothing but emitters and the luminance of
  /// signs; the first has signs as they are.
  explicit LayoutLights(const std::vector<LayoutLight>& layouts);

  size_t layouts() const { return sign_factors_.size(); }
  size_t emitters() const { return emitters_.size(); }
  /// Of these, those that some layouts have and others have not.
  size_t varying() const;
  /// Whether light can be added: no layout has a luminaire with a body, which would stand in the
  /// way of others' light, that another one has not.
  bool can_add() const;

  /// A state of the building in the light of each layout, in their order. `scene`: the building at
  /// any time; its emitters are not asked for. Errors: as judged_scene.
  Result<JudgedScene> judged(const SceneDescription& scene, const Scenario& scenario,
                             const OtherSmoke& smoke) const;

 private:
  bool varies(size_t emitter) const;

  std::vector<Emitter> emitters_;       // of all layouts
  std::vector<std::vector<bool>> has_;  // of each emitter: which layouts have it
  std::vector<double> sign_factors_;    // of each layout
};

}  // namespace luxodus
