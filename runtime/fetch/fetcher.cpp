// A fetch goes through the object's holders: each has `tries` requests, of which a timeout, wrong
// bytes or an unreachable holder use up one, and "not here" all. The fetch goes round from holder
// to holder while any of them has a try left, so it ends after a bounded number of requests
// whatever the network does. All requests of a fetch have one id, so that pieces of several answers
// fill one room; after wrong bytes it takes a new id, so that their remaining pieces are not mixed
// in.
#include "runtime/fetch/fetcher.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "runtime/core/check.hpp"
#include "runtime/core/log.hpp"

namespace luxodus {

namespace {

/// Bytes of a reply beside the object: two numbers in Cap'n Proto, and room for fields of later
/// versions. If it is too small, objects of several pieces are rejected.
constexpr size_t max_reply_head_bytes = 256;

/// How soon to retry after a full outbox: after a turn or two of the node's loop.
constexpr Nanoseconds outbox_patience = microseconds(100);

std::shared_ptr<uint64_t[]> room_of(size_t bytes) {
  return std::make_shared_for_overwrite<uint64_t[]>((bytes + 7) / 8);  // whole words, aligned
}

size_t nodes_of(const std::vector<ObjectPlace>& objects) {
  size_t nodes = 0;
  for (const ObjectPlace& object : objects)
    for (const NodeId holder : object.holders) nodes = std::max<size_t>(nodes, holder.value + 1u);
  return nodes;
}

void check_fetch(const FetchConfig& config, const std::vector<ObjectPlace>& objects) {
  if (config.tries == 0 || config.flights == 0)
    throw std::invalid_argument("fetch: without a try or a flight nothing is fetched");
  for (const ObjectPlace& object : objects) {
    if (object.holders.size() > limits::holders)
      throw std::invalid_argument("fetch: an object has more holders than can be asked");
    if (object.wire_bytes == 0 && object.holders.empty()) continue;  // entered later
    if (object.wire_bytes == 0) throw std::invalid_argument("fetch: an object has no bytes");
    if (object.wire_bytes > config.receive_bytes)
      throw std::invalid_argument(fmt::format(
          "fetch: an object of {} bytes is longer than receive_bytes, {}: raise it, or pack "
          "smaller objects",
          object.wire_bytes, config.receive_bytes));
  }
}

}  // namespace

Fetcher::Fetcher(const FetchConfig& config, const std::vector<ObjectPlace>& objects,
                 ObjectStore& store, Sender& sender, Supervised& owner, Timers& timers,
                 const Clock& clock, const Random& jitter)
    : config_((check_fetch(config, objects), config)),
      objects_(objects),
      store_(store),
      sender_(sender),
      owner_(owner),
      timers_(timers),
      clock_(clock),
      jitter_(jitter),
      routes_(std::max(config.nodes, nodes_of(objects))),
      waiting_(objects.size()),
      flights_("flights", config.flights, WhenEmpty::wait),
      sequences_(config.flights) {}

Fetcher::~Fetcher() {
  if (begins_soon_) timers_.cancel(begin_timer_);
  for (size_t i = 0; i < flights_.capacity(); ++i) {
    PendingFetch& flight = flights_.at(i);
    if (flight.id.sequence == 0) continue;
    timers_.cancel(flight.timer);
    sender_.forget(flight.id, Kind::reply);
  }
}

void Fetcher::plan_memory(MemoryPlan& plan, const FetchConfig& config, size_t objects) {
  plan.add("objects received", config.receive_bytes, "receive_bytes: asked for and not yet built");
  const size_t flight_bytes =
      sizeof(PendingFetch) + FixedPool<PendingFetch>::bytes_beside + sizeof(uint64_t);
  plan.add("fetches", config.flights * flight_bytes + objects * sizeof(Wish) + sizeof(Fetcher),
           fmt::format("{} flights x {} B + {} objects x {} B + {} B, mostly histograms",
                       config.flights, flight_bytes, objects, sizeof(Wish), sizeof(Fetcher)));
}

void Fetcher::add_metrics(Metrics& metrics) const {
  const Counters& c = counters_;
  metrics.add_counter({"fetches", "", "Fetches begun.", ""}, c.fetches);
  metrics.add_counter({"fetch_retries", "", "Questions asked again.", ""}, c.retries);
  metrics.add_counter({"fetch_timeouts", "", "Questions not answered in time.", ""}, c.timeouts);
  metrics.add_counter({"fetch_not_here", "", "Holders that did not have it.", ""}, c.not_here);
  metrics.add_counter({"fetch_wrong_hash", "", "Bytes that were not the object's.", ""},
                      c.wrong_hash);
  metrics.add_counter({"fetch_late", "", "Answers nobody waited for any more.", ""}, c.late);
  metrics.add_counter({"fetch_outbox_full", "", "Questions that waited for the network.", ""},
                      c.outbox_full);
  metrics.add_counter({"fetch_unobtainable", "", "Fetches in vain.", ""}, c.unobtainable);
  metrics.add_counter({"fetch_in", "bytes", "Bytes of objects that came.", ""}, c.bytes_in);
  metrics.add_gauge({"receive_held", "bytes", "Bytes asked for and not yet built.", ""},
                    c.receive_bytes_held);
  for (size_t hops = 0; hops < delay_.size(); ++hops)
    metrics.add_histogram({"fetch_delay", "seconds", "From the wish to the bytes, by links passed.",
                           fmt::format("hops=\"{}\"", hops)},
                          delay_[hops]);
}

// ---- begin and end of fetches

void Fetcher::fetch(uint32_t object, FetchClient& client, bool traced) {
  LUX_CHECK(object < objects_.size(), "fetched an object that the run does not have");
  LUX_CHECK(waiting_.push({object, &client, clock_.now(), traced}),
            "fetched an object twice at once");
  begin_soon();
}

void Fetcher::release(uint32_t object) {
  counters_.receive_bytes_held -= objects_[object].wire_bytes;
  begin_soon();
}

void Fetcher::begin_soon() {
  if (begins_soon_ || waiting_.empty()) return;
  begins_soon_ = true;
  begin_timer_ = timers_.set(clock_.now(), owner_.own_task([this] { begin_flights(); }));
}

void Fetcher::begin_flights() {
  begins_soon_ = false;
  while (!waiting_.empty() && flights_.in_use() < flights_.capacity()) {
    const uint64_t bytes = objects_[waiting_[0].object].wire_bytes;
    if (counters_.receive_bytes_held + bytes > config_.receive_bytes) return;
    counters_.receive_bytes_held += bytes;
    begin(waiting_.pop());
  }
}

void Fetcher::begin(const Wish& wish) {
  PendingFetch& flight = *flights_.take();
  flight.wish = wish;
  take_id(flight, sender_.next_id());
  flight.timer = {};
  flight.questions = 0;
  flight.holder = nearest_holder(wish.object);
  flight.tries.fill(0);
  flight.trace_id = wish.traced && config_.trace != nullptr ? trace_id(flight.id) : 0;
  if (flight.trace_id != 0) config_.trace->begin(TraceKind::fetch, flight.trace_id, wish.object);
  ++counters_.fetches;
  ask(flight);
}

size_t Fetcher::nearest_holder(uint32_t object) const {
  if (config_.hops.empty()) return 0;
  const std::vector<NodeId>& holders = objects_[object].holders;
  const auto nearest = std::min_element(holders.begin(), holders.end(), [this](NodeId a, NodeId b) {
    return config_.hops[a.value] < config_.hops[b.value];
  });
  return static_cast<size_t>(nearest - holders.begin());
}

void Fetcher::end(PendingFetch& flight) {
  if (flight.trace_id != 0)
    config_.trace->end(TraceKind::fetch, flight.trace_id, flight.wish.object);
  timers_.cancel(flight.timer);
  sender_.forget(flight.id, Kind::reply);
  take_id(flight, {});
  flight.room.reset();
  flights_.give(flight);
  begin_soon();
}

Fetcher::PendingFetch* Fetcher::flight_of(const MessageId& id) {
  if (id.sequence == 0) return nullptr;
  // An answer is looked up several times in a row.
  if (sequences_[looked_up_] != id.sequence) {
    const auto at = std::find(sequences_.begin(), sequences_.end(), id.sequence);
    if (at == sequences_.end()) return nullptr;
    looked_up_ = static_cast<size_t>(at - sequences_.begin());
  }
  PendingFetch& flight = flights_.at(looked_up_);
  return flight.id == id ? &flight : nullptr;
}

void Fetcher::take_id(PendingFetch& flight, const MessageId& id) {
  flight.id = id;
  sequences_[flights_.index_of(flight)] = id.sequence;
}

// ---- asking

/// Asks the next holder, in turn, that has tries left and can be reached.
void Fetcher::ask(PendingFetch& flight) {
  const std::vector<NodeId>& holders = objects_[flight.wish.object].holders;
  bool ways_missing = false;
  for (size_t n = 0; n < holders.size(); ++n) {
    const size_t at = flight.holder;
    if (flight.tries[at] < config_.tries) {
      if (holders[at] == config_.self) {
        if (take_from_store(flight)) return;
        flight.tries[at] = config_.tries;
      } else {
        if (ask_holder(flight, holders[at])) return;
        ways_missing = true;
      }
    }
    flight.holder = (at + 1) % holders.size();
  }
  if (take_from_store(flight)) return;
  if (ways_missing) return wait_for_ways(flight);
  give_up(flight);
}

/// Asks now, or once the network has room for the request; false if there is no route.
bool Fetcher::ask_holder(PendingFetch& flight, NodeId holder) {
  const RouteDelay& route = routes_[holder.value];
  const unsigned nth = flight.tries[flight.holder] + 1u;
  const Nanoseconds patience = with_jitter(route.timeout(config_.timeouts, nth));
  const FetchObject question{objects_[flight.wish.object].id,
                             static_cast<uint64_t>(patience / microseconds(1)),
                             static_cast<uint16_t>(flight.questions + 1)};
  const SendOutcome outcome =
      sender_.send(config_.address(), {holder, ActorName::part_server}, flight.id, question);
  if (outcome == SendOutcome::unreachable) return false;
  if (outcome == SendOutcome::full) {
    ++counters_.outbox_full;
    set_timer(flight, outbox_patience, false);
    return true;
  }
  ++flight.tries[flight.holder];
  if (++flight.questions > 1) ++counters_.retries;
  flight.asked_at = clock_.now();
  set_timer(flight, patience, true);
  return true;
}

/// No holder with a try left can be reached: this costs each of them one try, and the timeout of an
/// unknown route; meanwhile routes may be updated.
void Fetcher::wait_for_ways(PendingFetch& flight) {
  uint8_t used = 0;
  for (size_t at = 0; at < objects_[flight.wish.object].holders.size(); ++at)
    if (flight.tries[at] < config_.tries) used = std::max(used, ++flight.tries[at]);
  set_timer(flight, with_jitter(RouteDelay().timeout(config_.timeouts, used)), false);
}

bool Fetcher::take_from_store(PendingFetch& flight) {
  SharedBytes bytes = store_.find(objects_[flight.wish.object].id);
  if (bytes.bytes.empty()) bytes = store_.find_in_storage(flight.wish.object);
  return !bytes.bytes.empty() && accept(flight, std::move(bytes), 0, config_.self);
}

/// The object's name for people, if it has one.
std::string Fetcher::text_of(uint32_t object, const char* what) const {
  const std::string name = store_.stored_name(object);
  return name.empty() ? what : name + ": " + what;
}

void Fetcher::give_up(PendingFetch& flight) {
  const Wish wish = flight.wish;
  ++counters_.unobtainable;
  if (log_unobtainable_.may(clock_.now()))
    log_warning("fetch=unobtainable node={} object={:#x} questions={} total={} text=\"{}\"",
                config_.self.value, objects_[wish.object].id.value, flight.questions,
                counters_.unobtainable,
                text_of(wish.object, "nobody who can be reached gives it whole"));
  end(flight);
  release(wish.object);
  wish.client->unobtainable(wish.object);
}

void Fetcher::set_timer(PendingFetch& flight, Nanoseconds span, bool answer_due) {
  timers_.cancel(flight.timer);
  flight.answer_due = answer_due;
  flight.timer =
      timers_.set(clock_.now() + span, owner_.own_task([this, &flight] { timer_fired(flight); }));
}

void Fetcher::timer_fired(PendingFetch& flight) {
  if (flight.answer_due) {
    ++counters_.timeouts;
    const NodeId holder = objects_[flight.wish.object].holders[flight.holder];
    routes_[holder.value].timed_out(flight.asked_at, clock_.now());
  }
  ask(flight);
}

/// Adds up to a quarter, so that nodes which lost the same holder do not retry in step.
Nanoseconds Fetcher::with_jitter(Nanoseconds span) {
  return span + static_cast<Nanoseconds>(jitter_.uniform_double() * static_cast<double>(span / 4));
}

// ---- answers

std::span<std::byte> Fetcher::room_for(const MessageId& id, size_t bytes) {
  PendingFetch* flight = flight_of(id);
  if (flight == nullptr) return {};
  const size_t most = objects_[flight->wish.object].wire_bytes + max_reply_head_bytes;
  if (bytes > most) return {};
  if (flight->room == nullptr) flight->room = room_of(most);
  // The answer has begun: its pieces take turns with those of all other messages in flight.
  if (flight->answer_due) set_timer(*flight, config_.timeouts.most, true);
  return std::as_writable_bytes(std::span(flight->room.get(), (most + 7) / 8)).first(most);
}

/// An answer in pieces is in its room already; any other is valid only during this call.
SharedBytes Fetcher::keep(const MessageId& id, std::span<const std::byte> payload) {
  const PendingFetch* flight = flight_of(id);
  if (flight == nullptr) return {};
  const auto* room = reinterpret_cast<const std::byte*>(flight->room.get());
  const size_t most = objects_[flight->wish.object].wire_bytes + max_reply_head_bytes;
  if (room != nullptr && payload.data() >= room && payload.data() < room + most)
    return {payload, flight->room};
  if (payload.empty() || payload.size() > most) return {};
  const auto copy = room_of(payload.size());
  const std::span to = std::as_writable_bytes(std::span(copy.get(), (payload.size() + 7) / 8));
  std::copy(payload.begin(), payload.end(), to.begin());
  return {to.first(payload.size()), copy};
}

void Fetcher::found(const MessageId& id, uint8_t hops, const ObjectFound& answer,
                    SharedBytes bytes) {
  PendingFetch* flight = flight_of(id);
  if (flight == nullptr) {
    ++counters_.late;
    return;
  }
  counters_.bytes_in += bytes.bytes.size();
  const std::vector<NodeId>& holders = objects_[flight->wish.object].holders;
  if (flight->questions == 1)
    routes_[holders[flight->holder].value].answered(clock_.now() - flight->asked_at);
  if (accept(*flight, std::move(bytes), hops, answer.answered_by)) return;
  sender_.forget(flight->id, Kind::reply);
  take_id(*flight, sender_.next_id());
  flight->holder = (flight->holder + 1) % holders.size();
  ask(*flight);
}

void Fetcher::not_here(const MessageId& id, const ObjectNotHere& answer) {
  PendingFetch* flight = flight_of(id);
  if (flight == nullptr ||
      answer.answered_by != objects_[flight->wish.object].holders[flight->holder]) {
    ++counters_.late;
    return;
  }
  ++counters_.not_here;
  flight->tries[flight->holder] = config_.tries;
  ask(*flight);
}

/// Completes the fetch with these bytes, if they are the object's.
bool Fetcher::accept(PendingFetch& flight, SharedBytes bytes, uint8_t hops, NodeId from) {
  const Wish wish = flight.wish;
  const ObjectPlace& place = objects_[wish.object];
  if (bytes.bytes.size() != place.wire_bytes || object_id_of(bytes.bytes) != place.id) {
    ++counters_.wrong_hash;
    if (log_wrong_.may(clock_.now()))
      log_warning("fetch=wrong_bytes node={} object={:#x} answered_by={} total={} text=\"{}\"",
                  config_.self.value, place.id.value, from.value, counters_.wrong_hash,
                  text_of(wish.object, from == config_.self
                                           ? "it is damaged where it is stored: make that file "
                                             "again, or copy it again"
                                           : "what the other node gave is damaged"));
    return false;
  }
  delay_[hops].add(clock_.now() - wish.since);
  end(flight);
  wish.client->fetched(wish.object, std::move(bytes));
  return true;
}

}  // namespace luxodus
