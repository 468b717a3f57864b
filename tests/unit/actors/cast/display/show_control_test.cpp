// What a coordinator sends a display: pieces of one show at a time, repeated on request, and the
// end until the flux is on a disk.
#include "actors/cast/display/show_control.hpp"

#include <catch2/catch.hpp>
#include <vector>

#include "actors/cast/names/role.hpp"
#include "runtime/messaging/actor_system.hpp"
#include "tests/unit/actors/cast/process/equal_bits.hpp"
#include "tests/unit/actors/cast/process/library_scene.hpp"

using namespace luxodus;

namespace {

struct NotedSender final : Sender {
  MessageId next_id() override { return {{9}, {77}, ++last}; }
  SendOutcome send(Address, Address to, const MessageId& id, const Message& message,
                   SharedBytes payload) override {
    sent.push_back({to, id, message, payload.bytes.size()});
    return SendOutcome::taken;
  }
  struct Sent {
    Address to;
    MessageId id;
    Message message;
    size_t bytes;
  };
  std::vector<Sent> sent;
  uint64_t last = 0;
};

constexpr NodeId display_node{4};
constexpr Address display{display_node, role::display};

struct Desk {
  Desk() : run(scene_of("smoke_tank", "", 1), 1, 1) {
    StopRule stop;
    stop.particles = 2 * run.scene().batch_particles;
    run.run(stop, nobody, ignore);
  }
  void ask(uint32_t show, uint32_t piece, uint64_t sequence, uint64_t life = 5) {
    control.on(Letter<ShowTotals>{display, {display_node, {life}, sequence}, {show, piece}});
  }
  void pack(bool over = false) {
    REQUIRE(control.begin_pack());
    control.pack(run, 0);
    control.packed(over, StopReason::time);
  }
  const TotalsShown& shown() { return std::get<TotalsShown>(sender.sent.back().message); }

  LocalRun run;
  NotedSender sender;
  const RetryTimer timer{milliseconds(125), seconds(30)};
  ShowControl control{display_node, run, timer, sender, {{9}, role::coordinator}};
};

}  // namespace

TEST_CASE("the first piece is sent when the totals are packed, the others on request",
          "[showing]") {
  Desk desk;
  CHECK_FALSE(desk.control.begin_pack());
  desk.ask(1, 0, 10);
  CHECK(desk.control.wanted());
  CHECK(desk.sender.sent.empty());
  desk.pack(true);
  REQUIRE(desk.sender.sent.size() == 1);
  CHECK(desk.sender.sent[0].to == display);
  CHECK(desk.sender.sent[0].id.sequence == 10);
  CHECK(desk.shown().over);
  CHECK(desk.shown().stopped == static_cast<uint8_t>(StopReason::time));
  CHECK(desk.shown().batches == 2);
  for (int again = 0; again < 2; ++again) {
    desk.ask(1, 1, 11);
    CHECK(desk.shown().piece == 1);
    CHECK(desk.sender.sent.back().bytes > 0);
  }
  CHECK(desk.sender.sent.size() == 3);
  CHECK_FALSE(desk.control.wanted());
}

TEST_CASE("a request for a piece of an old show or another life gets an empty answer",
          "[showing]") {
  Desk desk;
  desk.ask(1, 3, 10);
  CHECK(desk.shown().pieces == 0);
  desk.ask(2, 0, 11);
  desk.pack();
  desk.ask(2, 1, 12, 6);
  CHECK(desk.shown().pieces == 0);
  desk.ask(2, 1'000'000, 13);
  CHECK(desk.shown().pieces == 0);
}

TEST_CASE("while totals are packed no piece of an earlier show is sent", "[showing]") {
  Desk desk;
  desk.ask(1, 0, 10);
  desk.pack();
  desk.ask(2, 0, 11);
  REQUIRE(desk.control.begin_pack());
  const size_t before = desk.sender.sent.size();
  desk.ask(1, 1, 12);
  REQUIRE(desk.sender.sent.size() == before + 1);
  CHECK(desk.shown().pieces == 0);
  desk.control.end_life(display_node);  // the requester is gone
  desk.control.pack(desk.run, 0);
  desk.control.packed(false, StopReason::time);
  CHECK(desk.sender.sent.size() == before + 1);
}

TEST_CASE("the end is repeated until the flux is on a disk, and again to a restarted display",
          "[showing]") {
  Desk desk;
  Nanoseconds now = 0;
  const auto told = [&] {
    const size_t before = desk.sender.sent.size();
    desk.control.tell_end({3, ""}, now);
    return desk.sender.sent.size() > before;
  };
  CHECK(told());
  CHECK_FALSE(told());  // the display may yet answer
  now += seconds(1);
  CHECK(told());
  desk.control.heard(now);
  now += seconds(8);
  CHECK(told());
  desk.control.saved();
  CHECK(desk.control.is_saved());
  CHECK_FALSE(told());
  desk.control.end_life(NodeId{1});
  CHECK_FALSE(told());
  desk.control.end_life(display_node);
  CHECK_FALSE(desk.control.is_saved());
  CHECK(told());
}

TEST_CASE("a run without a display sends no show messages", "[showing]") {
  Desk desk;
  ShowControl none(std::nullopt, desk.run, desk.timer, desk.sender, {{9}, role::coordinator});
  none.tell_end({3, ""}, 0);
  none.end_life(display_node);
  CHECK(desk.sender.sent.empty());
  CHECK_FALSE(none.any());
  CHECK_FALSE(none.is_display(display));
}
