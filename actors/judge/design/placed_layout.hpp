// A layout of luminaires in the scene that it was found for. Plain values.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "actors/judge/design/candidates.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

/// A luminaire of the layout.
struct PlacedLuminaire {
  LuminaireCandidate candidate;
  std::string name;
  std::optional<glm::dvec3> moved_from{};  // of one of the scene
  /// Whether a layout has it where it is: it is new, or moved.
  bool is_placed() const { return is_new() || moved_from.has_value(); }
  bool is_new() const { return candidate.type != LuminaireCandidate::existing; }
};

struct PlacedLayout {
  /// The scene with the layout, as the variant on disk gives it; null where there is none.
  std::shared_ptr<const SceneDescription> variant;
  std::vector<PlacedLuminaire> luminaires;  // those of the scene that stay first
  std::vector<std::string> removed;         // luminaires of the scene that go
};

}  // namespace luxodus
