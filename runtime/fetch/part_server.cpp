#include "runtime/fetch/part_server.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace luxodus {

namespace {

/// How soon to retry after a full outbox: after a turn or two of the node's loop.
constexpr Nanoseconds answer_patience = microseconds(100);

std::vector<std::pair<ObjectId, uint32_t>> numbers_of(const std::vector<ObjectPlace>& objects) {
  std::vector<std::pair<ObjectId, uint32_t>> numbers;
  numbers.reserve(objects.size());
  for (uint32_t object = 0; object < objects.size(); ++object)
    if (objects[object].wire_bytes > 0) numbers.emplace_back(objects[object].id, object);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace

PartServer::PartServer(const FetchConfig& fetch, const CacheConfig& cache,
                       const std::vector<ObjectPlace>& objects, ObjectStore& store,
                       ObjectBuilder& builder, Scheduler& scheduler, Sender& sender,
                       const Random& jitter)
    : NodeActor(scheduler, sender, fetch.address(), "part server"),
      config_(fetch),
      store_(store),
      numbers_(numbers_of(objects)),
      fetcher_(fetch, objects, store, sender, *this, scheduler.timers(), scheduler.clock(), jitter),
      cache_(cache, objects.size(), fetcher_, builder, *this, scheduler.fibers(),
             scheduler.timers(), scheduler.clock()),
      waiting_(fetch.requests) {}

PartServer::~PartServer() {
  if (tries_again_) scheduler().timers().cancel(again_timer_);
}

void PartServer::plan_memory(MemoryPlan& plan, const FetchConfig& fetch, const CacheConfig& cache,
                             size_t objects) {
  Fetcher::plan_memory(plan, fetch, objects);
  ObjectCache::plan_memory(plan, cache, objects);
  constexpr size_t entry = sizeof(std::pair<ObjectId, uint32_t>);
  plan.add("part server", memory_bytes() + fetch.requests * sizeof(Question) + objects * entry,
           fmt::format("mailbox of {} B + {} requests x {} B + {} objects x {} B", memory_bytes(),
                       fetch.requests, sizeof(Question), objects, entry));
}

void PartServer::add_metrics(Metrics& metrics) const {
  fetcher_.add_metrics(metrics);
  cache_.add_metrics(metrics);
  const Counters& c = counters_;
  metrics.add_counter({"fetch_out", "bytes", "Bytes of objects given to others.", ""}, c.bytes_out);
  metrics.add_counter({"objects_served", "", "Objects given to others.", ""}, c.served);
  metrics.add_counter({"objects_refused", "", "Requests for what is not here.", ""}, c.refused);
  metrics.add_counter({"objects_intercepted", "", "Requests answered on their way.", ""},
                      c.intercepted);
  metrics.add_counter(
      {"objects_from_cache", "", "Objects given to others by a node that does not hold them.", ""},
      c.from_cache);
  metrics.add_counter({"requests_waited", "", "Requests without room for an answer.", ""},
                      c.waited);
  metrics.add_counter({"requests_dropped", "", "Of those, beyond the room for them.", ""},
                      c.dropped);
}

// ---- objects that are entered later ------------------------------------------------------------

void PartServer::enter(ObjectId id, uint32_t object) {
  const std::pair entry(id, object);
  numbers_.insert(std::lower_bound(numbers_.begin(), numbers_.end(), entry), entry);
}

void PartServer::forget(ObjectId id, uint32_t object) {
  LUX_CHECK(cache_.state(object) == ObjectState::absent, "forgot an object that is in use");
  const std::pair entry(id, object);
  const auto at = std::lower_bound(numbers_.begin(), numbers_.end(), entry);
  LUX_CHECK(at != numbers_.end() && *at == entry, "forgot an object that was not entered");
  numbers_.erase(at);
}

// ---- requests of others -------------------------------------------------------------------------

/// The object if it is resident and shared with others, else null.
const BuiltObject* PartServer::ready(ObjectId object) const {
  if (!config_.shares_cache) return nullptr;
  const auto at =
      std::lower_bound(numbers_.begin(), numbers_.end(), std::pair(object, uint32_t{0}));
  if (at == numbers_.end() || at->first != object) return nullptr;
  return cache_.peek(at->second);
}

bool PartServer::answers(const Message& passing) {
  const auto* wanted = std::get_if<FetchObject>(&passing);
  if (wanted == nullptr || failed()) return false;
  if (rarely(config_.buggify, Buggify::Site::object_missing)) return false;
  if (store_.find(wanted->object).bytes.empty() && ready(wanted->object) == nullptr) return false;
  ++counters_.intercepted;
  return true;
}

void PartServer::on(const Letter<FetchObject>& request) {
  if (request.from.node == config_.self) return;  // a forgery: this node never asks itself
  const Question question{request.from, request.id, request.body.object};
  if (waiting_.empty() && serve(question)) return;
  ++counters_.waited;
  if (!waiting_.push(question)) ++counters_.dropped;
  try_again_soon();
}

/// False: no room now.
bool PartServer::serve(const Question& question) {
  SharedBytes bytes;
  if (!rarely(config_.buggify, Buggify::Site::object_missing)) bytes = store_.find(question.object);
  const BuiltObject* built = bytes.bytes.empty() ? ready(question.object) : nullptr;
  if (built != nullptr) bytes = built->wire_bytes();
  const size_t size = bytes.bytes.size();
  const Message answer = size > 0 ? Message{ObjectFound{question.object, config_.self}}
                                  : Message{ObjectNotHere{question.object, config_.self}};
  const SendOutcome outcome =
      sender().send(address(), question.from, question.id, answer, std::move(bytes));
  if (outcome == SendOutcome::full) return false;
  if (outcome == SendOutcome::unreachable) return true;  // the requester retries, or has gone
  ++(size > 0 ? counters_.served : counters_.refused);
  if (built != nullptr) ++counters_.from_cache;
  counters_.bytes_out += size;
  return true;
}

void PartServer::try_again_soon() {
  if (std::exchange(tries_again_, true)) return;
  again_timer_ = scheduler().timers().set(scheduler().clock().now() + answer_patience,
                                          own_task([this] { serve_waiting(); }));
}

void PartServer::serve_waiting() {
  tries_again_ = false;
  while (!waiting_.empty() && serve(waiting_[0])) (void)waiting_.pop();
  if (!waiting_.empty()) try_again_soon();
}

// ---- answers of others --------------------------------------------------------------------------

void PartServer::on(Letter<ObjectFound>&& answer) {
  fetcher_.found(answer.id, answer.hops, answer.body, std::move(answer.payload).shared());
}

void PartServer::on(const Letter<ObjectNotHere>& answer) {
  fetcher_.not_here(answer.id, answer.body);
}

std::span<std::byte> PartServer::room_for(const MessageId& id, size_t bytes) {
  return failed() ? std::span<std::byte>{} : fetcher_.room_for(id, bytes);
}

SharedBytes PartServer::keep(const MessageId& id, std::span<const std::byte> payload) {
  return failed() ? SharedBytes{} : fetcher_.keep(id, payload);
}

}  // namespace luxodus
