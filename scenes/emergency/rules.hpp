// The rules of the codes that geometry and photometry can decide, each applied to what was
// computed: illuminance on routes, areas and task planes, glare, what luminaires must be near to,
// signs. EN 1838 (2013, and 2024) and NFPA 101, with deviations from them: each call applies one
// set (rule_sets.hpp). Values are those of direct light in clear air, at the end of the rated
// duration, unless a rule asks otherwise. The codes' texts were not at hand: every rule says what
// it is quoted from. Pure functions; any thread.
#pragma once

#include <functional>

#include "scenes/emergency/check.hpp"
#include "scenes/emergency/rule_sets.hpp"
#include "scenes/emergency/sign_geometry.hpp"
#include "scenes/emergency/way.hpp"

namespace luxodus {

/// Measured in its own height above the floor [m] (EN 1838: at most 2 cm).
inline constexpr double floor_plane_m = 0.02;
/// Between points of calculation on routes, and in areas [m].
inline constexpr double route_grid_m = 0.25, area_grid_m = 0.5;

/// A point of calculation, with what each emergency luminaire gives there [lx].
struct LitPoint {
  glm::dvec3 place;
  std::vector<double> lux;
};

/// The emergency luminaires of a scene: numbers of its emitters, in their order.
std::vector<uint32_t> emergency_luminaires(const SceneDescription& scene);

/// Whether a straight line that nothing solid blocks leads from a place to each emergency
/// luminaire, in their order; empty: taken for granted.
using LinesOfSight = std::vector<bool>;

/// Height of the floor that a thing hangs over [m]; empty: that of the nearest route or area below.
using FloorUnder = std::function<std::optional<double>(const glm::dvec3&)>;
std::optional<double> floor_of(const SceneDescription& scene, const FloorUnder& floor_under,
                               const glm::dvec3& place);

/// Points that the rules for a route ask for.
struct RoutePoints {
  std::vector<glm::dvec3> centre;  // of its strips of 2 m at most (EN 1838)
  std::vector<glm::dvec3> band;    // half the width of each strip
  std::vector<glm::dvec3> inner;   // all but the edges (2024)
};
RoutePoints points_of(const EscapeRoute& route);

struct RouteLight {
  std::vector<LitPoint> centre, band, inner;
};

std::vector<Check> checks_of_route(const SceneDescription& scene, const EscapeRoute& route,
                                   const RouteLight& light, const CodeChoice& codes);
std::vector<Check> checks_of_open_area(const SceneDescription& scene, const AssessedArea& area,
                                       const std::vector<LitPoint>& core, const CodeChoice& codes);
std::vector<Check> checks_of_task_area(const SceneDescription& scene, const AssessedArea& area,
                                       const std::vector<LitPoint>& plane, const CodeChoice& codes);
/// The least of the illuminance when one luminaire fails, whichever is worst: `luminaires` are
/// those of the columns of lux. Information; no code's.
Check check_of_failure(const SceneDescription& scene, const Subject& subject,
                       const std::vector<LitPoint>& points);
/// Disability glare of a luminaire by its intensity, with the highest emergency flux.
std::vector<Check> checks_of_glare(const SceneDescription& scene, const CodeChoice& codes,
                                   const FloorUnder& floor_under = {});
/// Whether emergency luminaires hang high enough above the floor.
std::vector<Check> checks_of_height(const SceneDescription& scene, const CodeChoice& codes,
                                    const FloorUnder& floor_under = {});

/// The places of emphasis that the scene names, and the bends of its routes.
std::vector<EmphasisPoint> emphasis_of(const SceneDescription& scene);
/// A luminaire is near by its distance in plan, if it is on the storey of the place, in sight of it
/// and shines there, and higher where `above` asks for it; one that is nearer and does not is
/// named.
Check luminaire_near(const Rule& rule, const SceneDescription& scene, const Subject& subject,
                     const glm::dvec3& place, bool above, const LinesOfSight& seen);
/// `vertical_lx`: on the front of equipment; none where it says no facing.
std::vector<Check> checks_of_emphasis(const SceneDescription& scene, const EmphasisPoint& point,
                                      const LinesOfSight& seen, std::optional<double> vertical_lx,
                                      const CodeChoice& codes);

/// What a sign is by itself. `face_lx`: mean direct light on an externally lit face in emergency
/// operation. `seen`: from its face.
std::vector<Check> checks_of_sign(const SceneDescription& scene, const Sign& sign, double face_lx,
                                  const LinesOfSight& seen, const CodeChoice& codes,
                                  const FloorUnder& floor_under = {});

/// A sign that somebody on a route has a clear line to.
struct ClearSign {
  uint32_t sign;
  SignView view;
  bool through_glass = false;
};
/// Whether people on a route have a sign ahead of them near enough everywhere, by the codes'
/// distances.
/// `clear`: by walker.
std::vector<Check> checks_of_distance(const SceneDescription& scene, const EscapeRoute& route,
                                      const std::vector<Walker>& walkers,
                                      const std::vector<std::vector<ClearSign>>& clear,
                                      const CodeChoice& codes);

/// Whether what is asked for on a route or in an area, `demanded_lx`, is there in time, by the
/// onset of each luminaire. One that states none counts as dark: with light enough from others a
/// check passes all the same, else it is not assessed. Nothing where no luminaire states any.
std::vector<Check> checks_of_onset(const SceneDescription& scene, const Subject& subject,
                                   const std::vector<LitPoint>& points, double demanded_lx,
                                   const CodeChoice& codes);
/// Of high-risk tasks: all of it, nearly at once.
std::vector<Check> checks_of_task_onset(const SceneDescription& scene, const Subject& subject,
                                        const std::vector<LitPoint>& plane, double demanded_lx,
                                        const CodeChoice& codes);

/// Rules of the chosen codes that a scene says too little for, each once.
std::vector<Check> checks_beyond(const SceneDescription& scene, const CodeChoice& codes);

}  // namespace luxodus
