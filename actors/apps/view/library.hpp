// What a viewer may add to the building: the kinds of luminaires and signs that the scene has, and
// those of its [[design.type]] and [[design.sign]] tables. Pure; any thread.
#pragma once

#include "actors/results/formats/json_out.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

namespace limits {
/// Kinds of each that are listed.
inline constexpr size_t view_library = 500;
}  // namespace limits

/// The list as PROTOCOL.md has it. Kinds of the tables come first. Luminaires whose shape is a mesh
/// are left out, since they are not copied; so is what goes beyond the limit.
Json library_json(const SceneDescription& scene);

}  // namespace luxodus
