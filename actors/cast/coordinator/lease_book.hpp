// Leases of batches. A lease gives one batch to a node until a deadline; a lease that is late, or
// whose node is gone, is fenced before its batch is leased again, so that nothing is counted twice.
// Batches are leased up to the end of the open round, in order or, for nodes with preferences,
// slightly out of order: the batches of a round never change. A pure state machine of calls and
// time. Thread rule: one node's thread.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <memory_resource>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "runtime/core/clock.hpp"
#include "runtime/core/ids.hpp"

namespace luxodus {

struct Lease {
  uint64_t id = 0;
  NodeId node;
  int64_t batch = 0;  // its number
  Nanoseconds lent = 0;
  Nanoseconds deadline = 0;
  bool held = false;  // its flush is being committed: see LeaseBook::hold
};

/// Consecutive leases of consecutive batches, one each.
struct LentBatches {
  uint64_t first_lease = 0;
  int64_t first_batch = 0;
  int64_t count = 0;
};

class LeaseBook {
 public:
  /// Rank of a batch for a node; the lowest rank is leased first.
  using Rank = std::function<uint32_t(int64_t batch)>;

  /// Batches below number `next` are committed already, except those `missing`: a run that is
  /// continued. Leases are numbered from `first_lease`: if that is random, leases of an earlier
  /// incarnation are never taken for current ones. A preferred batch is leased at most `look_ahead`
  /// numbers before its turn, since everything skipped must be traced when a run is stopped.
  /// Requires: look_ahead >= 1.
  explicit LeaseBook(int64_t next, const std::vector<int64_t>& missing = {},
                     uint64_t first_lease = 1, int64_t look_ahead = 1);

  LeaseBook(LeaseBook&&) = default;
  LeaseBook& operator=(LeaseBook&&) = delete;

  /// Allows leasing of batches below number `end`. Requires: end never decreases.
  void open_until(int64_t end) { end_ = end; }
  /// One past the open round's last batch.
  int64_t end() const { return end_; }

  /// Adds a batch that is leased besides those of rounds, for a sub-coordinator. Requires: the book
  /// does not hold it.
  void add(int64_t batch) { again_.insert(batch); }
  /// Removes these batches from the book, and from the set, except those whose flush is being
  /// journaled: they will be counted. Returns the leases that were valid, which are fenced.
  std::vector<Lease> remove(std::set<int64_t>& batches);
  /// This node makes progress: extends all its leases to at least `deadline`.
  void renew(NodeId node, Nanoseconds deadline);

  /// Leases up to `most` batches; none if the round has none left. Fenced ones go first, then those
  /// of the lowest `rank`, in order of number; without `rank` all are equal. Batches of different
  /// ranks, or not adjacent, are not leased together. The deadline is after `span`, doubled for
  /// each time that the batch was late before, and at least one and a half times the slowest batch
  /// so far: however slow nodes are, eventually their work is in time.
  LentBatches lend(NodeId node, int64_t most, Nanoseconds now, Nanoseconds span,
                   const Rank& rank = {});

  /// Whether all of these leases are valid and this node's: only then a flush of them may be
  /// counted.
  bool stand(NodeId node, const std::vector<uint64_t>& leases) const;
  /// Their batches, until the next call. Requires: they are valid.
  std::span<const int64_t> batches_of(const std::vector<uint64_t>& leases);
  /// Protects leases from fencing while their flush is journaled. Requires: stand(node, leases);
  /// commit(leases) follows.
  void hold(const std::vector<uint64_t>& leases);
  /// Marks their batches as counted. Requires: stand(node, leases).
  void commit(const std::vector<uint64_t>& leases, Nanoseconds now);

  /// Fences late leases and returns them; their batches are leased again first.
  std::vector<Lease> fence_late(Nanoseconds now);
  /// Fences all leases of a node that is gone or has restarted.
  std::vector<Lease> fence_node(NodeId node);
  /// Fences those of these leases that are valid and this node's: their results are lost.
  std::vector<Lease> fence_leases(NodeId node, const std::vector<uint64_t>& leases);

  /// Whether every batch of the round is counted or lost.
  bool round_done() const { return committed_ + lost() == end_; }
  int64_t committed() const { return committed_; }
  /// One past the highest batch that was ever leased.
  int64_t lent_end() const { return ahead_.empty() ? next_ : *ahead_.rbegin() + 1; }
  /// Takes back those of these leases that are valid and the node's: it cannot trace their batches,
  /// and does not get them again.
  std::vector<Lease> give_back(NodeId node, const std::vector<uint64_t>& leases);
  bool has_given_back() const { return !given_back_.empty(); }
  /// The node has restarted, and may be leased again what it gave back.
  void forgive(NodeId node);
  /// Declares lost the batches that every one of these nodes has given back: they are not leased
  /// any more, and a round may end without them. Returns the number newly lost.
  int64_t lose_what_all_gave_back(const std::vector<NodeId>& nodes);
  int64_t lost() const { return static_cast<int64_t>(lost_.size()); }
  /// Removes and returns the lost batches: if one is added again, for another state of the scene,
  /// any node may try it.
  std::set<int64_t> take_lost() {
    for (const int64_t batch : lost_) {
      given_back_.erase(batch);
      late_.erase(batch);
    }
    return std::exchange(lost_, {});
  }

  /// Batches in 0..lent_end() - 1 that are not committed.
  std::vector<int64_t> missing() const;
  /// Ends the round at the last leased batch, including what was skipped before it.
  void close() { end_ = lent_end(); }
  size_t standing() const { return leases_.size(); }
  /// Batches of the round that may be leased now.
  int64_t waiting() const {
    return end_ - next_ - static_cast<int64_t>(ahead_.size()) + static_cast<int64_t>(again_.size());
  }
  /// When fence_late() may have something to do; nothing without leases.
  std::optional<Nanoseconds> next_deadline() const;

 private:
  template <class Which>
  std::vector<Lease> fence(Which&& which);  // all but those that are held
  int64_t first_choice(NodeId node, const Rank& rank) const;
  bool may_again(NodeId node, int64_t batch) const;
  bool open(int64_t batch) const;
  void take(int64_t batch);
  Nanoseconds patience(int64_t batch, Nanoseconds span) const;

  /// Removed entries leave their memory to new ones.
  using Memory = std::pmr::unsynchronized_pool_resource;
  std::unique_ptr<Memory> memory_ = std::make_unique<Memory>();
  std::pmr::map<uint64_t, Lease> leases_{memory_.get()};
  std::pmr::set<int64_t> again_;                     // fenced, to be leased before new ones
  std::pmr::map<int64_t, int> late_{memory_.get()};  // how often uncounted batches were late
  std::map<int64_t, std::set<NodeId>> given_back_;   // of again_: nodes that could not trace them
  std::set<int64_t> lost_;
  std::pmr::set<int64_t> ahead_{memory_.get()};  // leased before their turn: at or above next_
  std::vector<int64_t> batches_;                 // result of batches_of()
  mutable std::vector<uint64_t> named_;          // by a flush, sorted
  uint64_t last_id_;
  int64_t look_ahead_;
  Nanoseconds slowest_ = 0;  // from the lease of a batch to its commit
  int64_t next_;             // the lowest number never leased
  int64_t end_;
  int64_t committed_;
};

}  // namespace luxodus
