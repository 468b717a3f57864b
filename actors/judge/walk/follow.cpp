#include "actors/judge/walk/follow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/emergency/adaptation.hpp"
#include "scenes/emergency/guidance.hpp"
#include "scenes/emergency/way.hpp"

namespace luxodus {

namespace {

/// How far heads reach above eyes [m].
constexpr double crown_m = 0.11;
/// Rounding of times that are multiples of a step, in steps.
constexpr double step_rounding = 1e-9;
/// Points along each edge of a face.
constexpr int face_points = 3;

/// Whether the line between two places passes through an upright cylinder on a foot.
bool passes(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& foot, double height_m) {
  const glm::dvec2 way(to - from), aside(glm::dvec2(from) - glm::dvec2(foot));
  const double a = glm::dot(way, way), b = glm::dot(way, aside),
               c = glm::dot(aside, aside) - body_radius_m * body_radius_m;
  if (c < 0) return false;  // the eye stands within: two people at one place
  const double root = b * b - a * c;
  if (a <= 0 || root < 0) return false;
  const double enters = (-b - std::sqrt(root)) / a, leaves = (-b + std::sqrt(root)) / a;
  const double first = std::max(enters, 0.0), last = std::min(leaves, 1.0);
  if (first >= last) return false;
  const double z0 = from.z + first * (to.z - from.z), z1 = from.z + last * (to.z - from.z);
  return std::min(z0, z1) < foot.z + height_m && std::max(z0, z1) > foot.z;
}

/// The numbers of the first and the last step of a person on the clock; the last is smaller where
/// no multiple of the step lies within the person's times.
std::pair<double, double> step_numbers(const PlacedPerson& person, double step_s) {
  return {std::ceil(person.times_s.front() / step_s - step_rounding),
          std::floor(person.times_s.back() / step_s + step_rounding)};
}

/// People who are in the building at a time, but one.
std::vector<const PlacedPerson*> others_at(const std::vector<PlacedPerson>& people, size_t but,
                                           double time_s) {
  std::vector<const PlacedPerson*> out;
  for (size_t i = 0; i < people.size(); ++i)
    if (i != but && is_present(people[i], time_s)) out.push_back(&people[i]);
  return out;
}

/// Looks with the eyes of one person after another.
class Looking {
 public:
  Looking(const SceneDescription& scene, const std::vector<PlacedPerson>& people,
          const WalkOptions& options)
      : scene_(scene), people_(people), options_(options) {}

  /// `answers`: to all steps of the person.
  void look(WalkedPerson& walked, std::span<const SignAnswer> answers) const {
    double read_s = walked.steps.front().time_s;
    for (size_t i = 0; i < walked.steps.size(); ++i) {
      WalkStep& step = walked.steps[i];
      step.signs = signs_at(walked.person, step,
                            answers.subspan(i * scene_.signs.size(), scene_.signs.size()));
      if (step.reads()) read_s = step.time_s;
      step.unread_s = step.time_s - read_s;
    }
  }

 private:
  std::vector<SignOnWay> signs_at(size_t person, const WalkStep& step,
                                  std::span<const SignAnswer> answers) const {
    std::vector<SignOnWay> out;
    const glm::dvec3 foot = step.eye - glm::dvec3(0, 0, people_[person].eye_height_m);
    const WaysAhead ways(scene_, foot);
    std::optional<std::vector<const PlacedPerson*>> others;
    for (uint32_t s = 0; s < scene_.signs.size(); ++s) {
      const Sign& sign = scene_.signs[s];
      const SignView view = view_of_sign(sign, step.eye);
      if (!in_field_of_view(step.eye, step.facing, view.centre, options_.field_of_view_deg) ||
          !ways.lead_past(sign, view))
        continue;
      SignOnWay one{s, answers[s], false};
      if (options_.crowd_hides && one.answer != SignAnswer::hidden) {
        if (!others) others = others_at(people_, person, step.time_s);
        one.hidden_by_people = people_hide(sign, view, step.eye, *others, step.time_s);
        if (one.hidden_by_people) one.answer = SignAnswer::hidden;
      }
      out.push_back(one);
    }
    return out;
  }

  const SceneDescription& scene_;
  const std::vector<PlacedPerson>& people_;
  const WalkOptions& options_;
};

}  // namespace

size_t WalkStep::count(SignAnswer answer) const {
  return static_cast<size_t>(std::count_if(
      signs.begin(), signs.end(), [&](const SignOnWay& one) { return one.answer == answer; }));
}

std::vector<double> step_times(const PlacedPerson& person, double step_s) {
  std::vector<double> out;
  const auto [first, last] = step_numbers(person, step_s);
  for (double k = first + 0.0; k <= last; ++k)  // no negative zero
    out.push_back(std::clamp(k * step_s, person.times_s.front(), person.times_s.back()));
  if (out.empty()) out.push_back(person.times_s.front());
  return out;
}

Result<void> check_steps(const std::vector<PlacedPerson>& people, double step_s,
                         const std::string& scene_file) {
  double steps = 0, first_s = 0, last_s = 0;
  for (size_t i = 0; i < people.size(); ++i) {
    const auto [first, last] = step_numbers(people[i], step_s);
    steps += std::max(last - first + 1, 1.0);
    const double from_s = people[i].times_s.front(), to_s = people[i].times_s.back();
    first_s = i == 0 ? from_s : std::min(first_s, from_s);
    last_s = i == 0 ? to_s : std::max(last_s, to_s);
  }
  constexpr auto most = static_cast<double>(limits::walk_steps);
  if (steps > most)
    return problem_in(scene_file,
                      fmt::format("the people take {:.0f} steps of {:g} s; at most {:.0f} are "
                                  "followed: choose a longer --step",
                                  steps, step_s, most));
  if ((last_s - first_s) / step_s > most)
    return problem_in(
        scene_file, fmt::format("people are in the building from {:g} to {:g} s, more than {:.0f} "
                                "steps of {:g} s: choose a longer --step, or state other "
                                "time_shift_s in [[people]]",
                                first_s, last_s, most, step_s));
  return {};
}

bool in_field_of_view(const glm::dvec3& eye, const glm::dvec2& facing, const glm::dvec3& place,
                      double field_of_view_deg) {
  const glm::dvec2 to(place - eye);
  const double length = glm::length(to);
  if (facing == glm::dvec2(0) || length == 0) return true;
  return glm::dot(to, facing) / length >= std::cos(glm::radians(field_of_view_deg / 2)) - 1e-12;
}

WaysAhead::WaysAhead(const SceneDescription& scene, const glm::dvec3& foot)
    : foot_(foot), any_sign_(scene.routes.empty()) {
  for (const EscapeRoute& route : scene.routes) {
    const double along_m = passed_at_m(route, foot);
    if (std::abs(place_along(route, along_m).z - foot.z) <= storey_m)
      here_.push_back({&route, along_m});
  }
}

bool WaysAhead::lead_past(const Sign& sign, const SignView& view) const {
  if (view.behind) return false;
  return any_sign_ || !led_along(sign, view).empty();
}

std::vector<const EscapeRoute*> WaysAhead::led_along(const Sign& sign, const SignView& view) const {
  std::vector<const EscapeRoute*> out;
  // Where the person looks is asked elsewhere: for the route the sign is straight ahead.
  const glm::dvec3 to = view.centre - foot_;
  const double length = glm::length(to);
  if (length == 0) return out;
  for (const RouteHere& one : here_)
    if (can_guide(*one.route, {foot_, to / length, one.along_m}, sign, view))
      out.push_back(one.route);
  return out;
}

bool people_hide(const Sign& sign, const SignView& view, const glm::dvec3& eye,
                 std::span<const PlacedPerson* const> others, double time_s) {
  std::vector<std::pair<glm::dvec3, double>> bodies;  // feet and heights near the line
  for (const PlacedPerson* one : others) {
    const glm::dvec3 foot = foot_at(*one, time_s);
    if (glm::distance(glm::dvec2(foot), glm::dvec2(eye)) < view.distance_m + body_radius_m)
      bodies.emplace_back(foot, one->eye_height_m + crown_m);
  }
  int hidden = 0;
  for (int j = 0; j < face_points; ++j)
    for (int i = 0; i < face_points; ++i) {
      const glm::dvec2 uv = (glm::dvec2(i, j) + 0.5) / static_cast<double>(face_points) - 0.5;
      const glm::dvec3 place = view.centre + sign.frame.axes[0] * (uv.x * sign.width_m) +
                               sign.frame.axes[1] * (uv.y * sign.height_m);
      hidden += std::any_of(bodies.begin(), bodies.end(), [&](const auto& body) {
        return passes(eye, place, body.first, body.second);
      });
    }
  return 2 * hidden > face_points * face_points;
}

std::optional<double> MainsFailure::since(double time_s) const {
  if (!at_s) return since_s;
  return time_s >= *at_s ? std::optional(time_s - *at_s) : std::nullopt;
}

std::vector<WalkedPerson> begin_walks(const std::vector<PlacedPerson>& people,
                                      const WalkOptions& options) {
  std::vector<WalkedPerson> out;
  for (size_t p = 0; p < people.size(); ++p) {
    const PlacedPerson& one = people[p];
    WalkedPerson walked{p, {}};
    const std::vector<double> times = step_times(one, options.step_s);
    const std::vector<PersonAt> places = person_at_each(one, times);
    for (size_t i = 0; i < times.size(); ++i) {
      WalkStep step;
      step.time_s = times[i];
      step.eye = places[i].foot + glm::dvec3(0, 0, one.eye_height_m);
      step.facing = places[i].facing;
      walked.steps.push_back(std::move(step));
    }
    out.push_back(std::move(walked));
  }
  return out;
}

std::vector<TimedEye> eyes_of(const std::vector<WalkedPerson>& walks) {
  std::vector<TimedEye> out;
  for (const WalkedPerson& walked : walks)
    for (const WalkStep& step : walked.steps) out.push_back({step.time_s, step.eye});
  return out;
}

void look(const SceneDescription& scene, const std::vector<PlacedPerson>& people,
          const WalkOptions& options, const FoundAtEyes& found, const MainsFailure& failure,
          std::vector<WalkedPerson>& walks) {
  const Looking looking(scene, people, options);
  size_t first = 0;
  for (WalkedPerson& walked : walks) {
    const double before = people[walked.person].luminance_before_cd_m2;
    for (size_t i = 0; i < walked.steps.size(); ++i) {
      WalkStep& step = walked.steps[i];
      step.extinction_per_m = found.extinctions[first + i];
      if (const auto since = failure.since(step.time_s))
        step.bleached_cd_m2 = equivalent_background(before, *since);
    }
    looking.look(
        walked, std::span(found.answers)
                    .subspan(first * scene.signs.size(), walked.steps.size() * scene.signs.size()));
    first += walked.steps.size();
  }
}

}  // namespace luxodus
