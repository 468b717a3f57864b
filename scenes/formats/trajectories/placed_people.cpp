#include "scenes/formats/trajectories/placed_people.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace luxodus {

namespace {

/// The way within this time before and after tells a direction [s]: a stride takes about as long.
constexpr double stride_s = 0.5;
/// A shorter way within a second tells none: people who wait sway [m].
constexpr double sway_m = 0.1;

glm::dvec2 turned(const glm::dvec2& v, double deg) {
  const double c = std::cos(glm::radians(deg)), s = std::sin(glm::radians(deg));
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

/// Errors: heights are stated for a file that has them, or are shifted in one that has none.
Result<void> check_heights(const PeopleSettings& settings, const Trajectories& file) {
  const auto bad = [&](const char* what) {
    return problem_in(settings.place, "the file \"" + settings.file + "\" has " + what);
  };
  if (file.has_heights && !settings.storeys.empty())
    return bad("heights, which [[people.storey]] contradicts: take these tables away");
  if (file.has_heights && settings.floor_m)
    return bad(
        "heights, which 'floor_m' contradicts: take it away, or state the z of 'shift' instead");
  if (!file.has_heights && settings.shift.z != 0)
    return bad(
        "no heights that the z of 'shift' could be added to: state 'floor_m' instead, or the "
        "floor_m of each [[people.storey]]");
  return {};
}

/// The place before all turns and shifts, with the height of its floor.
Result<glm::dvec3> on_floor(const PeopleSettings& settings, const Trajectories& file,
                            const Trajectory& person, size_t i) {
  const glm::dvec3& place = person.places[i];
  if (file.has_heights) return place;
  if (settings.storeys.empty()) return glm::dvec3(glm::dvec2(place), settings.floor_m.value_or(0));
  for (const PeopleStorey& storey : settings.storeys)
    if (place.x >= storey.low.x && place.x <= storey.high.x && place.y >= storey.low.y &&
        place.y <= storey.high.y)
      return glm::dvec3(glm::dvec2(place) + storey.shift, storey.floor_m);
  return problem_in(settings.place,
                    fmt::format("person {} of \"{}\" is at ({:.4g}, {:.4g}) m in the file at {:g} "
                                "s, which is in the box of no [[people.storey]]",
                                person.id, settings.name, place.x, place.y, person.times_s[i]));
}

/// Direction of the way around a time; 0 if the person stands.
glm::dvec2 motion_at(const PlacedPerson& person, double time_s) {
  const glm::dvec2 way(foot_at(person, time_s + stride_s) - foot_at(person, time_s - stride_s));
  const double length = glm::length(way);
  return length > sway_m ? way / length : glm::dvec2(0);
}

/// Looks in strides for the nearest direction of a way, back in time (-1) or ahead (1). Two times
/// that are whole strides apart look at the same times, so the second search goes as far as the
/// first has begun, and takes over what that found.
class WaySearch {
 public:
  WaySearch(const PlacedPerson& person, int sign) : person_(person), sign_(sign) {}

  /// 0 if there is none. Requires: times asked come in the direction against that of the search.
  glm::dvec2 from(double time_s) {
    const double end_s = sign_ < 0 ? person_.times_s.front() : person_.times_s.back();
    const long phase = std::lround(std::remainder(time_s, stride_s) / phase_s);
    Known& known = known_.try_emplace(phase, Known{end_s, glm::dvec2(0)}).first->second;
    glm::dvec2 out = motion_at(person_, time_s);
    for (double at = time_s + sign_ * stride_s;
         out == glm::dvec2(0) && sign_ * (known.until_s - at) > 0; at += sign_ * stride_s)
      out = motion_at(person_, at);
    if (out == glm::dvec2(0)) out = known.found;
    known = {time_s - sign_ * stride_s / 2, out};
    return out;
  }

 private:
  struct Known {
    double until_s;    // beyond it is what an earlier search has looked at, or the person's end
    glm::dvec2 found;  // from there on
  };
  /// Times are alike whose places in a stride differ by less [s]; so there are few of them.
  static constexpr double phase_s = 0.01;

  const PlacedPerson& person_;
  int sign_;
  std::map<long, Known> known_;  // by the place of a time in a stride
};

glm::dvec2 stated_facing(const PlacedPerson& person, double time_s) {
  const auto& t = person.times_s;
  const auto next = std::lower_bound(t.begin(), t.end(), time_s);
  auto i = static_cast<size_t>(next - t.begin());
  if (i == t.size() || (i > 0 && time_s - t[i - 1] < t[i] - time_s)) --i;
  return person.facing[i];
}

}  // namespace

glm::dvec3 foot_at(const PlacedPerson& person, double time_s) {
  const auto& t = person.times_s;
  const auto next = std::upper_bound(t.begin(), t.end(), time_s);
  if (next == t.begin()) return person.feet.front();
  if (next == t.end()) return person.feet.back();
  const auto i = static_cast<size_t>(next - t.begin());
  const double share = (time_s - t[i - 1]) / (t[i] - t[i - 1]);
  return glm::mix(person.feet[i - 1], person.feet[i], share);
}

Result<std::vector<PlacedPerson>> place_people(const PeopleSettings& settings,
                                               const Trajectories& trajectories,
                                               const AssessmentSettings& assessment) {
  if (auto ok = check_heights(settings, trajectories); !ok) return ok.problem();
  std::vector<PlacedPerson> out;
  for (const Trajectory& person : trajectories.people) {
    PlacedPerson placed{
        .group = settings.name,
        .id = person.id,
        .eye_height_m = settings.eye_height_m.value_or(assessment.eye_heights_m.front()),
        .luminance_before_cd_m2 =
            settings.luminance_before_cd_m2.value_or(assessment.luminance_before_cd_m2),
        .times_s = {},
        .feet = {},
        .facing = {}};
    for (size_t i = 0; i < person.times_s.size(); ++i) {
      const auto place = on_floor(settings, trajectories, person, i);
      if (!place) return place.problem();
      const glm::dvec2 plan = turned(glm::dvec2(place.value()), settings.turn_deg);
      placed.feet.emplace_back(plan + glm::dvec2(settings.shift), place->z + settings.shift.z);
      placed.times_s.push_back(person.times_s[i] + settings.time_shift_s);
    }
    for (const glm::dvec2& facing : person.facing)
      placed.facing.push_back(turned(facing, settings.turn_deg));
    out.push_back(std::move(placed));
  }
  return out;
}

PersonAt person_at(const PlacedPerson& person, double time_s) {
  return person_at_each(person, {time_s}).front();
}

std::vector<PersonAt> person_at_each(const PlacedPerson& person,
                                     const std::vector<double>& times_s) {
  std::vector<PersonAt> out;
  for (const double time_s : times_s) out.push_back({foot_at(person, time_s), glm::dvec2(0)});
  if (!person.facing.empty()) {
    for (size_t i = 0; i < times_s.size(); ++i) out[i].facing = stated_facing(person, times_s[i]);
    return out;
  }
  WaySearch before(person, -1), after(person, 1);
  for (size_t i = 0; i < times_s.size(); ++i) out[i].facing = before.from(times_s[i]);
  for (size_t i = times_s.size(); i-- > 0;)
    if (out[i].facing == glm::dvec2(0)) out[i].facing = after.from(times_s[i]);
  return out;
}

}  // namespace luxodus
