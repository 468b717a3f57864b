// What the viewers of a live view have changed, step by step, so that steps can be undone and
// redone. Times of the scene and after a failure are points of view and no steps. Thread rule: one
// thread.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "actors/apps/view/live_scene.hpp"

namespace luxodus {

namespace limits {
/// Steps that are remembered; the oldest are forgotten first.
inline constexpr size_t view_steps = 200;
}  // namespace limits

/// What steps change: places and copies, scenario and smoke, and the factors of source groups.
struct EditedState {
  SceneEdits edits;  // without a time
  std::map<std::string, double> factors;
  bool operator==(const EditedState&) const = default;
};

enum class EditKind : uint8_t { factor, scenario, smoke, move, add, remove };
const char* name_of(EditKind kind);

/// A step, as it is listed.
struct EditStep {
  EditKind kind = EditKind::move;
  std::vector<std::string> names;  // groups, signs, luminaires, or the scenario
  std::optional<double> value;     // of a factor or of smoke: the last one given
};

class EditHistory {
 public:
  using Time = std::chrono::steady_clock::time_point;
  explicit EditHistory(EditedState first);

  enum class Noted : uint8_t { nothing, continued, changed };
  /// Adds a step that led to `now`, and forgets steps that were undone. A drag of one slider, and
  /// one click that changes many things, arrive as many edits and become one step. An edit that
  /// changes nothing is no step, nor is a drag that returns to where it began.
  Noted note(EditStep step, EditedState now, Time at);

  const std::vector<EditStep>& steps() const { return steps_; }
  /// The number of steps that are not undone.
  size_t done() const { return done_; }
  /// The state after the first `done` steps, from where the next edit continues.
  /// Requires: done <= steps().size().
  const EditedState& go_to(size_t done);

  /// What has led away from `now` was refused, and `now` holds again. After an edit, the steps that
  /// were refused are forgotten; dimming, which is never refused, stays. After undoing or redoing
  /// all steps stay. Returns the factors that hold.
  std::map<std::string, double> take_back(const EditedState& now);

 private:
  /// Whether a step continues the last one.
  bool continues(const EditStep& step, Time at) const;
  /// The state with these edits that is nearest to the present one; none if there is none.
  std::optional<size_t> nearest_with(const SceneEdits& edits) const;
  void forget_refused_after(size_t kept, const EditedState& now);

  std::vector<EditStep> steps_;
  std::vector<EditedState> states_;  // before the first step and after each
  size_t done_ = 0;
  bool travelled_ = false;  // the present state was gone to, and not led to by an edit
  Time last_;               // of the last note
};

}  // namespace luxodus
