#include "actors/apps/view/view_answers.hpp"

#include <algorithm>
#include <utility>

#include "actors/apps/view/code_checks.hpp"
#include "actors/apps/view/sign_verdicts.hpp"
#include "actors/apps/view/suggestions.hpp"

namespace luxodus {

namespace {

/// A refusal, marked with what was asked for: the page has a place for each.
Json refusal(const ViewQuestion& question, const std::string& why) {
  Json out = {{"type", "refused"}, {"why", why}};
  if (std::holds_alternative<SuggestAsk>(question)) out["suggestion"] = true;
  if (std::holds_alternative<ChecksAsk>(question)) out["checks"] = true;
  return out;
}

}  // namespace

// ---- lanes -------------------------------------------------------------------------------------

AnswerLane::AnswerLane(Answer answer)
    : answer_(std::move(answer)), thread_([this] { work(); }) {}

AnswerLane::~AnswerLane() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void AnswerLane::put(ViewOrder order) {
  {
    const std::lock_guard lock(mutex_);
    const auto waits = std::find_if(waiting_.begin(), waiting_.end(),
                                    [&](const ViewOrder& one) { return replaces(order, one); });
    if (waits != waiting_.end())
      *waits = std::move(order);
    else
      waiting_.push_back(std::move(order));
  }
  changed_.notify_all();
}

void AnswerLane::forget(uint64_t viewer) {
  const std::lock_guard lock(mutex_);
  std::erase_if(waiting_, [&](const ViewOrder& one) { return one.viewer == viewer; });
}

bool AnswerLane::is_replaced(const ViewOrder& order) {
  const std::lock_guard lock(mutex_);
  return std::any_of(waiting_.begin(), waiting_.end(),
                     [&](const ViewOrder& one) { return replaces(one, order); });
}

void AnswerLane::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return ends_ || !waiting_.empty(); });
    if (ends_) return;
    const ViewOrder order = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    answer_(order);
    lock.lock();
  }
}

// ---- answers -----------------------------------------------------------------------------------

ViewAnswers::ViewAnswers(const LiveOptions& options, SceneAt scene_at, Tell tell)
    : options_(options),
      scene_at_(std::move(scene_at)),
      tell_(std::move(tell)),
      checks_([this](const ViewOrder& order) { answer(order); }),
      others_([this](const ViewOrder& order) { answer(order); }) {}

ViewAnswers::~ViewAnswers() {
  ends_ = true;
}

void ViewAnswers::put(ViewOrder order) {
  const bool checks = std::holds_alternative<ChecksAsk>(order.question);
  (checks ? checks_ : others_).put(std::move(order));
}

void ViewAnswers::forget(uint64_t viewer) {
  checks_.forget(viewer);
  others_.forget(viewer);
}

void ViewAnswers::answer(const ViewOrder& order) {
  const auto said = [&]() -> Result<Json> {
    try {
      const auto scene = scene_at_(order.edits.at_s);
      if (!scene) return scene.problem();
      return answer_to(order, *scene.value());
    } catch (const std::exception& e) {
      return problem(e.what());
    }
  }();
  if (!said) return tell_(order.viewer, refusal(order.question, said.problem().text()));
  if (!said->is_null()) tell_(order.viewer, said.value());
}

Result<Json> ViewAnswers::answer_to(const ViewOrder& order, const SceneDescription& scene) {
  if (const auto* const suggest = std::get_if<SuggestAsk>(&order.question))
    return suggestion(scene, order.edits, suggest->free, options_, ends_);
  if (std::holds_alternative<ChecksAsk>(order.question))
    return code_checks(scene, order.edits, order.dimming.factors, options_);
  return verdicts(order);
}

Result<Json> ViewAnswers::verdicts(const ViewOrder& order) {
  const auto judged = options_.judged ? options_.judged->at(order.edits.at_s)
                                      : scene_at_(order.edits.at_s);
  if (!judged) return judged.problem();
  const auto with = [&](VerdictCare care) {
    return sign_verdicts(*judged.value(), order.edits, order.dimming.both(),
                         std::get<JudgeAsk>(order.question).sign, care, options_, ends_);
  };
  Json first = with(VerdictCare::provisional);
  if (first["type"] == "refused") return first;
  tell_(order.viewer, first);
  if (others_.is_replaced(order)) return Json();
  return with(VerdictCare::sure);
}

}  // namespace luxodus
