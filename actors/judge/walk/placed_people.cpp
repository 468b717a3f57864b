#include "actors/judge/walk/placed_people.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

/// The place before all turns and shifts, with the height of its floor.
Result<glm::dvec3> on_floor(const PeopleSettings& settings, const Trajectories& file,
                            const Trajectory& person, size_t i) {
  const glm::dvec3& place = person.places[i];
  if (file.has_heights) return place;
  if (settings.storeys.empty()) return glm::dvec3(glm::dvec2(place), settings.floor_m);
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
  if (trajectories.has_heights && !settings.storeys.empty())
    return problem_in(settings.place, "the file \"" + settings.file +
                                          "\" has heights, which [[people.storey]] contradicts: "
                                          "take these tables away");
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
      const double lift_m = trajectories.has_heights ? settings.shift.z : 0;
      placed.feet.emplace_back(plan + glm::dvec2(settings.shift), place->z + lift_m);
      placed.times_s.push_back(person.times_s[i] + settings.time_shift_s);
    }
    for (const glm::dvec2& facing : person.facing)
      placed.facing.push_back(turned(facing, settings.turn_deg));
    out.push_back(std::move(placed));
  }
  return out;
}

PersonAt person_at(const PlacedPerson& person, double time_s) {
  PersonAt out{foot_at(person, time_s), glm::dvec2(0)};
  if (!person.facing.empty()) {
    out.facing = stated_facing(person, time_s);
    return out;
  }
  out.facing = motion_at(person, time_s);
  const auto& t = person.times_s;
  for (double before = time_s; out.facing == glm::dvec2(0) && before > t.front();
       before -= stride_s)
    out.facing = motion_at(person, before);
  for (double after = time_s; out.facing == glm::dvec2(0) && after < t.back(); after += stride_s)
    out.facing = motion_at(person, after);
  return out;
}

}  // namespace luxodus
