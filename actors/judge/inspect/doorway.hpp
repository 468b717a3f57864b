// Doorways, found by rays: a narrow place between walls that widens before and behind. Openings are
// holes in meshes, which no table of a scene names. Any thread.
#pragma once

#include "actors/judge/inspect/site.hpp"

namespace luxodus {

struct Doorway {
  double width_m = 0;
  /// From the place up to the lintel; none where the opening has none.
  std::optional<double> lintel_m;
};

/// The opening that a place lies in and that one passes along `way`, a level direction.
std::optional<Doorway> doorway_at(const Site& site, const GeometryAccess& access,
                                  const glm::dvec3& place, const glm::dvec3& way);

/// The nearest wall or body within `length_m`; door leaves and furniture are none, and neither is
/// what lets light through.
std::optional<Facing> wall_ahead(const Site& site, const GeometryAccess& access,
                                 const glm::dvec3& from, const glm::dvec3& direction,
                                 double length_m);

}  // namespace luxodus
