// Whether people on an escape route are guided to its end, in space and in time: which signs guide
// them at a place, up to when every place is guided, how far somebody comes who sets out at a time.
// It says nothing about how signs are read (legibility.hpp), nor about heat, gases or how long
// people need to set out: it is no analysis of available and required safe egress time. Pure
// functions; any thread. Design: docs/decisions/0049-guidance-over-time.md.
#pragma once

#include <optional>
#include <vector>

#include "scenes/emergency/sign_geometry.hpp"
#include "scenes/emergency/way.hpp"

namespace luxodus {

/// A sign is ahead within this angle of the way, and points along it within the same, seen from
/// above [deg].
inline constexpr double guiding_angle_deg = 60;
/// Behind the place where a sign is passed its arrow may point along any of the next metres [m].
inline constexpr double arrow_reach_m = 2;

/// The times of the states: from, from + step, ..., and the last one.
std::vector<double> times_of(const TimeSettings& time);

/// Where the arrow of a face points, in the scene, level and of unit length. A sign that lies on
/// the floor or hangs under a ceiling has its top ahead.
glm::dvec3 arrow_direction(const Sign& sign, SignArrow arrow, bool back_face);

/// How far along a route somebody has come who passes a place: the point that is nearest to it. At
/// a bend the leg that follows counts [m].
double passed_at_m(const EscapeRoute& route, const glm::dvec3& place);

/// Whether somebody at a place of a route can follow a sign, if it can be read: it leads to this
/// route, lies ahead of the walker, is passed later, and its arrow points along the route there.
/// `view`: of the sign from the walker's eye.
bool can_guide(const EscapeRoute& route, const Walker& walker, const Sign& sign,
               const SignView& view);

enum class Guidance { guided, undecided, not_guided };
/// "guided", ...
const char* name_of(Guidance guidance);

/// One route for eyes of one height. `at[t][i]`: at time t, at place i.
struct GuidedRoute {
  double length_m = 0;
  std::vector<double> times_s;  // ascending, at least one
  std::vector<double> along_m;  // ascending from 0, at least one
  std::vector<std::vector<Guidance>> at;

  bool holds(size_t time, size_t place) const { return at[time][place] == Guidance::guided; }
  bool holds(size_t time) const;  // at every place
};

/// Up to when every place was guided, without a gap from the first state on.
struct GuidedTime {
  std::optional<double> until_s;    // the last such state; none: not in the first
  std::optional<double> lost_by_s;  // the next state; none: in all of them
  double lost_at_m = 0;             // the first place that was not guided then
};
GuidedTime guided_time(const GuidedRoute& route);

/// How far somebody comes who walks at a constant speed. Between two states the worse holds, for
/// all of the time that he takes to the next place.
struct Walk {
  enum class End { arrives, lost, unknown };  // unknown: still on the way after the last state
  double start_s = 0;
  End end = End::arrives;
  double at_m = 0, at_s = 0;  // where and when; of who arrives, the end of the route
};
/// Requires: a start within the times, a speed above 0 [m/s].
Walk walk(const GuidedRoute& route, double start_s, double speed_m_s);
const char* name_of(Walk::End end);

}  // namespace luxodus
