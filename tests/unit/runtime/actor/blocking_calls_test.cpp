#include "runtime/actor/blocking_calls.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <thread>

#include "tests/unit/runtime/actor/node_kit.hpp"

using namespace luxodus;
using test::Node;

TEST_CASE("a blocking call runs on another thread, and its completion on the node's",
          "[runtime][actor]") {
  Node node;
  BlockingThread calls(node.scheduler.handoff());
  std::atomic<bool> may_return{false};
  std::thread::id called_on;
  bool done = false;
  calls.begin(
      [&] {
        called_on = std::this_thread::get_id();
        while (!may_return) std::this_thread::yield();
      },
      [&done] { done = true; });
  for (int turn = 0; turn < 10; ++turn) node.scheduler.turn();  // the node runs meanwhile
  CHECK_FALSE(done);
  may_return = true;
  calls.finish();
  CHECK_FALSE(done);  // only in the node's next turn
  node.settle();
  CHECK(done);
  CHECK(called_on != std::this_thread::get_id());
}

TEST_CASE("blocking calls run one after another, each with its own completion",
          "[runtime][actor]") {
  Node node;
  BlockingThread calls(node.scheduler.handoff());
  int called = 0, done = 0;
  for (int i = 1; i <= 50; ++i) {
    calls.begin([&called] { ++called; }, [&done] { ++done; });
    calls.finish();
    node.settle();
    CHECK(called == i);
    CHECK(done == i);
  }
}
