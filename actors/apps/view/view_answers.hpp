// Answers questions of viewers that take seconds: a sign to judge, luminaires to suggest, the
// checks of the codes. Checks follow every edit, so they have a thread of their own and wait for no
// other answer. Thread rule: any thread may ask and forget.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <variant>

#include "actors/apps/view/live_json.hpp"
#include "actors/apps/view/page_message.hpp"

namespace luxodus {

using ViewQuestion = std::variant<JudgeAsk, SuggestAsk, ChecksAsk>;

/// A question about the building in the state that it has when the question is put.
struct ViewOrder {
  uint64_t viewer = 0;
  ViewQuestion question;
  SceneEdits edits;
  LiveDimming dimming;
};

/// Answers orders in turn on a thread of its own. One order waits for each viewer and kind of
/// question: a later one replaces it.
class AnswerLane {
 public:
  using Answer = std::function<void(const ViewOrder&)>;  // called on the lane's thread
  explicit AnswerLane(Answer answer);
  ~AnswerLane();
  AnswerLane(const AnswerLane&) = delete;
  AnswerLane& operator=(const AnswerLane&) = delete;

  void put(ViewOrder order);
  /// Drops what waits of a viewer, who has left.
  void forget(uint64_t viewer);
  /// Whether nobody waits for the rest of this answer, which is in work: its viewer has left, or a
  /// later order of the same viewer and kind waits.
  bool is_in_vain(const ViewOrder& order);

 private:
  static bool replaces(const ViewOrder& one, const ViewOrder& other) {
    return one.viewer == other.viewer && one.question.index() == other.question.index();
  }
  void work();

  const Answer answer_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<ViewOrder> waiting_;
  std::optional<uint64_t> served_;  // the viewer whose order is in work; none once that has left
  bool ends_ = false;
  std::thread thread_;  // declared last: it starts when all other members exist
};

class ViewAnswers {
 public:
  using SceneAt =
      std::function<Result<std::shared_ptr<const SceneDescription>>(std::optional<double> at_s)>;
  /// Messages of types "sign", "suggested" and "checks", or "refused" with the reason. Called on
  /// threads of the answers.
  using Tell = std::function<void(uint64_t viewer, const Json& message)>;

  ViewAnswers(const LiveOptions& options, SceneAt scene_at, Tell tell);
  ~ViewAnswers();

  void put(ViewOrder order);
  void forget(uint64_t viewer);

 private:
  void answer(const ViewOrder& order);
  Result<Json> answer_to(const ViewOrder& order, const SceneDescription& scene);
  /// Tells provisional verdicts first, and returns the sure ones; null if nobody waits for them by
  /// then.
  Result<Json> verdicts(const ViewOrder& order);
  Result<Json> checks(const ViewOrder& order, const SceneDescription& scene);

  const LiveOptions options_;
  const SceneAt scene_at_;
  const Tell tell_;
  std::atomic<bool> ends_{false};
  /// The last checks, for other viewers of the same state. Used by the thread of checks only.
  struct Checked {
    SceneEdits edits;
    std::map<std::string, double> factors;
    std::optional<double> seconds;
    Json answer;
  };
  std::optional<Checked> checked_;
  AnswerLane checks_, others_;  // declared last: their threads use all other members
};

}  // namespace luxodus
