#include "runtime/net/delayed_transport.hpp"

#include <algorithm>
#include <cstring>

namespace luxodus {

Sent DelayedTransport::send(NodeId neighbour, Lane lane, std::span<const std::byte> head,
                            std::span<const std::byte> body) {
  const Nanoseconds now = clock_.now();
  stamped_.resize(sizeof now + head.size());
  std::memcpy(stamped_.data(), &now, sizeof now);
  std::copy(head.begin(), head.end(), stamped_.begin() + sizeof now);
  return below_.send(neighbour, lane, stamped_, body);
}

std::optional<Arrival> DelayedTransport::receive() {
  if (auto arrival = take_due()) return arrival;
  take_in();
  return take_due();
}

void DelayedTransport::take_in() {
  while (held_bytes_ < held_most_) {
    const auto arrival = below_.receive();
    if (!arrival) return;
    Nanoseconds sent = 0;
    if (arrival->bytes.size() < sizeof sent) {
      ++unstamped_;
      continue;
    }
    std::memcpy(&sent, arrival->bytes.data(), sizeof sent);
    const auto frame = arrival->bytes.subspan(sizeof sent);
    auto& heap = held_[static_cast<size_t>(arrival->lane)];
    // Never longer than the delay from now, whatever the frame says.
    const Nanoseconds due = std::clamp<Nanoseconds>(sent, 0, clock_.now()) + delay_;
    heap.push_back({due, arrived_++, arrival->neighbour, {frame.begin(), frame.end()}});
    std::push_heap(heap.begin(), heap.end(), later);
    held_bytes_ += frame.size();
  }
}

std::optional<Arrival> DelayedTransport::take_due() {
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

void DelayedTransport::wait_until(Nanoseconds until) {
  for (const auto& heap : held_)
    if (!heap.empty()) until = std::min(until, heap.front().due);
  below_.wait_until(until);
}

}  // namespace luxodus
