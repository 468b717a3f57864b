// The objects of a run that a node has ready for use, and the way to get others: each is fetched
// and built once, however many fibers wait for it, and kept until room is needed, the one unused
// for the longest going first. Charged is what an object really takes once it is built.
//
// An object that is found stays where it is until the fiber that found it next suspends; no longer,
// so nobody keeps the pointer. Objects come in and go on the scheduler's stack only.
//
// Where the nodes of a process share, an object that another of them has ready is neither fetched
// nor built, but comes in as if it had been.
//
// Progress: an object comes in only when every fiber that was woken for the one before has run. So
// each wait ends with the object in hand, even where the cache has room for a single one.
//
// Thread rule: the node's thread; get() from a fiber. What is fetched from where: Fetcher.
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

/// What an object is to its node.
///
///             get, prefetch, pin               bytes                       it comes in
///   absent ───────────────────────► requested ───────► building ─────────────────────► resident
///     ▲ ▲                               │                 │                                │
///     │ └───────── unobtainable ────────┴─ no such thing ─┘                                │
///     └──────────────────────────────── room is needed ────────────────────────────────────┘
///
/// Building lasts from the bytes' arrival: in line for the builder, with it, and then until the
/// fibers woken for the object before have run. What another node of the process has ready is in
/// line at once; if that has let it go before its turn, it is requested.
enum class ObjectState : uint8_t { absent, requested, building, resident };

struct CacheConfig {
  /// For built objects and the one that is being built.
  size_t budget_bytes = 0;
  /// The most that an object takes while it is built: about 1.6 times what it takes afterwards.
  size_t largest_build_bytes = 0;
  /// Of the budget, what pinned objects may take at most: the rest serves what was not foreseen.
  double pinned_share = 0.5;
  NodeTrace* trace = nullptr;  // null: nothing is traced
  Buggify* buggify = nullptr;  // rare ways; null: none
  /// What nodes of the process have ready; null: this node shares nothing. It outlives the cache.
  SharedObjects* shared = nullptr;

  /// For resident objects: what the budget leaves beside one build.
  size_t max_resident_bytes() const { return budget_bytes - largest_build_bytes; }
  size_t max_pinned_bytes() const {
    return static_cast<size_t>(pinned_share * static_cast<double>(budget_bytes));
  }
};

/// What a fiber got.
struct Got {
  enum class How : uint8_t {
    resident,
    cancelled,    // the fiber shall end
    unobtainable  // nobody gave it, or it cannot be built; asking again may succeed
  };
  How how = How::cancelled;
  const BuiltObject* object = nullptr;  // where resident; until the fiber next suspends
};

class ObjectCache final : private FetchClient, private ObjectBuilder::Client {
 public:
  /// Timers are set as those of `owner`.
  /// Requires: all references outlive this; objects are named by their place, below `objects`.
  /// Errors (exception): a budget that has no room for the pinned, an object, and a build.
  ObjectCache(const CacheConfig& config, size_t objects, Fetcher& fetcher, ObjectBuilder& builder,
              Supervised& owner, Fibers& fibers, Timers& timers, const Clock& clock);
  /// Requires: !building().
  ~ObjectCache() override;
  ObjectCache(const ObjectCache&) = delete;
  ObjectCache& operator=(const ObjectCache&) = delete;

  /// Adds what a cache of this configuration takes.
  static void plan_memory(MemoryPlan& plan, const CacheConfig& config, size_t objects);
  /// Timers that it may have set at once.
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

  /// The object if it is resident, without a use of it: it is evicted as soon as it would be.
  const BuiltObject* peek(uint32_t object) const { return entries_[object].built.get(); }

  /// The object, after a wait if need be. Requires: on a fiber. Suspends where it is not resident.
  /// `traced`: if this begins a fetch, its times are told to the trace. `ahead`: where it waits,
  /// these are asked for after it, as by prefetch().
  [[nodiscard]] Got get(uint32_t object, bool traced = false, std::span<const uint32_t> ahead = {});

  /// Has those fetched that are absent, and waits for none.
  void prefetch(std::span<const uint32_t> objects);

  /// Has these kept for good, the first first, while they fit their share of the budget; those that
  /// do not are kept as others are. Fetches the absent.
  void pin(std::span<const uint32_t> objects);

  ObjectState state(uint32_t object) const { return entries_[object].state; }
  bool pinned(uint32_t object) const { return entries_[object].pin == Pin::pinned; }
  /// Whether the builder owes an answer: for the phase of a shutdown that waits for it.
  bool building() const { return in_builder_; }

  struct Counters {
    uint64_t hits = 0;
    uint64_t misses = 0;  // that found it absent
    uint64_t joined = 0;  // that found it under way
    uint64_t builds = 0;
    uint64_t builds_saved = 0;  // of objects that another node of the process had ready
    uint64_t build_failures = 0;
    uint64_t evictions = 0;
    uint64_t pins_refused = 0;  // for want of room in their share
    uint64_t oversized = 0;     // objects above largest_build_bytes: the budget was passed
    uint64_t resident_bytes = 0;
    uint64_t pinned_bytes = 0;  // of those
  };
  const Counters& counters() const { return counters_; }
  /// Of fibers: from asking for an object that was not resident to going on.
  const Histogram& wait_time() const { return wait_time_; }
  void add_metrics(Metrics& metrics) const;

 private:
  enum class Pin : uint8_t { none, wanted, pinned };
  /// In `unpinned_` while resident, in `to_build_` while it waits for the builder.
  struct Entry : ListHook {
    std::shared_ptr<const BuiltObject> built;  // while resident
    ObjectState state = ObjectState::absent;
    Pin pin = Pin::none;
    bool traced = false;  // the fetch that is under way
    size_t charge = 0;    // bytes while resident
    WaitList waiters;
    /// From arrival until they are given to the builder; none of what another node has ready.
    SharedBytes bytes;
  };

  void fetched(uint32_t object, SharedBytes bytes) override;
  void unobtainable(uint32_t object) override;
  void built(uint32_t object, Result<std::shared_ptr<const BuiltObject>> result) override;

  void request(uint32_t object, bool traced = false);
  void step_soon();
  void step();
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
  IntrusiveList<Entry> unpinned_;  // resident; the one unused for the longest first
  IntrusiveList<Entry> to_build_;
  bool in_builder_ = false;
  Entry* ready_ = nullptr;  // built, and not yet come in
  Result<std::shared_ptr<const BuiltObject>> ready_result_{nullptr};
  size_t to_run_ = 0;  // fibers woken for an object that have not run since
  TimerId step_timer_;
  bool steps_soon_ = false;
  Counters counters_;
  Nanoseconds build_began_ = 0;
  Histogram build_time_;  // from the builder's beginning to its answer
  Histogram wait_time_;
  OnceAMinute log_failure_;
};

}  // namespace luxodus
