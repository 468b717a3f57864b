#include "runtime/net/link.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <utility>
#include <variant>

#include "runtime/core/log.hpp"
#include "runtime/net/handshake.hpp"

namespace luxodus {

namespace {
/// Between reconnecting to a neighbour that has refused this node and the next hello.
constexpr Nanoseconds reconnection = seconds(1);
}  // namespace

Link::Link(const LinkSurroundings& around, NodeId neighbour, Nanoseconds now)
    : around_(around), neighbour_(neighbour), state_(around.config.times, now) {
  pools_.reserve(routed_kinds.size() * around.config.hop_limit);
  for (const Kind kind : routed_kinds)
    for (int hops = 1; hops <= around.config.hop_limit; ++hops)
      pools_.emplace_back(around.config.window_bytes(kind), around.config.chunk_bytes(kind));
}

size_t Link::index(Kind kind, uint8_t hop_class) const {
  return (static_cast<size_t>(kind) - 1) * around_.config.hop_limit + (hop_class - 1u);
}

size_t Link::memory_bytes() const {
  size_t sum = 0;
  for (const Pool& pool : pools_) sum += pool.frames.memory_bytes();
  return sum;
}

size_t Link::memory_bytes(const NetConfig& config) {
  size_t sum = 0;
  for (const Kind kind : routed_kinds)
    sum += config.hop_limit *
           FrameRing::memory_bytes(config.window_bytes(kind), config.chunk_bytes(kind));
  return sum;
}

uint64_t Link::credit_bytes() const {
  uint64_t sum = 0;
  for (const Pool& pool : pools_) sum += pool.out.left();
  return sum;
}

uint64_t Link::held_bytes() const {
  uint64_t sum = 0;
  for (const Pool& pool : pools_) sum += pool.in.held();
  return sum;
}

// ---- sending

Sent Link::give(const Envelope& envelope, std::span<const std::byte> body, Lane lane) {
  alignas(8) std::array<std::byte, limits::frame_head_bytes> head;
  const size_t head_bytes = around_.codec.encode(envelope, body, head);
  const Sent sent = around_.transport.send(neighbour_, lane, {head.data(), head_bytes}, body);
  switch (sent) {
    case Sent::taken:
      ++around_.counters.frames_sent;
      around_.counters.bytes_sent += head_bytes + body.size();
      bytes_sent_ += head_bytes + body.size();
      break;
    case Sent::full:
      ++around_.counters.transport_full;
      break;
    case Sent::unreachable:
      ++around_.counters.transport_unreachable;
      break;
  }
  return sent;
}

Envelope Link::link_envelope() const {
  Envelope envelope;
  envelope.from = envelope.source = around_.config.self;
  envelope.from_incarnation = around_.config.incarnation;
  envelope.to_incarnation = state_.accepted() ? state_.peer() : Incarnation{};
  envelope.destination = neighbour_;
  return envelope;
}

Sent Link::say(const Message& message, Lane lane, std::optional<Incarnation> to) {
  const auto bytes = around_.codec.encode(message, around_.scratch);
  if (!bytes) throw std::logic_error("link: " + bytes.problem().what);
  Envelope envelope = link_envelope();
  if (to) envelope.to_incarnation = *to;
  envelope.total_bytes = static_cast<uint32_t>(bytes.value());
  return give(envelope, around_.scratch.first(bytes.value()), lane);
}

void Link::tick(Nanoseconds now) {
  state_.tick(now);
  if (!state_.hello_due(now)) return;
  if (std::exchange(parted_, false)) {
    around_.transport.renew(neighbour_);
    return state_.postpone_until(now + reconnection);
  }
  const Sent sent = say(Message{Hello{around_.config.identity}}, Lane::control);
  if (sent == Sent::taken)
    state_.greeted(now);
  else
    state_.unreachable(now);
}

void Link::beat(uint64_t view_hash, Nanoseconds now) {
  if (!state_.accepted()) return;
  for (const Lane lane : {Lane::control, Lane::bulk}) {
    Beat beat;
    beat.view_hash = view_hash;
    for (const Kind kind : routed_kinds) {
      if (lane_of(kind) != lane) continue;
      for (uint8_t hops = 1; hops <= around_.config.hop_limit; ++hops) {
        Pool& pool = at(kind, hops);
        beat.pools.push_back({kind, hops, pool.out.sent(), pool.in.announce()});
      }
    }
    const Sent sent = say(Message{beat}, lane);  // if it is full, the next beat repeats it
    if (sent == Sent::unreachable && around_.config.falls_with_connection)
      return state_.unreachable(now);
  }
}

void Link::say_bye() {
  // the heartbeat timeout has the same effect
  if (state_.accepted()) (void)say(Message{Bye{}}, Lane::control);
}

void Link::say(const LinkChanges& changes) {
  if (state_.usable()) (void)say(Message{changes}, Lane::control);  // repeated while views differ
}

void Link::tell_grants() {
  if (!state_.usable()) return;
  for (const Kind kind : routed_kinds)
    for (uint8_t hops = 1; hops <= around_.config.hop_limit; ++hops) {
      if (!at(kind, hops).in.overdue()) continue;
      Envelope envelope = link_envelope();
      envelope.grant = {kind, hops, at(kind, hops).in.announce()};
      (void)give(envelope, {}, Lane::control);  // the next beat repeats it
    }
}

Grant Link::next_grant() {
  for (size_t tried = 0; tried < pools_.size(); ++tried) {
    grant_cursor_ = (grant_cursor_ + 1) % pools_.size();
    CreditIn& in = pools_[grant_cursor_].in;
    if (!in.news()) continue;
    const auto kind = static_cast<Kind>(1 + grant_cursor_ / around_.config.hop_limit);
    const auto hops = static_cast<uint8_t>(1 + grant_cursor_ % around_.config.hop_limit);
    return {kind, hops, in.announce()};
  }
  return {};
}

Link::Gone Link::send(Envelope envelope, std::span<const std::byte> body, Nanoseconds now) {
  if (!state_.usable()) return Gone::not_now;
  CreditOut& out = at(envelope.kind, envelope.hops).out;
  const size_t charge = frame_charge(body.size());
  if (!out.allows(charge)) return Gone::not_now;
  envelope.from = around_.config.self;
  envelope.from_incarnation = around_.config.incarnation;
  envelope.to_incarnation = state_.peer();
  envelope.sent = out.sent() + charge;
  envelope.grant = next_grant();
  switch (give(envelope, body, lane_of(envelope.kind))) {
    case Sent::taken:
      out.spend(charge);
      return Gone::sent;
    case Sent::unreachable:
      state_.unreachable(now);
      break;
    case Sent::full:
      break;
  }
  return Gone::not_now;
}

// ---- receiving

bool Link::take(const Envelope& envelope, Lane lane, const Message& message, Nanoseconds now) {
  const bool was_usable = state_.usable();
  bool current = true;
  if (const auto* hello = std::get_if<Hello>(&message)) {
    meet(envelope, hello->identity, false, now);
  } else if (const auto* welcome = std::get_if<Welcome>(&message)) {
    meet(envelope, welcome->identity, true, now);
  } else if (const auto* refuse = std::get_if<Refuse>(&message)) {
    // A node that refuses has accepted no incarnation of ours, so it names none; but it may be a
    // past incarnation itself. If it refuses an earlier incarnation of this node, it names that
    // one.
    current = (!state_.accepted() || envelope.from_incarnation == state_.peer()) &&
              (envelope.to_incarnation == Incarnation{} ||
               envelope.to_incarnation == around_.config.incarnation);
    if (current) be_refused(*refuse, now);
  } else {
    current = admits(envelope, now);
    if (current && std::holds_alternative<Bye>(message)) {
      state_.bye(now);
      works_for_.clear();
    }
    if (const auto* beat = std::get_if<Beat>(&message); current && beat) settle(*beat, lane);
  }
  if (!current) ++around_.counters.dropped_stale;
  note_rise(was_usable, now);
  return current;
}

void Link::meet(const Envelope& envelope, const Identity& theirs, bool welcomed, Nanoseconds now) {
  if (const auto no = refusal(around_.config.identity, theirs, neighbour_)) {
    const auto reason = static_cast<size_t>(no->reason);
    ++around_.counters.refused[reason];
    if (log_refusal_[reason].may(now))
      log_error("link=refused node={} neighbour={} reason={} text=\"{}\"",
                around_.config.self.value, neighbour_.value, name_of(no->reason), no->text);
    state_.refuse(now);
    refusal_ = no->text;
    refused_for_ = no->reason;
    (void)say(Message{*no}, Lane::control);  // a peer that misses it asks again
    return;
  }
  if (taken(envelope, theirs, now)) return;
  if (!theirs.results.empty()) works_for_ = theirs.results;
  if (state_.accept(envelope.from_incarnation, now))
    for (Pool& pool : pools_) {
      pool.out.restart();
      pool.in.restart();
    }
  if (envelope.to_incarnation == around_.config.incarnation) state_.acknowledge(now);
  if (!welcomed) (void)say(Message{Welcome{around_.config.identity}}, Lane::control);
}

/// Two controllers of one cluster file have the same name and identity, except for the results'
/// path. A node works for the first one it hears: if the second were taken for a restart of the
/// first, each would take the node from the other forever. The link itself stays as it is.
bool Link::taken(const Envelope& envelope, const Identity& theirs, Nanoseconds now) {
  if (theirs.results.empty() || works_for_.empty() || theirs.results == works_for_) return false;
  const auto reason = static_cast<size_t>(RefusalReason::taken);
  const Refuse no{
      RefusalReason::taken,
      fmt::format("node {} works for the run whose results go to {}, not for that of {}",
                  around_.config.self.value, works_for_, theirs.results)
          .substr(0, limits::text_bytes)};
  ++around_.counters.refused[reason];
  if (log_refusal_[reason].may(now))
    log_error("link=refused node={} neighbour={} reason={} text=\"{}\"", around_.config.self.value,
              neighbour_.value, name_of(no.reason), no.text);
  (void)say(Message{no}, Lane::control, envelope.from_incarnation);
  return true;
}

void Link::be_refused(const Refuse& refuse, Nanoseconds now) {
  const auto reason = static_cast<size_t>(refuse.reason);
  if (log_being_refused_[reason].may(now))
    log_error("link=refused_by_peer node={} neighbour={} reason={} text=\"{}\"",
              around_.config.self.value, neighbour_.value, name_of(refuse.reason), refuse.text);
  ++around_.counters.refused_by_peer[reason];
  state_.refuse(now);
  refusal_ = refuse.text;
  refused_for_ = refuse.reason;
  parted_ = true;
  around_.transport.part(neighbour_);
}

void Link::note_rise(bool was_usable, Nanoseconds now) {
  if (was_usable || !state_.usable()) return;
  state_.heard(now);
  ++sessions_;
}

void Link::settle(const Beat& beat, Lane lane) {
  for (const PoolState& told : beat.pools) {
    if (told.kind == Kind::link || told.hop_class == 0) continue;
    if (told.hop_class > around_.config.hop_limit || lane_of(told.kind) != lane) continue;
    at(told.kind, told.hop_class).in.settle(told.sent);
    use({told.kind, told.hop_class, told.limit});
  }
}

void Link::use(const Grant& grant) {
  if (grant.kind == Kind::link || grant.hop_class == 0) return;
  if (grant.hop_class > around_.config.hop_limit) return;
  at(grant.kind, grant.hop_class).out.grant(grant.limit);
}

bool Link::admits(const Envelope& envelope, Nanoseconds now) {
  if (!state_.accepted() || envelope.from_incarnation != state_.peer()) return false;
  if (envelope.to_incarnation != around_.config.incarnation) return false;
  const bool was_usable = state_.usable();
  state_.acknowledge(now);
  note_rise(was_usable, now);
  use(envelope.grant);
  return true;
}

bool Link::hold(const Envelope& envelope, std::span<const std::byte> body) {
  Pool& pool = at(envelope.kind, envelope.hops);
  if (!pool.in.arrive(envelope.sent, frame_charge(body.size()))) return false;
  pool.frames.push(envelope, body);
  return true;
}

bool Link::pass(const Envelope& envelope, size_t body_bytes) {
  CreditIn& in = at(envelope.kind, envelope.hops).in;
  const size_t charge = frame_charge(body_bytes);
  if (!in.arrive(envelope.sent, charge)) return false;
  in.release(charge);
  return true;
}

void Link::release(Kind kind, uint8_t hop_class) {
  Pool& pool = at(kind, hop_class);
  pool.in.release(frame_charge(pool.frames.front().body.size()));
  pool.frames.pop();
}

}  // namespace luxodus
