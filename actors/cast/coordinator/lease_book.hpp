// Who works on which batches. A lease lends one batch to a node until a deadline; a lease that is
// late, or whose node is gone, is fenced before its batch is lent again, so that nothing is counted
// twice. Batches are lent up to the end of the open round and no farther, in their order or, to
// nodes that prefer some, a little out of it: which batches a round holds never changes. A pure
// state machine of calls and time. Thread rule: one node's thread.
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
  bool held = false;  // it is being committed: see LeaseBook::hold
};

/// Leases of consecutive numbers for batches of consecutive numbers, one each.
struct LentBatches {
  uint64_t first_lease = 0;
  int64_t first_batch = 0;
  int64_t count = 0;
};

class LeaseBook {
 public:
  /// How little a node likes a batch: it is lent one of the least rank.
  using Rank = std::function<uint32_t(int64_t batch)>;

  /// Batches up to number `next` are committed already, but for those `missing`: a run that goes
  /// on. Leases are numbered from `first_lease`: where that is random, a lease of an earlier life
  /// of the book is never taken for one of this. A preferred batch is lent at most `look_ahead`
  /// numbers before its turn, for all that was skipped must be done when a run is stopped.
  /// Requires: look_ahead >= 1.
  explicit LeaseBook(int64_t next, const std::vector<int64_t>& missing = {},
                     uint64_t first_lease = 1, int64_t look_ahead = 1);

  LeaseBook(LeaseBook&&) = default;
  LeaseBook& operator=(LeaseBook&&) = delete;

  /// Batches may be lent up to number `end`. Requires: end is not before an earlier one.
  void open_until(int64_t end) { end_ = end; }
  /// Of the open round: beyond its last batch.
  int64_t end() const { return end_; }

  /// A batch that is lent beside those of rounds, by who coordinates for another. Requires: the
  /// book does not hold it.
  void add(int64_t batch) { again_.insert(batch); }
  /// Those of these batches that it holds are lent no more, and taken from the set, but for those
  /// whose flush is being kept: they will be counted. Gives the leases that stood, which are
  /// fenced.
  std::vector<Lease> remove(std::set<int64_t>& batches);
  /// This node makes progress: none of its leases is late before `deadline`.
  void renew(NodeId node, Nanoseconds deadline);

  /// Lends up to `most` batches; none where none is left in the round. What was fenced goes first,
  /// then what `rank` ranks least, of equals the first; without `rank` all are equal. Batches of
  /// different ranks, or with others between them, are not lent together. They shall be back after
  /// `span`, doubled for each time that the batch was late before, and after half as much again as
  /// the slowest batch so far: however slow nodes are, in the end their work is in time.
  LentBatches lend(NodeId node, int64_t most, Nanoseconds now, Nanoseconds span,
                   const Rank& rank = {});

  /// Whether all of these leases stand, and are this node's: then a flush of them may be counted.
  bool stand(NodeId node, const std::vector<uint64_t>& leases) const;
  /// Their batches, until the next call. Requires: they stand.
  std::span<const int64_t> batches_of(const std::vector<uint64_t>& leases);
  /// Their flush is being kept: they cannot be fenced any more. Requires: stand(node, leases);
  /// commit(leases) follows.
  void hold(const std::vector<uint64_t>& leases);
  /// Their batches are counted. Requires: stand(node, leases).
  void commit(const std::vector<uint64_t>& leases, Nanoseconds now);

  /// Fences what is late, and gives the leases that were; their batches are lent again first.
  std::vector<Lease> fence_late(Nanoseconds now);
  /// Fences all leases of a node that is gone, or has begun another life.
  std::vector<Lease> fence_node(NodeId node);
  /// Fences those of these leases that stand and are this node's: what it did with them is gone.
  std::vector<Lease> fence_leases(NodeId node, const std::vector<uint64_t>& leases);

  /// Everything up to the end of the round is counted, or lost.
  bool round_done() const { return committed_ + lost() == end_; }
  int64_t committed() const { return committed_; }
  /// Beyond the last batch that was lent at least once.
  int64_t lent_end() const { return ahead_.empty() ? next_ : *ahead_.rbegin() + 1; }
  /// A node gives back those of these leases that stand and are its own: it cannot trace their
  /// batches, and is not lent them again.
  std::vector<Lease> give_back(NodeId node, const std::vector<uint64_t>& leases);
  bool has_given_back() const { return !given_back_.empty(); }
  /// The node is another one now, and may be lent what it has given back.
  void forgive(NodeId node);
  /// Batches that every one of these nodes has given back are lost: no lease of them is lent any
  /// more, and a round may end without them. Gives those that are lost since the last call.
  int64_t lose_what_all_gave_back(const std::vector<NodeId>& nodes);
  int64_t lost() const { return static_cast<int64_t>(lost_.size()); }
  /// The lost batches, which the book then holds no more: if one is added again, as of another
  /// state of the scene, any node may try it.
  std::set<int64_t> take_lost() {
    for (const int64_t batch : lost_) {
      given_back_.erase(batch);
      late_.erase(batch);
    }
    return std::exchange(lost_, {});
  }

  /// Batches 0..lent_end() - 1 that are not committed.
  std::vector<int64_t> missing() const;
  /// Ends the round with what has been lent, and what was skipped on the way.
  void close() { end_ = lent_end(); }
  size_t standing() const { return leases_.size(); }
  /// Batches of the round that may be lent now.
  int64_t waiting() const {
    return end_ - next_ - static_cast<int64_t>(ahead_.size()) + static_cast<int64_t>(again_.size());
  }
  /// When fence_late() may have something to do; nothing without leases.
  std::optional<Nanoseconds> next_deadline() const;

 private:
  template <class Which>
  std::vector<Lease> fence(Which&& which);  // but for those that are held
  int64_t first_choice(NodeId node, const Rank& rank) const;
  bool may_again(NodeId node, int64_t batch) const;
  bool open(int64_t batch) const;
  void take(int64_t batch);
  Nanoseconds patience(int64_t batch, Nanoseconds span) const;

  /// What is struck out of the book leaves its memory to what comes.
  using Memory = std::pmr::unsynchronized_pool_resource;
  std::unique_ptr<Memory> memory_ = std::make_unique<Memory>();
  std::pmr::map<uint64_t, Lease> leases_{memory_.get()};
  std::pmr::set<int64_t> again_;                     // fenced, to be lent before new ones
  std::pmr::map<int64_t, int> late_{memory_.get()};  // how often batches not yet counted were
  std::map<int64_t, std::set<NodeId>> given_back_;   // of again_: who could not trace them
  std::set<int64_t> lost_;
  std::pmr::set<int64_t> ahead_{memory_.get()};  // lent before their turn: beyond next_
  std::vector<int64_t> batches_;                 // as batches_of() told them
  mutable std::vector<uint64_t> named_;          // by a flush, in order
  uint64_t last_id_;
  int64_t look_ahead_;
  Nanoseconds slowest_ = 0;  // from the lease of a batch to when it was counted
  int64_t next_;             // the first that was never lent
  int64_t end_;
  int64_t committed_;
};

}  // namespace luxodus
