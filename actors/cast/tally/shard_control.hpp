// The coordinator's side of shards: sends every shard the decision about each flush until the shard
// acknowledges it, and gathers the shards' totals on request. Decisions about one node are sent to
// a shard one at a time and in order; those about different nodes, several at a time: otherwise on
// a slow network a round would wait for as many round trips as nodes flush. A shard whose range is
// no longer complete is a fault, and ends the run.
// Lost, late and duplicate messages: a decision or a question is retried under the same id until
// its answer arrives; other answers are old and ignored; the shard's handling is idempotent. A
// piece of the totals is added only once, since the next question has another id.
// Thread rule: the node's thread. Answers add totals, so they may not be handled on a fiber.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "actors/cast/tally/shard_plan.hpp"
#include "runtime/core/clock.hpp"
#include "runtime/messaging/actor_system.hpp"
#include "runtime/messaging/retry_timer.hpp"

namespace luxodus {

class ShardControl {
 public:
  /// `self` is the coordinator on whose behalf it asks. Retries are at most `lost` apart. Requires:
  /// all references outlive this.
  ShardControl(const ShardPlan& plan, Totals& totals, const Clock& clock, Nanoseconds lost,
               Sender& sender, Address self);

  /// Decisions in flight to a shard: half of its mailbox.
  static constexpr size_t max_decisions = 32;
  /// Shards other than the controller's.
  size_t others() const { return shards_.size(); }
  bool owns(NodeId worker) const { return plan_.shard_of(worker) != 0; }

  /// Makes every shard add its slice of a flush, or drop it. Requires: as many hashes as others().
  void take(const MessageId& flush, const std::vector<uint64_t>& slice_hashes);
  void refuse(const MessageId& flush);
  /// No further flush of a worker's ended incarnation will be counted.
  void end_life(NodeId worker, Incarnation life);
  /// Whether every shard has acknowledged every decision.
  bool settled() const;

  /// Adds the shards' totals to those here, and calls `done`, possibly within this call. Requires:
  /// settled(), no gather in progress; no flush is taken until it is done.
  void gather(std::function<void()> done);
  bool gathering() const { return static_cast<bool>(done_); }

  /// Answers of shards.
  void on(const Letter<FlushSettled>& settled);
  void on(const Letter<TotalsTold>& told);
  /// Retries what got no answer in time.
  void look();
  /// Why the totals are lost.
  const std::optional<std::string>& fault() const { return fault_; }

  struct Counters {
    uint64_t decisions = 0;
    uint64_t asked_again = 0;
    uint64_t gathers = 0;
    uint64_t gathered_bytes = 0;
  };
  const Counters& counters() const { return counters_; }

 private:
  /// A message that a shard is to answer.
  struct Question {
    MessageId id;
    RetryTimer timer;  // runs once the network has taken the question
  };
  struct Decision {
    FlushDecided what;
    std::optional<Question> asked;
  };
  struct Shard {
    NodeId owner;
    BinRange bins;
    std::deque<Decision> decisions;           // not acknowledged yet
    RetryTimer decision_timer, totals_timer;  // adapted to the last answers
    std::optional<Question> asked;            // for totals, in a gather
    int64_t next = 0;                         // first bin of the next question
  };

  void decide(size_t shard, const FlushDecided& decision);
  void ask_decisions(Shard& shard);
  void ask_totals(Shard& shard);
  void put(const Shard& shard, Question& question, const Message& message);
  void put_again(const Shard& shard, Question& question, const Message& message);
  AskTotals next_totals(const Shard& shard) const;
  Shard* shard_of(NodeId owner);
  void add(Shard& shard, const TotalsTold& told, std::span<const std::byte> payload);
  void end_gather();

  const ShardPlan plan_;
  Totals& totals_;
  const Clock& clock_;
  Sender& sender_;
  const Address self_;
  std::vector<Shard> shards_;
  uint32_t gather_ = 0;
  std::function<void()> done_;  // of the current gather
  std::optional<std::string> fault_;
  Counters counters_;
};

}  // namespace luxodus
