// Brings the bytes of objects from wherever they are. An object is asked of its holders in their
// order, each several times with growing patience, then of this node's own store; only when all of
// them have said no or nothing is it unobtainable, for now. Bytes are checked against the object's
// name: wrong ones are dropped and asked for elsewhere. It keeps nothing: who keeps objects, and
// sees that each is fetched once, is the ObjectCache. Both are state of the part server, which is
// the actor that holders answer.
//
// Memory: a fetch begins when the object's bytes, known beforehand, find room under receive_bytes,
// and holds that room until release(); fetches beyond it wait in turn. The bytes themselves are the
// one piece of memory that is taken for a fetch.
//
// Thread rule: the node's thread. fetch() may be called from a fiber: it only notes the wish;
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
  /// Under way at once: as many messages as a network puts together at once
  /// (NetConfig::assemblies).
  size_t flights = 64;
  /// Bytes asked for and not yet released: 16 objects of 1 MB, ten times what 1 Gb/s brings in
  /// 10 ms. Smaller, and the link idles; larger takes from the objects that are kept.
  size_t receive_bytes = 16 << 20;
  /// Questions to one holder. If it is silent from the start it has 1, 2, 4 and 5 s for them: long
  /// enough for routes to be made anew (2 s), short enough for a batch to be leased again.
  uint8_t tries = 4;
  /// Requests of others that wait for room to be answered: four of each of 64 nodes.
  size_t requests = 256;
  /// Whether others are given what this node has ready for itself, and holds for nobody.
  bool shares_cache = true;
  TimeoutLimits timeouts;
  /// Links to each node, by number: of an object's holders the nearest is asked first, then those
  /// that follow it. Empty: in the order of ObjectPlace.
  std::vector<uint32_t> hops;
  NodeTrace* trace = nullptr;  // null: nothing is traced
  Buggify* buggify = nullptr;  // rare ways; null: none

  Address address() const { return {self, ActorName::part_server}; }
};

/// Who wants an object. Called on the scheduler's stack.
class FetchClient {
 public:
  virtual ~FetchClient() = default;
  /// The object's bytes, which are right. Their room is taken until Fetcher::release().
  virtual void fetched(uint32_t object, SharedBytes bytes) = 0;
  /// Nobody gave it; it may be fetched again.
  virtual void unobtainable(uint32_t object) = 0;
};

class Fetcher {
 public:
  /// Takes all memory there will be but for objects' bytes. Timers are set as those of `owner`.
  /// `jitter` is a stream of its own.
  /// Requires: all references outlive this; `objects` does not change.
  /// Errors (exception): an object without bytes, or longer than receive_bytes; too many holders.
  Fetcher(const FetchConfig& config, const std::vector<ObjectPlace>& objects, ObjectStore& store,
          Sender& sender, Supervised& owner, Timers& timers, const Clock& clock,
          const Random& jitter);
  ~Fetcher();
  Fetcher(const Fetcher&) = delete;
  Fetcher& operator=(const Fetcher&) = delete;

  /// Adds what a fetcher of this configuration takes.
  static void plan_memory(MemoryPlan& plan, const FetchConfig& config, size_t objects);
  /// Timers that it may have set at once, for SchedulerLimits::timers_beside_fibers.
  static size_t max_timers(const FetchConfig& config) { return config.flights + 1; }

  /// Has `client` told of this object's bytes, or that nobody has them; never within the call.
  /// Requires: it is not under way, and its room was released; `client` outlives the fetch.
  /// `traced`: its time is told to the trace.
  void fetch(uint32_t object, FetchClient& client, bool traced = false);
  /// The bytes of a fetched object are no longer needed: their room is free for others.
  void release(uint32_t object);

  // ---- what others answer ------------------------------------------------------------------

  void found(const MessageId& id, uint8_t hops, const ObjectFound& answer, SharedBytes bytes);
  void not_here(const MessageId& id, const ObjectNotHere& answer);
  /// Room for an answer that is awaited, of its object's size; empty for all others. It stays with
  /// its fetch, which asks again if no more pieces come.
  std::span<std::byte> room_for(const MessageId& id, size_t bytes);
  /// The bytes of an answer that is awaited, where they stay; empty for all others.
  SharedBytes keep(const MessageId& id, std::span<const std::byte> payload);

  // ---- counts ------------------------------------------------------------------------------

  struct Counters {
    uint64_t fetches = 0;       // begun
    uint64_t retries = 0;       // questions asked beyond the first of a fetch
    uint64_t timeouts = 0;      // questions without an answer in time
    uint64_t not_here = 0;      // answers that the holder does not have it
    uint64_t wrong_hash = 0;    // bytes that were not the object's
    uint64_t late = 0;          // answers that nobody waited for any more
    uint64_t outbox_full = 0;   // questions that had to wait for the network
    uint64_t unobtainable = 0;  // fetches in vain
    uint64_t bytes_in = 0;      // of objects, wrong ones included, and late ones not
    uint64_t receive_bytes_held = 0;
  };
  const Counters& counters() const { return counters_; }
  /// From the wish to the bytes, by the links that the answer passed; 0: from the own store.
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
    MessageId id;           // sequence 0 while it rests
    uint64_t trace_id = 0;  // of its first question; 0: it is not traced
    TimerId timer;
    bool answer_due = false;  // what the timer ends: the wait for an answer, or for asking again
    Nanoseconds asked_at = 0;
    uint16_t questions = 0;
    size_t holder = 0;                             // that was asked, or is to be asked next
    std::array<uint8_t, limits::holders> tries{};  // by holder, used up
    std::shared_ptr<uint64_t[]> room;              // of a reply in pieces
  };

  void begin_soon();
  void begin_flights();
  void begin(const Wish& wish);
  size_t nearest_holder(uint32_t object) const;
  void end(PendingFetch& flight);
  PendingFetch* flight_of(const MessageId& id);

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
  TimerId begin_timer_;
  bool begins_soon_ = false;
  Counters counters_;
  std::array<Histogram, limits::hops + 1> delay_;
  OnceAMinute log_wrong_, log_unobtainable_;
};

}  // namespace luxodus
