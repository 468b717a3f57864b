#include "actors/apps/view/edit_history.hpp"

#include <algorithm>
#include <iterator>

namespace luxodus {

namespace {

using std::chrono::milliseconds;

/// Edits of one subject within this time are one drag.
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

bool EditHistory::continues(const EditStep& step, Time at) const {
  if (done_ == 0 || done_ != steps_.size() || steps_.back().kind != step.kind) return false;
  return at - last_ < one_click || (at - last_ < one_drag && steps_.back().names == step.names);
}

void EditHistory::note(EditStep step, EditedState now, Time at) {
  now = without_time(std::move(now));
  if (now == states_[done_]) return;
  if (continues(step, at)) {
    EditStep& last = steps_.back();
    for (std::string& name : step.names)
      if (std::find(last.names.begin(), last.names.end(), name) == last.names.end())
        last.names.push_back(std::move(name));
    last.value = step.value;
    states_.back() = std::move(now);
  } else {
    steps_.resize(done_);
    states_.resize(done_ + 1);
    steps_.push_back(std::move(step));
    states_.push_back(std::move(now));
    if (steps_.size() > limits::view_steps) {
      steps_.erase(steps_.begin());
      states_.erase(states_.begin());
    }
    done_ = steps_.size();
  }
  last_ = at;
}

const EditedState& EditHistory::go_to(size_t done) {
  done_ = done;
  last_ = {};  // the next edit continues no step
  return states_[done_];
}

void EditHistory::take_back(const EditedState& refused_to) {
  const EditedState now = without_time(refused_to);
  size_t kept = done_;
  while (kept > 0 && !(states_[kept].edits == now.edits)) --kept;
  steps_.resize(kept);
  states_.resize(kept + 1);
  states_.back() = now;
  done_ = kept;
  last_ = {};
}

}  // namespace luxodus
