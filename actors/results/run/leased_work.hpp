// The two sides of a tracer, the actor that stands between a coordinator and those who do its work:
// LeasedWork does what was leased, in a node's own photon-threads or, where a node coordinates
// others in its coordinator's stead, in theirs; of a scene whose states change it traces the one
// that was entered. LeasePort is how it gets leases and gives results.
// Neither knows messages. Thread rule: the node's thread, from within a fiber or not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <span>
#include <string>

#include "runtime/core/ids.hpp"
#include "runtime/core/result.hpp"
#include "scenes/light/tally/totals.hpp"

namespace luxodus {

class LeasePort {
 public:
  virtual ~LeasePort() = default;
  /// Fewer leases are at hand than shall be: ask for so many.
  virtual void want_leases(size_t count) = 0;
  /// The batches of these leases are merged into the node's totals, together.
  /// Requires: has_room_for(leases.size()).
  virtual void leases_done(std::span<const uint64_t> leases) = 0;
  /// Whether so many leases more can be named by the flush that holds what is merged now.
  virtual bool has_room_for(size_t leases) const = 0;
  /// The batch of this lease could not be traced here: an object was not to be had.
  virtual void lease_failed(uint64_t lease, int64_t batch) = 0;
  /// Nobody is left here who could ever trace the batches of these leases. False: there was no room
  /// to say so. Requires: limits::leases at most.
  virtual bool give_back(std::span<const uint64_t> leases) = 0;
  /// Nobody is here who could trace, for now: what is merged is sent, and then the leases are
  /// returned, to be lent to others, and dropped; where there are none, too. To be called again and
  /// again, for as long as it is so.
  virtual void return_leases() = 0;

  /// The tally is full: what is merged shall leave as soon as it can.
  virtual void want_room() = 0;
  /// Whether memory of the tally will become free although no batch ends: of batches that are
  /// merged and not yet flushed, or of a flush under way.
  virtual bool room_to_come() const = 0;
  /// What flushes take in memory.
  virtual size_t flush_bytes() const = 0;
  /// This node cannot go on.
  virtual void give_up(const Problem& why) = 0;
  /// An exception has left a photon-thread, which has ended.
  virtual void thread_failed(const std::exception_ptr& why) = 0;
};

class LeasedWork {
 public:
  virtual ~LeasedWork() = default;
  /// Whether it is batches of this state of the scene that are traced, and what is merged is of. A
  /// run has one state, which all know.
  virtual bool is_in(ObjectId /*state*/) const { return true; }
  virtual bool knows(ObjectId /*state*/) const { return true; }
  /// Makes a state of its bytes, so that it may be entered. Errors: bytes of no state.
  virtual Result<void> learn(ObjectId /*state*/, std::span<const std::byte> /*bytes*/) {
    return {};
  }
  /// Forgets all that is at hand: what is added from now on is of another state, and waits for it.
  virtual void leave_state() {}
  /// What has been added since, and is added from now on, is of this state. Requires: knows(it); no
  /// totals are being emptied.
  virtual void enter(ObjectId /*state*/) {}
  /// What is added from now on is of this round of the run.
  virtual void enter_round(uint32_t /*round*/) {}
  /// Adds work. A lease is of one batch, so that what is merged is always whole leases.
  virtual void add(uint64_t lease, int64_t batch) = 0;
  /// Forgets those of these leases that have not been merged yet; all of them.
  virtual void drop(std::span<const uint64_t> leases) = 0;
  virtual void drop_all() = 0;
  /// Empties what has been merged since it was last given, whose leases are fenced. False: it
  /// cannot; then that leaves in a flush, which is refused.
  virtual bool forget_merged() { return false; }
  /// Cannot trace any of what is at hand, ever: it goes back.
  virtual void give_back_all() { drop_all(); }
  /// There may be leases to ask for again.
  virtual void look_again() = 0;

  /// What has been merged so far, to be emptied at leisure; what is merged from now on goes
  /// elsewhere. Requires: may_give(); what was given before is empty.
  virtual Totals& give_totals() = 0;
  virtual bool may_give() const { return true; }
  /// All that are given are of this size.
  virtual const Totals& totals() const = 0;
  /// Leases not merged yet.
  virtual size_t at_hand() const = 0;

  /// The run is over, for this reason; "": it ended well.
  virtual void end(const std::string& why) = 0;
  /// This node gives the run up; for others it may go on.
  virtual void abandon() { end(""); }
  /// Whether all whom it coordinates have heard of the end.
  virtual bool end_is_known() const { return true; }
  /// They may leave; whether all of them have been told.
  virtual void let_go() {}
  virtual bool gone() const { return true; }
};

}  // namespace luxodus
