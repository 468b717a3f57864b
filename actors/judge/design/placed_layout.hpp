// A layout of luminaires with the scene that contains it. Plain values; any thread.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "actors/judge/design/candidates.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

/// A luminaire of a layout.
struct PlacedLuminaire {
  LuminaireCandidate candidate;
  std::string name;
  std::optional<glm::dvec3> moved_from{};  // set if it is a luminaire of the scene that was moved
  /// Whether the layout decides its place: it is new or was moved.
  bool is_placed() const { return is_new() || moved_from.has_value(); }
  bool is_new() const { return candidate.type != LuminaireCandidate::existing; }
};

/// The name of its type; "" of one that the scene has. `scene`: that of the design.
inline std::string type_of(const SceneDescription& scene, const PlacedLuminaire& one) {
  return one.is_new() ? scene.design->types[one.candidate.type].name : "";
}

struct PlacedLayout {
  /// The scene with the layout, as its variant on disk gives it; null without a layout.
  std::shared_ptr<const SceneDescription> variant;
  std::vector<PlacedLuminaire> luminaires;  // first the luminaires of the scene that stay
  std::vector<std::string> removed;         // luminaires of the scene that are removed
};

}  // namespace luxodus
