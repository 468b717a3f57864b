// Whether people on an escape route are guided to its end, in space and in time: which signs guide
// them at a place, until when every place is guided, and how far a person gets who sets out at a
// given time. It does not decide whether a sign can be read (legibility.hpp), and it knows neither
// heat nor gases nor the time that people need to set out: it is no analysis of available and
// required safe egress time. Pure functions; any thread. Design:
// docs/decisions/0049-guidance-over-time.md.
#pragma once

#include <optional>
#include <vector>

#include "scenes/emergency/sign_geometry.hpp"
#include "scenes/emergency/way.hpp"

namespace luxodus {

/// Largest angle, seen from above, between the route and a sign that counts as ahead, and between
/// the route and an arrow that counts as pointing along it [deg].
inline constexpr double guiding_angle_deg = 60;
/// An arrow may point along the route anywhere in this distance after the place where its sign is
/// passed [m].
inline constexpr double arrow_reach_m = 2;

/// Times of the states: from, from + step, ..., and to.
std::vector<double> times_of(const TimeSettings& time);

/// Direction of a face's arrow in the scene, horizontal and of unit length. The top of a sign that
/// lies on the floor or hangs flat under a ceiling counts as ahead.
glm::dvec3 arrow_direction(const Sign& sign, SignArrow arrow, bool back_face);

/// Distance along a route at which a walker passes a place: that of the nearest point of the route.
/// At a bend the following leg counts [m].
double passed_at_m(const EscapeRoute& route, const glm::dvec3& place);

/// Whether a walker on a route can follow a sign, provided that the sign can be read: it leads to
/// this route, lies ahead of the walker, is passed later, and its arrow points along the route
/// there.
/// `view`: the sign as seen from the walker's eye.
bool can_guide(const EscapeRoute& route, const Walker& walker, const Sign& sign,
               const SignView& view);

enum class Guidance { guided, undecided, not_guided };
/// "guided", "undecided", ...
const char* name_of(Guidance guidance);

/// One route for one eye height. `at[t][i]`: guidance at time t and place i.
struct GuidedRoute {
  double length_m = 0;
  std::vector<double> times_s;  // ascending, at least one
  std::vector<double> along_m;  // ascending from 0, at least one
  std::vector<std::vector<Guidance>> at;

  bool holds(size_t time, size_t place) const { return at[time][place] == Guidance::guided; }
  bool holds(size_t time) const;  // at every place
};

/// The last state up to which every place was guided in every state.
struct GuidedTime {
  std::optional<double> until_s;    // that state; none: not even the first state
  std::optional<double> lost_by_s;  // the state after it; none: all states are guided
  double lost_at_m = 0;             // the first place that was not guided then
};
GuidedTime guided_time(const GuidedRoute& route);

/// How far a person gets who walks at a constant speed. A place must be guided in all states from
/// the last one before the walker reaches it to the first one after he reaches the next place.
struct GuidedWalk {
  enum class End { arrives, lost, unknown };  // unknown: still walking after the last state
  static constexpr size_t ends = static_cast<size_t>(End::unknown) + 1;
  double start_s = 0;
  End end = End::arrives;
  double at_m = 0, at_s = 0;  // where and when the walk ends
};
/// Requires: a start between the first and the last state; a speed above 0 [m/s].
GuidedWalk walk(const GuidedRoute& route, double start_s, double speed_m_s);
const char* name_of(GuidedWalk::End end);

}  // namespace luxodus
