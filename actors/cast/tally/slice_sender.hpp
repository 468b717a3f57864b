// A worker's side of shards: sends every shard its slice of a flush, with retries, until the shard
// holds it. Only then does the flush itself go to the controller, so that it decides only about
// slices that are in place. With one shard there is nothing to send. Thread rule: the node's
// thread.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "actors/cast/tally/flush_codec.hpp"
#include "actors/cast/tally/shard_plan.hpp"
#include "runtime/messaging/actor_system.hpp"
#include "runtime/messaging/retry_timer.hpp"

namespace luxodus {

class SliceSender {
 public:
  /// `self` is the tracer on whose behalf it sends. Requires: `sender` outlives this.
  SliceSender(const ShardPlan& plan, Sender& sender, Address self, const RetryTimer& timer)
      : plan_(plan), sender_(sender), self_(self), timer_(timer) {}

  /// Reserves room for flushes of this many source groups and totals each.
  void make_room(int groups, int64_t totals);

  size_t slices() const { return plan_.owners.size(); }
  /// Bins that stay with the flush, and those of a slice.
  BinRange own_bins() const { return plan_.range(0, totals_); }
  BinRange bins_of(size_t slice) const { return plan_.range(slice + 1, totals_); }
  FlushEncoder& encoder(size_t slice) { return *slices_[slice].encoder; }
  /// Whether the network has released all slices of the last flush.
  bool free() const;
  size_t memory_bytes() const;

  /// Sends the packed slices. Requires: free() before packing.
  void send(const MessageId& flush, Nanoseconds now);
  /// Whether every slice is held, or one was refused, which the controller is then told.
  bool placed() const;
  /// Hashes of all slices; empty if one was refused, so that the controller refuses the flush.
  std::vector<uint64_t> hashes() const;
  /// Retries slices without an answer in time, or for which the network had no room.
  void ask_again(Nanoseconds now);
  /// Retries all slices without an answer: a route has come back.
  void ask_now(Nanoseconds now);
  /// Answers of shards about the slices of a flush.
  void on(const Letter<SliceHeld>& held, Nanoseconds now);
  void on(const Letter<FlushRefused>& refused);

 private:
  struct Slice {
    std::shared_ptr<FlushEncoder> encoder;  // shared with the network while it sends
    uint64_t hash = 0;
    bool held = false;
  };
  void put_missing(Nanoseconds now);
  SendOutcome put(size_t slice);
  Slice* asked(NodeId owner, const MessageId& flush);

  const ShardPlan plan_;
  Sender& sender_;
  const Address self_;
  int64_t totals_ = 0;
  std::vector<Slice> slices_;
  MessageId flush_;
  bool refused_ = false;
  RetryTimer timer_;
};

}  // namespace luxodus
