#include "runtime/net/router.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace luxodus {

namespace {
/// Frames moved in one turn: small ones take 0.5 ms.
constexpr size_t frames_per_turn = 256;
/// Bytes moved in one turn: 16 chunks of 64 KB are 1.3 ms of TCP on one host.
constexpr size_t bytes_per_turn = 1 << 20;
}  // namespace

Router::Router(const NetConfig& config, NetCounters& counters, std::vector<Link>& links,
               Destination& here)
    : config_(config), counters_(counters), links_(links), here_(here), next_(config.nodes) {
  outboxes_.reserve(routed_kinds.size());
  for (const Kind kind : routed_kinds)
    outboxes_.emplace_back(config.outbox_messages, config.chunk_bytes(kind));
}

void Router::use(NextHops hops) {
  if (hops.next.size() != config_.nodes)
    throw std::invalid_argument("a next-hop table must name every node");
  for (size_t node = 0; node < hops.next.size(); ++node) {
    next_[node] = nullptr;
    if (hops.next[node] == no_node || node == config_.self.value) continue;
    const auto link = std::find_if(links_.begin(), links_.end(),
                                   [&](const Link& l) { return l.neighbour() == hops.next[node]; });
    if (link == links_.end()) throw std::invalid_argument("a next hop must be a neighbour");
    next_[node] = &*link;
  }
}

Link* Router::hop_to(NodeId destination) const {
  return destination.value < next_.size() ? next_[destination.value] : nullptr;
}

bool Router::pump(uint64_t epoch, Nanoseconds now) {
  epoch_ = epoch;
  budget_ = frames_per_turn;
  bytes_left_ = bytes_per_turn;
  for (const Kind kind : routed_kinds)
    while (budget_ > 0 && pump_kind(kind, now)) {
    }
  if (!links_.empty()) first_link_ = (first_link_ + 1) % links_.size();
  return budget_ == 0;
}

/// The last frame of a turn may exceed the budget.
void Router::spend(size_t bytes) {
  bytes_left_ -= std::min(bytes, bytes_left_);
  budget_ = bytes_left_ == 0 ? 0 : budget_ - 1;
}

bool Router::pump_kind(Kind kind, Nanoseconds now) {
  bool moved = false;
  // The highest class first: it is nearest to leaving the network, and frees buffers that others
  // wait for.
  for (uint8_t hops = config_.hop_limit; hops >= 1; --hops)
    for (size_t i = 0; i < links_.size(); ++i)
      moved |= step(links_[(first_link_ + i) % links_.size()], kind, hops, now);
  moved |= step_outbox(kind, now);
  return moved;
}

bool Router::step(Link& from, Kind kind, uint8_t hop_class, Nanoseconds now) {
  const FrameRing& pool = from.pool(kind, hop_class);
  if (pool.empty() || budget_ == 0) return false;
  const FrameRing::Frame frame = pool.front();
  if (frame.envelope.destination == config_.self) {
    if (!here_.take(frame.envelope, frame.body, now)) return false;
  } else if (Link* to = hop_to(frame.envelope.destination); to == nullptr) {
    ++counters_.dropped_unreachable;
  } else {
    Envelope onward = frame.envelope;
    ++onward.hops;
    if (to->send(onward, frame.body, now) != Link::Gone::sent) return false;
    ++counters_.frames_forwarded;
  }
  spend(frame.body.size());
  from.release(kind, hop_class);
  return true;
}

bool Router::step_outbox(Kind kind, Nanoseconds now) {
  Outbox& waiting = outbox(kind);
  for (size_t n = 0; n < waiting.size() && budget_ > 0; ++n) {
    Link* to = hop_to(waiting.destination(n));
    if (to == nullptr) {
      ++counters_.dropped_unreachable;
      waiting.drop(n);
      return true;
    }
    Envelope envelope;
    envelope.source = config_.self;
    envelope.kind = kind;
    envelope.hops = 1;
    envelope.epoch = epoch_;
    const auto chunk = waiting.chunk(n, envelope);
    if (to->send(envelope, chunk, now) != Link::Gone::sent) continue;
    spend(chunk.size());
    if (waiting.advance(n)) ++counters_.messages_sent;
    return true;
  }
  return false;
}

}  // namespace luxodus
