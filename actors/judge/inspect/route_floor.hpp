// The floor of a route as rays find it: the treads of stairs that its line climbs, wherever the
// line is drawn, and the surface of ramps. Thread rule: called from one thread, which has rows of
// rays computed by others.
#pragma once

#include "actors/judge/inspect/building.hpp"
#include "scenes/emergency/calculation_grid.hpp"

namespace luxodus {

/// A leg of a route that climbs stairs.
struct FlightOfRoute {
  std::string name;  // "way, flight 1"
  std::vector<glm::dvec3> treads;
};

class RouteFloor {
 public:
  /// Requires: `building` outlives this.
  explicit RouteFloor(const Building& building) : building_(building) {}

  /// Points at most `spacing_m` apart on a line beside a route's centre line. On a leg that climbs
  /// steps they stand in the middle of each tread, or of equal parts of a landing. On other legs
  /// they are those of line_along, on the floor where a leg climbs and its line misses the floor.
  /// A level leg that ends at a riser has its last point half a spacing before it.
  GridLine line(const EscapeRoute& route, double aside_m, double spacing_m) const;

  /// Flights of stairs on a route: its legs that climb by more than 15 degrees.
  std::vector<FlightOfRoute> flights_of(const EscapeRoute& route) const;

 private:
  struct Profile;  // heights of the floor along a line

  Profile profile(const glm::dvec3& from, const glm::dvec3& to) const;
  GridLeg leg(const glm::dvec3& from, const glm::dvec3& to, double aside_m, double spacing_m) const;

  const Building& building_;
};

}  // namespace luxodus
