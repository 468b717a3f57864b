// Light of a uniform Lambertian polygon without media or occlusion, in closed form: the integral of
// the cosine over its solid angle (Lambert 1760, as in Baum, Rushmeier and Winget 1989), after
// clipping at the receiver's horizon, and the solid angle itself (Van Oosterom and Strackee 1983).
// Pure; any thread.
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace luxodus {

namespace limits {
inline constexpr size_t polygon_corners = 8;
}

/// Illuminance per radiance [sr]: the projected solid angle above the horizon of a receiver at the
/// origin. Requires: a flat convex polygon of at most limits::polygon_corners corners, in order;
/// `normal` of unit length.
double projected_solid_angle(std::span<const glm::dvec3> corners, const glm::dvec3& normal);

/// Solid angle [sr] seen from the origin. Requires: as above.
double solid_angle(std::span<const glm::dvec3> corners);

}  // namespace luxodus
