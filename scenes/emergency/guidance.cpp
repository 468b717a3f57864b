#include "scenes/emergency/guidance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace luxodus {

namespace {

/// Two points closer than this, seen from above, define no direction [m].
constexpr double no_direction_m = 0.01;
/// A face whose normal is steeper than 45 degrees (this sine) counts as lying flat: its top is
/// ahead.
constexpr double lies_flat = 0.707;
/// Rounding: a time short of the end by less than this share of a step is the end.
constexpr double step_rounding = 1e-9;

double angle_in_plan_deg(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec2 p(a), q(b);
  const double lengths = glm::length(p) * glm::length(q);
  if (lengths < no_direction_m * no_direction_m) return 180;
  return glm::degrees(std::acos(std::clamp(glm::dot(p, q) / lengths, -1.0, 1.0)));
}

/// Whether a direction is within the guiding angle of the route anywhere in the metres after a
/// place.
bool points_along(const EscapeRoute& route, double from_m, const glm::dvec3& direction) {
  double before = 0;
  for (size_t i = 1; i < route.path.size(); ++i) {
    const glm::dvec3 leg = route.path[i] - route.path[i - 1];
    const double after = before + glm::length(leg);
    const bool last = i + 1 == route.path.size();
    const bool near = before <= from_m + arrow_reach_m && (after > from_m || last);
    if (near && angle_in_plan_deg(leg, direction) <= guiding_angle_deg) return true;
    before = after;
  }
  return false;
}

}  // namespace

std::vector<double> times_of(const TimeSettings& time) {
  std::vector<double> out;
  const double span = time.to_s - time.from_s;
  for (int i = 0; i < limits::max_states; ++i) {
    const double at = i * time.step_s;
    if (at >= span - step_rounding * time.step_s) break;
    out.push_back(time.from_s + at);
  }
  out.push_back(time.to_s);
  return out;
}

glm::dvec3 arrow_direction(const Sign& sign, SignArrow arrow, bool back_face) {
  const glm::dmat3& axes = sign.frame.axes;
  glm::dvec3 out = arrow == SignArrow::left ? -axes[0] : axes[0];
  if (arrow == SignArrow::ahead) {
    const bool flat = std::abs(axes[2].z) > lies_flat;
    out = flat ? axes[1] : back_face ? axes[2] : -axes[2];
  }
  out.z = 0;
  const double length = glm::length(out);
  return length > 0 ? out / length : glm::dvec3(0);
}

double passed_at_m(const EscapeRoute& route, const glm::dvec3& place) {
  double least = std::numeric_limits<double>::infinity(), out = 0, before = 0;
  for (size_t i = 1; i < route.path.size(); ++i) {
    const glm::dvec3 a = route.path[i - 1], leg = route.path[i] - a;
    const double t = std::clamp(glm::dot(place - a, leg) / glm::dot(leg, leg), 0.0, 1.0);
    const double distance = glm::length(place - a - leg * t), length = glm::length(leg);
    // At a bend the following leg counts: the arrow points along it.
    if (distance <= least + no_direction_m) {
      least = std::min(distance, least);
      out = before + t * length;
    }
    before += length;
  }
  return out;
}

bool can_guide(const EscapeRoute& route, const Walker& walker, const Sign& sign,
               const SignView& view) {
  const auto leads = std::find_if(sign.leads_to.begin(), sign.leads_to.end(),
                                  [&](const LeadsTo& one) { return one.route == route.name; });
  if (leads == sign.leads_to.end() || view.behind) return false;
  if (angle_in_plan_deg(view.centre - walker.foot, walker.ahead) > guiding_angle_deg) return false;
  const double passed_m = passed_at_m(route, view.centre);
  if (passed_m < walker.along_m) return false;
  return points_along(route, passed_m, arrow_direction(sign, leads->arrow, view.back_face));
}

const char* name_of(Guidance guidance) {
  constexpr const char* words[] = {"guided", "undecided", "not guided"};
  return words[static_cast<size_t>(guidance)];
}

const char* name_of(GuidedWalk::End end) {
  constexpr const char* words[] = {"arrives", "lost", "unknown"};
  return words[static_cast<size_t>(end)];
}

bool GuidedRoute::holds(size_t time) const {
  return std::all_of(at[time].begin(), at[time].end(),
                     [](Guidance one) { return one == Guidance::guided; });
}

GuidedTime guided_time(const GuidedRoute& route) {
  GuidedTime out;
  for (size_t t = 0; t < route.times_s.size(); ++t) {
    if (route.holds(t)) {
      out.until_s = route.times_s[t];
      continue;
    }
    out.lost_by_s = route.times_s[t];
    size_t place = 0;
    while (route.holds(t, place)) ++place;
    out.lost_at_m = route.along_m[place];
    break;
  }
  return out;
}

/// Each place stands for the part of the route up to the next place. The states that count reach
/// from the last one before the walker reaches the place to the first one after he has left it.
GuidedWalk walk(const GuidedRoute& route, double start_s, double speed_m_s) {
  GuidedWalk out;
  out.start_s = start_s;
  const auto& times = route.times_s;
  for (size_t i = 0; i < route.along_m.size(); ++i) {
    out.at_m = route.along_m[i];
    out.at_s = start_s + out.at_m / speed_m_s;
    const double next_m = i + 1 < route.along_m.size() ? route.along_m[i + 1] : route.length_m;
    const auto reached = std::upper_bound(times.begin(), times.end(), out.at_s);
    const auto left = std::lower_bound(times.begin(), times.end(), start_s + next_m / speed_m_s);
    const auto first = static_cast<size_t>(std::max<ptrdiff_t>(reached - times.begin() - 1, 0));
    const auto last = std::min(static_cast<size_t>(left - times.begin()), times.size() - 1);
    for (size_t t = first; t <= last; ++t) {
      if (route.holds(t, i)) continue;
      out.end = GuidedWalk::End::lost;
      return out;
    }
    if (left == times.end()) {
      out.end = GuidedWalk::End::unknown;
      return out;
    }
  }
  out.at_m = route.length_m;
  out.at_s = start_s + route.length_m / speed_m_s;
  return out;
}

}  // namespace luxodus
