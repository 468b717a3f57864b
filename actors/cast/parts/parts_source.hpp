// The tracers' view of a run's objects: cells, bricks and tiles by their numbers. `Parts` provides
// built objects: from a cache, from memory, or built on request. Thread rule: that of `Parts`.
#pragma once

#include "actors/cast/parts/built_parts.hpp"
#include "scenes/light/transport/object_source.hpp"

namespace luxodus {

/// Requires: Parts has `const BuiltObject* part(uint32_t object, std::span<const Candidate> next)`,
/// which returns null if the object is unobtainable.
template <class Parts>
class PartsSource : public ObjectSource {
 public:
  explicit PartsSource(const SceneParts& parts) : parts_(parts) {}

  const CellScene* cell(uint32_t cell, std::span<const Candidate> next) final {
    const auto* const built = static_cast<const BuiltCell*>(part(cell, next));
    return built != nullptr ? &built->scene() : nullptr;
  }
  const Brick* brick(int medium, int brick) final {
    const uint32_t object = parts_.of_brick(medium, brick);
    if (object == none_index) return &clear_brick();
    const auto* const built = static_cast<const BuiltBrick*>(part(object, {}));
    return built != nullptr ? &built->brick() : nullptr;
  }
  const ImageTile* tile(uint32_t image, uint32_t tile) final {
    const auto* const built = static_cast<const BuiltTile*>(part(parts_.of_tile(image, tile), {}));
    return built != nullptr ? &built->tile() : nullptr;
  }

 private:
  const BuiltObject* part(uint32_t object, std::span<const Candidate> next) {
    return static_cast<Parts*>(this)->part(object, next);
  }

  const SceneParts& parts_;
};

}  // namespace luxodus
