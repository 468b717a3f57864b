// A name leads to a slot of a table of fixed size, which the part server takes for the list of all
// objects of the run. A slot is filled before its object is fetched and emptied only while the
// object is absent, so that nothing under way refers to it.
#include "runtime/node/named_objects.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace luxodus {

namespace {

/// What the nodes say to each other about names, as the schema of an AppMessage.
enum Word : uint64_t { where = 1, here = 2, not_here = 3 };

/// The first wait for answers; each round doubles it.
constexpr Nanoseconds first_round = milliseconds(50);
constexpr Nanoseconds longest_round = seconds(1);

/// Names for which the first answer is awaited at once: half of the places of an outbox, so that
/// other messages leave beside these. Thousands at once would find the outbox full, and wait for
/// their next round.
constexpr size_t names_at_once = defaults::outbox_messages / 2;

/// Bytes that are fetched at once, if two of the largest objects are no more: the windows of four
/// links, and what 10 Gb/s bring in 3 ms. With 16 MB, objects of 100 kB took 1.4 times as much
/// processor time on one host, since its caches do not hold them.
constexpr size_t bytes_at_once = 4 << 20;

/// A fiber that finds everything in the cache lets others run after this many objects: 32 take some
/// microseconds beside what the fiber does with them.
constexpr uint64_t hits_at_once = 32;

/// The bytes as they came.
class KeptBytes final : public BuiltObject {
 public:
  explicit KeptBytes(SharedBytes wire) : wire_(std::move(wire)) {}
  size_t bytes() const override { return wire_.bytes.size(); }
  SharedBytes wire_bytes() const override { return wire_; }

 private:
  SharedBytes wire_;
};

FetchConfig fetch_config(const NamedObjectsConfig& config) {
  FetchConfig fetch;
  fetch.self = config.self;
  fetch.nodes = config.nodes;
  fetch.flights = NamedObjects::fetches_at_once;
  fetch.receive_bytes = std::max(bytes_at_once, 2 * config.max_object_bytes);
  return fetch;
}

CacheConfig cache_config(const NamedObjectsConfig& config) {
  return {.budget_bytes = config.cache_bytes,
          .largest_build_bytes = config.max_object_bytes,
          .pinned_share = 0};
}

Random jitter_of(NodeId self) {
  Random random(self.value, RandomStream::fetch);
  random.start(0);
  return random;
}

}  // namespace

/// What is known of a name: its hash, and the hash and size of the bytes.
struct NamedObjects::Found {
  uint64_t key = 0;
  uint64_t id = 0;
  uint64_t bytes = 0;
};

NamedObjects::NamedObjects(const NamedObjectsConfig& config, Scheduler& scheduler,
                           ActorSystem& system, AppActors& line)
    : config_(config),
      scheduler_(scheduler),
      system_(system),
      line_(line),
      places_(config.known),
      keys_(config.known),
      server_(fetch_config(config), cache_config(config), places_, *this, *this, scheduler, system,
              jitter_of(config.self)) {
  line.add_line(line_number, [this](const Mail& mail) { take_message(mail); });
}

size_t NamedObjects::max_timers() {
  return PartServer::max_timers(fetch_config({}));
}

// ---- objects of this node

Result<void> NamedObjects::put(std::string_view name, std::span<const std::byte> bytes) {
  if (bytes.empty()) return problem(fmt::format("object '{}': it has no bytes", name));
  if (bytes.size() > config_.max_object_bytes)
    return problem(fmt::format(
        "object '{}': it has {} bytes, and max_object_bytes is {}: raise that at all nodes, or "
        "cut the object into parts",
        name, bytes.size(), config_.max_object_bytes));
  const ObjectId id = object_id_of(bytes);
  if (const auto at = held_.find(name_hash(name)); at != held_.end()) {
    if (at->second.id == id) return {};
    return problem(fmt::format(
        "object '{}': this node holds other bytes under this name, and an object never changes: "
        "give the new one a name of its own",
        name));
  }
  if (!content_.contains(id.value)) {
    if (held_bytes_ + bytes.size() > config_.store_bytes)
      return problem(fmt::format("object '{}': {} bytes do not fit, since {} of store_bytes, {}, "
                                 "are taken: raise store_bytes, or put it at another node",
                                 name, bytes.size(), held_bytes_, config_.store_bytes),
                     ProblemKind::no_room);
    held_bytes_ += bytes.size();
    content_[id.value] = shared_copy(bytes);
  }
  held_[name_hash(name)] = {id, bytes.size()};
  return {};
}

SharedBytes NamedObjects::find(ObjectId object) {
  const auto at = content_.find(object.value);
  return at == content_.end() ? SharedBytes{} : at->second;
}

void NamedObjects::build(uint32_t object, SharedBytes bytes, Client& client) {
  client.built(object, {std::make_shared<KeptBytes>(std::move(bytes))});
}

// ---- objects of others

Result<std::span<const std::byte>> NamedObjects::get(std::string_view name) {
  if (++asked_ % hits_at_once == 0 && scheduler_.fibers().yield() == Wake::cancelled)
    return node_leaves();
  const uint64_t key = name_hash(name);
  if (const auto at = held_.find(key); at != held_.end()) return find(at->second.id).bytes;
  // Where a name leads may be out of date: its holders have ended, and others hold it now.
  for (int attempt = 0; attempt < 2; ++attempt) {
    const Result<uint32_t> slot = locate(name, key);
    if (!slot) return slot.problem();
    const Got got = server_.cache().get(slot.value());
    if (got.how == Got::How::cancelled) return node_leaves();
    if (got.how == Got::How::resident)
      return static_cast<const KeptBytes&>(*got.object).wire_bytes().bytes;
    if (places_[slot.value()].wire_bytes > 0 && keys_[slot.value()] == key &&
        server_.cache().state(slot.value()) == ObjectState::absent)
      forget(slot.value());
  }
  return problem(fmt::format("object '{}': no node that holds it gives it whole", name),
                 ProblemKind::lost_peer);
}

/// The slot of a name, after asking the other nodes if it is not known.
Result<uint32_t> NamedObjects::locate(std::string_view name, uint64_t key) {
  Fibers& fibers = scheduler_.fibers();
  for (;;) {
    const auto at = slots_.find(key);
    const auto other = searches_.find(key);
    const bool may_ask = first_rounds_ < names_at_once;
    const bool asks = at == slots_.end() && other == searches_.end();
    if (asks && may_ask) break;
    if (may_ask) fibers.wake_one(turn_);  // this fiber does not need the turn that woke it
    if (at != slots_.end()) return at->second;
    if (fibers.wait(asks ? turn_ : other->second->others, "where is it") == Wake::cancelled)
      return node_leaves();
  }
  Search search;
  search.open.assign(config_.nodes, true);
  search.open[config_.self.value] = false;
  search.open_count = config_.nodes - 1;
  searches_[key] = &search;
  const Wake how = ask_all(search, key, scheduler_.clock().now() + config_.patience);
  searches_.erase(key);
  fibers.wake_all(search.others);
  if (search.slot) return *search.slot;
  if (how == Wake::cancelled) return node_leaves();
  if (search.open_count == 0)
    return problem(fmt::format("object '{}': no node holds it", name), ProblemKind::not_found);
  return problem(fmt::format("object '{}': {} of {} other nodes do not hold it, and the others did "
                             "not answer within {} s, or this node has no room for what they "
                             "hold: see max_object_bytes and objects",
                             name, config_.nodes - 1 - search.open_count, config_.nodes - 1,
                             seconds_in(config_.patience)),
                 ProblemKind::lost_peer);
}

/// Asks all nodes that have not answered, until one has it, all have denied it, or it is too late.
Wake NamedObjects::ask_all(Search& search, uint64_t key, Nanoseconds end) {
  const SharedBytes content = shared_copy(std::as_bytes(std::span(&key, 1)));
  const MessageId id = system_.next_id();
  Nanoseconds wait = first_round;
  Wake how = Wake::woken;
  bool first = true;
  ++first_rounds_;
  const auto end_first_round = [&] {
    if (!std::exchange(first, false)) return;
    --first_rounds_;
    scheduler_.fibers().wake_one(turn_);
  };
  while (!search.slot && search.open_count > 0 && how != Wake::cancelled) {
    const Nanoseconds now = scheduler_.clock().now();
    if (now >= end) break;
    bool full = false;
    for (uint16_t node = 0; node < config_.nodes; ++node)
      if (search.open[node])
        full |= line_.send({line_number, line_number, where, false}, {node}, id, content) ==
                SendOutcome::full;
    // What had no room to leave is asked again soon.
    const Nanoseconds round_ends = std::min(end, now + (full ? retry_after : wait));
    while (!search.slot && search.open_count > 0 && how == Wake::woken)
      how = scheduler_.wait_until(search.asker, round_ends, "where is it");
    if (how == Wake::timed_out) how = Wake::woken;
    if (!full) wait = std::min(2 * wait, longest_round);
    end_first_round();
  }
  end_first_round();
  return how;
}

std::optional<NamedObjects::Found> NamedObjects::own_knowledge(uint64_t key) {
  if (const auto at = held_.find(key); at != held_.end())
    return Found{key, at->second.id.value, at->second.bytes};
  const auto slot = slots_.find(key);
  if (slot == slots_.end() || server_.cache().state(slot->second) != ObjectState::resident)
    return std::nullopt;
  return Found{key, places_[slot->second].id.value, places_[slot->second].wire_bytes};
}

void NamedObjects::take_message(const Mail& mail) {
  Found told;
  if (mail.bytes().size() < sizeof told.key) return;
  std::memcpy(&told.key, mail.bytes().data(), sizeof told.key);
  if (mail.schema == where) return answer_where(mail, told.key);
  if (mail.schema == here && mail.bytes().size() == sizeof told) {
    std::memcpy(&told, mail.bytes().data(), sizeof told);
    return learn(mail.from.node, told);
  }
  const auto at = searches_.find(told.key);
  if (mail.schema != not_here || at == searches_.end()) return;
  Search& search = *at->second;
  if (mail.from.node.value >= config_.nodes || !search.open[mail.from.node.value]) return;
  search.open[mail.from.node.value] = false;
  if (--search.open_count == 0) scheduler_.fibers().wake_one(search.asker);
}

void NamedObjects::answer_where(const Mail& mail, uint64_t key) {
  const std::optional<Found> found = own_knowledge(key);
  const Found told = found ? *found : Found{key};
  const size_t bytes = found ? sizeof told : sizeof key;
  const uint64_t word = found ? here : not_here;
  // If there is no room to send it, the other node asks again.
  (void)line_.send({line_number, line_number, word, false}, mail.from.node, mail.id,
                   shared_copy(std::as_bytes(std::span(&told, 1)).first(bytes)));
}

/// A node has told that it holds an object. Further holders of an object that is known are noted
/// beside the first, for when that one ends.
void NamedObjects::learn(NodeId holder, const Found& found) {
  if (found.bytes == 0 || found.bytes > config_.max_object_bytes) return;
  if (holder.value >= config_.nodes || holder == config_.self) return;
  if (const auto at = slots_.find(found.key); at != slots_.end()) {
    ObjectPlace& place = places_[at->second];
    const bool same = place.id.value == found.id && place.wire_bytes == found.bytes;
    const bool known = std::count(place.holders.begin(), place.holders.end(), holder) > 0;
    if (same && !known && place.holders.size() < limits::holders) place.holders.push_back(holder);
    return;
  }
  const auto search = searches_.find(found.key);
  if (search == searches_.end() || search->second->slot) return;
  const std::optional<uint32_t> slot = free_slot();
  if (!slot) return;
  ObjectPlace& place = places_[*slot];
  place.id = {found.id};
  place.wire_bytes = found.bytes;
  place.holders.assign(1, holder);
  keys_[*slot] = found.key;
  slots_[found.key] = *slot;
  server_.enter(place.id, *slot);
  search->second->slot = *slot;
  scheduler_.fibers().wake_one(search->second->asker);
}

/// A slot without an object, or one whose object is absent and forgotten for it.
std::optional<uint32_t> NamedObjects::free_slot() {
  for (size_t n = 0; n < places_.size(); ++n) {
    const uint32_t slot = hand_;
    hand_ = static_cast<uint32_t>((hand_ + 1) % places_.size());
    if (places_[slot].wire_bytes == 0) return slot;
    // One that a search has just found is not fetched yet.
    const bool wanted = searches_.contains(keys_[slot]);
    if (wanted || server_.cache().state(slot) != ObjectState::absent) continue;
    forget(slot);
    return slot;
  }
  return std::nullopt;
}

void NamedObjects::forget(uint32_t slot) {
  server_.forget(places_[slot].id, slot);
  slots_.erase(keys_[slot]);
  places_[slot] = {};
}

}  // namespace luxodus
