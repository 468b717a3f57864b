// Places on routes and in areas for the inspection, and whether a way is of any building's size. A
// way in another unit has millions of places: the inspection takes at most some ten thousand of
// each, so that it ends, and codes could not judge it. Pure functions; any thread.
#pragma once

#include <vector>

#include "actors/judge/inspect/site.hpp"
#include "scenes/emergency/way.hpp"

namespace luxodus {

namespace limits {
/// Places of a route or an area that are inspected: those of an area of 100 000 m2 at 1 m.
inline constexpr size_t inspected_places = 100'000;
/// Steps along a route that are compared with each other: 1 km at 0.25 m.
inline constexpr size_t inspected_steps = 4'000;
/// Memory for the light of all luminaires at the points of calculation of all routes, or of an area
/// [bytes].
inline constexpr double judged_light_bytes = 4e9;
}  // namespace limits

// As the functions of `way.hpp`, with this spacing, or a larger one if the places would be too
// many.
std::vector<glm::dvec3> places_along(const EscapeRoute& route, double spacing_m);
std::vector<glm::dvec3> places_within(const EscapeRoute& route, double half_width_m,
                                      double spacing_m);
std::vector<glm::dvec3> places_within(const AssessedArea& area, double border_m, double spacing_m,
                                      size_t most = limits::inspected_places);
std::vector<Walker> steps_along(const EscapeRoute& route, double spacing_m);
/// The spacing of places_within.
double spacing_within(const AssessedArea& area, double spacing_m, size_t most);

/// Routes and areas with more points of calculation than memory takes.
void inspect_way_sizes(const SceneDescription& scene, Findings& out);

}  // namespace luxodus
