// Shards of the totals, their owners and the controller, over a wire that loses, duplicates and
// delays messages: a taken flush is counted once, a refused one never.
#include <catch2/catch.hpp>
#include <deque>
#include <map>

#include "actors/cast/names/role.hpp"
#include "actors/cast/tally/shard_control.hpp"
#include "actors/cast/tally/slice_sender.hpp"
#include "actors/cast/tally/tally_shard.hpp"
#include "runtime/core/hash.hpp"
#include "runtime/core/random.hpp"
#include "tests/unit/runtime/actor/node_kit.hpp"

using namespace luxodus;

namespace {

constexpr NodeId controller{9};
constexpr int shard_groups = 2;
constexpr int64_t bins = 1000;

TallyLayout layout_of_bins() {
  TallyLayout layout(1);
  layout.add_block({"patches", bins, 1, ScoreUnit::weight});
  return layout;
}

/// A message in flight.
struct Mail {
  Address from, to;
  MessageId id;
  Message message;
  std::vector<std::byte> payload;
};

constexpr Address coordinator{controller, role::coordinator};
Address tracer_of(NodeId node) {
  return {node, role::tracer};
}
Address shard_of(NodeId node) {
  return {node, role::tally_shard};
}

/// A controller, workers of which some hold shards, and the wire between them, moved by the test.
struct Stage : Sender {
  explicit Stage(std::vector<NodeId> owners)
      : plan{std::move(owners)},
        totals(layout, shard_groups, {}),
        expected(layout, shard_groups, {}),
        control(plan, totals, node.clock, seconds(30), *this, coordinator) {
    for (size_t i = 0; i < plan.owners.size(); ++i) {
      const NodeId owner = plan.owners[i];
      const TallyShardConfig config{owner, controller, plan.range(i + 1, bins)};
      const auto made = shards.emplace(
          owner, std::make_unique<TallyShard>(config, layout, shard_groups, node.scheduler, *this));
      made.first->second->start();
    }
  }
  ~Stage() override {
    node.scheduler.fibers().cancel_all();
    node.settle();
  }

  MessageId next_id() override { return {controller, {1}, ++ids}; }
  SendOutcome send(Address from, Address to, const MessageId& id, const Message& message,
                   SharedBytes bytes = {}) override {
    if (room == 0) return SendOutcome::full;
    --room;
    wire.push_back({from, to, id, message, {bytes.bytes.begin(), bytes.bytes.end()}});
    return SendOutcome::taken;
  }

  template <class Receiver, class Body>
  void hand_letter(Receiver& receiver, const Letter<Body>& letter) {
    if constexpr (std::is_same_v<Body, SliceHeld>)
      receiver.on(letter, node.clock.now());
    else
      receiver.on(letter);
  }
  /// Calls the receiver's handler, if it has one for the message.
  template <class... Kinds, class Receiver>
  void hand_to(Receiver& receiver, const Mail& sent) {
    const auto hand = [&](const auto* body) {
      if (body != nullptr)
        hand_letter(receiver, Letter<std::decay_t<decltype(*body)>>{sent.from, sent.id, *body,
                                                                    Payload(bytes_of(sent))});
    };
    (hand(std::get_if<Kinds>(&sent.message)), ...);
  }
  static SharedBytes bytes_of(const Mail& sent) {
    const auto owner = std::make_shared<const std::vector<std::byte>>(sent.payload);
    return {*owner, owner};
  }

  void deliver(const Mail& sent) {
    const NodeId to = sent.to.node;
    if (sent.to == coordinator) {
      hand_to<FlushSettled, TotalsTold>(control, sent);
    } else if (const auto sender = senders.find(to); sent.to == tracer_of(to)) {
      if (sender != senders.end()) hand_to<SliceHeld, FlushRefused>(*sender->second, sent);
    } else if (const auto shard = shards.find(to); shard != shards.end()) {
      Message message = sent.message;
      (void)shard->second->accept({sent.from, sent.id, message, Payload(bytes_of(sent))});
    }
    node.settle();
  }
  /// Delivers messages until there are none; keeps a copy of each in `passed`.
  void pass() {
    while (!wire.empty()) {
      const Mail next = wire.front();
      wire.pop_front();
      passed.push_back(next);
      deliver(next);
    }
  }

  /// Packs a worker's flush in slices; adds it to the expected totals if it will be taken.
  SliceSender& pack(NodeId worker, const MessageId& id, uint64_t seed, bool counts) {
    auto& sender = senders[worker];
    if (!sender) {
      sender = std::make_unique<SliceSender>(plan, *this, tracer_of(worker),
                                             RetryTimer(seconds(1), seconds(8)));
      sender->make_room(shard_groups, bins);
    }
    Totals own(layout, shard_groups, {});
    TotalsGain gain;
    Random random(seed, RandomStream::test);
    random.start(id.sequence);
    for (int g = 0; g < shard_groups; ++g) {
      auto& group = gain.groups.emplace_back();
      group.batches = 1;
      for (int64_t i = random.bits() % 9; i < bins; i += 1 + random.bits() % 9)
        group.bins.push_back({i, {static_cast<Int128>(random.bits()), random.bits()}});
    }
    own.add(gain);
    if (counts) expected.add(gain);
    for (size_t slice = 0; slice < sender->slices(); ++slice) {
      FlushEncoder& encoder = sender->encoder(slice);
      encoder.begin(own, sender->bins_of(slice), FlushCounts::without);
      while (!encoder.step(100)) {
      }
    }
    FlushEncoder rest(shard_groups, bins);
    rest.begin(own, sender->own_bins(), FlushCounts::with);
    while (!rest.step(100)) {
    }
    payload = rest.bytes();
    sender->send(id, node.clock.now());
    return *sender;
  }
  /// What the controller does when it takes the flush packed last.
  void take(const MessageId& id, const std::vector<uint64_t>& hashes) {
    control.take(id, hashes);
    decode_flush(payload, shard_groups, plan.range(0, bins)).value().add_to(totals);
  }
  bool gather() {
    bool done = false;
    control.gather([&] { done = true; });
    pass();
    return done;
  }
  int64_t differences() const {
    int64_t count = 0;
    for (int g = 0; g < shard_groups; ++g) {
      count += totals.batches(g) != expected.batches(g);
      for (size_t i = 0; i < bins; ++i) {
        const Total &a = totals.state(g).totals[i], &b = expected.state(g).totals[i];
        count += a.sum != b.sum || a.squares != b.squares;
      }
    }
    return count;
  }

  test::Node node;
  const TallyLayout layout = layout_of_bins();
  ShardPlan plan;
  Totals totals, expected;
  uint64_t ids = 0;
  size_t room = SIZE_MAX;  // for messages in the network
  std::deque<Mail> wire;
  std::vector<Mail> passed;
  std::map<NodeId, std::unique_ptr<TallyShard>> shards;
  std::map<NodeId, std::unique_ptr<SliceSender>> senders;
  std::vector<std::byte> payload;
  ShardControl control;
};

constexpr NodeId worker{1};
MessageId flush_of(NodeId node, uint64_t sequence, uint64_t life = 7) {
  return {node, {life}, sequence};
}

}  // namespace

TEST_CASE("ranges of shards are consecutive and cover all bins", "[shards]") {
  for (const size_t owners : {0, 1, 2, 6}) {
    const ShardPlan plan{std::vector<NodeId>(owners)};
    for (const int64_t totals : {int64_t{0}, int64_t{3}, int64_t{1000}, int64_t{1} << 40}) {
      int64_t next = 0;
      for (size_t shard = 0; shard < plan.shards(); ++shard) {
        CHECK(plan.range(shard, totals).first == next);
        next = plan.range(shard, totals).end;
      }
      CHECK(next == totals);
    }
  }
}

TEST_CASE("a slice is held until its flush is decided, then added once or dropped", "[shards]") {
  Stage stage(std::vector<NodeId>{{0}, {2}});
  SliceSender& sender = stage.pack(worker, flush_of(worker, 1), 5, true);
  CHECK_FALSE(sender.placed());
  stage.pass();
  REQUIRE(sender.placed());
  CHECK(stage.shards.at({2})->counters().held == 1);
  CHECK(stage.shards.at({2})->totals().bytes() == 0);
  stage.take(flush_of(worker, 1), sender.hashes());
  CHECK_FALSE(stage.control.settled());
  stage.pass();
  REQUIRE(stage.control.settled());
  CHECK(stage.shards.at({2})->counters().slices == 1);

  stage.pack(worker, flush_of(worker, 2), 5, false);
  stage.pass();
  stage.control.refuse(flush_of(worker, 2));
  stage.pass();
  CHECK(stage.shards.at({2})->counters().held == 0);
  CHECK(stage.shards.at({2})->counters().slices_dropped == 1);
  CHECK(stage.gather());
  CHECK(stage.differences() == 0);
  CHECK_FALSE(stage.control.fault());
}

TEST_CASE("duplicates in any order, however late, add nothing", "[shards]") {
  Stage stage(std::vector<NodeId>{{0}, {2}});
  for (uint64_t flush = 1; flush <= 3; ++flush) {
    const bool taken = flush != 2;
    SliceSender& sender = stage.pack(worker, flush_of(worker, flush), 6, taken);
    stage.pass();
    REQUIRE(sender.placed());
    if (taken)
      stage.take(flush_of(worker, flush), sender.hashes());
    else
      stage.control.refuse(flush_of(worker, flush));
    stage.pass();
    REQUIRE(stage.gather());
  }
  const std::vector<Mail> all = stage.passed;
  for (int round = 0; round < 2; ++round) {
    for (size_t i = 0; i < all.size(); ++i) stage.deliver(all[round == 0 ? i : all.size() - 1 - i]);
    stage.pass();
  }
  REQUIRE(stage.gather());
  CHECK(stage.differences() == 0);
  CHECK(stage.shards.at({0})->counters().slices == 2);
  CHECK_FALSE(stage.control.fault());
}

TEST_CASE("an incarnation has one slice at a shard, and the next waits until it is decided",
          "[shards]") {
  Stage stage(std::vector<NodeId>{{2}});
  SliceSender& sender = stage.pack(worker, flush_of(worker, 1), 7, true);
  stage.pass();
  const std::vector<uint64_t> hashes = sender.hashes();
  stage.take(flush_of(worker, 1), hashes);
  std::deque<Mail> decision;
  decision.swap(stage.wire);  // it is late
  stage.pack(worker, flush_of(worker, 2), 7, true);
  stage.pass();
  CHECK_FALSE(sender.placed());
  stage.wire = decision;
  stage.pass();
  sender.ask_again(seconds(100));
  stage.pass();
  REQUIRE(sender.placed());
  stage.take(flush_of(worker, 2), sender.hashes());
  stage.pass();
  REQUIRE(stage.gather());
  CHECK(stage.differences() == 0);
}

TEST_CASE("slices of an ended incarnation are dropped, and the next incarnation goes on",
          "[shards]") {
  Stage stage(std::vector<NodeId>{{2}});
  stage.pack(worker, flush_of(worker, 4, 7), 8, false);
  stage.pass();
  const std::vector<Mail> late = stage.passed;
  stage.control.end_life(worker, {7});
  SliceSender& sender = stage.pack(worker, flush_of(worker, 1, 8), 8, true);
  stage.pass();
  REQUIRE(sender.placed());
  CHECK(stage.shards.at({2})->counters().held == 1);
  stage.take(flush_of(worker, 1, 8), sender.hashes());
  stage.pass();
  for (const Mail& sent : late) stage.deliver(sent);
  stage.pass();
  CHECK(stage.shards.at({2})->counters().held == 0);
  REQUIRE(stage.gather());
  CHECK(stage.differences() == 0);
}

TEST_CASE("a slice that is damaged, of other bins, or counts batches is refused", "[shards]") {
  Stage stage(std::vector<NodeId>{{2}});
  stage.pack(worker, flush_of(worker, 1), 9, false);
  REQUIRE(stage.wire.size() == 1);
  Mail slice = stage.wire.front();
  stage.wire.clear();
  const auto answer_to = [&](const Mail& sent) {
    stage.deliver(sent);
    REQUIRE(stage.wire.size() == 1);
    const Message answer = stage.wire.front().message;
    stage.wire.clear();
    return std::holds_alternative<FlushRefused>(answer);
  };
  Mail damaged = slice;
  damaged.payload.back() ^= std::byte{1};
  CHECK(answer_to(damaged));
  Mail other = slice;  // the controller's bins, and its batches
  other.payload = stage.payload;
  other.message = FlushSlice{hash_of(other.payload)};
  CHECK(answer_to(other));
  CHECK_FALSE(answer_to(slice));
  CHECK(stage.shards.at({2})->counters().held == 1);
  // Only a flush's worker may send its slices, and only the controller may decide.
  Mail forged = slice;
  forged.from = tracer_of({3});
  stage.deliver(forged);
  stage.deliver({tracer_of({3}),
                 shard_of({2}),
                 flush_of({3}, 1),
                 FlushDecided{flush_of(worker, 1), 0, false},
                 {}});
  CHECK(stage.wire.empty());
  CHECK(stage.shards.at({2})->counters().held == 1);
}

TEST_CASE("a sender whose slice was refused reports no slices to the controller", "[shards]") {
  Stage stage(std::vector<NodeId>{{0}, {2}});
  SliceSender& sender = stage.pack(worker, flush_of(worker, 1), 9, false);
  sender.on(Letter<FlushRefused>{shard_of({2}), flush_of(worker, 1), {{}, "damaged"}});
  CHECK(sender.placed());
  CHECK(sender.hashes().empty());
}

TEST_CASE("decisions about several nodes are in flight at once, one per node", "[shards]") {
  constexpr NodeId other{3};
  Stage stage(std::vector<NodeId>{{2}});
  stage.control.refuse(flush_of(worker, 1));
  stage.control.refuse(flush_of(worker, 2));
  stage.control.refuse(flush_of(other, 1));
  const auto under_way = [&] {
    std::vector<MessageId> flushes;
    for (const Mail& sent : stage.wire)
      if (const auto* decided = std::get_if<FlushDecided>(&sent.message))
        flushes.push_back(decided->flush);
    return flushes;
  };
  REQUIRE(under_way() == std::vector<MessageId>{flush_of(worker, 1), flush_of(other, 1)});
  // The second is answered first: the first stays, and so does what waits for it.
  std::swap(stage.wire[0], stage.wire[1]);
  const auto deliver_next = [&] {
    const Mail next = stage.wire.front();
    stage.wire.pop_front();
    stage.deliver(next);
  };
  deliver_next();  // the decision
  std::swap(stage.wire[0], stage.wire[1]);
  deliver_next();  // its answer
  CHECK(under_way() == std::vector<MessageId>{flush_of(worker, 1)});
  stage.pass();
  CHECK(stage.control.settled());
  CHECK_FALSE(stage.control.fault());
}

TEST_CASE("at most half of a shard's mailbox is filled by decisions in flight", "[shards]") {
  Stage stage(std::vector<NodeId>{{2}});
  for (uint16_t node = 10; node < 60; ++node) stage.control.refuse(flush_of({node}, 1));
  CHECK(stage.wire.size() == ShardControl::max_decisions);
  stage.pass();
  CHECK(stage.control.settled());
}

TEST_CASE("slices without room in the network are sent again without waiting for an answer",
          "[shards]") {
  Stage stage(std::vector<NodeId>{{2}, {5}});
  stage.room = 1;
  SliceSender& sender = stage.pack(worker, flush_of(worker, 1), 7, true);
  CHECK(stage.wire.size() == 1);
  stage.room = 10;
  sender.ask_again(stage.node.clock.now());
  CHECK(stage.wire.size() == 3);
  sender.ask_again(stage.node.clock.now());
  CHECK(stage.wire.size() == 3);  // both are in flight
  sender.ask_now(stage.node.clock.now());
  CHECK(stage.wire.size() == 5);
  stage.pass();
  CHECK(sender.placed());
  sender.ask_now(stage.node.clock.now());
  CHECK(stage.wire.empty());
}

TEST_CASE("a shard without the slice of a taken flush is a fault", "[shards]") {
  Stage stage(std::vector<NodeId>{{2}});
  stage.control.take(flush_of(worker, 1), {1});
  stage.pass();
  REQUIRE(stage.control.fault());
}

TEST_CASE("shards on a wire that loses, duplicates and delays count every taken flush once",
          "[shards]") {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    INFO("seed " << seed);
    Stage stage(std::vector<NodeId>{{0}, {2}, {5}});
    Random chance(seed, RandomStream::test);
    chance.start(1);
    const std::vector<NodeId> workers{{0}, {1}, {2}};
    std::map<NodeId, uint64_t> flush;
    std::map<NodeId, std::vector<std::byte>> payloads;
    std::map<NodeId, bool> taken;
    for (int step = 0; step < 4000; ++step) {
      for (const NodeId w : workers) {
        const auto at = stage.senders.find(w);
        if (at != stage.senders.end() && !at->second->placed()) continue;
        if (at != stage.senders.end() && flush[w] > 0 && !payloads[w].empty()) {
          if (taken[w]) {
            stage.payload = payloads[w];
            stage.take(flush_of(w, flush[w]), at->second->hashes());
          } else {
            stage.control.refuse(flush_of(w, flush[w]));
          }
          payloads[w].clear();
        }
        if (flush[w] == 6) continue;
        taken[w] = chance.bits() % 3 != 0;
        stage.pack(w, flush_of(w, ++flush[w]), seed, taken[w]);
        payloads[w] = stage.payload;
      }
      if (!stage.wire.empty()) {
        const size_t which = chance.bits() % stage.wire.size();
        const Mail sent = stage.wire[which];
        const uint32_t fate = chance.bits() % 8;
        if (fate != 0) stage.deliver(sent);  // 0: lost; 1: duplicated
        if (fate != 1) {
          const auto same =
              std::find_if(stage.wire.begin(), stage.wire.end(), [&](const Mail& other) {
                return other.id == sent.id && other.to == sent.to &&
                       other.message.index() == sent.message.index();
              });
          if (same != stage.wire.end()) stage.wire.erase(same);
        }
      }
      if (step % 20 == 0) {
        stage.node.advance(seconds(2));
        stage.control.look();
        for (auto& [w, sender] : stage.senders) sender->ask_again(stage.node.clock.now());
      }
    }
    REQUIRE(stage.control.settled());
    bool done = false;
    stage.control.gather([&] { done = true; });
    for (int step = 0; step < 4000 && !done; ++step) {
      if (stage.wire.empty() || step % 20 == 0) {
        stage.node.advance(seconds(2));
        stage.control.look();
      }
      if (stage.wire.empty()) continue;
      const Mail sent = stage.wire.front();
      stage.wire.pop_front();
      const uint32_t fate = chance.bits() % 8;
      if (fate == 1) stage.wire.push_back(sent);
      if (fate != 0) stage.deliver(sent);
    }
    REQUIRE(done);
    CHECK_FALSE(stage.control.fault());
    CHECK(stage.differences() == 0);
  }
}
