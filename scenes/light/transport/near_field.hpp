// Where photometric files are asked for what they do not know: their intensities are those of a
// luminaire far away, and hold within some percent from five times the largest extent of its
// luminous opening (CIE S 025, EN 13032-1: the limiting photometric distance). Pure; any thread.
#pragma once

#include <functional>
#include <vector>

#include "scenes/light/world/description.hpp"

namespace luxodus {

/// Distance over luminous opening from which intensities of a photometric file hold.
inline constexpr double far_field_openings = 5;

/// Whether light passes straight between two places [scene coordinates]; empty: always.
using SeesPlace = std::function<bool(const glm::dvec3&, const glm::dvec3&)>;

/// A place that a luminaire comes too near to.
struct NearPlace {
  Problem problem;
  /// Codes judge the light that falls there: in emergency operation, that of a route, an area, an
  /// externally lit sign. Of planes and probes it is only measured; a sign that shines has its own.
  bool judged = false;
};

/// Each plane, probe, route, area and sign that somebody looks at which a lit luminaire of a
/// photometric file comes nearer to than that, into which it sends light: names the place, the
/// luminaire that is nearest by its opening, both distances, and how many others there are.
std::vector<NearPlace> near_field_places(const SceneDescription& scene, const Scenario& scenario,
                                         const SeesPlace& sees = {});

}  // namespace luxodus
