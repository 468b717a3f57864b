// What people on the routes read of the signs ahead, by place, and the share of the routes' length
// that these places represent. Pure functions; any thread.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "actors/judge/assess/assessment.hpp"

namespace luxodus {

/// Largest angle between walking direction and a sign that is ahead [deg].
inline constexpr double ahead_deg = 60;

/// Share of the length of all routes from which a sign ahead is read. Undecided views count as not
/// read in `least`, and as read in `most`.
struct LegibleShare {
  double least = 0, most = 0;  // [1]
  static constexpr void fields(auto&& field, auto& m) { field("least", m.least)("most", m.most); }
};

/// What is read from a place on a route.
enum class Read { nothing, undecided, a_sign };

/// A place: route, distance along it, eye height [m].
using RoutePlace = std::tuple<Subject, double, double>;

struct SeenPlace {
  double stands_for = 0;  // length of route [m]
  Read read = Read::nothing;
};
using SeenPlaces = std::map<RoutePlace, SeenPlace>;

/// Whether a view counts: its sign is ahead.
bool is_ahead(const SightRow& row);

/// Whether the sign of a view may be read: it is legible or undecided, in aged light and in new
/// light.
bool may_be_read(const SightRow& row);

/// All places on routes, also those without views because all signs face away.
SeenPlaces places_of(const SceneDescription& scene, const std::vector<SightRow>& rows);

/// The share over the places that `counts` selects.
LegibleShare share_of(const SeenPlaces& places,
                      const std::function<bool(const RoutePlace&)>& counts);

}  // namespace luxodus
