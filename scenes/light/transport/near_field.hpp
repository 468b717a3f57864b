// Finds places too near to a luminaire for its photometric file: the file's intensities are those
// at a large distance, and hold within some percent from five times the largest extent of the
// luminous opening (CIE S 025, EN 13032-1: the limiting photometric distance). Pure; any thread.
#pragma once

#include <functional>
#include <vector>

#include "scenes/light/world/description.hpp"

namespace luxodus {

/// Distance relative to the luminous opening from which a photometric file is valid.
inline constexpr double far_field_openings = 5;

/// Whether a luminaire's light reaches a place [scene coordinates]; empty: always.
using SeesPlace = std::function<bool(const Emitter&, const glm::dvec3&)>;

/// A place that is too near to a luminaire.
struct NearPlace {
  Problem problem;
  /// Whether codes judge the light there: in emergency operation on a route, an area, an externally
  /// lit sign. Planes and probes are only measured, and a luminous sign has its own light.
  bool judged = false;
};

/// Planes, probes, routes, areas and observed signs that are nearer than that to a lit luminaire
/// with a photometric file that sends light there. Each problem names the place, the luminaire that
/// is nearest relative to its opening, both distances, and the number of others.
std::vector<NearPlace> near_field_places(const SceneDescription& scene, const Scenario& scenario,
                                         const SeesPlace& sees = {});

}  // namespace luxodus
