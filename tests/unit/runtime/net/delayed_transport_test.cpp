// Links that hold frames back, over a network in memory, time by hand.
#include "runtime/net/delayed_transport.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/runtime/net/net_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

constexpr NodeId a{0}, b{1};
constexpr Nanoseconds delay = milliseconds(1);

/// Two ends of delayed links to each other.
struct Pair {
  explicit Pair(size_t held_most = limits::held_back_bytes)
      : one(below_one, delay, clock, held_most), other(below_other, delay, clock, held_most) {}

  void send(Lane lane, std::vector<std::byte> bytes) {
    REQUIRE(one.send(b, lane, {}, bytes) == Sent::taken);
    net.arrive();
  }
  /// Everything that the other end gives out now, as the first byte of each frame.
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
  DelayedTransport one, other;
};

std::vector<std::byte> frame(int first, size_t bytes = 100) {
  std::vector<std::byte> out(bytes);
  out.front() = static_cast<std::byte>(first);
  return out;
}

/// Nothing ever comes; it remembers until when it was asked to wait.
class Waiting final : public Transport {
 public:
  Sent send(NodeId, Lane, std::span<const std::byte>, std::span<const std::byte>) override {
    return Sent::taken;
  }
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

}  // namespace

TEST_CASE("a frame comes when the delay has passed, whole, and not before", "[runtime][delay]") {
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

TEST_CASE("a node that was busy gets what is due at once", "[runtime][delay]") {
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

TEST_CASE("a wait ends when a held frame is due, or when it was to end", "[runtime][delay]") {
  ManualClock clock{seconds(1)};
  Waiting below;
  DelayedTransport transport(below, delay, clock);
  transport.wait_until(clock.now() + seconds(5));
  CHECK(below.waited_until == clock.now() + seconds(5));
  const Nanoseconds sent = clock.now();
  below.frames.push_back(frame(0, 20));
  std::memcpy(below.frames[0].data(), &sent, sizeof sent);
  CHECK_FALSE(transport.receive());
  transport.wait_until(clock.now() + seconds(5));
  CHECK(below.waited_until == sent + delay);
  transport.wait_until(sent + delay / 2);
  CHECK(below.waited_until == sent + delay / 2);
}

TEST_CASE("what is held back is bounded, and nothing beyond it is lost", "[runtime][delay]") {
  Pair pair(1000);
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

TEST_CASE("a frame from an end that is not delayed is dropped and counted", "[runtime][delay]") {
  Pair pair;
  REQUIRE(pair.below_one.send(b, Lane::control, {}, frame(1, 4)) == Sent::taken);
  pair.net.arrive();
  CHECK_FALSE(pair.other.receive());
  CHECK(pair.other.unstamped() == 1);
}

TEST_CASE("a frame that says it comes from the future waits no longer than the delay",
          "[runtime][delay]") {
  ManualClock clock{seconds(1)};
  Waiting below;
  DelayedTransport transport(below, delay, clock);
  const Nanoseconds sent = clock.now() + seconds(1000);
  below.frames.push_back(frame(0, 20));
  std::memcpy(below.frames[0].data(), &sent, sizeof sent);
  CHECK_FALSE(transport.receive());
  clock.advance(delay);
  CHECK(transport.receive());
}

TEST_CASE("two nodes on delayed links ask and answer in two delays, and objects come whole",
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
