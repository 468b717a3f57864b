// The part server of a node: the actor that owns what the node has of the run's objects. It gives
// other nodes what it holds for all or has ready for itself, on their way to another node too, and
// brings its own node what that lacks. Photon-threads of the node use the cache directly: it is
// state of their thread, and a fiber that waits there suspends.
//
// A request that finds no room to be answered waits here, in its turn. Only when more wait than
// `requests` is one dropped and counted; who has asked asks again under the same id.
//
// Thread rule: the node's thread. What an object is, and who holds which: actors/cast/parts.
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
/// Requests in the mailbox: more than a turn brings, of those for this node and of those that pass.
inline constexpr size_t part_requests = 512;
/// Answers: as many as a node fetches at once, each twice.
inline constexpr size_t part_answers = 128;
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
  /// Takes all memory there will be but for objects. `jitter` is a stream of its own.
  /// Requires: all references outlive this; `objects` does not change.
  /// Errors (exception): as Fetcher and ObjectCache.
  PartServer(const FetchConfig& fetch, const CacheConfig& cache,
             const std::vector<ObjectPlace>& objects, ObjectStore& store, ObjectBuilder& builder,
             Scheduler& scheduler, Sender& sender, const Random& jitter);
  ~PartServer() override;

  /// Adds what a part server of these configurations takes.
  static void plan_memory(MemoryPlan& plan, const FetchConfig& fetch, const CacheConfig& cache,
                          size_t objects);
  /// Timers that it may have set at once, for SchedulerLimits::timers_beside_fibers.
  static size_t max_timers(const FetchConfig& fetch) {
    return Fetcher::max_timers(fetch) + ObjectCache::max_timers + 1;
  }

  ObjectCache& cache() { return cache_; }
  const ObjectCache& cache() const { return cache_; }
  const Fetcher& fetcher() const { return fetcher_; }

  void on(const Letter<FetchObject>& request);
  void on(Letter<ObjectFound>&& answer);
  void on(const Letter<ObjectNotHere>& answer);

  /// A request for what is here is answered, whomever it is for.
  bool answers(const Message& passing) override;
  AwaitedRooms* rooms() override { return this; }

  struct Counters {
    uint64_t served = 0;       // objects given to others
    uint64_t refused = 0;      // requests for what this node does not have
    uint64_t intercepted = 0;  // requests that were on their way to another node
    uint64_t from_cache = 0;   // of those served: what this node has ready and holds for nobody
    uint64_t waited = 0;       // requests that found no room to be answered at once
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
  std::vector<std::pair<ObjectId, uint32_t>> numbers_;  // of all objects, ascending by name
  Fetcher fetcher_;
  ObjectCache cache_;
  Ring<Question> waiting_;
  TimerId again_timer_;
  bool tries_again_ = false;
  Counters counters_;
};

}  // namespace luxodus
