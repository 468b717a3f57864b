// The cache of a node's objects: each is fetched and built once, however many fibers wait for it,
// and kept until room is needed; the least recently used one is evicted first. An object is charged
// its real size once it is built.
//
// A pointer to an object is valid until the fiber that found it next suspends, so nobody keeps it.
// Objects come and go only on the scheduler's stack.
//
// If the nodes of a process share, an object that another of them has resident is neither fetched
// nor built, but comes in as if it had been.
//
// Progress: an object is evicted only after every fiber woken for it has run. So each wait ends
// with the object in hand, even if the cache has room for only one.
//
// Thread rule: the node's thread; get() from a fiber. Fetching is in Fetcher.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "runtime/core/check.hpp"
#include "runtime/core/once_a_minute.hpp"
#include "runtime/fetch/fetcher.hpp"
#include "runtime/fetch/object_builder.hpp"
#include "runtime/fetch/shared_objects.hpp"
#include "runtime/fiber/fiber.hpp"

namespace luxodus {

/// State of an object at its node.
///
///             get, prefetch, pin               bytes                       it comes in
///   absent ───────────────────────► requested ───────► building ─────────────────────► resident
///     ▲ ▲                               │                 │                                │
///     │ └───────── unobtainable ────────┴─ build failed ──┘                                │
///     └──────────────────────────────── room is needed ────────────────────────────────────┘
///
/// Building lasts from the arrival of the bytes: in the builder's queue, in the builder, and then
/// until there is room, for which fibers woken for other objects may have to run. An object that
/// another node of the process has resident is queued at once; if that node releases it before its
/// turn, it is requested.
enum class ObjectState : uint8_t { absent, requested, building, resident };

struct CacheConfig {
  /// For built objects and the one that is being built.
  size_t budget_bytes = 0;
  /// The most memory that a build takes: about 1.6 times the built object.
  size_t largest_build_bytes = 0;
  /// Largest share of the budget for pinned objects: the rest serves unforeseen ones.
  double pinned_share = 0.5;
  NodeTrace* trace = nullptr;  // null: no tracing
  Buggify* buggify = nullptr;  // rare paths, or null
  /// Resident objects of the process's nodes; null: this node shares nothing. It outlives the
  /// cache.
  SharedObjects* shared = nullptr;

  /// For resident objects: the budget minus one build.
  size_t max_resident_bytes() const { return budget_bytes - largest_build_bytes; }
  size_t max_pinned_bytes() const {
    return static_cast<size_t>(pinned_share * static_cast<double>(budget_bytes));
  }
};

/// Result of get().
struct Got {
  enum class How : uint8_t {
    resident,
    cancelled,    // the fiber shall end
    unobtainable  // the fetch or the build failed; asking again may succeed
  };
  How how = How::cancelled;
  const BuiltObject* object = nullptr;  // if resident; valid until the fiber next suspends
};

class ObjectCache final : private FetchClient, private ObjectBuilder::Client {
 public:
  /// Timers run as tasks of `owner`. Requires: all references outlive this; objects are numbered
  /// below `objects`. Errors (exception): a budget without room for the pinned share, an object,
  /// and a build.
  ObjectCache(const CacheConfig& config, size_t objects, Fetcher& fetcher, ObjectBuilder& builder,
              Supervised& owner, Fibers& fibers, Timers& timers, const Clock& clock);
  /// Requires: !building().
  ~ObjectCache() override;
  ObjectCache(const ObjectCache&) = delete;
  ObjectCache& operator=(const ObjectCache&) = delete;

  /// Adds the memory of a cache with this configuration.
  static void plan_memory(MemoryPlan& plan, const CacheConfig& config, size_t objects);
  /// Most timers set at once.
  static constexpr size_t max_timers = 1;

  /// The object if it is resident, else null.
  const BuiltObject* find(uint32_t object) {
    LUX_CHECK(object < entries_.size(), "looked for an object that the run does not have");
    Entry& entry = entries_[object];
    if (entry.built == nullptr) return nullptr;
    ++counters_.hits;
    if (entry.linked()) {  // pinned ones are not
      entry.unlink();
      unpinned_.push_back(entry);
    }
    return entry.built.get();
  }

  /// The object if it is resident, without counting as a use for LRU eviction.
  const BuiltObject* peek(uint32_t object) const { return entries_[object].built.get(); }

  /// The object, after a wait if necessary. Requires: on a fiber. Suspends if it is not resident.
  /// `traced`: if this begins a fetch, its times are written to the trace. `ahead`: if it waits,
  /// these are prefetched after it.
  [[nodiscard]] Got get(uint32_t object, bool traced = false, std::span<const uint32_t> ahead = {});

  /// Fetches the absent ones of these objects without waiting.
  void prefetch(std::span<const uint32_t> objects);

  /// Pins these objects, in order, while they fit the pinned share; the others are cached without a
  /// pin. Fetches the absent ones.
  void pin(std::span<const uint32_t> objects);

  ObjectState state(uint32_t object) const { return entries_[object].state; }
  bool pinned(uint32_t object) const { return entries_[object].pin == Pin::pinned; }
  /// Whether the builder owes an answer: a shutdown phase waits for it.
  bool building() const { return in_builder_; }

  struct Counters {
    uint64_t hits = 0;
    uint64_t misses = 0;  // found absent
    uint64_t joined = 0;  // found in flight
    uint64_t builds = 0;
    uint64_t builds_saved = 0;  // resident at another node of the process
    uint64_t build_failures = 0;
    uint64_t evictions = 0;
    uint64_t pins_refused = 0;  // no room in the pinned share
    uint64_t oversized = 0;     // objects above largest_build_bytes: the budget was exceeded
    uint64_t resident_bytes = 0;
    uint64_t pinned_bytes = 0;  // of those
  };
  const Counters& counters() const { return counters_; }
  /// Waits of fibers, from asking for an object that was not resident until they go on.
  const Histogram& wait_time() const { return wait_time_; }
  void add_metrics(Metrics& metrics) const;

 private:
  enum class Pin : uint8_t { none, wanted, pinned };
  /// In `unpinned_` while resident, in `to_build_` while it waits for the builder.
  struct Entry : ListHook {
    std::shared_ptr<const BuiltObject> built;  // while resident
    ObjectState state = ObjectState::absent;
    Pin pin = Pin::none;
    bool traced = false;  // the fetch in flight
    size_t charge = 0;    // bytes while resident
    WaitList waiters;
    size_t to_run = 0;  // fibers woken for it that have not run since
    /// From arrival until they are given to the builder; empty for a shared object.
    SharedBytes bytes;
  };

  void fetched(uint32_t object, SharedBytes bytes) override;
  void unobtainable(uint32_t object) override;
  void built(uint32_t object, Result<std::shared_ptr<const BuiltObject>> result) override;

  void request(uint32_t object, bool traced = false);
  void step_soon();
  void step();
  bool step_once();
  bool take_ready();
  bool make_room(size_t bytes);
  void start_build(Entry& entry);
  bool take_shared(Entry& entry);
  void come_in(Entry& entry, std::shared_ptr<const BuiltObject> built);
  void keep(Entry& entry);
  void evict(Entry& entry);
  void wake_waiters(Entry& entry);
  uint32_t number_of(const Entry& entry) const {
    return static_cast<uint32_t>(&entry - entries_.data());
  }

  CacheConfig config_;
  Fetcher& fetcher_;
  ObjectBuilder& builder_;
  Supervised& owner_;
  Fibers& fibers_;
  Timers& timers_;
  const Clock& clock_;
  std::vector<Entry> entries_;
  IntrusiveList<Entry> unpinned_;  // resident; the least recently used first
  IntrusiveList<Entry> to_build_;
  bool in_builder_ = false;
  Entry* ready_ = nullptr;  // built, and not yet resident
  Result<std::shared_ptr<const BuiltObject>> ready_result_{nullptr};
  TimerId step_timer_;
  bool steps_soon_ = false;
  bool stepping_ = false;
  Counters counters_;
  Nanoseconds build_began_ = 0;
  Histogram build_time_;  // of the builder
  Histogram wait_time_;
  OnceAMinute log_failure_;
};

}  // namespace luxodus
