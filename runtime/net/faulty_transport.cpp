#include "runtime/net/faulty_transport.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "runtime/core/log.hpp"

namespace luxodus {

namespace {

/// Exit code as after SIGKILL.
constexpr int crashed = 128 + 9;

FaultyConfig complete(FaultyConfig config) {
  if (!config.stand_still)
    config.stand_still = [](Nanoseconds span) {
      std::this_thread::sleep_for(std::chrono::nanoseconds(span));
    };
  if (!config.crash) config.crash = [] { std::_Exit(crashed); };
  return config;
}

}  // namespace

FaultyTransport::FaultyTransport(Transport& below, FaultyConfig config, const Clock& clock)
    : below_(below),
      config_(complete(std::move(config))),
      clock_(clock),
      began_(clock.now()),
      troubles_(config_.plan.links, config_.plan.seed, config_.self.value),
      working_since_(began_) {}

// ---- out ---------------------------------------------------------------------------------------

/// Whether a fault holds on the way from this node to the neighbour; a disconnect affects both
/// ends.
bool FaultyTransport::holds(Fault::Kind kind, NodeId neighbour) const {
  const bool both = kind == Fault::Kind::disconnect;
  return std::any_of(config_.plan.faults.begin(), config_.plan.faults.end(), [&](const Fault& f) {
    const bool forth = f.node == config_.self && f.peer == neighbour;
    const bool back = both && f.peer == config_.self && f.node == neighbour;
    return f.kind == kind && (forth || back) && f.holds(moment());
  });
}

Nanoseconds FaultyTransport::clogged_for(NodeId neighbour) const {
  Nanoseconds longest = 0;
  for (const Fault& f : config_.plan.faults)
    if (f.kind == Fault::Kind::clog && f.node == config_.self && f.peer == neighbour &&
        f.holds(moment()))
      longest = std::max(longest, f.at + f.lasts - moment());
  return longest;
}

Sent FaultyTransport::send(NodeId neighbour, Lane lane, std::span<const std::byte> head,
                           std::span<const std::byte> body) {
  if (holds(Fault::Kind::disconnect, neighbour)) return Sent::unreachable;
  const size_t bytes = head.size() + body.size();
  const Nanoseconds now = clock_.now();
  Way& way = ways_[neighbour];
  way.free_at = std::max(way.free_at, now);
  if (way.free_at - now > troubles_.wire_time(config_.plan.links.queue_bytes)) return Sent::full;
  const FrameFate fate = troubles_.next(moment() >= config_.plan.healed_at);
  if (fate.lost || holds(Fault::Kind::cut, neighbour)) {
    ++counters_.lost;
    return Sent::taken;
  }
  frame_.resize(sizeof(Stamp));
  frame_.insert(frame_.end(), head.begin(), head.end());
  frame_.insert(frame_.end(), body.begin(), body.end());
  if (fate.harmed) {
    ++counters_.harmed;
    troubles_.harm(std::span(frame_).subspan(sizeof(Stamp)));
  }
  const Nanoseconds wire = way.free_at - now + troubles_.wire_time(bytes);
  const Nanoseconds before = std::max(wire, clogged_for(neighbour));
  const Sent sent = give(neighbour, lane, {now, before + fate.hold, fate.overtaken ? 1u : 0u});
  if (sent != Sent::taken) return sent;
  way.free_at = now + wire;
  counters_.overtaken += fate.overtaken ? 1 : 0;
  for (const auto& copy : {fate.again, fate.ghost}) {
    if (!copy) continue;
    ++counters_.duplicated;
    (void)give(neighbour, lane, {now, before + *copy, 1});
  }
  return Sent::taken;
}

/// Sends the frame in `frame_`.
Sent FaultyTransport::give(NodeId neighbour, Lane lane, const Stamp& stamp) {
  std::memcpy(frame_.data(), &stamp, sizeof stamp);
  return below_.send(neighbour, lane, frame_, {});
}

// ---- in ----------------------------------------------------------------------------------------

std::optional<Arrival> FaultyTransport::receive() {
  suffer();
  if (auto arrival = take_due()) return arrival;
  take_in();
  return take_due();
}

/// Applies the faults of this node.
void FaultyTransport::suffer() {
  for (const Fault& f : config_.plan.faults) {
    if (f.node != config_.self || !f.holds(moment())) continue;
    if (f.kind == Fault::Kind::crash || f.kind == Fault::Kind::pause)
      log_warning("fault={} node={} text=\"on purpose, by [faults]\"", name_of(f.kind),
                  config_.self.value);
    if (f.kind == Fault::Kind::crash) config_.crash();
    if (f.kind == Fault::Kind::pause) config_.stand_still(f.at + f.lasts - moment());
    if (f.kind == Fault::Kind::slow) {
      constexpr Nanoseconds too_short = microseconds(500);  // to sleep
      const Nanoseconds worked = clock_.now() - working_since_;
      if (worked < too_short) continue;
      config_.stand_still(static_cast<Nanoseconds>((f.factor - 1) * static_cast<double>(worked)));
    }
    working_since_ = clock_.now();
  }
}

void FaultyTransport::take_in() {
  while (held_bytes_ < config_.max_held) {
    const auto arrival = below_.receive();
    if (!arrival) return;
    if (arrival->bytes.size() < sizeof(Stamp))
      ++counters_.unstamped;
    else
      hold_back(*arrival);
  }
}

void FaultyTransport::hold_back(const Arrival& arrival) {
  Stamp stamp;
  std::memcpy(&stamp, arrival.bytes.data(), sizeof stamp);
  const auto frame = arrival.bytes.subspan(sizeof stamp);
  const Nanoseconds now = clock_.now();
  const Nanoseconds sent = config_.one_clock ? std::clamp<Nanoseconds>(stamp.sent, 0, now) : now;
  Nanoseconds due = sent + std::clamp<Nanoseconds>(stamp.hold, 0, limits::held_back_for);
  if (stamp.overtaken == 0) {
    Nanoseconds& last = ways_[arrival.neighbour].last_due[static_cast<size_t>(arrival.lane)];
    due = last = std::max(last, due);
  }
  auto& heap = held_[static_cast<size_t>(arrival.lane)];
  heap.push_back({due, arrived_++, arrival.neighbour, {frame.begin(), frame.end()}});
  std::push_heap(heap.begin(), heap.end(), later);
  held_bytes_ += frame.size();
}

std::optional<Arrival> FaultyTransport::take_due() {
  const Nanoseconds now = clock_.now();
  for (const Lane lane : {Lane::control, Lane::bulk}) {
    auto& heap = held_[static_cast<size_t>(lane)];
    if (heap.empty() || heap.front().due > now) continue;
    std::pop_heap(heap.begin(), heap.end(), later);
    given_ = std::move(heap.back());
    heap.pop_back();
    held_bytes_ -= given_.bytes.size();
    return Arrival{given_.neighbour, lane, given_.bytes};
  }
  return std::nullopt;
}

void FaultyTransport::wait_until(Nanoseconds until) {
  for (const auto& heap : held_)
    if (!heap.empty()) until = std::min(until, heap.front().due);
  below_.wait_until(until);
  working_since_ = clock_.now();
}

}  // namespace luxodus
