// How soon a failure is known, and how soon a link is used again: bounds in simulated time, with a
// rack's delays, for a link on which nothing else is sent.
#include <spdlog/spdlog.h>

#include <catch2/catch.hpp>
#include <memory>
#include <vector>

#include "runtime/node/node.hpp"
#include "runtime/sim/sim_world.hpp"
#include "tests/unit/runtime/node/app_kit.hpp"

using namespace luxodus;

namespace {

constexpr NodeId first{0}, second{1};
constexpr Nanoseconds fault_at = seconds(5);
constexpr LinkTimes times = app_link_times();

/// A node of an application as the simulated world drives it.
class SimulatedNode final : public SimNode {
 public:
  SimulatedNode(SimWorld& world, NodeId self)
      : node_(test::options_of(self.value, 2), world.clock(self), world.transport(self)) {
    REQUIRE(node_.start().ok());
  }
  Nanoseconds turn() override { return node_.turn(); }
  bool finished() const override { return node_.finished(); }
  void die() override { node_.die(); }
  bool is_up() const { return node_.is_up(node_.shell().network().neighbours().front().value); }

 private:
  mutable Node node_;
};

/// Two nodes, and the moments at which each saw its link fail and come back.
class World {
 public:
  explicit World(std::vector<Fault> faults) {
    spdlog::set_level(spdlog::level::off);
    SimSetup setup;
    setup.nodes = 2;
    setup.edges = {{first, second}};
    setup.plan.links.delay = microseconds(50);
    setup.plan.links.jitter = microseconds(20);
    for (Fault& fault : faults) fault.at = fault_at;
    setup.plan.faults = std::move(faults);
    world_ = std::make_unique<SimWorld>(setup);
    world_->start(
        [this](NodeId node, uint32_t) { return std::make_unique<SimulatedNode>(*world_, node); });
  }

  bool up(NodeId node) {
    const auto* at = static_cast<const SimulatedNode*>(world_->node(node));
    return at != nullptr && at->is_up();
  }
  /// The time from `from` until this node's link is up, or is not; `never` if that takes a minute.
  Nanoseconds until(NodeId node, bool is_up, Nanoseconds from) {
    while (world_->now() < from + seconds(60) && world_->step())
      if (world_->now() >= from && up(node) == is_up) return world_->now() - from;
    return never;
  }

 private:
  std::unique_ptr<SimWorld> world_;
};

Fault fault_of(Fault::Kind kind, NodeId node, NodeId peer, Nanoseconds lasts) {
  Fault fault;
  fault.kind = kind;
  fault.node = node;
  fault.peer = peer;
  fault.lasts = lasts;
  return fault;
}

}  // namespace

/// Silence that ends a link: 8 beats of 250 ms, and the way of a frame.
constexpr Nanoseconds silence = times.beat * times.down_after_beats + milliseconds(1);
/// A peer that is reachable again is used within this.
constexpr Nanoseconds return_bound = milliseconds(200);

TEST_CASE("a killed peer is known, and used again when it is back", "[runtime][node][bounds]") {
  constexpr Nanoseconds away = seconds(30);
  World world({fault_of(Fault::Kind::crash, second, first, away)});
  CHECK(world.until(first, true, 0) < return_bound);
  // Its connections break, and the next beat finds nobody.
  CHECK(world.until(first, false, fault_at) <= times.beat + milliseconds(1));
  CHECK(world.until(first, true, fault_at + away) <= return_bound);
  CHECK(world.up(second));
}

TEST_CASE("a broken connection is known by the next beat, and restored",
          "[runtime][node][bounds]") {
  for (const NodeId end : {first, second}) {
    World world({fault_of(Fault::Kind::disconnect, first, second, 0)});
    CHECK(world.until(end, true, fault_at + milliseconds(300)) <= return_bound);
  }
}

TEST_CASE("a stopped peer is known, and used again when it goes on", "[runtime][node][bounds]") {
  constexpr Nanoseconds away = seconds(30);
  World world({fault_of(Fault::Kind::pause, second, first, away)});
  CHECK(world.until(first, false, fault_at) <= silence);
  CHECK(world.until(first, true, fault_at + away) <= return_bound);
}

TEST_CASE("a cut link is known at both ends, and used again when it is whole",
          "[runtime][node][bounds]") {
  constexpr Nanoseconds away = seconds(30);
  for (const NodeId end : {first, second}) {
    World world({fault_of(Fault::Kind::cut, first, second, away),
                 fault_of(Fault::Kind::cut, second, first, away)});
    CHECK(world.until(end, false, fault_at) <= silence);
    CHECK(world.until(end, true, fault_at + away) <= return_bound);
  }
}

TEST_CASE("a link on which one direction is lost is known at both ends",
          "[runtime][node][bounds]") {
  constexpr Nanoseconds away = seconds(30);
  for (const NodeId end : {first, second}) {
    INFO(end.value);
    World world({fault_of(Fault::Kind::cut, first, second, away)});
    // The end that hears nothing falls silent; then the other one hears nothing.
    CHECK(world.until(end, false, fault_at) <= 2 * silence);
    CHECK(world.until(end, true, fault_at + away) <= return_bound);
  }
}
