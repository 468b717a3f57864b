#include "runtime/sim/simulated_calls.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/runtime/actor/node_kit.hpp"

using namespace luxodus;

TEST_CASE("a simulated call is made at once, and completes after its delay", "[runtime][sim]") {
  test::Node node;
  SimulatedCalls calls(node.scheduler, [] { return milliseconds(5); });
  bool called = false, done = false;
  calls.begin([&called] { called = true; }, [&done] { done = true; });
  CHECK(called);
  node.advance(milliseconds(4));
  CHECK_FALSE(done);
  node.advance(milliseconds(1));
  CHECK(done);
}
