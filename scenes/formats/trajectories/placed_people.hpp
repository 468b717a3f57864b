// People of trajectory files, placed in a scene: in its coordinates, on its floors, by its clock.
// Plain values and pure functions; any thread.
#pragma once

#include <vector>

#include "scenes/formats/trajectories/trajectories.hpp"
#include "scenes/light/world/people.hpp"

namespace luxodus {

/// Half of the width of a body [m], as evacuation programs take it.
inline constexpr double body_radius_m = 0.25;

struct PlacedPerson {
  std::string group;
  int64_t id = 0;  // in the file of the group
  double eye_height_m = 0;
  double luminance_before_cd_m2 = 0;  // of the view from which the person comes
  std::vector<double> times_s;        // of the scene's clock, ascending, at least one
  std::vector<glm::dvec3> feet;       // on the floor, one for each time
  std::vector<glm::dvec2> facing;     // unit directions, one for each time; empty: not stated
};

struct PersonAt {
  glm::dvec3 foot{0};
  glm::dvec2 facing{0};  // unit; 0 if nothing tells it: a person who never moves
};

/// Turns, shifts and lifts the people of one group. Errors: a person beside all boxes of
/// [[people.storey]]; storeys or floor_m for a file that has heights; a z of shift for one that has
/// none.
Result<std::vector<PlacedPerson>> place_people(const PeopleSettings& settings,
                                               const Trajectories& trajectories,
                                               const AssessmentSettings& assessment);

/// Where a person stands, linear between the stated times.
glm::dvec3 foot_at(const PlacedPerson& person, double time_s);

/// Where a person is and looks: where the file says, or else where the person walks, along the way
/// within half a second before and after, or, for people who stand, where they walked before, or
/// will walk first. Requires: a time within the person's times.
PersonAt person_at(const PlacedPerson& person, double time_s);
/// The same at each of these ascending times, in a time that does not grow with how long people
/// stand.
std::vector<PersonAt> person_at_each(const PlacedPerson& person,
                                     const std::vector<double>& times_s);

/// Whether a person is in the building at a time.
inline bool is_present(const PlacedPerson& person, double time_s) {
  return time_s >= person.times_s.front() && time_s <= person.times_s.back();
}

}  // namespace luxodus
