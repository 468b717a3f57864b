// Finds doorways by rays: a narrow place between walls that widens in front and behind. Openings
// are holes in meshes, which no table of a scene names. Pure functions; any thread.
#pragma once

#include "actors/judge/inspect/site.hpp"

namespace luxodus {

struct Doorway {
  double width_m = 0;
  /// From the place up to the lintel; none if the opening has none.
  std::optional<double> lintel_m;
};

/// The opening at a place, passed along `way`, a horizontal direction.
std::optional<Doorway> doorway_at(const Site& site, const GeometryAccess& access,
                                  const glm::dvec3& place, const glm::dvec3& way);

/// The nearest wall or body within `length_m`, ignoring door leaves, furniture and transparent
/// surfaces.
std::optional<FacedSurface> wall_ahead(const Site& site, const GeometryAccess& access,
                                       const glm::dvec3& from, const glm::dvec3& direction,
                                       double length_m);

}  // namespace luxodus
