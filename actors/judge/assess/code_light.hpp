// The building and its emergency light by the assumptions of the codes: direct light in clear air,
// for each emergency luminaire separately. `code_mode` applies rules to it, and
// `actors/judge/design` computes layouts with it, so both agree. No reflections, no smoke. Thread
// rule: one thread, which has rows computed by others.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "actors/judge/assess/level_screens.hpp"
#include "actors/judge/inspect/route_floor.hpp"
#include "actors/judge/inspect/building.hpp"
#include "scenes/emergency/rules.hpp"

namespace luxodus {

/// The scene with emergency fluxes and luminances of signs after the circuits of the judged state,
/// never above the stated values: a luminaire that the state switches off lights no check. Supplies
/// last for ever.
SceneDescription after_circuits(const SceneDescription& scene, const Scenario& state);

/// The same at the judged time: what its supply no longer feeds is dark, too.
SceneDescription as_switched(const SceneDescription& scene, const Scenario& state);

/// The building for the codes: no media, emergency luminaires only.
SceneDescription code_scene(const SceneDescription& scene, bool furnished);

/// Emergency operation with the doors of a scenario.
Scenario code_scenario(const SceneDescription& scene, const Scenario& doors);

/// Places from which a point of emphasis is seen: in front of it, or all around it if it states no
/// facing. The point itself may lie in a door or a step.
std::vector<glm::dvec3> beside(const EmphasisPoint& point);

/// The place from which a luminaire near a sign must be visible: just before the sign's face.
glm::dvec3 before_face(const Sign& sign);

class CodeLight {
 public:
  /// `places`: a number for each emergency luminaire. Luminaires with equal numbers hang one behind
  /// another in one place, so that what hides the first hides all. Empty: each has its own place.
  /// Requires: `building` was made of code_scene(scene, ...) in code_scenario; both outlive this.
  CodeLight(const SceneDescription& scene, const Building& building,
            std::vector<uint32_t> places = {});

  /// Illuminance from each luminaire at places raised by `lift_m` along `normal`, on a surface that
  /// faces `normal`.
  std::vector<LitPoint> lit(const std::vector<glm::dvec3>& places, const glm::dvec3& normal,
                            double lift_m) const;
  /// The same on a floor, without places in furniture and walls, or so close to an upright surface
  /// that rounding decides on which side of it they are.
  std::vector<LitPoint> lit_off_bodies(const std::vector<glm::dvec3>& places) const;
  /// Points of a square grid at least `border_m` from the edge of an area, outside furniture and
  /// walls.
  CalculationGrid points_of(const AssessedArea& area, double border_m) const;
  /// Points of a route, on the treads of its stairs, outside furniture and walls.
  RoutePoints points_of(const EscapeRoute& route) const;
  /// Points of a grid on a route, at most `spacing_m` apart, as of points_of.
  CalculationGrid points_within(const EscapeRoute& route, double half_width_m,
                                double spacing_m) const;
  /// Flights of stairs that a route climbs.
  std::vector<FlightOfRoute> flights_of(const EscapeRoute& route) const {
    return floor_.flights_of(route);
  }
  /// Illuminance on the front of equipment from each luminaire; none if it states no facing.
  std::optional<std::vector<double>> vertical_lux(const EmphasisPoint& point) const;
  /// Mean illuminance on the face of an externally lit sign from each luminaire; empty for other
  /// signs.
  std::vector<double> lux_on_face(const Sign& sign) const;
  /// For each luminaire, whether it is visible from any of the places and shines there.
  LinesOfSight seen_from(const std::vector<glm::dvec3>& places) const;
  /// Height of the floor below a thing: the first surface below it without furniture. If that is
  /// only a little above the floor of a route or area, such as a desk, the floor of the route or
  /// area.
  std::optional<double> floor_under(const glm::dvec3& place) const;

  /// Luminaires that no floor slab certainly hides from a place, ascending.
  std::vector<uint32_t> in_question(const glm::dvec3& place) const;
  const Building& building() const { return building_; }

 private:
  /// Luminaires of one storey, by number; a screen that hides their box hides all of them.
  struct Storey {
    Bounds box;
    std::vector<uint32_t> luminaires;
    std::vector<Bounds> boxes;  // of each luminaire
  };
  void find_storeys();
  bool is_in_body(const GeometryAccess& access, const glm::dvec3& place) const;
  bool touches_a_surface(const GeometryAccess& access, const glm::dvec3& place) const;
  /// A grid without its points in furniture and walls, where nobody walks or works.
  CalculationGrid without_bodies(const CalculationGrid& grid) const;
  /// The first luminaire in the place of this one.
  uint32_t leader_of(uint32_t luminaire) const {
    while (!leads(luminaire)) --luminaire;
    return luminaire;
  }
  bool leads(uint32_t i) const { return places_.empty() || i == 0 || places_[i] != places_[i - 1]; }
  std::vector<uint32_t> columns_of(const std::vector<uint32_t>& luminaires) const;

  /// Illuminance at one point from each luminaire [lx].
  std::vector<double> light_at(const GeometryAccess& access, const glm::dvec3& place,
                               const glm::dvec3& normal) const;
  /// Whether a luminaire sends light towards a place.
  bool shines_at(const GeometryAccess& access, size_t luminaire, const glm::dvec3& place) const;

  const SceneDescription& scene_;
  const Building& building_;
  LevelScreens screens_;
  RouteFloor floor_;
  std::vector<uint32_t> luminaires_;  // indices among the scene's emitters
  std::vector<uint32_t> columns_;     // the same among the compiled emitters
  std::vector<uint32_t> places_;      // of each luminaire
  std::vector<Storey> storeys_;
};

}  // namespace luxodus
