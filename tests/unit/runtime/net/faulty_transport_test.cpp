// Links and nodes with injected faults, over an in-memory network with a manual clock.
#include "runtime/net/faulty_transport.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/runtime/net/net_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

constexpr NodeId a{0}, b{1};
constexpr Nanoseconds delay = milliseconds(1);

FaultPlan delayed() {
  FaultPlan plan;
  plan.links.delay = delay;
  return plan;
}

FaultyConfig config_of_end(NodeId self, const FaultPlan& plan,
                           size_t max_held = limits::held_back_bytes) {
  FaultyConfig config;
  config.self = self;
  config.plan = plan;
  config.max_held = max_held;
  return config;
}

/// Two ends of a link.
struct Pair {
  explicit Pair(const FaultPlan& plan = delayed(), size_t max_held = limits::held_back_bytes)
      : one(below_one, config_of_end(a, plan, max_held), clock),
        other(below_other, config_of_end(b, plan, max_held), clock) {}

  void send(Lane lane, std::vector<std::byte> bytes) {
    REQUIRE(one.send(b, lane, {}, bytes) == Sent::taken);
    net.arrive();
  }
  /// Everything that the other end delivers now, as the first byte of each frame.
  std::vector<int> given() {
    std::vector<int> first;
    while (const auto arrival = other.receive()) {
      CHECK(arrival->neighbour == a);
      first.push_back(std::to_integer<int>(arrival->bytes.front()));
    }
    return first;
  }

  SimNet net;
  ManualClock clock{seconds(1)};
  SimTransport below_one{net, a}, below_other{net, b};
  FaultyTransport one, other;
};

std::vector<std::byte> frame(int first, size_t bytes = 100) {
  std::vector<std::byte> out(bytes);
  out.front() = static_cast<std::byte>(first);
  return out;
}

/// Nothing ever arrives; it records until when it was asked to wait.
class IdleTransport final : public Transport {
 public:
  Sent send(NodeId, Lane, std::span<const std::byte>, std::span<const std::byte>) override {
    return Sent::taken;
  }
  void renew(NodeId) override {}
  std::optional<Arrival> receive() override {
    if (frames.empty()) return std::nullopt;
    given = std::move(frames.back());
    frames.pop_back();
    return Arrival{a, Lane::bulk, given};
  }
  void wait_until(Nanoseconds until) override { waited_until = until; }
  void wake() noexcept override {}

  std::vector<std::vector<std::byte>> frames;
  std::vector<std::byte> given;
  Nanoseconds waited_until = 0;
};

/// As the other end would send it.
std::vector<std::byte> stamped(Nanoseconds sent, Nanoseconds hold) {
  std::vector<std::byte> bytes(40);
  std::memcpy(bytes.data(), &sent, sizeof sent);
  std::memcpy(bytes.data() + sizeof sent, &hold, sizeof hold);
  return bytes;
}

}  // namespace

TEST_CASE("a frame is delivered whole after the delay, and not before", "[runtime][delay]") {
  Pair pair;
  REQUIRE(pair.one.send(b, Lane::control, frame(7, 3), frame(8, 2)) == Sent::taken);
  pair.net.arrive();
  CHECK_FALSE(pair.other.receive());
  pair.clock.advance(delay - 1);
  CHECK_FALSE(pair.other.receive());
  CHECK(pair.other.held_bytes() == 5);
  pair.clock.advance(1);
  const auto arrival = pair.other.receive();
  REQUIRE(arrival);
  REQUIRE(arrival->bytes.size() == 5);
  CHECK(arrival->bytes[0] == std::byte{7});
  CHECK(arrival->bytes[3] == std::byte{8});
  CHECK(pair.other.held_bytes() == 0);
}

TEST_CASE("a node that was busy gets due frames at once", "[runtime][delay]") {
  Pair pair;
  pair.send(Lane::bulk, frame(1));
  pair.clock.advance(delay + milliseconds(3));
  CHECK(pair.given() == std::vector{1});
}

TEST_CASE("frames of a lane keep their order, and control overtakes bulk", "[runtime][delay]") {
  Pair pair;
  for (const int first : {1, 2, 3}) pair.send(Lane::bulk, frame(first));
  CHECK(pair.given().empty());
  pair.clock.advance(microseconds(10));
  pair.send(Lane::bulk, frame(4));
  pair.send(Lane::control, frame(5));
  CHECK(pair.given().empty());
  pair.clock.advance(delay);
  CHECK(pair.given() == std::vector{5, 1, 2, 3, 4});
}

TEST_CASE("a wait ends when a held frame is due, or at its own deadline", "[runtime][delay]") {
  ManualClock clock{seconds(1)};
  IdleTransport below;
  FaultyTransport transport(below, config_of_end(b, delayed()), clock);
  transport.wait_until(clock.now() + seconds(5));
  CHECK(below.waited_until == clock.now() + seconds(5));
  const Nanoseconds sent = clock.now();
  below.frames.push_back(stamped(sent, delay));
  CHECK_FALSE(transport.receive());
  transport.wait_until(clock.now() + seconds(5));
  CHECK(below.waited_until == sent + delay);
  transport.wait_until(sent + delay / 2);
  CHECK(below.waited_until == sent + delay / 2);
}

TEST_CASE("held bytes are bounded, and nothing beyond the bound is lost", "[runtime][delay]") {
  Pair pair(delayed(), 1000);
  for (int i = 0; i < 50; ++i) pair.send(Lane::bulk, frame(i));
  CHECK(pair.given().empty());
  CHECK(pair.other.held_bytes() == 1000);
  std::vector<int> all;
  for (int turns = 0; turns < 10; ++turns) {
    pair.clock.advance(delay);
    for (const int first : pair.given()) all.push_back(first);
  }
  REQUIRE(all.size() == 50);
  CHECK(std::is_sorted(all.begin(), all.end()));
}

TEST_CASE("a frame from an end without a plan is dropped and counted", "[runtime][delay]") {
  Pair pair;
  REQUIRE(pair.below_one.send(b, Lane::control, {}, frame(1, 4)) == Sent::taken);
  pair.net.arrive();
  CHECK_FALSE(pair.other.receive());
  CHECK(pair.other.counters().unstamped == 1);
}

TEST_CASE("a frame stamped in the future waits no longer than the delay", "[runtime][delay]") {
  ManualClock clock{seconds(1)};
  IdleTransport below;
  FaultyTransport transport(below, config_of_end(b, delayed()), clock);
  const Nanoseconds sent = clock.now() + seconds(1000);
  below.frames.push_back(stamped(sent, delay));
  CHECK_FALSE(transport.receive());
  clock.advance(delay);
  CHECK(transport.receive());
}

TEST_CASE("on delayed links a request and its answer take two delays, and objects arrive whole",
          "[runtime][delay]") {
  spdlog::set_level(spdlog::level::off);
  Pair pair;
  Handler handlers[2] = {Handler(config_of(0, 2, ring(2), 1000)),
                         Handler(config_of(1, 2, ring(2), 1001))};
  Network asker(config_of(0, 2, ring(2), 1000), pair.one, handlers[0], pair.clock.now());
  Network holder(config_of(1, 2, ring(2), 1001), pair.other, handlers[1], pair.clock.now());
  const auto object = pattern(1'000'003);
  handlers[1].on_deliver = [&](const Delivery& d) {
    return holder.send(d.source, d.id, ObjectFound{{7}, b}, share(object)) == SendOutcome::taken;
  };
  const auto run = [&](Nanoseconds span) {
    for (Nanoseconds t = 0; t < span; t += microseconds(50)) {
      asker.poll(pair.clock.now());
      holder.poll(pair.clock.now());
      pair.net.arrive();
      pair.clock.advance(microseconds(50));
    }
  };
  run(seconds(1));
  REQUIRE(asker.phase(b) == LinkPhase::up);
  REQUIRE(asker.send(b, asker.next_id(), FetchObject{{7}, 0, 1}) == SendOutcome::taken);
  run(2 * delay - microseconds(50));
  CHECK(handlers[0].taken.empty());
  run(milliseconds(50));
  REQUIRE(handlers[0].taken.size() == 1);
  CHECK(handlers[0].taken[0].payload == object);
  CHECK(asker.counters().dropped_malformed + holder.counters().dropped_malformed == 0);
}

TEST_CASE("links treat frames by the plan, until it is healed", "[runtime][delay]") {
  FaultPlan plan = delayed();
  plan.healed_at = seconds(10);
  plan.links.tail = milliseconds(1);
  const auto sent_and_given = [&](Pair& pair, int frames) {
    for (int i = 0; i < frames; ++i) pair.send(Lane::control, frame(i % 100));
    pair.clock.advance(milliseconds(5));
    return pair.given();
  };
  SECTION("loss") {
    plan.links.loss = 0.3;
    Pair pair(plan);
    const auto given = sent_and_given(pair, 1000);
    CHECK(given.size() == 1000 - pair.one.counters().lost);
    CHECK(pair.one.counters().lost > 240);
    CHECK(pair.one.counters().lost < 360);
    pair.clock.advance(seconds(10));
    CHECK(sent_and_given(pair, 1000).size() == 1000);
  }
  SECTION("duplication") {
    plan.links.duplication = 0.3;
    Pair pair(plan);
    const auto given = sent_and_given(pair, 1000);
    CHECK(given.size() == 1000 + pair.one.counters().duplicated);
    CHECK(pair.one.counters().duplicated > 240);
  }
  SECTION("reordering") {
    plan.links.reordering = 0.3;
    Pair pair(plan);
    const auto given = sent_and_given(pair, 100);
    CHECK(given.size() == 100);
    CHECK_FALSE(std::is_sorted(given.begin(), given.end()));
  }
  SECTION("corruption") {
    plan.links.corruption = 1;
    Pair pair(plan);
    REQUIRE(pair.one.send(b, Lane::control, {}, std::vector<std::byte>(100)) == Sent::taken);
    pair.net.arrive();
    pair.clock.advance(milliseconds(5));
    const auto arrival = pair.other.receive();
    REQUIRE(arrival);
    REQUIRE(arrival->bytes.size() == 100);
    CHECK(std::count(arrival->bytes.begin(), arrival->bytes.end(), std::byte{0}) < 100);
  }
  SECTION("bandwidth") {
    plan.links.bytes_per_second = 1e6;
    plan.links.queue_bytes = 1000;
    Pair pair(plan);
    int taken = 0;
    while (pair.one.send(b, Lane::bulk, {}, frame(taken)) == Sent::taken) ++taken;
    CHECK(taken == 11);  // 100 bytes each, one of them on the wire
    pair.net.arrive();
    pair.clock.advance(delay + microseconds(300));
    CHECK(pair.given().size() == 3);
    CHECK(pair.one.send(b, Lane::bulk, {}, frame(0)) == Sent::taken);
  }
}

TEST_CASE("cut links lose frames, clogged ones hold them, and broken ones report it",
          "[runtime][delay]") {
  FaultPlan plan;
  Fault fault;
  fault.at = milliseconds(10);
  fault.lasts = milliseconds(20);
  fault.node = a;
  fault.peer = b;
  const auto at_20ms = [&](Fault::Kind kind) {
    fault.kind = kind;
    plan.faults = {fault};
    auto pair = std::make_unique<Pair>(plan);
    pair->clock.advance(milliseconds(20));
    return pair;
  };
  const auto cut = at_20ms(Fault::Kind::cut);
  cut->send(Lane::control, frame(1));
  CHECK(cut->given().empty());
  // the other direction works
  CHECK(cut->other.send(a, Lane::control, {}, frame(2)) == Sent::taken);
  cut->net.arrive();
  CHECK(cut->one.receive());
  cut->clock.advance(milliseconds(10));
  cut->send(Lane::control, frame(3));
  CHECK(cut->given() == std::vector{3});

  const auto clogged = at_20ms(Fault::Kind::clog);
  clogged->send(Lane::control, frame(1));
  clogged->clock.advance(milliseconds(9));
  CHECK(clogged->given().empty());
  clogged->clock.advance(milliseconds(1));
  CHECK(clogged->given() == std::vector{1});

  const auto broken = at_20ms(Fault::Kind::disconnect);
  CHECK(broken->one.send(b, Lane::control, {}, frame(1)) == Sent::unreachable);
  CHECK(broken->other.send(a, Lane::control, {}, frame(1)) == Sent::unreachable);
  broken->clock.advance(milliseconds(10));
  CHECK(broken->one.send(b, Lane::control, {}, frame(1)) == Sent::taken);
}

TEST_CASE("nodes pause, slow down and crash by the plan", "[runtime][delay]") {
  ManualClock clock;
  IdleTransport below;
  FaultyConfig config = config_of_end(a, {});
  config.plan.faults = {{Fault::Kind::pause, milliseconds(10), milliseconds(5), a, {}, 1},
                        {Fault::Kind::slow, milliseconds(20), milliseconds(100), a, {}, 3},
                        {Fault::Kind::crash, milliseconds(200), milliseconds(1), a, {}, 1},
                        {Fault::Kind::crash, milliseconds(1), milliseconds(500), b, {}, 1}};
  Nanoseconds stood = 0;
  int crashes = 0;
  config.stand_still = [&](Nanoseconds span) {
    stood += span;
    clock.advance(span);
  };
  config.crash = [&] { ++crashes; };
  FaultyTransport transport(below, config, clock);
  (void)transport.receive();
  CHECK(stood == 0);
  clock.advance(milliseconds(12));
  (void)transport.receive();
  CHECK(stood == milliseconds(3));
  clock.advance(milliseconds(10));
  transport.wait_until(clock.now());
  clock.advance(milliseconds(2));  // of work
  (void)transport.receive();
  CHECK(stood == milliseconds(3 + 4));
  CHECK(crashes == 0);
  clock.advance(milliseconds(200) - clock.now());
  (void)transport.receive();
  CHECK(crashes == 1);
}
