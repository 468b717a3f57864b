// A hostile neighbour that was admitted, or took an admitted one's place: it costs bounded memory
// and its own link, and the others go on. Node 0 is that neighbour: the test makes its frames.
// Random bytes are tested by the fuzzers (tests/fuzz); objects with false content by the fetcher's
// tests (tests/unit/runtime/fetch).
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <catch2/catch.hpp>
#include <sstream>

#include "tests/unit/runtime/net/net_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

constexpr uint64_t of_hostile = 1000, of_victim = 1001;
constexpr uint64_t boundless = ~uint64_t{0};
/// Of 60 kB, in a bulk window.
constexpr size_t frames_of_a_window = defaults::bulk_window_bytes / frame_charge(60'000);

/// Node 1 has an honest neighbour, 2, and a hostile one.
class Besieged {
 public:
  Besieged() : nodes(3, ring(3)) {
    nodes.bring_up();
    REQUIRE(victim().phase({0}) == LinkPhase::up);
  }

  Network& victim() { return nodes[1].network; }

  Envelope envelope(Kind kind) {
    Envelope e;
    e.from = e.source = {0};
    e.from_incarnation = {of_hostile};
    e.to_incarnation = {of_victim};
    e.destination = {1};
    e.kind = kind;
    e.hops = kind == Kind::link ? 0 : 1;
    e.id = {{0}, {of_hostile}, ++sequence_};
    return e;
  }
  /// A frame encoded by the codec, to the victim.
  void send(const Envelope& e, std::span<const std::byte> body) {
    std::vector<std::byte> frame(limits::frame_head_bytes);
    frame.resize(codec_.encode(e, body, frame));
    frame.insert(frame.end(), body.begin(), body.end());
    nodes.net.send({0}, {1}, lane_of(e.kind), frame, {});
  }
  /// A message in one piece, of its own kind.
  void say(const Message& message, size_t payload_bytes = 0, uint64_t sent = 0) {
    std::vector<std::byte> body(limits::message_bytes);
    body.resize(codec_.encode(message, body).value());
    body.resize(body.size() + payload_bytes);
    Envelope e = envelope(kind_of(message));
    e.chunk_bytes = e.total_bytes = static_cast<uint32_t>(body.size());
    e.sent = sent;
    send(e, body);
  }
  /// The honest neighbour's request and long flush arrive within a second.
  void check_that_others_go_on() {
    const size_t asked = nodes[1].handler.count<AskStatus>();
    const size_t flushed = nodes[1].handler.count<Flush>();
    nodes[2].network.send({1}, nodes[2].network.next_id(), AskStatus{});
    nodes[2].network.send({1}, nodes[2].network.next_id(), Flush{1, 2, {3}, {}},
                          share(pattern(300'000)));
    nodes.run(seconds(1), milliseconds(1));
    CHECK(nodes[1].handler.count<AskStatus>() == asked + 1);
    CHECK(nodes[1].handler.count<Flush>() == flushed + 1);
    CHECK(victim().phase({2}) == LinkPhase::up);
  }

  Cluster nodes;

 private:
  Codec codec_;
  uint64_t sequence_ = 0;
};

}  // namespace

TEST_CASE("a neighbour that floods without credit fills only its own windows",
          "[runtime][hostile]") {
  Besieged siege;
  const size_t memory = siege.victim().memory_bytes();
  const uint64_t before = siege.victim().counters().dropped_over_credit;
  siege.nodes[1].handler.on_deliver = [](const Delivery& d) { return d.source != NodeId{0}; };
  constexpr size_t frames = 4000;
  for (size_t i = 0; i < frames; ++i) {
    siege.say(Flush{1, 2, {3}, {}}, 60'000);
    if (i % 100 == 99) siege.nodes.turn();
  }
  siege.nodes.run(milliseconds(100), milliseconds(1));  // a turn takes in a megabyte
  // These are not delivered here.
  CHECK(siege.victim().counters().dropped_over_credit - before >= frames - frames_of_a_window - 1);
  CHECK(siege.victim().memory_bytes() == memory);
  siege.check_that_others_go_on();
}

TEST_CASE("a neighbour that begins messages without ending them makes room for others",
          "[runtime][hostile]") {
  Besieged siege;
  const std::vector<std::byte> piece(1000);
  for (int i = 0; i < 500; ++i) {
    Envelope e = siege.envelope(Kind::commit);
    e.chunk_bytes = 1000;
    e.total_bytes = 5000;
    siege.send(e, piece);
    if (i % 20 == 19) siege.nodes.turn();
  }
  siege.nodes.turn();
  CHECK(siege.victim().counters().dropped_unexpected > 0);  // it has as many as the limit
  siege.check_that_others_go_on();
  CHECK(siege.victim().counters().assemblies_abandoned >= 1);
  siege.nodes.run(seconds(15));
  CHECK(siege.victim().counters().assemblies_abandoned >= defaults::assemblies);
}

TEST_CASE("a neighbour that grants without bound and reads nothing is sent one window per pool",
          "[runtime][hostile]") {
  Besieged siege;
  siege.nodes.net.faults.capacity = 4096;
  siege.nodes.stop(0);  // from here on it reads nothing, and its connection stays
  siege.nodes.net.join({0});
  uint64_t answered = 0;
  siege.nodes[1].handler.on_deliver = [&](const Delivery& d) {
    if (std::holds_alternative<FetchObject>(d.message) &&
        siege.victim().send(d.source, d.id, ObjectFound{{1}, {1}}, share(pattern(60'000))) ==
            SendOutcome::taken)
      ++answered;
    return true;
  };
  Envelope grant = siege.envelope(Kind::link);
  grant.grant = {Kind::reply, 1, boundless};
  siege.send(grant, {});
  const uint64_t before = siege.victim().counters().bytes_sent;
  const NetConfig usual;
  for (int i = 0; i < 200; ++i) {
    siege.say(FetchObject{{1}, 1'000'000, 1}, 0, static_cast<uint64_t>(i + 1) * 200);
    siege.nodes.turn();
  }
  // Its own replies wait in an outbox.
  CHECK(answered <= defaults::outbox_messages + frames_of_a_window + 1);
  CHECK(siege.victim().counters().bytes_sent - before < 2 * usual.bulk_window_bytes);
  siege.check_that_others_go_on();
}

TEST_CASE("a neighbour's false sizes are rejected", "[runtime][hostile]") {
  Besieged siege;
  const std::vector<std::byte> piece(1000);
  const auto lie = [&](uint32_t chunk, uint32_t chunk_bytes, uint32_t total) {
    Envelope e = siege.envelope(Kind::commit);
    e.chunk = chunk;
    e.chunk_bytes = chunk_bytes;
    e.total_bytes = total;
    siege.send(e, piece);
    siege.nodes.turn();
  };
  const uint64_t before = siege.victim().counters().dropped_malformed;
  lie(0, 1000, 0xffffffff);           // longer than any message
  lie(0, 0xffffffff, 1000);           // pieces longer than any
  lie(7, 1000, 5000);                 // a piece beyond the end
  lie(0xffffffff, 0xffffffff, 5000);  // their product wraps
  lie(0, 0, 1000);
  lie(0, 2000, 5000);  // a piece shorter than declared
  lie(4, 1000, 4500);  // the last one longer than the rest
  CHECK(siege.victim().counters().dropped_malformed == before + 7);
  // A plausible length asks for the handler's room, and gets none.
  siege.nodes[1].handler.wants_pieces = false;
  lie(0, 1000, defaults::max_message_bytes);
  CHECK(siege.victim().counters().dropped_unexpected == 1);
  siege.nodes[1].handler.wants_pieces = true;
  siege.check_that_others_go_on();
}

TEST_CASE("the ends of a link contradict a neighbour that reports it down", "[runtime][hostile]") {
  Besieged siege;
  siege.say(LinkChanges{{{{1}, {2}, 77}, {{0}, {1}, 99}}});
  siege.nodes.turn();
  CHECK_FALSE(siege.victim().reaches({2}));  // the report was believed
  siege.nodes.run(seconds(6));
  CHECK(siege.victim().reaches({2}));
  siege.say(LinkChanges{{{{1}, {2}, 0xffffffff}}});  // which could never be superseded
  siege.nodes.run(seconds(1));
  CHECK(siege.victim().reaches({2}));
  siege.check_that_others_go_on();
}

TEST_CASE("replayed frames to a later incarnation of a node are dropped", "[runtime][hostile]") {
  Besieged siege;
  siege.nodes.net.max_record = 1000;
  for (int i = 0; i < 20; ++i)
    siege.nodes[0].network.send({1}, siege.nodes[0].network.next_id(), RequestLease{1});
  siege.nodes.run(milliseconds(300));
  CHECK(siege.nodes[1].handler.count<RequestLease>() == 20);
  const auto recorded = siege.nodes.net.recorded;
  siege.nodes.net.max_record = 0;

  NetConfig again = siege.nodes[1].config;
  again.incarnation = {7777};
  siege.nodes.stop(1);
  siege.nodes.start(again);
  siege.nodes.run(seconds(8));
  REQUIRE(siege.victim().phase({2}) == LinkPhase::up);
  for (int round = 0; round < 20; ++round) {
    for (const auto& frame : recorded)
      for (const Lane lane : {Lane::control, Lane::bulk})
        siege.nodes.net.send({0}, {1}, lane, frame, {});
    siege.nodes.turn();
  }
  CHECK(siege.nodes[1].handler.count<RequestLease>() == 0);
  CHECK(siege.victim().counters().dropped_stale > 0);
  siege.check_that_others_go_on();
}

TEST_CASE("replayed frames to the same incarnation are bounded by the window of their pool",
          "[runtime][hostile]") {
  Besieged siege;
  const size_t memory = siege.victim().memory_bytes();
  siege.nodes.net.max_record = 1000;
  siege.nodes[0].network.send({1}, siege.nodes[0].network.next_id(), Flush{1, 2, {3}, {}},
                              share(pattern(200'000)));
  siege.nodes.run(milliseconds(300));
  const auto recorded = siege.nodes.net.recorded;
  siege.nodes.net.max_record = 0;
  for (int round = 0; round < 100; ++round) {
    for (const auto& frame : recorded) siege.nodes.net.send({0}, {1}, Lane::bulk, frame, {});
    siege.nodes.turn();
  }
  CHECK(siege.victim().memory_bytes() == memory);
  siege.check_that_others_go_on();
}

TEST_CASE("a neighbour that is refused a thousand times cannot flood the log",
          "[runtime][hostile]") {
  Besieged siege;
  std::ostringstream lines;
  const auto usual = spdlog::default_logger();
  spdlog::set_default_logger(std::make_shared<spdlog::logger>(
      "counted", std::make_shared<spdlog::sinks::ostream_sink_mt>(lines)));
  for (int i = 0; i < 1000; ++i) {
    Identity odd = siege.nodes[0].config.identity;
    if (i % 2 == 0) ++odd.scene_hash;
    siege.say(Hello{odd});
    if (i % 10 == 9) siege.nodes.turn();
  }
  siege.nodes.turn();
  spdlog::set_default_logger(usual);
  const std::string text = lines.str();
  CHECK(std::count(text.begin(), text.end(), '\n') <= 10);
  CHECK(siege.victim().counters().refused[static_cast<size_t>(RefusalReason::scene)] >= 400);
  siege.check_that_others_go_on();
}
