#include "tests/fuzz/fuzz_session.hpp"

#include <spdlog/spdlog.h>

#include "tests/fuzz/must.hpp"
#include "tests/fuzz/samples.hpp"
#include "tests/unit/runtime/net/net_kit.hpp"

namespace luxodus::test {

namespace {

constexpr uint64_t of_first_life = 1000;

/// Reads the input to its end, followed by zeros.
class Script {
 public:
  explicit Script(std::span<const std::byte> input) : left_(input) {}
  bool more() const { return !left_.empty(); }
  size_t next() {
    if (left_.empty()) return 0;
    const auto byte = std::to_integer<size_t>(left_.front());
    left_ = left_.subspan(1);
    return byte;
  }

 private:
  std::span<const std::byte> left_;
};

Envelope of_session(const Message& message, size_t body_bytes, bool later) {
  Envelope e;
  e.from = e.source = {0};
  e.from_incarnation = {of_first_life};
  e.to_incarnation = {of_first_life + 1 + (later ? 1u : 0u)};
  e.destination = {1};
  e.kind = kind_of(message);
  e.hops = e.kind == Kind::link ? 0 : 1;
  e.id = {{0}, {of_first_life}, body_bytes};
  e.chunk_bytes = e.total_bytes = static_cast<uint32_t>(body_bytes);
  e.sent = body_bytes;
  return e;
}

/// The next frame of the script, to node 1.
std::vector<std::byte> next_frame(Script& script, size_t flags, const std::vector<Message>& samples,
                                  size_t which, Codec& codec) {
  const Message& message = samples[which % samples.size()];
  std::vector<std::byte> body(limits::message_bytes);
  body.resize(codec.encode(message, body).value());
  if ((flags & session::payload) != 0) body.resize(body.size() + 500);
  const Envelope envelope = (flags & session::addressed) != 0
                                ? of_session(message, body.size(), (flags & session::later) != 0)
                                : sample_envelope();
  std::vector<std::byte> frame(limits::frame_head_bytes);
  frame.resize(codec.encode(envelope, body, frame));
  frame.insert(frame.end(), body.begin(), body.end());
  const size_t harms = script.next() % 8;
  for (size_t i = 0; i < harms; ++i) {
    const size_t at = script.next() * 256 + script.next();
    std::byte& byte = frame[at % frame.size()];
    byte = static_cast<std::byte>(std::to_integer<size_t>(byte) + script.next());
  }
  if ((flags & session::sealed) != 0) Codec::seal(frame);
  return frame;
}

}  // namespace

uint64_t fuzz_session(std::span<const std::byte> input) {
  static const std::vector<Message> samples = sample_messages();
  Script script(input);
  Cluster trio(3, ring(3));
  Codec codec;
  if (script.next() % 4 != 0) trio.bring_up();  // otherwise the frames arrive during the handshake
  NetNode& victim = trio[1];
  const size_t memory = victim.network.memory_bytes();
  const uint64_t before = victim.network.counters().dropped_malformed;
  uint64_t frames = 0;
  for (; script.more() && frames < 400; ++frames) {
    const size_t which = script.next();
    const size_t flags = script.next();
    const auto frame = next_frame(script, flags, samples, which, codec);
    const Lane lane = (flags & session::bulk) != 0 ? Lane::bulk : Lane::control;
    trio.net.send({0}, {1}, lane, frame, {});
    if ((flags & session::turn) != 0) trio.turn();
  }
  trio.turn();
  const uint64_t malformed = victim.network.counters().dropped_malformed - before;
  must(malformed <= frames, "more is malformed than came");

  // A refusal is retried after 30 s, a false grant ends with the link.
  trio.run(seconds(70), milliseconds(50));
  must(victim.network.memory_bytes() == memory, "the node's buffers have grown");
  for (const uint16_t other : {uint16_t{0}, uint16_t{2}}) {
    must(victim.network.phase({other}) == LinkPhase::up, "a link does not heal");
    const size_t asked = victim.handler.count<AskStatus>();
    trio[other].network.send({1}, trio[other].network.next_id(), AskStatus{});
    trio.run(seconds(1), milliseconds(50));
    must(victim.handler.count<AskStatus>() == asked + 1, "a neighbour's question does not come");
  }
  return frames - malformed;
}

}  // namespace luxodus::test
