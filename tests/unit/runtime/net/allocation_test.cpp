// The steady path allocates nothing: two nodes exchange requests and answers over a transport that
// allocates nothing itself, while every allocation is counted.
#include <array>
#include <catch2/catch.hpp>

#include "tests/kit/allocation_count.hpp"
#include "tests/unit/runtime/net/net_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// Frames between two nodes, in memory allocated once.
struct Wire {
  struct Queue {
    Queue() : frames(64) {
      constexpr size_t longest = defaults::bulk_chunk_bytes + limits::frame_head_bytes;
      for (auto& frame : frames) frame.reserve(longest);
    }
    std::vector<std::vector<std::byte>> frames;
    size_t first = 0, count = 0;
  };
  std::array<Queue, 2 * lanes> queues;  // by receiver and lane
  Queue& to(NodeId node, Lane lane) {
    return queues[node.value * lanes + static_cast<size_t>(lane)];
  }
};

class WireTransport final : public Transport {
 public:
  WireTransport(Wire& wire, NodeId self) : wire_(wire), self_(self) {}
  Sent send(NodeId to, Lane lane, std::span<const std::byte> head,
            std::span<const std::byte> body) override {
    auto& queue = wire_.to(to, lane);
    if (queue.count == queue.frames.size()) return Sent::full;
    auto& frame = queue.frames[(queue.first + queue.count++) % queue.frames.size()];
    frame.assign(head.begin(), head.end());
    frame.insert(frame.end(), body.begin(), body.end());
    return Sent::taken;
  }
  void renew(NodeId) override {}
  std::optional<Arrival> receive() override {
    for (const Lane lane : {Lane::control, Lane::bulk}) {
      auto& queue = wire_.to(self_, lane);
      if (queue.count == 0) continue;
      const auto& frame = queue.frames[queue.first];
      queue.first = (queue.first + 1) % queue.frames.size();
      --queue.count;
      const NodeId other{static_cast<uint16_t>(1 - self_.value)};
      return Arrival{other, lane, frame};
    }
    return std::nullopt;
  }
  void wait_until(Nanoseconds) override {}
  void wake() noexcept override {}

 private:
  Wire& wire_;
  NodeId self_;
};

/// Answers every request with an object of several chunks; keeps nothing.
struct Holder final : NetHandler {
  explicit Holder(SharedBytes bytes)
      : object(std::move(bytes)), room(object.bytes.size() / 8 + 9) {}
  bool deliver(const Delivery& d) override {
    if (std::holds_alternative<FetchObject>(d.message))
      return network->send(d.source, d.id, ObjectFound{}, object) == SendOutcome::taken;
    ++answers;
    return true;
  }
  std::span<std::byte> room_for(const MessageId&, NodeId, ActorPair, size_t) override {
    return std::as_writable_bytes(std::span(room));
  }
  void abandoned(const MessageId&, Kind) override {}
  bool intercept(const Delivery&) override { return false; }
  void link_changed(NodeId, LinkPhase) override {}
  NextHops reroute(std::span<const Edge>) override { return {{{0}, {1}}}; }

  SharedBytes object;
  std::vector<uint64_t> room;
  Network* network = nullptr;
  size_t answers = 0;
};

}  // namespace

TEST_CASE("requests, answers in chunks and heartbeats allocate no memory", "[runtime][network]") {
  if (!allocations_are_counted()) {
    WARN("sanitizers have an allocator of their own: nothing is counted in this build");
    return;
  }
  spdlog::set_level(spdlog::level::off);
  Wire wire;
  ManualClock clock;
  const SharedBytes object = share(pattern(200'000));
  Holder handlers[] = {Holder(object), Holder(object)};
  WireTransport transports[] = {WireTransport(wire, {0}), WireTransport(wire, {1})};
  Network asker(config_of(0, 2, ring(2), 1000), transports[0], handlers[0], clock.now());
  Network holder(config_of(1, 2, ring(2), 1001), transports[1], handlers[1], clock.now());
  handlers[0].network = &asker;
  handlers[1].network = &holder;
  const auto run = [&](int turns) {
    for (int i = 0; i < turns; ++i) {
      if (i % 4 == 0) asker.send({1}, asker.next_id(), FetchObject{{1}, 2, 3});
      asker.poll(clock.now());
      holder.poll(clock.now());
      clock.advance(milliseconds(10));
    }
  };
  run(200);
  REQUIRE(handlers[0].answers > 10);
  const size_t answers_before = handlers[0].answers;
  const uint64_t before = allocations_of_this_thread();
  run(1000);
  CHECK(allocations_of_this_thread() == before);
  CHECK(handlers[0].answers > answers_before + 200);
}
