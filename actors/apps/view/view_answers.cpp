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
  if (const auto* const judge = std::get_if<JudgeAsk>(&question)) out["sign"] = judge->sign;
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
  if (served_ == viewer) served_.reset();
}

bool AnswerLane::is_in_vain(const ViewOrder& order) {
  const std::lock_guard lock(mutex_);
  return served_ != order.viewer || std::any_of(waiting_.begin(), waiting_.end(),
                     [&](const ViewOrder& one) { return replaces(one, order); });
}

void AnswerLane::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return ends_ || !waiting_.empty(); });
    if (ends_) return;
    const ViewOrder order = std::move(waiting_.front());
    waiting_.pop_front();
    served_ = order.viewer;
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
  if (std::holds_alternative<ChecksAsk>(order.question)) return checks(order, scene);
  return verdicts(order);
}

Result<Json> ViewAnswers::checks(const ViewOrder& order, const SceneDescription& scene) {
  const LiveDimming& dimming = order.dimming;
  if (!checked_ || checked_->edits != order.edits || checked_->factors != dimming.factors ||
      checked_->seconds != dimming.seconds) {
    auto answer = code_checks(scene, order.edits, dimming, options_);
    if (!answer) return answer;
    checked_ =
        Checked{order.edits, dimming.factors, dimming.seconds, std::move(answer).value()};
  }
  Json out = checked_->answer;
  out["id"] = std::get<ChecksAsk>(order.question).id;
  return out;
}

Result<Json> ViewAnswers::verdicts(const ViewOrder& order) {
  const auto judged = options_.judged ? options_.judged->at(order.edits.at_s)
                                      : scene_at_(order.edits.at_s);
  if (!judged) return judged.problem();
  const auto& ask = std::get<JudgeAsk>(order.question);
  const auto with = [&](VerdictCare care) -> Result<Json> {
    Json out = sign_verdicts(*judged.value(), order.edits, order.dimming.both(), ask.sign, care,
                             options_, ends_);
    if (out["type"] == "refused") return problem(out["why"].get<std::string>());
    out["id"] = ask.id;
    return out;
  };
  const auto first = with(VerdictCare::provisional);
  if (!first) return first;
  tell_(order.viewer, first.value());
  if (others_.is_in_vain(order)) return Json();
  return with(VerdictCare::sure);
}

}  // namespace luxodus
