// A layout of luminaires in the scene that it was found for. Plain values.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "actors/design/candidates.hpp"
#include "scenes/world/description.hpp"

namespace luxodus {

/// A luminaire of the layout.
struct PlacedLuminaire {
  LuminaireCandidate candidate;
  std::string name;
  bool is_new() const { return candidate.type != LuminaireCandidate::existing; }
};

struct PlacedLayout {
  /// The scene with the layout, as the variant on disk gives it; null where there is none.
  std::shared_ptr<const SceneDescription> variant;
  std::vector<PlacedLuminaire> luminaires;  // those of the scene that stay first
  std::vector<std::string> removed;         // luminaires of the scene that go
};

}  // namespace luxodus
