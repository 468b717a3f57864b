// An actor that throws: it does nothing more, its supervisor is notified once, and a restart begins
// with an empty mailbox.
#include "runtime/actor/supervised.hpp"

#include <catch2/catch.hpp>
#include <stdexcept>
#include <string>

#include "runtime/actor/actor.hpp"
#include "tests/unit/runtime/actor/node_kit.hpp"

using namespace luxodus;
using test::Node;

namespace {

struct Order {
  int number;
};
struct Task1 {
  int number;
};

/// Throws at a negative number, and records all others.
class Clerk final : public Actor<Clerk, ControlLane<Accepts<Order, 4, WhenFull::reject>>,
                                 DataLane<Accepts<Task1, 4, WhenFull::reject>>> {
 public:
  explicit Clerk(Node& node) : Actor(node.scheduler, "clerk"), node_(node) {}

  void on(const Order& order) { take("order", order.number); }
  void on(const Task1& task) { take("task", task.number); }
  void on_timer(int number) { take("timer", number); }
  void set_timer(Nanoseconds after, int number) {
    scheduler().timers().set(scheduler().clock().now() + after,
                             own_task([this, number] { on_timer(number); }));
  }

  int resets = 0;

 private:
  void reset() override { ++resets; }
  void take(const char* what, int number) {
    if (number < 0) throw std::runtime_error(what);
    node_.note(what + std::to_string(number));
  }
  Node& node_;
};

struct NotedFailures final : FailureListener {
  void on_failure(Supervised&, const std::exception_ptr& why) noexcept override {
    try {
      std::rethrow_exception(why);
    } catch (const std::exception& e) {
      text += std::string(e.what()) + " ";
    }
  }
  std::string text;
};

struct Office {
  Office() { clerk.start(); }
  ~Office() {
    node.scheduler.fibers().cancel_all();
    node.settle();
  }
  void give(int order, int task) {
    if (order != 0) REQUIRE(clerk.offer(Order{order}) == Offered::taken);
    if (task != 0) REQUIRE(clerk.offer(Task1{task}) == Offered::taken);
  }
  Node node;
  NotedFailures failures;
  Clerk clerk{node};
};

}  // namespace

TEST_CASE("a failed actor does nothing more, and its supervisor is notified once",
          "[actor][supervision]") {
  Office office;
  office.clerk.supervise_by(office.failures);
  std::string how;
  SECTION("in a handler of control") {
    how = "order ";
    office.give(-1, 0);
  }
  SECTION("in a handler of data, on its fiber") {
    how = "task ";
    office.give(0, -1);
  }
  SECTION("on a timer of its own") {
    how = "timer ";
    office.clerk.set_timer(1, -1);
    office.node.advance(2);
  }
  office.node.settle();
  CHECK(office.clerk.failed());
  CHECK(office.failures.text == how);
  office.give(2, 3);
  office.give(-4, -5);
  office.clerk.set_timer(1, 6);
  office.node.advance(2);
  CHECK(office.node.noted.empty());
  CHECK(office.failures.text == how);
}

TEST_CASE("a restarted actor has an empty mailbox, and no timer of its earlier life",
          "[actor][supervision]") {
  Office office;
  office.clerk.supervise_by(office.failures);
  office.clerk.set_timer(10, 1);
  office.give(-1, 2);
  office.node.settle();
  REQUIRE(office.clerk.failed());
  office.give(3, 0);
  office.clerk.begin_anew();
  CHECK(office.clerk.resets == 1);
  CHECK(office.clerk.life() == 2);
  CHECK(office.clerk.waiting() == 0);
  office.node.advance(20);
  CHECK(office.node.noted.empty());
  office.give(4, 5);
  office.clerk.set_timer(1, 6);
  office.node.advance(2);
  CHECK(office.node.noted == "timer6 order4 task5 ");
}

TEST_CASE("an injected failure hits an actor once, at its next handler", "[actor][supervision]") {
  Office office;
  office.clerk.supervise_by(office.failures);
  office.clerk.fail_next();
  office.give(1, 0);
  office.node.settle();
  CHECK(office.failures.text == "a failure on purpose ");
  office.clerk.begin_anew();
  office.give(1, 0);
  office.node.settle();
  CHECK(office.node.noted == "order1 ");
}

TEST_CASE("without a supervisor an actor's exception leaves the turn", "[actor][supervision]") {
  Office office;
  office.give(-1, 0);
  CHECK_THROWS_WITH(office.node.scheduler.turn(), "order");
}
