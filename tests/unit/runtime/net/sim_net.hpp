// An in-memory network for tests. Frames are in flight until arrive() is called, so that all nodes
// act on what was sent before, as distant nodes do. Faults are drawn from a seed. One thread.
#pragma once

#include <algorithm>
#include <cstring>
#include <deque>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "runtime/core/random.hpp"
#include "runtime/net/transport.hpp"

namespace luxodus::test {

struct SimFaults {
  float loss = 0;  // fractions of frames
  float twice = 0;
  float reorder = 0;  // a frame goes to the front of its queue
  float flipped_bit = 0;
  size_t capacity = 1'000'000;  // frames in one queue; beyond it the transport is full
};

class SimNet {
 public:
  explicit SimNet(uint64_t seed = 1) : random_(seed, RandomStream::test) { random_.start(0); }

  SimFaults faults;

  /// Frames between these two are lost, while sends return "taken".
  void cut(NodeId a, NodeId b) { cut_.insert(std::minmax(a, b)); }
  void heal() { cut_.clear(); }
  /// Sends to this node return "unreachable"; frames in flight to it are lost.
  void leave(NodeId node) {
    absent_.insert(node);
    for (auto* all : {&queues_, &on_way_})
      for (auto& [way, queue] : *all)
        if (std::get<1>(way) == node) queue.clear();
  }
  void join(NodeId node) { absent_.erase(node); }

  Sent send(NodeId from, NodeId to, Lane lane, std::span<const std::byte> head,
            std::span<const std::byte> body) {
    if (absent_.contains(to)) return Sent::unreachable;
    auto& queue = on_way_[{from, to, lane}];
    if (queue.size() + queues_[{from, to, lane}].size() >= faults.capacity) return Sent::full;
    if (cut_.contains(std::minmax(from, to)) || happens(faults.loss)) return Sent::taken;
    std::vector<std::byte> frame(head.begin(), head.end());
    frame.insert(frame.end(), body.begin(), body.end());
    if (happens(faults.flipped_bit)) {
      const uint32_t bit = random_.bits() % static_cast<uint32_t>(8 * frame.size());
      frame[bit / 8] ^= static_cast<std::byte>(1u << (bit % 8));
    }
    if (recorded.size() < max_record) recorded.push_back(frame);
    if (happens(faults.twice)) queue.push_back(frame);
    if (happens(faults.reorder))
      queue.push_front(std::move(frame));
    else
      queue.push_back(std::move(frame));
    ++frames;
    return Sent::taken;
  }

  /// Delivers the frames in flight.
  void arrive() {
    for (auto& [way, frames_on_way] : on_way_) {
      auto& queue = queues_[way];
      std::move(frames_on_way.begin(), frames_on_way.end(), std::back_inserter(queue));
      frames_on_way.clear();
    }
  }

  /// The next frame for this node, neighbours in turn, control before bulk.
  std::optional<std::pair<NodeId, Lane>> receive(NodeId at, std::vector<std::byte>& frame) {
    for (const Lane lane : {Lane::control, Lane::bulk}) {
      auto& turn = turns_[{at, lane}];
      auto best = queues_.end();
      for (auto way = queues_.begin(); way != queues_.end(); ++way) {
        if (std::get<1>(way->first) != at || std::get<2>(way->first) != lane) continue;
        if (way->second.empty()) continue;
        if (best == queues_.end()) best = way;
        if (std::get<0>(way->first).value > turn) {
          best = way;
          break;
        }
      }
      if (best == queues_.end()) continue;
      frame = std::move(best->second.front());
      best->second.pop_front();
      turn = std::get<0>(best->first).value;
      return std::pair{std::get<0>(best->first), lane};
    }
    return std::nullopt;
  }

  uint64_t frames = 0;
  /// The first `max_record` frames that were sent.
  std::vector<std::vector<std::byte>> recorded;
  size_t max_record = 0;

 private:
  bool happens(float share) { return share > 0 && random_.uniform() < share; }

  using Way = std::tuple<NodeId, NodeId, Lane>;
  Random random_;
  std::map<Way, std::deque<std::vector<std::byte>>> queues_, on_way_;
  std::map<std::pair<NodeId, Lane>, uint16_t> turns_;
  std::set<std::pair<NodeId, NodeId>> cut_;
  std::set<NodeId> absent_;
};

class SimTransport final : public Transport {
 public:
  SimTransport(SimNet& net, NodeId self) : net_(net), self_(self) {}

  Sent send(NodeId neighbour, Lane lane, std::span<const std::byte> head,
            std::span<const std::byte> body) override {
    return net_.send(self_, neighbour, lane, head, body);
  }
  void renew(NodeId neighbour) override { renewed.push_back(neighbour); }
  std::optional<Arrival> receive() override {
    const auto from = net_.receive(self_, frame_);
    if (!from) return std::nullopt;
    // At an odd address, as on a real network.
    shifted_.resize(frame_.size() + 1);
    if (!frame_.empty()) std::memcpy(shifted_.data() + 1, frame_.data(), frame_.size());
    return Arrival{from->first, from->second, std::span(shifted_).subspan(1)};
  }
  void wait_until(Nanoseconds) override {}
  void wake() noexcept override {}

  std::vector<NodeId> renewed;

 private:
  SimNet& net_;
  NodeId self_;
  std::vector<std::byte> frame_, shifted_;
};

}  // namespace luxodus::test
