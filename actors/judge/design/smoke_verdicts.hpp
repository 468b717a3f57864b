// What people on the routes read of the signs ahead, place by place, and the share of the routes'
// length that it stands for. Pure; any thread.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "actors/judge/assess/assessment.hpp"

namespace luxodus {

/// A sign is ahead of a walker within this angle of the way [deg].
inline constexpr double ahead_deg = 60;

/// Of the length of all routes: the share from which a sign ahead is read. What is undecided counts
/// as not read in `least`, and as read in `most`.
struct LegibleShare {
  double least = 0, most = 0;  // [1]
};

/// What is read from a place on a route.
enum class Read { nothing, undecided, a_sign };

/// A place: route, metres along it, height of the eye [m].
using RoutePlace = std::tuple<Subject, double, double>;

struct SeenPlace {
  double stands_for = 0;  // metres of the route
  Read read = Read::nothing;
};
using SeenPlaces = std::map<RoutePlace, SeenPlace>;

/// Whether a view counts: one of a sign ahead.
bool is_ahead(const SightRow& row);

/// Whether its sign is read, or chance leaves open that it is: in aged light and in new.
bool may_be_read(const SightRow& row);

/// Of all places on routes: where all signs turn their backs there is no row.
SeenPlaces places_of(const SceneDescription& scene, const std::vector<SightRow>& rows);

/// Of the places that `counts` names.
LegibleShare share_of(const SeenPlaces& places,
                      const std::function<bool(const RoutePlace&)>& counts);

}  // namespace luxodus
