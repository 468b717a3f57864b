// The journal's actor: it reports a flush only when it is durable, its node's loop goes on
// meanwhile, and a node that ends waits for the disk, not for its own loop.
#include "actors/cast/journal/journal_actor.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <thread>
#include <vector>

#include "tests/unit/runtime/actor/node_kit.hpp"

using namespace luxodus;
using test::Node;

namespace {

/// Records the flushes; it takes a configurable time, and can fail.
struct NotedKeeper final : FlushKeeper {
  Result<void> keep(std::span<const int64_t> batches, std::span<const std::byte>) override {
    while (slow) std::this_thread::yield();
    if (fails) {
      whole = false;
      return problem("the disk is full");
    }
    kept.insert(kept.end(), batches.begin(), batches.end());
    return {};
  }
  bool is_whole() const override { return whole; }
  bool rest_is_due() const override { return !whole; }
  void rest() override { whole = true; }

  std::atomic<bool> slow{false};
  bool fails = false;
  bool whole = true;
  std::vector<int64_t> kept;
};

struct Desk {
  Desk() { journal.start(); }
  ~Desk() {
    node.scheduler.fibers().cancel_all();
    node.settle();
  }
  void give(std::vector<int64_t> numbers, Kept& kept) {
    batches = std::move(numbers);
    REQUIRE(journal.offer(KeepFlush{batches, {}, &kept}) == Offered::taken);
  }
  void until(const bool& holds) {
    for (int turn = 0; turn < 1'000'000 && !holds; ++turn) {
      node.settle();
      std::this_thread::yield();
    }
    REQUIRE(holds);
  }

  Node node;
  NotedKeeper keeper;
  BlockingThread calls{node.scheduler.handoff()};
  JournalActor journal{node.scheduler, keeper, calls};
  std::vector<int64_t> batches;
};

}  // namespace

TEST_CASE("a flush is reported as kept when the keeper has it, and not before", "[journal]") {
  Desk desk;
  desk.keeper.slow = true;
  Kept kept;
  desk.give({4, 5}, kept);
  for (int turn = 0; turn < 20; ++turn) desk.node.scheduler.turn();
  CHECK_FALSE(kept.done);
  CHECK(desk.journal.busy());
  CHECK_FALSE(desk.journal.is_whole());
  desk.keeper.slow = false;
  desk.until(kept.done);
  CHECK(kept.outcome.ok());
  CHECK(desk.keeper.kept == std::vector<int64_t>{4, 5});
  CHECK(desk.journal.is_whole());
}

TEST_CASE("a failed write is reported, and tidying makes the journal whole", "[journal]") {
  Desk desk;
  desk.keeper.fails = true;
  Kept kept;
  desk.give({1}, kept);
  desk.until(kept.done);
  CHECK_FALSE(kept.outcome.ok());
  CHECK_FALSE(desk.journal.is_whole());
  REQUIRE(desk.journal.tidying_is_due());
  bool tidied = false;
  REQUIRE(desk.journal.offer(TidyJournal{[&tidied] { tidied = true; }}) == Offered::taken);
  CHECK_FALSE(desk.journal.tidying_is_due());  // it is busy
  desk.until(tidied);
  CHECK(desk.journal.is_whole());
}

TEST_CASE("a node that ends waits for the call in progress", "[journal]") {
  Desk desk;
  desk.keeper.slow = true;
  Kept kept;
  desk.give({7}, kept);
  for (int turn = 0; turn < 20; ++turn) desk.node.scheduler.turn();
  std::thread disk([&] { desk.keeper.slow = false; });
  desk.node.scheduler.fibers().cancel_all();
  desk.node.settle();  // its fiber ends only after the call has returned
  disk.join();
  CHECK(desk.node.scheduler.fibers().live() == 0);
  CHECK(desk.keeper.kept == std::vector<int64_t>{7});
  CHECK_FALSE(kept.done);
}
