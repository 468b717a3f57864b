// Rules of the codes that can be decided from geometry and photometry, applied to computed values:
// illuminance on routes, areas and task planes, glare, luminaires near points of emphasis, signs.
// They are those of EN 1838 (2013 and 2024) and NFPA 101 with deviations; each call applies one set
// (rule_sets.hpp). Illuminance is direct light in clear air at the end of the rated duration,
// unless a rule requires otherwise. The texts of the codes were not at hand: every rule names the
// source that quotes it. Nothing is traced here. Pure functions; any thread.
#pragma once

#include <functional>
#include <span>

#include "scenes/emergency/calculation_grid.hpp"
#include "scenes/emergency/check.hpp"
#include "scenes/emergency/rule_sets.hpp"
#include "scenes/emergency/sign_geometry.hpp"
#include "scenes/emergency/way.hpp"

namespace luxodus {

/// Height of the measuring plane above the floor [m] (EN 1838: at most 2 cm).
inline constexpr double floor_plane_m = 0.02;
/// Spacing of points of calculation on routes, and in areas [m].
inline constexpr double route_grid_m = 0.25, area_grid_m = 0.5;

/// A point of calculation with the illuminance from each emergency luminaire [lx].
struct LitPoint {
  glm::dvec3 place;
  std::vector<double> lux;
};

/// The light on a route, an area or a plane. Minima and ratios are intervals: one end is that of
/// the grid alone, the other that of all points. A check passes only if the worse end does.
struct JudgedPoints {
  std::vector<LitPoint> grid;
  std::vector<LitPoint> between;  // further points, below luminaires and in gaps of the grid
  size_t in_bodies = 0;           // points of a route left out, which its checks state

  JudgedPoints() = default;
  JudgedPoints(std::vector<LitPoint> points) : grid(std::move(points)) {}
  JudgedPoints(std::initializer_list<LitPoint> points) : grid(points) {}
};

/// Factors on the light of each emergency luminaire.
using LuminaireFactors = std::vector<double>;

/// Heights of the floors of the storeys to which a place and each emergency luminaire belong [m].
/// If `luminaires` is empty, those of the nearest route or area below count.
struct StoreyFloors {
  std::optional<double> place;
  std::span<const std::optional<double>> luminaires;
};

/// Emergency luminaires of a scene: indices of its emitters, ascending.
std::vector<uint32_t> emergency_luminaires(const SceneDescription& scene);

/// For each emergency luminaire, whether no solid blocks the straight line from a place to it. If
/// empty, all lines count as free.
using LinesOfSight = std::vector<bool>;

/// For each emergency luminaire, whether its supply still feeds it at the judged time. If empty,
/// all are fed.
using FedLuminaires = std::vector<bool>;

/// Height of the floor below a thing [m]. If empty, the nearest route or area below counts as the
/// floor.
using FloorUnder = std::function<std::optional<double>(const glm::dvec3&)>;
std::optional<double> floor_of(const SceneDescription& scene, const FloorUnder& floor_under,
                               const glm::dvec3& place);

/// Points of calculation on a route.
struct RoutePoints {
  CalculationGrid centre;  // centre lines of its strips, each at most 2 m wide (EN 1838)
  CalculationGrid band;    // middle half of each strip
  CalculationGrid inner;   // all but the edges (2024)
};
/// `line`: points on lines along the route, at most route_grid_m apart.
RoutePoints points_of(const EscapeRoute& route, const LineOfRoute& line);

struct RouteLight {
  JudgedPoints centre, band, inner;
};

/// The factors with which some check by these codes judges a smallest or largest illuminance: those
/// of the judged time, of new luminaires, and of times at which some are not fully on. None is a
/// multiple of another.
std::vector<LuminaireFactors> factors_of_checks(const SceneDescription& scene,
                                                const std::vector<CodeChoice>& codes,
                                                const FedLuminaires& fed);

std::vector<Check> checks_of_route(const SceneDescription& scene, const EscapeRoute& route,
                                   const RouteLight& light, const CodeChoice& codes,
                                   const FedLuminaires& fed = {});
std::vector<Check> checks_of_open_area(const SceneDescription& scene, const AssessedArea& area,
                                       const JudgedPoints& core, const CodeChoice& codes,
                                       const FedLuminaires& fed = {});
std::vector<Check> checks_of_task_area(const SceneDescription& scene, const AssessedArea& area,
                                       const JudgedPoints& plane, const CodeChoice& codes,
                                       const FedLuminaires& fed = {});
/// Whether luminaires that are fed light each tread of a flight directly: on the darkest tread, the
/// illuminance from the one that lights it most. `treads`: at least one.
std::vector<Check> checks_of_flight(const std::string& flight, const std::vector<LitPoint>& treads,
                                    const CodeChoice& codes, const FedLuminaires& fed = {});
/// Smallest illuminance if one luminaire fails, for the worst such luminaire. Information: no code
/// asks for it.
Check check_of_failure(const SceneDescription& scene, const Subject& subject,
                       const JudgedPoints& points, const FedLuminaires& fed = {});
/// Disability glare of luminaires by their intensity at the highest emergency flux.
std::vector<Check> checks_of_glare(const SceneDescription& scene, const CodeChoice& codes,
                                   const FloorUnder& floor_under = {});
/// Whether emergency luminaires hang high enough above the floor.
std::vector<Check> checks_of_height(const SceneDescription& scene, const CodeChoice& codes,
                                    const FloorUnder& floor_under = {});

/// Points of emphasis that the scene names, and the bends of its routes.
std::vector<EmphasisPoint> emphasis_of(const SceneDescription& scene);
/// Distance in plan from a place to the nearest emergency luminaire that is on the same storey, in
/// sight, fed, shines there, and with `above` hangs higher than the place. A luminaire that is
/// nearer but fails one of these is named in the check.
Check luminaire_near(const Rule& rule, const SceneDescription& scene, const Subject& subject,
                     const glm::dvec3& place, bool above, const LinesOfSight& seen,
                     const FedLuminaires& fed = {}, const StoreyFloors& floors = {});
/// `vertical_lx`: illuminance on the front of equipment; none if the scene states no facing.
std::vector<Check> checks_of_emphasis(const SceneDescription& scene, const EmphasisPoint& point,
                                      const LinesOfSight& seen, std::optional<double> vertical_lx,
                                      const CodeChoice& codes, const FedLuminaires& fed = {},
                                      const StoreyFloors& floors = {});

/// Checks of one sign. `face_lx`: mean direct illuminance on an externally lit face in emergency
/// operation. `seen`: lines of sight from its face.
std::vector<Check> checks_of_sign(const SceneDescription& scene, const Sign& sign, double face_lx,
                                  const LinesOfSight& seen, const CodeChoice& codes,
                                  const FloorUnder& floor_under = {}, const FedLuminaires& fed = {},
                                  const StoreyFloors& floors = {});

/// A sign that a walker on a route can see along a free line.
struct ClearSign {
  uint32_t sign;
  SignView view;
  bool through_glass = false;
};
/// Whether people on a route always have a sign ahead of them within the distances of the codes.
/// `clear`: visible signs by walker.
std::vector<Check> checks_of_distance(const SceneDescription& scene, const EscapeRoute& route,
                                      const std::vector<Walker>& walkers,
                                      const std::vector<std::vector<ClearSign>>& clear,
                                      const CodeChoice& codes);

/// Whether the required illuminance `demanded_lx` on a route or in an area is reached in time, by
/// the onset of each luminaire, whose supply may be exhausted by then. A luminaire without `onset`
/// counts as dark: if the others give enough light the check passes, else it is not assessed. No
/// checks if no luminaire states an onset.
std::vector<Check> checks_of_onset(const SceneDescription& scene, const Subject& subject,
                                   const JudgedPoints& points, double demanded_lx,
                                   const CodeChoice& codes);
/// High-risk task areas: the full illuminance, after 0.5 s.
std::vector<Check> checks_of_task_onset(const SceneDescription& scene, const Subject& subject,
                                        const JudgedPoints& plane, double demanded_lx,
                                        const CodeChoice& codes);

/// Whether every stated duration of a supply is as long as the code requires. One that is shorter
/// fails, whatever the others state; if none is shorter and some are not stated, it is not
/// assessed. Requires: `scene` as stated, since a circuit that is switched off does not lengthen a
/// supply.
Check check_of_duration(const SceneDescription& scene, const CodeChoice& codes);

/// Rules of the chosen codes for which the scene states too little, each once.
std::vector<Check> checks_beyond(const SceneDescription& scene, const CodeChoice& codes);

}  // namespace luxodus
