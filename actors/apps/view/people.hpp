// The people of a live view: where each is at even steps of time, for the page, which shows them
// walk. Pure functions; any thread.
#pragma once

#include <string>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/formats/trajectories/placed_people.hpp"

namespace luxodus {

namespace limits {
/// People whom a live view shows.
inline constexpr size_t view_people = 20'000;
/// Places of all of them together, of 12 bytes each.
inline constexpr size_t view_people_places = 1'000'000;
}  // namespace limits

/// Time between two places of a person, unless limits::view_people_places asks for more [s].
inline constexpr double view_people_step_s = 0.2;

/// people.json of PROTOCOL.md. Errors: more people than limits::view_people.
Result<std::string> people_json(const std::vector<PlacedPerson>& people);

}  // namespace luxodus
