// Memory never exceeds the budget: residents stay below it by one build's peak, at most one object
// is being built or waits after its build, and it becomes resident only after evictions have made
// room. The next build starts only then, so a builder on another thread works while the fibers
// woken last are running. Many small objects come in at one step: a turn for each would cost more
// than they do.
#include "runtime/fetch/object_cache.hpp"

#include <fmt/core.h>

#include <stdexcept>
#include <utility>

#include "runtime/core/log.hpp"

namespace luxodus {

namespace {

/// Objects that come in at one step, and the time after which it begins no other: short against a
/// turn of 1 ms, so that a builder that answers at once does not starve arrivals and fibers.
constexpr int objects_of_a_step = 32;
constexpr Nanoseconds step_time = microseconds(50);

void check_cache(const CacheConfig& config) {
  if (config.largest_build_bytes == 0 || !(config.pinned_share >= 0) || config.pinned_share > 1)
    throw std::invalid_argument("cache: a build's size and a share of 0 to 1 are needed");
  if (config.budget_bytes < 2 * config.largest_build_bytes + config.max_pinned_bytes())
    throw std::invalid_argument(
        fmt::format("cache: a budget of {} bytes has no room for one object and one build of {} "
                    "bytes beside {} that may be pinned",
                    config.budget_bytes, config.largest_build_bytes, config.max_pinned_bytes()));
}

}  // namespace

ObjectCache::ObjectCache(const CacheConfig& config, size_t objects, Fetcher& fetcher,
                         ObjectBuilder& builder, Supervised& owner, Fibers& fibers, Timers& timers,
                         const Clock& clock)
    : config_((check_cache(config), config)),
      fetcher_(fetcher),
      builder_(builder),
      owner_(owner),
      fibers_(fibers),
      timers_(timers),
      clock_(clock),
      entries_(objects) {}

ObjectCache::~ObjectCache() {
  LUX_CHECK(!in_builder_, "a cache ended before its builder had answered");
  if (steps_soon_) timers_.cancel(step_timer_);
}

void ObjectCache::plan_memory(MemoryPlan& plan, const CacheConfig& config, size_t objects) {
  plan.add("objects", config.budget_bytes,
           fmt::format("{} B resident + {} B for a build", config.max_resident_bytes(),
                       config.largest_build_bytes));
  plan.add("table of objects", objects * sizeof(Entry),
           fmt::format("{} objects x {} B", objects, sizeof(Entry)));
}

void ObjectCache::add_metrics(Metrics& metrics) const {
  const Counters& c = counters_;
  metrics.add_counter({"cache_hits", "", "Objects found resident.", ""}, c.hits);
  metrics.add_counter({"cache_misses", "", "Objects found absent.", ""}, c.misses);
  metrics.add_counter({"cache_joined", "", "Objects found under way.", ""}, c.joined);
  metrics.add_counter({"builds", "", "Objects built.", ""}, c.builds);
  metrics.add_counter(
      {"builds_saved", "", "Objects that another node of the process had ready.", ""},
      c.builds_saved);
  metrics.add_counter({"build_failures", "", "Objects that could not be built.", ""},
                      c.build_failures);
  metrics.add_counter({"evictions", "", "Objects that made room.", ""}, c.evictions);
  metrics.add_counter({"pins_refused", "", "Pins beyond their share of the budget.", ""},
                      c.pins_refused);
  metrics.add_counter({"objects_oversized", "", "Objects larger than builds were planned for.", ""},
                      c.oversized);
  metrics.add_gauge({"objects_resident", "bytes", "Bytes of resident objects.", ""},
                    c.resident_bytes);
  metrics.add_gauge({"objects_pinned", "bytes", "Bytes of pinned objects.", ""}, c.pinned_bytes);
  metrics.add_histogram({"build", "", "From a builder's beginning to its answer.", ""},
                        build_time_);
  metrics.add_histogram(
      {"object_wait", "", "From a fiber's asking for an object to its going on.", ""}, wait_time_);
}

// ---- asking for objects

Got ObjectCache::get(uint32_t object, bool traced, std::span<const uint32_t> ahead) {
  if (const BuiltObject* built = find(object)) return {Got::How::resident, built};
  Entry& entry = entries_[object];
  if (entry.state == ObjectState::absent) {
    ++counters_.misses;
    request(object, traced);
  } else {
    ++counters_.joined;
  }
  prefetch(ahead);
  const Nanoseconds asked_at = clock_.now();
  if (fibers_.wait(entry.waiters, "fetch") != Wake::woken) return {Got::How::cancelled};
  wait_time_.add(clock_.now() - asked_at);
  if (--entry.to_run == 0 && ready_ != nullptr) step_soon();
  if (entry.built == nullptr) return {Got::How::unobtainable};
  return {Got::How::resident, entry.built.get()};
}

void ObjectCache::prefetch(std::span<const uint32_t> objects) {
  for (const uint32_t object : objects)
    if (state(object) == ObjectState::absent) request(object);
}

void ObjectCache::pin(std::span<const uint32_t> objects) {
  for (const uint32_t object : objects) {
    Entry& entry = entries_[object];
    if (entry.pin != Pin::none) continue;
    entry.pin = Pin::wanted;
    if (entry.state == ObjectState::resident) keep(entry);
  }
  prefetch(objects);
}

void ObjectCache::request(uint32_t object, bool traced) {
  Entry& entry = entries_[object];
  entry.traced = traced && config_.trace != nullptr;
  if (config_.shared != nullptr && config_.shared->find(object) != nullptr) {
    entry.state = ObjectState::building;
    to_build_.push_back(entry);
    return step_soon();
  }
  entry.state = ObjectState::requested;
  fetcher_.fetch(object, *this, entry.traced);
}

// ---- arrival of objects

void ObjectCache::fetched(uint32_t object, SharedBytes bytes) {
  Entry& entry = entries_[object];
  entry.state = ObjectState::building;
  entry.bytes = std::move(bytes);
  to_build_.push_back(entry);
  step_soon();
}

void ObjectCache::unobtainable(uint32_t object) {
  Entry& entry = entries_[object];
  entry.state = ObjectState::absent;
  wake_waiters(entry);
}

void ObjectCache::built(uint32_t object, Result<std::shared_ptr<const BuiltObject>> result) {
  LUX_CHECK(in_builder_ && entries_[object].state == ObjectState::building,
            "a builder answered what it was not asked");
  LUX_CHECK(!result || result.value() != nullptr, "a builder said that nothing is an object");
  in_builder_ = false;
  build_time_.add(clock_.now() - build_began_);
  if (entries_[object].traced) config_.trace->end(TraceKind::build, object, object);
  ready_ = &entries_[object];
  if (result && config_.shared != nullptr)
    result = config_.shared->add(object, std::move(result).value());
  ready_result_ = std::move(result);
  fetcher_.release(object);
  step_soon();
}

// The next step comes a nanosecond later: a timer set for now would fire in the same turn.
void ObjectCache::step_soon() {
  if (stepping_ || std::exchange(steps_soon_, true)) return;
  step_timer_ = timers_.set(clock_.now() + 1, owner_.own_task([this] { step(); }));
}

void ObjectCache::step() {
  steps_soon_ = false;
  stepping_ = true;
  const Nanoseconds end = clock_.now() + step_time;
  bool more = true;
  for (int n = 0; more && n < objects_of_a_step && clock_.now() <= end; ++n) more = step_once();
  stepping_ = false;
  if (more) step_soon();
}

/// Lets the built object come in, and starts the next build. False: nothing more can be done until
/// fibers have run, the builder answers, or bytes arrive.
bool ObjectCache::step_once() {
  if (ready_ != nullptr && !take_ready()) return false;
  if (in_builder_ || to_build_.empty()) return false;
  start_build(*to_build_.pop_front());
  return ready_ != nullptr || (!in_builder_ && !to_build_.empty());
}

/// False: there is no room before the fibers that were woken for another object have run.
bool ObjectCache::take_ready() {
  Entry& entry = *ready_;
  if (ready_result_) {
    if (!make_room(ready_result_.value()->bytes())) return false;
    ready_ = nullptr;
    come_in(entry, std::move(ready_result_).value());
    return true;
  }
  ready_ = nullptr;
  ++counters_.build_failures;
  if (log_failure_.may(clock_.now()))
    log_error("fetch=build_failed object={} total={} text=\"{}\"", number_of(entry),
              counters_.build_failures, ready_result_.problem().text());
  unobtainable(number_of(entry));
  return true;
}

/// Evicts what was used longest ago. False: that was woken for, and is still to be used.
bool ObjectCache::make_room(size_t bytes) {
  while (counters_.resident_bytes + bytes > config_.max_resident_bytes() && !unpinned_.empty()) {
    if (unpinned_.front().to_run > 0) return false;
    evict(*unpinned_.pop_front());
  }
  return true;
}

/// A shared object is not held before its turn, since no budget is charged for it yet.
bool ObjectCache::take_shared(Entry& entry) {
  if (config_.shared == nullptr) return false;
  auto built = config_.shared->find(number_of(entry));
  if (built == nullptr) return false;
  ++counters_.builds_saved;
  if (!std::exchange(entry.bytes, {}).bytes.empty()) fetcher_.release(number_of(entry));
  ready_ = &entry;
  ready_result_ = std::move(built);
  return true;
}

void ObjectCache::start_build(Entry& entry) {
  if (take_shared(entry)) return;
  if (entry.bytes.bytes.empty()) {  // the other node released it meanwhile
    entry.state = ObjectState::requested;
    fetcher_.fetch(number_of(entry), *this, entry.traced);
    return;
  }
  ++counters_.builds;
  in_builder_ = true;
  build_began_ = clock_.now();
  const uint32_t object = number_of(entry);
  if (entry.traced) config_.trace->begin(TraceKind::build, object, object);
  builder_.build(number_of(entry), std::exchange(entry.bytes, {}), *this);
}

void ObjectCache::come_in(Entry& entry, std::shared_ptr<const BuiltObject> built) {
  entry.charge = built->bytes();
  if (entry.charge > config_.largest_build_bytes) ++counters_.oversized;
  if (!unpinned_.empty() && unpinned_.front().to_run == 0 &&
      rarely(config_.buggify, Buggify::Site::early_eviction))
    evict(*unpinned_.pop_front());
  entry.built = std::move(built);
  entry.state = ObjectState::resident;
  counters_.resident_bytes += entry.charge;
  unpinned_.push_back(entry);
  keep(entry);
  wake_waiters(entry);
}

/// Pins a resident object for which a pin was requested, if there is room.
void ObjectCache::keep(Entry& entry) {
  if (entry.pin != Pin::wanted) return;
  if (counters_.pinned_bytes + entry.charge > config_.max_pinned_bytes()) {
    entry.pin = Pin::none;
    ++counters_.pins_refused;
    return;
  }
  entry.pin = Pin::pinned;
  entry.unlink();
  counters_.pinned_bytes += entry.charge;
}

void ObjectCache::evict(Entry& entry) {
  ++counters_.evictions;
  counters_.resident_bytes -= entry.charge;
  entry.state = ObjectState::absent;
  entry.built.reset();
}

void ObjectCache::wake_waiters(Entry& entry) {
  while (fibers_.wake_one(entry.waiters)) ++entry.to_run;
}

}  // namespace luxodus
