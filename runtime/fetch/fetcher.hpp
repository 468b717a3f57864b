// Fetches the bytes of objects. The holders of an object are asked in order, each several times
// with growing timeouts, then this node's own store; only when all have failed is it unobtainable,
// for now. Bytes are verified by the object's id: wrong ones are dropped and requested elsewhere.
// It keeps nothing: the ObjectCache keeps objects and ensures that each is fetched once. Both are
// state of the part server, which is the actor that holders answer.
//
// Memory: a fetch begins when the object's bytes, whose number is known, fit below receive_bytes,
// and occupies them until release(); further fetches wait in turn. The bytes themselves are the
// only memory allocated for a fetch.
//
// Thread rule: the node's thread. fetch() may be called from a fiber: it only queues the request;
// everything else happens on the scheduler's stack.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "runtime/actor/supervised.hpp"
#include "runtime/actor/timers.hpp"
#include "runtime/core/buggify.hpp"
#include "runtime/core/fixed_pool.hpp"
#include "runtime/core/memory_plan.hpp"
#include "runtime/core/once_a_minute.hpp"
#include "runtime/core/random.hpp"
#include "runtime/core/ring.hpp"
#include "runtime/fetch/objects.hpp"
#include "runtime/fetch/route_delay.hpp"
#include "runtime/messaging/actor_system.hpp"
#include "runtime/observe/histogram.hpp"
#include "runtime/observe/metrics.hpp"
#include "runtime/observe/node_trace.hpp"

namespace luxodus {

struct FetchConfig {
  NodeId self;
  /// Fetches in flight: as many as messages that a network reassembles at once
  /// (NetConfig::assemblies).
  size_t flights = 64;
  /// Bytes requested and not yet released: 16 objects of 1 MB, ten times what 1 Gb/s brings in 10
  /// ms. A smaller value leaves the link idle; a larger one takes memory from the cache.
  size_t receive_bytes = 16 << 20;
  /// Requests to one holder. A silent holder gets 1, 2, 4 and 5 s for them: long enough for routes
  /// to be updated (2 s), short enough for a batch to be leased again.
  uint8_t tries = 4;
  /// Requests of others that wait for room to answer: four from each of 64 nodes.
  size_t requests = 256;
  /// Whether others are served objects that this node has only in its cache.
  bool shares_cache = true;
  TimeoutLimits timeouts;
  /// Nodes of the run, if objects are entered later (PartServer::enter); else 0: those that hold
  /// objects are known from the start.
  size_t nodes = 0;
  /// Links to each node, by number: the nearest holder of an object is asked first, then those that
  /// follow it. Empty: in the order of ObjectPlace.
  std::vector<uint32_t> hops;
  NodeTrace* trace = nullptr;  // null: no tracing
  Buggify* buggify = nullptr;  // rare paths, or null

  Address address() const { return {self, ActorName::part_server}; }
};

/// Receives the result of a fetch. Called on the scheduler's stack.
class FetchClient {
 public:
  virtual ~FetchClient() = default;
  /// The object's verified bytes. Their room is taken until Fetcher::release().
  virtual void fetched(uint32_t object, SharedBytes bytes) = 0;
  /// No holder delivered it; it may be fetched again.
  virtual void unobtainable(uint32_t object) = 0;
};

class Fetcher {
 public:
  /// Allocates everything but objects' bytes. Timers run as tasks of `owner`. `jitter` is a random
  /// stream of its own. Requires: all references outlive this; `objects` does not change, but for
  /// places without holders and bytes (PartServer::enter). Errors (exception): an object without
  /// bytes, or longer than receive_bytes; too many holders.
  Fetcher(const FetchConfig& config, const std::vector<ObjectPlace>& objects, ObjectStore& store,
          Sender& sender, Supervised& owner, Timers& timers, const Clock& clock,
          const Random& jitter);
  ~Fetcher();
  Fetcher(const Fetcher&) = delete;
  Fetcher& operator=(const Fetcher&) = delete;

  /// Adds the memory of a fetcher with this configuration.
  static void plan_memory(MemoryPlan& plan, const FetchConfig& config, size_t objects);
  /// Most timers set at once, for SchedulerLimits::timers_beside_fibers.
  static size_t max_timers(const FetchConfig& config) { return config.flights + 1; }

  /// Fetches an object and calls `client` with its bytes or with failure, never within this call.
  /// Requires: no fetch of it is in flight, and its room was released; `client` outlives the fetch.
  /// `traced`: its times are written to the trace.
  void fetch(uint32_t object, FetchClient& client, bool traced = false);
  /// Releases the room of a fetched object's bytes.
  void release(uint32_t object);

  // ---- answers of others -------------------------------------------------------------------

  void found(const MessageId& id, uint8_t hops, const ObjectFound& answer, SharedBytes bytes);
  void not_here(const MessageId& id, const ObjectNotHere& answer);
  /// Room for an awaited answer, of its object's size; empty for all others. It stays with its
  /// fetch, which retries if no more pieces come.
  std::span<std::byte> room_for(const MessageId& id, size_t bytes);
  /// The bytes of an awaited answer, in their final place; empty for all others.
  SharedBytes keep(const MessageId& id, std::span<const std::byte> payload);

  // ---- counts ------------------------------------------------------------------------------

  struct Counters {
    uint64_t fetches = 0;       // begun
    uint64_t retries = 0;       // requests beyond the first of a fetch
    uint64_t timeouts = 0;      // requests without an answer in time
    uint64_t not_here = 0;      // answers that the holder does not have it
    uint64_t wrong_hash = 0;    // bytes that were not the object's
    uint64_t late = 0;          // answers that were no longer awaited
    uint64_t outbox_full = 0;   // requests that had to wait for the network
    uint64_t unobtainable = 0;  // failed fetches
    uint64_t bytes_in = 0;      // of objects, including wrong ones, excluding late ones
    uint64_t receive_bytes_held = 0;
  };
  const Counters& counters() const { return counters_; }
  /// From the call of fetch() to the bytes, by links that the answer passed; 0: from the own store.
  const Histogram& delay(uint8_t hops) const { return delay_[hops]; }
  const RouteDelay& route(NodeId holder) const { return routes_[holder.value]; }
  void add_metrics(Metrics& metrics) const;

 private:
  struct Wish {
    uint32_t object = 0;
    FetchClient* client = nullptr;
    Nanoseconds since = 0;
    bool traced = false;
  };
  struct PendingFetch {
    Wish wish;
    MessageId id;           // sequence 0 while none is in flight
    uint64_t trace_id = 0;  // of its first request; 0: not traced
    TimerId timer;
    // whether the timer ends the wait for an answer, or the pause before a retry
    bool answer_due = false;
    Nanoseconds asked_at = 0;
    uint16_t questions = 0;
    size_t holder = 0;                             // asked last, or to be asked next
    std::array<uint8_t, limits::holders> tries{};  // used up, by holder
    std::shared_ptr<uint64_t[]> room;              // for a reply in pieces
  };

  void begin_soon();
  void begin_flights();
  void begin(const Wish& wish);
  size_t nearest_holder(uint32_t object) const;
  void end(PendingFetch& flight);
  PendingFetch* flight_of(const MessageId& id);
  void take_id(PendingFetch& flight, const MessageId& id);

  void ask(PendingFetch& flight);
  bool ask_holder(PendingFetch& flight, NodeId holder);
  void wait_for_ways(PendingFetch& flight);
  bool take_from_store(PendingFetch& flight);
  std::string text_of(uint32_t object, const char* what) const;
  void give_up(PendingFetch& flight);
  void set_timer(PendingFetch& flight, Nanoseconds span, bool answer_due);
  void timer_fired(PendingFetch& flight);
  Nanoseconds with_jitter(Nanoseconds span);

  bool accept(PendingFetch& flight, SharedBytes bytes, uint8_t hops, NodeId from);

  FetchConfig config_;
  const std::vector<ObjectPlace>& objects_;
  ObjectStore& store_;
  Sender& sender_;
  Supervised& owner_;
  Timers& timers_;
  const Clock& clock_;
  Random jitter_;
  std::vector<RouteDelay> routes_;  // by holder
  Ring<Wish> waiting_;              // for room: every object at most once
  FixedPool<PendingFetch> flights_;
  std::vector<uint64_t> sequences_;  // of the flights' ids, side by side: every answer is looked up
  size_t looked_up_ = 0;             // the place of the last that was found
  TimerId begin_timer_;
  bool begins_soon_ = false;
  Counters counters_;
  std::array<Histogram, limits::hops + 1> delay_;
  OnceAMinute log_wrong_, log_unobtainable_;
};

}  // namespace luxodus
