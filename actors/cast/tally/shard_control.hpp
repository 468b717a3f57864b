// The controller's side of shards: tells every shard what became of each flush, until the shard has
// answered, and brings the shards' totals here when they are asked for. Decisions about one node
// go to a shard one by one and in their order; those about different nodes, a few at a time: a slow
// network would else make a round wait for as many answers as nodes flush. A shard whose range is
// no longer whole is a fault, and ends the run.
// What if a message is lost, late, or comes twice? A decision or a question is sent again until its
// answer comes, under the same id; an answer to anything that is not asked is old, and passed over;
// the shard does not do twice what it is told twice. A piece of the totals is added when its answer
// comes for the first time, since the next question then has another id.
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
  /// `self` is the coordinator that it asks for. No question waits for longer than `lost` before it
  /// is asked again. Requires: all that is referred to outlives it.
  ShardControl(const ShardPlan& plan, Totals& totals, const Clock& clock, Nanoseconds lost,
               Sender& sender, Address self);

  /// Decisions under way to a shard at once: half of what its mailbox holds.
  static constexpr size_t max_decisions = 32;
  /// Shards beside the controller's.
  size_t others() const { return shards_.size(); }
  bool owns(NodeId worker) const { return plan_.shard_of(worker) != 0; }

  /// Has every shard add its slice of a flush, or drop it. Requires: as many hashes as others().
  void take(const MessageId& flush, const std::vector<uint64_t>& slice_hashes);
  void refuse(const MessageId& flush);
  /// Of a worker's life that has ended no flush is taken any more.
  void end_life(NodeId worker, Incarnation life);
  /// Every shard has answered every decision.
  bool settled() const;

  /// Adds the shards' totals to those here, and calls `done` from on() or from here.
  /// Requires: settled(), no gather under way; nothing is taken before it is done.
  void gather(std::function<void()> done);
  bool gathering() const { return static_cast<bool>(done_); }

  /// Answers of shards.
  void on(const Letter<FlushSettled>& settled);
  void on(const Letter<TotalsTold>& told);
  /// Sends again what got no answer in time.
  void look();
  /// Why the totals cannot be had any more.
  const std::optional<std::string>& fault() const { return fault_; }

  struct Counters {
    uint64_t decisions = 0;
    uint64_t asked_again = 0;
    uint64_t gathers = 0;
    uint64_t gathered_bytes = 0;
  };
  const Counters& counters() const { return counters_; }

 private:
  /// Something that a shard is to answer.
  struct Question {
    MessageId id;
    RetryTimer timer;  // open once the network has taken the question
  };
  struct Decision {
    FlushDecided what;
    std::optional<Question> asked;
  };
  struct Shard {
    NodeId owner;
    BinRange bins;
    std::deque<Decision> decisions;           // not answered yet
    RetryTimer decision_timer, totals_timer;  // with what the last answers took
    std::optional<Question> asked;            // for totals, in a gather
    int64_t next = 0;                         // bin to ask for
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
  std::function<void()> done_;  // of the gather under way
  std::optional<std::string> fault_;
  Counters counters_;
};

}  // namespace luxodus
