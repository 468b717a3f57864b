// A coordinator that leads two nodes on behalf of another one; the test plays the two nodes and the
// tracer above. Batches are leased onwards under its own leases, and reported upwards under the
// leases that they came with.
#include "actors/cast/coordinator/sub_coordinator.hpp"

#include <catch2/catch.hpp>
#include <vector>

#include "actors/cast/names/role.hpp"
#include "runtime/core/hash.hpp"
#include "scenes/light/transport/readout.hpp"
#include "tests/kit/encode_flush.hpp"
#include "tests/kit/lone_actor.hpp"
#include "tests/unit/actors/cast/process/library_scene.hpp"

using namespace luxodus;

namespace {

constexpr NodeId self{0}, left{1}, right{2};
constexpr Nanoseconds lease_time = seconds(60), lost_after = seconds(5);
using Numbers = std::vector<uint64_t>;

/// Records the requests to the tracer above.
struct NotedPort final : LeasePort {
  void want_leases(size_t count) override { wanted = count; }
  void leases_done(std::span<const uint64_t> leases) override {
    done.insert(done.end(), leases.begin(), leases.end());
  }
  bool has_room_for(size_t) const override { return has_room; }
  void lease_failed(uint64_t, int64_t) override { FAIL("a coordinator traces nothing"); }
  bool give_back(std::span<const uint64_t> leases) override {
    given_back.insert(given_back.end(), leases.begin(), leases.end());
    return true;
  }
  void return_leases() override { ++returns; }
  void want_room() override { ++rooms_wanted; }
  bool room_to_come() const override { return true; }
  size_t flush_bytes() const override { return 0; }
  void give_up(const Problem& why) override { FAIL(why.what); }
  void thread_failed(const std::exception_ptr&) override { FAIL("it has no photon-threads"); }

  size_t wanted = 0;
  bool has_room = true;
  Numbers done, given_back;
  int returns = 0, rooms_wanted = 0;
};

CoordinatorConfig leading_two() {
  CoordinatorConfig config;
  config.self = self;
  config.workers = {left, right};
  config.start = seconds(20);
  config.lost = lost_after;
  config.lease_time = lease_time;
  config.max_leases = 4;
  return config;
}

struct Stage : test::LoneNode {
  Stage() {
    coordinator.start();
    settle();
  }
  ~Stage() { end_fibers(); }

  /// Sends a message as a node's tracer.
  void say(NodeId node, const Message& message, std::vector<std::byte> payload = {}) {
    Message copy = message;
    REQUIRE(coordinator.accept({{node, role::tracer},
                                {node, {100u + node.value}, ++questions},
                                copy,
                                Payload(test::share(std::move(payload)))}) == Offered::taken);
    settle();
  }
  LeaseGranted ask(NodeId node, uint32_t batches) {
    say(node, RequestLease{batches});
    REQUIRE_FALSE(sender.told<LeaseGranted>(node).empty());
    return sender.told<LeaseGranted>(node).back();
  }
  /// Both nodes announce themselves without asking for work.
  void bring_both() {
    ask(left, 1);
    ask(right, 1);
  }
  /// As many batches as leases, each of which has added one to bin 0.
  void flush(NodeId node, const Numbers& leases) {
    Totals totals(scene->layout, static_cast<int>(scene->groups.size()), photopic_weights(*scene));
    TotalsGain gain;
    gain.groups.resize(scene->groups.size());
    gain.groups[0].batches = static_cast<int64_t>(leases.size());
    gain.groups[0].bins.push_back({0, {static_cast<Int128>(leases.size()), 0}});
    totals.add(gain);
    const std::vector<std::byte> bytes = test::encode_flush(totals);
    Hasher hash;
    hash.add(bytes.data(), bytes.size());
    say(node, Flush{0, hash.value(), leases}, bytes);
  }
  size_t taken(NodeId node) const { return sender.told<FlushTaken>(node).size(); }
  size_t refused(NodeId node) const { return sender.told<FlushRefused>(node).size(); }
  static int64_t sum_of(const Totals& totals) {
    return static_cast<int64_t>(totals.state(0).totals[0].sum);
  }

  const std::shared_ptr<const CompiledScene> scene = scene_of("empty_room", "", 1);
  NotedPort port;
  test::NotedSender sender{self};
  SubCoordinator coordinator{leading_two(), *scene, port, scheduler, network(), sender};
  uint64_t questions = 0;
};

}  // namespace

TEST_CASE("nothing is requested above before all workers are present, or half the time is over",
          "[sub-coordinator]") {
  Stage stage;
  CHECK(stage.ask(left, 2).batches == 0);
  CHECK(stage.port.wanted == 0);
  SECTION("all have come") {
    stage.ask(right, 2);
    CHECK(stage.port.wanted == 8);  // four for each
  }
  SECTION("one has not") {
    stage.run(seconds(11));
    CHECK(stage.port.wanted == 4);
  }
}

TEST_CASE("new batches are offered to as many workers as can get one, in turn",
          "[sub-coordinator]") {
  Stage stage;
  stage.bring_both();
  const auto told = [&](NodeId node) { return stage.sender.told<RoundOpened>(node).size(); };
  stage.coordinator.add(901, 30);
  stage.coordinator.look_again();
  stage.coordinator.look_again();
  CHECK(told(left) == 1);
  CHECK(told(right) == 1);  // offered to the second worker, since the first may not come
  stage.coordinator.look_again();
  CHECK(told(left) + told(right) == 2);
  SECTION("who does not come is told again, ever more seldom") {
    stage.run(seconds(8));
    CHECK(told(left) >= 4);
    CHECK(told(left) <= 6);
    CHECK(told(right) >= 4);
    CHECK(told(right) <= 6);
  }
  SECTION("who may not have what waits does not keep it from others") {
    stage.say(left, LeasesFenced{{stage.ask(left, 1).first_lease}});
    CHECK(stage.ask(left, 1).batches == 0);
    const size_t before = told(right);
    stage.coordinator.look_again();
    stage.run(seconds(1));
    CHECK(told(right) > before);
  }
  SECTION("who has asked in vain is told of the next") {
    CHECK(stage.ask(right, 1).batches == 1);
    CHECK(stage.ask(left, 1).batches == 0);
    stage.coordinator.add(902, 31);
    stage.coordinator.look_again();
    CHECK(told(left) == 2);
    CHECK(told(right) == 1);  // it has one
  }
}

TEST_CASE("batches are leased onwards, and reported under the leases that they came with",
          "[sub-coordinator]") {
  Stage stage;
  stage.bring_both();
  stage.coordinator.add(901, 30);
  stage.coordinator.add(902, 31);
  stage.coordinator.look_again();
  const LeaseGranted granted = stage.ask(left, 2);
  CHECK(granted.first_batch == 30);
  REQUIRE(granted.batches == 1);  // its share of what is available
  const LeaseGranted other = stage.ask(right, 2);
  CHECK(other.first_batch == 31);
  CHECK(stage.coordinator.at_hand() == 2);
  stage.flush(right, {other.first_lease});
  CHECK(stage.taken(right) == 1);
  CHECK(stage.port.done == Numbers{902});
  stage.flush(left, {granted.first_lease});
  CHECK(stage.port.done == Numbers{902, 901});
  CHECK(stage.coordinator.at_hand() == 0);
  CHECK(Stage::sum_of(stage.coordinator.merged()) == 2);
}

TEST_CASE("totals passed upwards are those merged since the last time", "[sub-coordinator]") {
  Stage stage;
  stage.bring_both();
  stage.coordinator.add(901, 30);
  stage.flush(left, {stage.ask(left, 1).first_lease});
  const Totals& given = stage.coordinator.give_totals();
  CHECK(Stage::sum_of(given) == 1);
  stage.coordinator.add(902, 31);
  stage.coordinator.add(903, 32);
  const uint64_t first = stage.ask(left, 1).first_lease, second = stage.ask(left, 1).first_lease;
  stage.flush(left, {first, second});
  CHECK(Stage::sum_of(given) == 1);
  CHECK(Stage::sum_of(stage.coordinator.merged()) == 2);
}

TEST_CASE("a lease fenced above is fenced below, and its flush is refused", "[sub-coordinator]") {
  Stage stage;
  stage.bring_both();
  stage.coordinator.add(901, 30);
  const uint64_t lease = stage.ask(left, 1).first_lease;
  const Numbers fenced{901};
  stage.coordinator.drop(fenced);
  REQUIRE(stage.sender.told<LeasesFenced>(left).size() == 1);
  CHECK(stage.sender.told<LeasesFenced>(left).front().leases == Numbers{lease});
  CHECK(stage.coordinator.at_hand() == 0);
  stage.flush(left, {lease});
  CHECK(stage.refused(left) == 1);
  CHECK(stage.port.done.empty());
  CHECK(Stage::sum_of(stage.coordinator.merged()) == 0);
}

TEST_CASE("a batch that returns under another lease is merged once, and reported under the new one",
          "[sub-coordinator]") {
  Stage stage;
  stage.bring_both();
  stage.coordinator.add(901, 30);
  const uint64_t lease = stage.ask(left, 1).first_lease;
  stage.coordinator.add(950, 30);  // the fencing of 901 was not heard of
  CHECK(stage.coordinator.at_hand() == 1);
  CHECK(stage.ask(right, 1).batches == 0);
  stage.flush(left, {lease});
  CHECK(stage.port.done == Numbers{950});
}

TEST_CASE("a lease that is late below goes to the other worker, and stays valid above",
          "[sub-coordinator]") {
  Stage stage;
  stage.bring_both();
  stage.coordinator.add(901, 30);
  const uint64_t late = stage.ask(left, 1).first_lease;
  stage.run(lease_time + seconds(1));
  const LeaseGranted again = stage.ask(right, 1);
  REQUIRE(again.batches == 1);
  CHECK(again.first_batch == 30);
  stage.flush(left, {late});
  CHECK(stage.refused(left) == 1);
  stage.flush(right, {again.first_lease});
  CHECK(stage.port.done == Numbers{901});
  CHECK(Stage::sum_of(stage.coordinator.merged()) == 1);
}

TEST_CASE("a flush is counted once the coordinator above has room for its leases",
          "[sub-coordinator]") {
  Stage stage;
  stage.bring_both();
  stage.coordinator.add(901, 30);
  const uint64_t lease = stage.ask(left, 1).first_lease;
  stage.port.has_room = false;
  stage.flush(left, {lease});
  CHECK(stage.taken(left) == 0);
  CHECK(stage.port.rooms_wanted > 0);
  stage.port.has_room = true;
  stage.coordinator.look_again();
  stage.settle();
  CHECK(stage.taken(left) == 1);
  CHECK(stage.port.done == Numbers{901});
}

TEST_CASE("batches that no worker below can trace are given back", "[sub-coordinator]") {
  Stage stage;
  stage.bring_both();
  stage.coordinator.add(901, 30);
  stage.say(left, LeasesFenced{{stage.ask(left, 1).first_lease}});
  stage.run(seconds(1));
  CHECK(stage.port.given_back.empty());  // the other may trace it
  stage.say(right, LeasesFenced{{stage.ask(right, 1).first_lease}});
  stage.run(seconds(1));
  CHECK(stage.port.given_back == Numbers{901});
  CHECK(stage.coordinator.at_hand() == 0);
}

TEST_CASE("leases are returned when all workers are lost", "[sub-coordinator]") {
  Stage stage;
  stage.bring_both();
  stage.coordinator.add(901, 30);
  stage.cluster.stop(left.value);
  stage.run(lost_after + seconds(4));
  CHECK(stage.port.returns == 0);
  stage.cluster.stop(right.value);
  stage.run(lost_after + seconds(4));
  CHECK(stage.port.returns > 0);
}

TEST_CASE(
    "the coordinator above is told that all workers have left or are idle, even without leases",
    "[sub-coordinator]") {
  Stage stage;
  stage.bring_both();
  stage.say(left, EnterPhase{EndPhase::leave, 0});
  CHECK(stage.sender.told<LeaseGranted>(left).size() == 2);  // the message has arrived
  stage.run(seconds(1));
  CHECK(stage.port.returns == 0);
  stage.ask(right, 0);
  stage.run(seconds(1));
  CHECK(stage.port.returns > 0);
}

TEST_CASE("a worker that returned its leases is awaited at the end, one that left is not",
          "[sub-coordinator]") {
  Stage stage;
  stage.bring_both();
  const bool leaves = GENERATE(false, true);
  if (leaves)
    stage.say(left, EnterPhase{EndPhase::leave, 0});
  else
    stage.ask(left, 0);
  stage.coordinator.end("");
  stage.say(right, RequestLease{0});
  CHECK(stage.coordinator.end_is_known() == leaves);
}

TEST_CASE("a worker that has not come yet is told of the end, as long as it may come",
          "[sub-coordinator]") {
  Stage stage;
  stage.ask(left, 1);
  SECTION("it is there, and answers") {
    stage.coordinator.end("");
    stage.say(left, RequestLease{0});
    CHECK_FALSE(stage.coordinator.end_is_known());
    CHECK(stage.sender.told<RunEnded>(right).size() == 1);
    stage.say(right, RequestLease{0});
    CHECK(stage.coordinator.end_is_known());
  }
  SECTION("no way leads to it, for as long as one waits for a lost node") {
    stage.cluster.stop(right.value);
    stage.run(lost_after + seconds(4));
    stage.coordinator.end("");
    stage.say(left, RequestLease{0});
    CHECK(stage.coordinator.end_is_known());
  }
}

TEST_CASE("a late goodbye does not count against a worker that is back", "[sub-coordinator]") {
  Stage stage;
  stage.bring_both();
  const uint64_t before = stage.questions;
  stage.questions = before + 10;
  stage.ask(left, 1);
  stage.questions = before;
  stage.say(left, EnterPhase{EndPhase::leave, 0});
  stage.coordinator.end("");
  stage.say(right, RequestLease{0});
  CHECK_FALSE(stage.coordinator.end_is_known());
}

TEST_CASE("the end is repeated until all have confirmed it, and then they are released",
          "[sub-coordinator]") {
  Stage stage;
  stage.bring_both();
  stage.coordinator.end("the disk is full");
  REQUIRE(stage.sender.told<RunEnded>(left).size() == 1);
  CHECK(stage.sender.told<RunEnded>(left).front().text == "the disk is full");
  stage.say(left, RequestLease{0});
  CHECK_FALSE(stage.coordinator.end_is_known());
  stage.run(milliseconds(300));
  CHECK(stage.sender.told<RunEnded>(right).size() > 1);
  stage.say(left, RequestLease{0});
  stage.say(right, RequestLease{0});
  CHECK(stage.coordinator.end_is_known());
  CHECK_FALSE(stage.coordinator.gone());
  stage.coordinator.let_go();
  CHECK(stage.sender.told<EnterPhase>(right).size() == 1);
  CHECK(stage.coordinator.gone());
}

TEST_CASE("the end is repeated soon after an answer, and ever more rarely without one",
          "[sub-coordinator]") {
  Stage stage;
  stage.bring_both();
  stage.coordinator.end("");
  const auto told = [&](NodeId node) { return stage.sender.told<RunEnded>(node).size(); };
  REQUIRE(told(left) == 1);
  for (int look = 0; look < 28; ++look) {
    stage.say(right, RequestLease{0});
    stage.run(milliseconds(250));
  }
  CHECK(told(left) == 6);  // after 0.25, 0.5, 1, 2 and 4 s
  CHECK(told(right) > 20);
}
