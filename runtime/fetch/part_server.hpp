// The part server of a node: the actor that owns the node's objects. It serves other nodes from its
// store and its cache, including requests in transit to another node, and fetches what its own node
// lacks. Tracing fibers of the node use the cache directly: it is state of their thread, and a
// fiber that waits there suspends.
//
// A request for which there is no room to answer waits here, in order. When more than `requests`
// wait, further ones are dropped and counted; the requester retries under the same id.
//
// Thread rule: the node's thread. actors/cast/parts decides what an object is, and which node holds
// it.
#pragma once

#include <utility>
#include <vector>

#include "runtime/core/memory_plan.hpp"
#include "runtime/core/ring.hpp"
#include "runtime/fetch/fetcher.hpp"
#include "runtime/fetch/object_cache.hpp"
#include "runtime/messaging/node_actor.hpp"

namespace luxodus {

namespace limits {
/// Requests in the mailbox: more than a turn brings, for this node and in transit.
inline constexpr size_t part_requests = 512;
/// Answers: as many as a node fetches at once, each twice; FetchConfig::flights is half of it at
/// most.
inline constexpr size_t part_answers = 512;
}  // namespace limits

class PartServer final
    : public NodeActor<
          PartServer,
          ControlLane<Accepts<Letter<FetchObject>, limits::part_requests, WhenFull::reject>,
                      Accepts<Letter<ObjectFound>, limits::part_answers, WhenFull::reject>,
                      Accepts<Letter<ObjectNotHere>, limits::part_answers, WhenFull::reject>>,
          DataLane<>>,
      private AwaitedRooms {
 public:
  /// Allocates everything but objects. `jitter` is a random stream of its own. Requires: all
  /// references outlive this; `objects` does not change, but for places without holders and bytes.
  /// Errors (exception): those of Fetcher and ObjectCache.
  PartServer(const FetchConfig& fetch, const CacheConfig& cache,
             const std::vector<ObjectPlace>& objects, ObjectStore& store, ObjectBuilder& builder,
             Scheduler& scheduler, Sender& sender, const Random& jitter);
  ~PartServer() override;

  /// Adds the memory of a part server with these configurations.
  static void plan_memory(MemoryPlan& plan, const FetchConfig& fetch, const CacheConfig& cache,
                          size_t objects);
  /// Most timers set at once, for SchedulerLimits::timers_beside_fibers.
  static size_t max_timers(const FetchConfig& fetch) {
    return Fetcher::max_timers(fetch) + ObjectCache::max_timers + 1;
  }

  /// The place at this index of the list of objects has been filled: from now on the object is
  /// given to others while it is resident. Requires: it was empty, without holders and bytes.
  void enter(ObjectId id, uint32_t object);
  /// The place is about to be emptied. Requires: the object is absent.
  void forget(ObjectId id, uint32_t object);

  ObjectCache& cache() { return cache_; }
  const ObjectCache& cache() const { return cache_; }
  const Fetcher& fetcher() const { return fetcher_; }

  void on(const Letter<FetchObject>& request);
  void on(Letter<ObjectFound>&& answer);
  void on(const Letter<ObjectNotHere>& answer);

  /// A request for an object that is here is answered, whichever node it is for.
  bool answers(const Message& passing) override;
  AwaitedRooms* rooms() override { return this; }

  struct Counters {
    uint64_t served = 0;       // objects sent to others
    uint64_t refused = 0;      // requests for objects that this node does not have
    uint64_t intercepted = 0;  // requests in transit to another node
    uint64_t from_cache = 0;   // of those served: resident, but not held
    uint64_t waited = 0;       // requests that could not be answered at once
    uint64_t dropped = 0;      // of those, beyond FetchConfig::requests
    uint64_t bytes_out = 0;
  };
  const Counters& counters() const { return counters_; }
  void add_metrics(Metrics& metrics) const;

 private:
  /// A request that waits to be answered.
  struct Question {
    Address from;
    MessageId id;
    ObjectId object;
  };

  std::span<std::byte> room_for(const MessageId& id, size_t bytes) override;
  SharedBytes keep(const MessageId& id, std::span<const std::byte> payload) override;

  const BuiltObject* ready(ObjectId object) const;
  bool serve(const Question& question);
  void try_again_soon();
  void serve_waiting();

  const FetchConfig config_;
  ObjectStore& store_;
  std::vector<std::pair<ObjectId, uint32_t>> numbers_;  // of known objects, sorted by id
  Fetcher fetcher_;
  ObjectCache cache_;
  Ring<Question> waiting_;
  TimerId again_timer_;
  bool tries_again_ = false;
  Counters counters_;
};

}  // namespace luxodus
