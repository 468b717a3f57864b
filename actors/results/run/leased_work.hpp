// Interfaces of a tracer, the actor between a coordinator and the threads or nodes that do its
// work. LeasedWork does leased batches on a node's photon-threads, or, where a node coordinates
// others on its coordinator's behalf, on theirs; of a scene whose states change it traces the
// entered one. LeasePort gets leases and returns results.
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
  /// Requests leases: `count` are missing.
  virtual void want_leases(size_t count) = 0;
  /// Reports that the batches of these leases are merged into the node's totals, together.
  /// Requires: has_room_for(leases.size()).
  virtual void leases_done(std::span<const uint64_t> leases) = 0;
  /// Whether the flush that holds what is merged now can name this many more leases.
  virtual bool has_room_for(size_t leases) const = 0;
  /// Reports that the batch of this lease could not be traced here: an object was not available.
  virtual void lease_failed(uint64_t lease, int64_t batch) = 0;
  /// Gives leases back because nobody is left here who could ever trace their batches. False: there
  /// was no room for the message. Requires: limits::leases at most.
  virtual bool give_back(std::span<const uint64_t> leases) = 0;
  /// Called while nobody here can trace: sends what is merged, then returns the leases, to be lent
  /// to others, and drops them; also without leases. To be called repeatedly, as long as this
  /// lasts.
  virtual void return_leases() = 0;

  /// The tally is full: what is merged shall be sent as soon as possible.
  virtual void want_room() = 0;
  /// Whether memory of the tally will become free although no batch ends: from merged batches not
  /// yet flushed, or from a flush in progress.
  virtual bool room_to_come() const = 0;
  /// Memory of flushes [bytes].
  virtual size_t flush_bytes() const = 0;
  /// This node cannot continue.
  virtual void give_up(const Problem& why) = 0;
  /// An exception has ended a photon-thread.
  virtual void thread_failed(const std::exception_ptr& why) = 0;
};

class LeasedWork {
 public:
  virtual ~LeasedWork() = default;
  /// Whether batches of this state of the scene are being traced and merged. A run has one state,
  /// which all nodes know.
  virtual bool is_in(ObjectId /*state*/) const { return true; }
  virtual bool knows(ObjectId /*state*/) const { return true; }
  /// Makes a state from its bytes, so that it can be entered. Errors: malformed bytes.
  virtual Result<void> learn(ObjectId /*state*/, std::span<const std::byte> /*bytes*/) {
    return {};
  }
  /// Drops all leases at hand: those added from now on belong to another state, and wait for it.
  virtual void leave_state() {}
  /// Leases added since then, and from now on, belong to this state. Requires: knows(it); no totals
  /// are being emptied.
  virtual void enter(ObjectId /*state*/) {}
  /// Leases added from now on belong to this round of the run.
  virtual void enter_round(uint32_t /*round*/) {}
  /// Adds a lease. It is of one batch, so that merged results always consist of whole leases.
  virtual void add(uint64_t lease, int64_t batch) = 0;
  /// Drops these leases, or all leases, as far as they have not been merged.
  virtual void drop(std::span<const uint64_t> leases) = 0;
  virtual void drop_all() = 0;
  /// Discards what has been merged since the last give_totals, because its leases are fenced.
  /// False: not possible; then a flush sends it, and is rejected.
  virtual bool forget_merged() { return false; }
  /// Gives back all leases at hand, because they can never be traced here.
  virtual void give_back_all() { drop_all(); }
  /// Leases may be available again: ask for them.
  virtual void look_again() = 0;

  /// Hands over what has been merged so far, to be emptied at leisure; from now on results are
  /// merged elsewhere. Requires: may_give(); the totals handed over before are empty.
  virtual Totals& give_totals() = 0;
  virtual bool may_give() const { return true; }
  /// Totals of the size of all that are handed over.
  virtual const Totals& totals() const = 0;
  /// Number of leases not merged yet.
  virtual size_t at_hand() const = 0;

  /// The run has ended, for this reason; "": successfully.
  virtual void end(const std::string& why) = 0;
  /// This node leaves the run; for others it may continue.
  virtual void abandon() { end(""); }
  /// Whether all nodes that it coordinates know of the end.
  virtual bool end_is_known() const { return true; }
  /// Allows them to leave; returns whether all have been told.
  virtual void let_go() {}
  virtual bool gone() const { return true; }
};

}  // namespace luxodus
