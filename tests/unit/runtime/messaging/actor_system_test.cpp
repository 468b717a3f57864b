// Actors on two nodes and on one that send each other messages by the same calls. A message without
// an actor, without room or to a full mailbox is dropped and counted, and delays no other.
#include "runtime/messaging/actor_system.hpp"

#include <catch2/catch.hpp>
#include <memory>
#include <vector>

#include "runtime/messaging/node_actor.hpp"
#include "tests/fuzz/samples.hpp"
#include "tests/unit/runtime/net/net_kit.hpp"

using namespace luxodus;

namespace {

/// Asks for batches, and records its grants.
class Asker final
    : public NodeActor<Asker, ControlLane<Accepts<Letter<LeaseGranted>, 4, WhenFull::reject>>,
                       DataLane<>> {
 public:
  Asker(Scheduler& scheduler, Sender& sender, NodeId self)
      : NodeActor(scheduler, sender, {self, ActorName{2}}, "asker") {}

  SendOutcome ask(Address whom, uint32_t count) { return tell(whom, RequestLease{count}); }
  SendOutcome flush(Address whom, std::vector<std::byte> bytes) {
    const auto owner = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
    return tell(whom, Flush{1, 2, {3}}, {*owner, owner});
  }
  void on(const Letter<LeaseGranted>& granted) { batches += granted.body.batches; }

  uint32_t batches = 0;
};

/// Grants every request; flushes go to its fiber, which records their bytes.
class Lender final
    : public NodeActor<Lender, ControlLane<Accepts<Letter<RequestLease>, 2, WhenFull::reject>>,
                       DataLane<Accepts<Letter<Flush>, 2, WhenFull::reject>>> {
 public:
  Lender(Scheduler& scheduler, Sender& sender, NodeId self)
      : NodeActor(scheduler, sender, {self, ActorName{1}}, "lender") {}

  void on(const Letter<RequestLease>& request) {
    last_from = request.from;
    answer(request, LeaseGranted{1, 1, 0, request.body.batches, 1000});
  }
  void on(Letter<Flush>&& flush) {
    const auto bytes = flush.payload.bytes();
    flushed.assign(bytes.begin(), bytes.end());
    if (keeps) kept = std::move(flush.payload);
  }

  Address last_from;
  std::vector<std::byte> flushed;
  bool keeps = false;
  Payload kept;
};

constexpr NodeId here{0}, there{1};
constexpr size_t payload_budget = 1 << 20;

SchedulerLimits few_fibers() {
  SchedulerLimits limits;
  limits.fibers.count = 4;
  limits.fibers.max_maps = 1000;
  return limits;
}

/// One of two nodes, each with a scheduler, a network and the system of its actors.
struct Member final : NetHandler {
  Member(test::SimNet& net, ManualClock& clock, NodeId self)
      : source(clock),
        scheduler(few_fibers(), clock, source),
        transport(net, self),
        network(test::config_of(self.value, 2, test::ring(2), 1000u + self.value), transport, *this,
                clock.now()),
        system(self, network, payload_budget) {}

  bool deliver(const Delivery& delivery) override {
    system.deliver(delivery);
    return true;
  }
  std::span<std::byte> room_for(const MessageId& id, NodeId, ActorPair actors,
                                size_t bytes) override {
    return system.room_for(id, actors.to, bytes);
  }
  void abandoned(const MessageId& id, Kind) override { system.abandoned(id); }
  bool intercept(const Delivery& d) override { return system.intercept(d); }
  void link_changed(NodeId, LinkPhase) override {}
  NextHops reroute(std::span<const Edge>) override { return {{here, there}}; }

  QuietSource source;
  Scheduler scheduler;
  test::SimTransport transport;
  Network network;
  ActorSystem system;
};

/// The asker and one lender are on the first node; another lender is on the second.
struct Stage {
  Stage() {
    spdlog::set_level(spdlog::level::off);
    first.system.add(ActorName{2}, asker, "asker");
    first.system.add(ActorName{1}, near, "near");
    second.system.add(ActorName{1}, far, "far");
    near.start();
    far.start();
    run(seconds(1));
  }
  ~Stage() {
    for (Member* member : {&first, &second}) {
      member->scheduler.fibers().cancel_all();
      while (member->scheduler.fibers().any_ready()) (void)member->scheduler.fibers().run_next();
    }
  }
  void run(Nanoseconds span) {
    for (const Nanoseconds end = clock.now() + span; clock.now() < end;
         clock.advance(milliseconds(10))) {
      for (Member* member : {&first, &second}) {
        member->network.poll(clock.now());
        for (int turn = 0; turn < 3; ++turn) member->scheduler.turn();
      }
      net.arrive();
    }
  }
  /// Selects the local or the remote lender.
  Address lender(bool local) const { return local ? near.address() : far.address(); }
  Lender& lender_at(bool local) { return local ? near : far; }

  test::SimNet net;
  ManualClock clock{seconds(1)};
  Member first{net, clock, here}, second{net, clock, there};
  Asker asker{first.scheduler, first.system, here};
  Lender near{first.scheduler, first.system, here}, far{second.scheduler, second.system, there};
};

std::vector<std::byte> bytes_of(size_t count, int first) {
  std::vector<std::byte> bytes(count);
  for (size_t i = 0; i < count; ++i)
    bytes[i] = static_cast<std::byte>(static_cast<size_t>(first) + i % 251);
  return bytes;
}

}  // namespace

TEST_CASE("a question and its answer work alike on a node and across nodes", "[messaging]") {
  for (const bool local : {true, false}) {
    INFO((local ? "on a node" : "across nodes"));
    Stage stage;
    REQUIRE(stage.asker.ask(stage.lender(local), 5) == SendOutcome::taken);
    CHECK(stage.asker.batches == 0);  // no handler runs inside a send
    stage.run(milliseconds(100));
    CHECK(stage.asker.batches == 5);
    CHECK(stage.lender_at(local).last_from == stage.asker.address());
    CHECK(stage.first.system.counters().local == (local ? 2u : 0u));
  }
}

TEST_CASE("a payload arrives whole, in one frame or in pieces, and outlives its handler if kept",
          "[messaging]") {
  for (const bool local : {true, false})
    for (const size_t size : {size_t{100}, 3 * defaults::bulk_chunk_bytes + 17}) {
      INFO((local ? "on a node, " : "across nodes, ") << size << " B");
      Stage stage;
      Lender& lender = stage.lender_at(local);
      lender.keeps = true;
      REQUIRE(stage.asker.flush(lender.address(), bytes_of(size, 3)) == SendOutcome::taken);
      stage.run(milliseconds(500));
      REQUIRE(lender.flushed == bytes_of(size, 3));
      const auto kept = lender.kept.bytes();
      lender.keeps = false;
      REQUIRE(stage.asker.flush(lender.address(), bytes_of(size, 90)) == SendOutcome::taken);
      stage.run(milliseconds(500));
      CHECK(lender.flushed == bytes_of(size, 90));
      CHECK(std::vector<std::byte>(kept.begin(), kept.end()) == bytes_of(size, 3));
    }
}

TEST_CASE("a full mailbox rejects local messages, drops remote ones, and counts both",
          "[messaging]") {
  Stage stage;
  for (int i = 0; i < 2; ++i) CHECK(stage.asker.ask(stage.near.address(), 1) == SendOutcome::taken);
  CHECK(stage.asker.ask(stage.near.address(), 1) == SendOutcome::full);
  CHECK(stage.near.waiting() == 2);
  CHECK(stage.first.system.counters().rejected == 1);
  stage.run(milliseconds(100));
  CHECK(stage.asker.batches == 2);

  // More remote messages may arrive in a turn than the mailbox takes: the link continues all the
  // same.
  for (int i = 0; i < 50; ++i) CHECK(stage.asker.ask(stage.far.address(), 1) == SendOutcome::taken);
  stage.run(seconds(1));
  const uint64_t dropped = stage.second.system.counters().rejected;
  CHECK(dropped > 0);
  CHECK(stage.asker.batches < 52);
  const uint32_t before = stage.asker.batches;
  CHECK(stage.asker.ask(stage.far.address(), 7) == SendOutcome::taken);
  stage.run(milliseconds(100));
  CHECK(stage.asker.batches == before + 7);
}

TEST_CASE("a message for no actor, or of a type that it does not accept, is counted and dropped",
          "[messaging]") {
  Stage stage;
  const auto id = [&] { return stage.first.system.next_id(); };
  const Address from = stage.asker.address();
  for (const NodeId node : {here, there}) {
    const Address nobody{node, ActorName{3}}, unknown{node, static_cast<ActorName>(200)};
    CHECK(stage.first.system.send(from, nobody, id(), RequestLease{1}) == SendOutcome::taken);
    CHECK(stage.first.system.send(from, unknown, id(), RequestLease{1}) == SendOutcome::taken);
    const Address lender{node, ActorName{1}};
    CHECK(stage.first.system.send(from, lender, id(), RoundOpened{1, 2}) == SendOutcome::taken);
  }
  stage.run(milliseconds(100));
  for (const Member* member : {&stage.first, &stage.second}) {
    CHECK(member->system.counters().no_actor == 2);
    CHECK(member->system.counters().not_accepted == 1);
  }
  CHECK(stage.asker.batches == 0);
}

TEST_CASE("any message to any actor name is taken, dropped or counted, and nothing else",
          "[messaging][fuzz]") {
  Stage stage;
  const std::vector<Message> messages = test::sample_messages();
  Random random(7, RandomStream::test);
  random.start(0);
  const auto taken = [&] { return stage.second.network.counters().messages_delivered; };
  const uint64_t before = taken();
  for (int i = 0; i < 20'000; ++i) {
    const Message& message = messages[random.bits() % messages.size()];
    const Kind kind = kind_of(message);
    if (kind == Kind::link) continue;
    const ActorPair actors{static_cast<ActorName>(random.bits() % 256),
                           static_cast<ActorName>(random.bits() % (random.bits() % 2 ? 8 : 256))};
    const auto bytes =
        std::make_shared<const std::vector<std::byte>>(bytes_of(random.bits() % 300, 1));
    (void)stage.first.network.send(there, stage.first.system.next_id(), message, {*bytes, bytes},
                                   actors);
    if (i % 50 == 0) stage.run(milliseconds(20));
  }
  stage.run(seconds(1));
  const ActorSystem::Counters& dropped = stage.second.system.counters();
  REQUIRE(taken() - before > 5'000);
  CHECK(dropped.no_actor > 1'000);
  CHECK(dropped.not_accepted > 500);
  CHECK(dropped.no_actor + dropped.not_accepted + dropped.rejected < taken() - before);
  CHECK(dropped.no_room == 0);
  REQUIRE(stage.asker.ask(stage.far.address(), 3) == SendOutcome::taken);
  const uint32_t granted = stage.asker.batches;
  stage.run(milliseconds(100));
  CHECK(stage.asker.batches == granted + 3);
}

TEST_CASE("payloads beyond the pool are dropped and counted, and later ones have room again",
          "[messaging]") {
  Stage stage;
  stage.far.keeps = true;
  REQUIRE(stage.asker.flush(stage.far.address(), bytes_of(payload_budget / 2, 1)) ==
          SendOutcome::taken);
  stage.run(seconds(1));
  const Payload held = std::move(stage.far.kept);
  REQUIRE(held.bytes().size() == payload_budget / 2);
  stage.far.keeps = false;
  stage.far.flushed.clear();
  REQUIRE(stage.asker.flush(stage.far.address(), bytes_of(payload_budget / 2 + 4096, 2)) ==
          SendOutcome::taken);
  stage.run(seconds(1));
  CHECK(stage.far.flushed.empty());
  CHECK(stage.second.system.counters().no_room > 0);
  REQUIRE(stage.asker.flush(stage.far.address(), bytes_of(payload_budget / 4, 3)) ==
          SendOutcome::taken);
  stage.run(seconds(1));
  CHECK(stage.far.flushed == bytes_of(payload_budget / 4, 3));
}

TEST_CASE("rooms are reused, so a pool that has grown allocates no more", "[messaging]") {
  RoomPool pool(1 << 20);
  const std::byte* places[2] = {};
  for (int round = 0; round < 4; ++round) {
    PayloadRoom large = pool.take(100'000), small = pool.take(100);
    REQUIRE(large.size_bytes() >= 100'000);
    if (round == 1) {
      places[0] = large.bytes().data();
      places[1] = small.bytes().data();
    } else if (round > 1) {
      CHECK(large.bytes().data() == places[0]);
      CHECK(small.bytes().data() == places[1]);
    }
    pool.give_back(std::move(large));
    pool.give_back(std::move(small));
  }
  CHECK(pool.lent_bytes() == 0);
  CHECK(pool.take(2 << 20).empty());
}
