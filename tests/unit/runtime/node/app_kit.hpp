// Nodes of an application in a network in memory, with a clock that a test advances. One thread.
#pragma once

#include <spdlog/spdlog.h>

#include <catch2/catch.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "runtime/node/node.hpp"
#include "tests/unit/runtime/net/sim_net.hpp"

namespace luxodus::test {

/// Options of node `self` of so many. Nobody listens at the endpoints.
inline NodeOptions options_of(uint16_t self, uint16_t nodes) {
  NodeOptions options;
  options.self = self;
  for (int i = 0; i < nodes; ++i)
    options.nodes.push_back("tcp://127.0.0.1:" + std::to_string(7400 + 2 * i));
  return options;
}

class AppCluster {
 public:
  /// `change` may change the options of each.
  explicit AppCluster(uint16_t nodes, std::function<void(NodeOptions&)> change = {})
      : count_(nodes), change_(std::move(change)), nodes_(nodes), transports_(nodes) {
    spdlog::set_level(spdlog::level::off);
    for (uint16_t i = 0; i < nodes; ++i) make(i);
  }

  SimNet net;
  ManualClock clock{seconds(1)};

  Node& operator[](size_t i) { return *nodes_[i]; }
  void start() {
    for (const auto& node : nodes_) REQUIRE(node->start().ok());
  }
  void turn(Nanoseconds by = milliseconds(1)) {
    for (int round = 0; round < 3; ++round) {
      for (const auto& node : nodes_)
        if (node && !node->finished()) node->turn();
      net.arrive();
    }
    clock.advance(by);
  }
  void run(Nanoseconds span, Nanoseconds step = milliseconds(10)) {
    for (Nanoseconds t = 0; t < span; t += step) turn(step);
  }
  /// Turns until it holds; fails the test after `most`.
  void until(const std::function<bool()>& holds, Nanoseconds most = seconds(60)) {
    const Nanoseconds end = clock.now() + most;
    while (!holds()) {
      REQUIRE(clock.now() < end);
      turn();
    }
  }
  /// The node crashes: nobody is told.
  void kill(uint16_t i) {
    net.leave({i});
    nodes_[i].reset();
  }
  /// A node in the place of one that was killed, to be given its actors and started.
  Node& revive(uint16_t i) {
    net.join({i});
    make(i);
    return *nodes_[i];
  }

 private:
  void make(uint16_t i) {
    NodeOptions options = options_of(i, count_);
    if (change_) change_(options);
    nodes_[i].reset();
    transports_[i] = std::make_unique<SimTransport>(net, NodeId{i});
    nodes_[i] = std::make_unique<Node>(options, clock, *transports_[i]);
  }

  const uint16_t count_;
  const std::function<void(NodeOptions&)> change_;
  std::vector<std::unique_ptr<Node>> nodes_;
  std::vector<std::unique_ptr<SimTransport>> transports_;
};

}  // namespace luxodus::test
