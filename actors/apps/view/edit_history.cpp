#include "actors/apps/view/edit_history.hpp"

#include <algorithm>

namespace luxodus {

namespace {

using std::chrono::milliseconds;

/// Values of one slider within this time are one drag.
constexpr milliseconds one_drag{1000};
/// Edits of one kind within this time are one click, whatever their subjects: nobody is so quick.
constexpr milliseconds one_click{200};

EditedState without_time(EditedState state) {
  state.edits.at_s.reset();
  return state;
}

}  // namespace

const char* name_of(EditKind kind) {
  switch (kind) {
    case EditKind::factor:
      return "factor";
    case EditKind::scenario:
      return "scenario";
    case EditKind::smoke:
      return "smoke";
    case EditKind::move:
      return "move";
    case EditKind::add:
      return "add";
    case EditKind::remove:
      return "remove";
  }
  return "";
}

EditHistory::EditHistory(EditedState first) {
  states_.push_back(without_time(std::move(first)));
}

/// Only drags of one slider are merged for longer than a click: what is traced may be refused, and
/// then its own state must be known.
bool EditHistory::continues(const EditStep& step, Time at) const {
  if (done_ == 0 || done_ != steps_.size() || steps_.back().kind != step.kind) return false;
  const bool slider = step.kind == EditKind::factor && steps_.back().names == step.names;
  return at - last_ < (slider ? one_drag : one_click);
}

EditHistory::Noted EditHistory::note(EditStep step, EditedState now, Time at) {
  now = without_time(std::move(now));
  if (now == states_[done_]) return Noted::nothing;
  travelled_ = false;
  const bool continued = continues(step, at);
  last_ = at;
  if (!continued) {
    steps_.resize(done_);
    states_.resize(done_ + 1);
    steps_.push_back(std::move(step));
    states_.push_back(std::move(now));
    if (steps_.size() > limits::view_steps) {
      steps_.erase(steps_.begin());
      states_.erase(states_.begin());
    }
    done_ = steps_.size();
    return Noted::changed;
  }
  EditStep& last = steps_.back();
  for (std::string& name : step.names)
    if (std::find(last.names.begin(), last.names.end(), name) == last.names.end())
      last.names.push_back(std::move(name));
  last.value = step.value;
  states_.back() = std::move(now);
  if (states_[done_] != states_[done_ - 1]) return Noted::continued;
  steps_.pop_back();
  states_.pop_back();
  --done_;
  last_ = {};
  return Noted::changed;
}

const EditedState& EditHistory::go_to(size_t done) {
  done_ = done;
  travelled_ = true;
  last_ = {};  // the next edit continues no step
  return states_[done_];
}

std::optional<size_t> EditHistory::nearest_with(const SceneEdits& edits) const {
  std::optional<size_t> best;
  const auto away = [&](size_t at) { return at > done_ ? at - done_ : done_ - at; };
  for (size_t at = 0; at < states_.size(); ++at)
    if (states_[at].edits == edits && (!best || away(at) <= away(*best))) best = at;
  return best;
}

void EditHistory::forget_refused_after(size_t kept, const EditedState& now) {
  std::vector<EditStep> steps(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(kept));
  std::vector<EditedState> states(states_.begin(),
                                  states_.begin() + static_cast<std::ptrdiff_t>(kept) + 1);
  for (size_t i = kept; i < done_; ++i) {
    if (steps_[i].kind != EditKind::factor) continue;
    steps.push_back(steps_[i]);
    states.push_back({now.edits, states_[i + 1].factors});
  }
  if (states.size() > kept + 1) states.back() = now;
  steps_ = std::move(steps);
  states_ = std::move(states);
  done_ = steps_.size();
}

std::map<std::string, double> EditHistory::take_back(const EditedState& restored) {
  const EditedState now = without_time(restored);
  const auto found = nearest_with(now.edits);
  last_ = {};
  if (travelled_) {
    if (!found) return now.factors;
    done_ = *found;
    return states_[done_].factors;
  }
  if (found)
    forget_refused_after(std::min(*found, done_), now);
  else if (done_ > 0)
    states_[done_] = now;  // a part of one click was traced: the rest of it is refused
  return now.factors;
}

}  // namespace luxodus
