// A tracer whose coordinator is lost: it joins another one, and says goodbye to the first when the
// other knows of it. Either may tell it of the end. The test plays both coordinators.
#include <catch2/catch.hpp>

#include "actors/cast/names/role.hpp"
#include "actors/cast/tracing/tracing_worker.hpp"
#include "actors/results/run/particle_worker.hpp"
#include "tests/kit/lone_actor.hpp"
#include "tests/unit/actors/cast/process/library_scene.hpp"

using namespace luxodus;

namespace {

constexpr NodeId own{0}, first{1}, second{2};
constexpr Nanoseconds rejoin_after = seconds(3);

/// Always wants a batch, and never traces one.
struct IdleWork final : LeasedWork {
  explicit IdleWork(const CompiledScene& scene) : nothing(empty_totals(scene)) {}

  void add(uint64_t, int64_t) override { ++added; }
  void drop(std::span<const uint64_t>) override {}
  void drop_all() override { ++dropped; }
  void look_again() override { port->want_leases(1); }
  Totals& give_totals() override { return *nothing; }
  const Totals& totals() const override { return *nothing; }
  size_t at_hand() const override { return 0; }
  void end(const std::string&) override { ++ended; }

  LeasePort* port = nullptr;
  std::unique_ptr<Totals> nothing;
  int added = 0, dropped = 0, ended = 0;
};

TracingWorkerConfig led_by_first() {
  TracingWorkerConfig config;
  config.self = own;
  config.coordinators = {{first, role::coordinator}, {second, role::coordinator}};
  config.rejoin = rejoin_after;
  return config;
}

struct Led : test::LoneNode {
  Led() {
    work.port = &tracer;
    tracer.start(work);
    work.look_again();
  }
  ~Led() { end_fibers(); }
  void say(NodeId node, const MessageId& id, const Message& message) {
    Message copy = message;
    REQUIRE(tracer.accept({{node, role::coordinator}, id, copy, Payload()}) == Offered::taken);
    settle();
  }
  /// Answers its last message to a node.
  void grant(NodeId node) { say(node, sender.sent.at(node).back().id, LeaseGranted{}); }
  size_t leaves(NodeId node) const { return sender.told<EnterPhase>(node).size(); }
  /// Its coordinator is unreachable until it has joined the other, and then is back.
  void lose_first() {
    cluster.stop(first.value);
    run(rejoin_after + seconds(4));
    cluster.start(test::config_of(first.value, 3, test::ring(3), 2001));
    run(seconds(6));
  }

  const std::shared_ptr<const CompiledScene> scene = scene_of("empty_room", "", 1);
  IdleWork work{*scene};
  ShardPlan one_shard;
  test::NotedSender sender{own};
  TracingWorker tracer{led_by_first(), one_shard, scheduler, network(), sender};
  uint64_t words = 0;
};

}  // namespace

TEST_CASE("a tracer says goodbye to its lost coordinator when another one knows of it",
          "[tracer]") {
  Led led;
  const MessageId asked = led.sender.sent.at(first).back().id;
  led.grant(first);
  led.lose_first();
  REQUIRE_FALSE(led.sender.told<RequestLease>(second).empty());
  CHECK(led.leaves(first) == 0);
  led.grant(second);
  led.run(seconds(2));
  CHECK(led.leaves(first) > 0);
  SECTION("an answer to what it asked before is no answer to that") {
    led.say(first, asked, LeaseGranted{});
    const size_t before = led.leaves(first);
    led.run(seconds(2));
    CHECK(led.leaves(first) > before);
  }
  SECTION("it is said again until it is answered, and no more") {
    led.grant(first);
    const size_t before = led.leaves(first);
    led.run(seconds(2));
    CHECK(led.leaves(first) == before);
  }
}

TEST_CASE("a tracer hears of the end from its lost coordinator while no other knows it",
          "[tracer]") {
  Led led;
  led.grant(first);
  led.lose_first();
  const bool known = GENERATE(false, true);
  if (known) led.grant(second);
  led.say(first, {first, {2001}, 1}, RunEnded{});
  CHECK(led.tracer.over() == !known);
  CHECK(led.work.ended == (known ? 0 : 1));
  REQUIRE_FALSE(led.sender.told<RequestLease>(first).empty());
  CHECK(led.sender.told<RequestLease>(first).back().batches == 0);
}

TEST_CASE("questions are retried at once when the coordinator is reachable again", "[tracer]") {
  Led led;
  led.grant(first);
  const auto asked = [&] { return led.sender.told<RequestLease>(first).size(); };
  led.run(seconds(10));  // retries become rarer
  led.cluster.stop(first.value);
  led.run(milliseconds(2500));  // down, but not lost yet
  const size_t before = asked();
  led.cluster.start(test::config_of(first.value, 3, test::ring(3), 2001));
  led.run(seconds(1));
  CHECK(asked() > before);
}

TEST_CASE("a tracer that got no batches asks again after a pause", "[tracer]") {
  Led led;
  led.grant(first);
  const auto asked = [&] { return led.sender.told<RequestLease>(first).size(); };
  const size_t before = asked();
  led.run(milliseconds(1500));
  CHECK(asked() == before);
  led.run(seconds(1));
  REQUIRE(asked() == before + 1);  // after the retry time: this answer took no time
  led.run(seconds(1));
  led.grant(first);  // this one took more than a second
  led.run(seconds(6));
  CHECK(asked() == before + 1);
  led.run(seconds(7));
  CHECK(asked() == before + 2);
}

TEST_CASE("a tracer that ends before the run says goodbye", "[tracer]") {
  Led led;
  led.grant(first);
  led.tracer.say_goodbye();
  CHECK(led.leaves(first) == 1);
}
