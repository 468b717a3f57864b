// What people see on their way: at each step, which signs are in their field of view and belong on
// the way, what they get from them, since when nothing was read, and in which smoke their eyes are.
// What eyes get of signs is computed elsewhere. Pure functions; any thread.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "actors/judge/visibility_map/sign_estimates.hpp"
#include "scenes/formats/trajectories/placed_people.hpp"

namespace luxodus {

namespace limits {
/// Steps of all people together.
inline constexpr size_t walk_steps = estimated_eyes;
}  // namespace limits

struct WalkOptions {
  double step_s = 1;
  double field_of_view_deg = 120;  // in plan, half of it on each side
  bool crowd_hides = false;        // whether people hide signs from those behind them
};

/// When the mains failed, for eyes that come from a lit room.
struct MainsFailure {
  std::optional<double> at_s;     // of the clock
  std::optional<double> since_s;  // stated for a state without a clock
  /// Seconds since then; none before, and where nothing is stated.
  std::optional<double> since(double time_s) const;
};

/// A sign in the field of view that belongs on the way.
struct SignOnWay {
  uint32_t sign = 0;  // of the scene
  SignAnswer answer = SignAnswer::undecided;
  bool hidden_by_people = false;  // the answer is then hidden
};

struct WalkStep {
  double time_s = 0;
  glm::dvec3 eye{0};
  glm::dvec2 facing{0};          // 0: unknown, and signs on all sides count
  double extinction_per_m = 0;   // at the eye
  double unread_s = 0;           // since a sign was read, or since the person came in; 0: reads one
  double bleached_cd_m2 = 0;     // equivalent background of eyes that come from a lit room
  std::vector<SignOnWay> signs;  // in the order of the scene

  size_t count(SignAnswer answer) const;
  bool reads() const { return count(SignAnswer::read) > 0; }
};

/// The steps of one person; at least one.
struct WalkedPerson {
  size_t person = 0;  // of the placed people
  std::vector<WalkStep> steps;
};

/// Times of the steps of a person: all multiples of the step within the person's times, or the
/// first time if there is none.
std::vector<double> step_times(const PlacedPerson& person, double step_s);

/// Errors: the people take more steps than limits::walk_steps, or more fit between the first and
/// the last of their times. Files state any times, so this is asked before steps are made.
Result<void> check_steps(const std::vector<PlacedPerson>& people, double step_s,
                         const std::string& scene_file);

/// The ways that lie ahead of a person whose foot is at one place.
class WaysAhead {
 public:
  /// Requires: the scene outlives it.
  WaysAhead(const SceneDescription& scene, const glm::dvec3& foot);
  /// Whether a sign belongs on the way: some route of the storey that it leads along comes past it
  /// later, in the direction of its arrow (guidance.hpp). In a scene without routes all signs do
  /// that turn a face to the eye. `view`: from the person's eye.
  bool lead_past(const Sign& sign, const SignView& view) const;
  /// The routes of the storey along which a sign leads so, in the order of the scene.
  std::vector<const EscapeRoute*> led_along(const Sign& sign, const SignView& view) const;

 private:
  /// A route of the storey, and how far along it the person is.
  struct RouteHere {
    const EscapeRoute* route;
    double along_m;
  };
  glm::dvec3 foot_;
  bool any_sign_;  // there are no routes in the scene
  std::vector<RouteHere> here_;
};

/// Whether a place lies in the field of view, in plan.
bool in_field_of_view(const glm::dvec3& eye, const glm::dvec2& facing, const glm::dvec3& place,
                      double field_of_view_deg);

/// Whether more than half of a sign's face, as nine points, is behind people. A person is an
/// upright cylinder of the width of shoulders.
bool people_hide(const Sign& sign, const SignView& view, const glm::dvec3& eye,
                 std::span<const PlacedPerson* const> others, double time_s);

/// The steps of all people, with places and directions only. Requires: check_steps.
std::vector<WalkedPerson> begin_walks(const std::vector<PlacedPerson>& people,
                                      const WalkOptions& options);
/// The eyes of all steps, one person after another.
std::vector<TimedEye> eyes_of(const std::vector<WalkedPerson>& walks);

/// What was found for these eyes.
struct FoundAtEyes {
  std::vector<SignAnswer> answers;  // element eye * signs + sign
  std::vector<double> extinctions;  // of the smoke at the eye [1/m]
};
/// Completes the steps. Requires: as many answers and extinctions as eyes_of(walks) needs.
void look(const SceneDescription& scene, const std::vector<PlacedPerson>& people,
          const WalkOptions& options, const FoundAtEyes& found, const MainsFailure& failure,
          std::vector<WalkedPerson>& walks);

}  // namespace luxodus
