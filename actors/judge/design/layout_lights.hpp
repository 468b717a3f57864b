// Several layouts of luminaires in one building as lights of one scene. Light adds, so what one set
// of paths gives for each luminaire serves every layout. Luminaires that belong to the same layouts
// and age alike form one source group. Immutable once made; any thread.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "actors/judge/assess/round_state.hpp"
#include "actors/judge/design/placed_layout.hpp"

namespace luxodus {

/// The light of a layout.
struct LayoutLight {
  const PlacedLayout* layout = nullptr;
  double sign_factor = 1;  // on the luminance of signs of the first layout
};

/// The luminaires of several layouts, each once for each of its places.
class LayoutLights {
 public:
  /// Requires: at least one layout; their variants differ only in emitters and in the luminance of
  /// signs; the first has the signs of the scene.
  explicit LayoutLights(const std::vector<LayoutLight>& layouts);

  size_t layouts() const { return sign_factors_.size(); }
  size_t emitters() const { return emitters_.size(); }
  /// Number of luminaires that some layouts have and others do not.
  size_t varying() const;
  /// Whether light can be added: each luminaire with a body, which may block the light of others,
  /// is in all layouts or in none.
  bool can_add() const;

  /// A state of the building in the light of each layout, in their order. `scene`: the building at
  /// any time; its emitters are not used. Errors: as judged_scene.
  Result<JudgedScene> judged(const SceneDescription& scene, const Scenario& scenario,
                             const OtherSmoke& smoke) const;

 private:
  bool varies(size_t emitter) const;

  std::vector<Emitter> emitters_;       // of all layouts
  std::vector<std::vector<bool>> has_;  // for each emitter, which layouts have it
  std::vector<double> sign_factors_;    // of each layout
};

}  // namespace luxodus
