#include "runtime/actor/actor.hpp"

#include <catch2/catch.hpp>
#include <csignal>
#include <string>
#include <vector>

#include "tests/unit/runtime/actor/node_kit.hpp"
#include "tests/unit/runtime/core/forked_end.hpp"

using namespace luxodus;
using test::Node;

namespace {

struct Stop {};
struct Beat {
  int number;
};
struct Work {
  int number;
};
struct Hint {
  int number;
};

/// Records what it handles; while `busy`, the handler of Work waits at a gate.
class Worker final
    : public Actor<
          Worker,
          ControlLane<Accepts<Stop, 1, WhenFull::fail>, Accepts<Beat, 1, WhenFull::coalesce>>,
          DataLane<Accepts<Work, 4, WhenFull::wait>, Accepts<Hint, 2, WhenFull::reject>>> {
 public:
  explicit Worker(Node& node) : Actor(node.scheduler, "worker"), node_(node) {}

  void on(const Stop&) { node_.note("stop"); }
  void on(const Beat& beat) { node_.note("beat" + std::to_string(beat.number)); }
  void on(const Hint& hint) { node_.note("hint" + std::to_string(hint.number)); }
  void on(const Work& work) {
    if (busy && scheduler().fibers().wait(gate, "gate") == Wake::cancelled) return;
    done.push_back(work.number);
  }

  bool busy = false;
  WaitList gate;
  std::vector<int> done;

 private:
  Node& node_;
};

/// Accepts one kind of data and no control.
class Sink final : public Actor<Sink, ControlLane<>, DataLane<Accepts<Work, 1, WhenFull::wait>>> {
 public:
  explicit Sink(Scheduler& scheduler) : Actor(scheduler, "sink") {}
  void on(const Work& work) { sum += work.number; }
  int sum = 0;
};

/// Accepts control only.
class Bell final : public Actor<Bell, ControlLane<Accepts<Beat, 2, WhenFull::reject>>, DataLane<>> {
 public:
  explicit Bell(Scheduler& scheduler) : Actor(scheduler, "bell") {}
  void on(const Beat& beat) { last = beat.number; }
  int last = 0;
};

std::vector<int> numbers(int from, int to) {
  std::vector<int> out;
  for (int i = from; i <= to; ++i) out.push_back(i);
  return out;
}

}  // namespace

TEST_CASE("data messages are handled in the order in which they were sent", "[runtime][actor]") {
  Node node;
  Worker worker(node);
  worker.start();
  node.settle();
  for (int i = 1; i <= 4; ++i) CHECK(worker.offer(Work{i}) == Offered::taken);
  node.settle();
  CHECK(worker.done == numbers(1, 4));
  node.scheduler.fibers().cancel_all();
  node.settle();
}

TEST_CASE("a full mailbox makes the sender wait and loses nothing", "[runtime][mailbox]") {
  Node node;
  Worker worker(node);
  worker.busy = true;
  worker.start();
  node.start([&worker] {
    for (int i = 1; i <= 20; ++i)
      if (worker.send(Work{i}) != Offered::taken) return;
  });
  node.settle();
  CHECK(worker.waiting() == 4);
  CHECK(worker.offer(Work{99}) == Offered::rejected);
  for (int i = 0; i < 20; ++i) {
    CHECK(worker.waiting() <= 4);
    node.scheduler.fibers().wake_all(worker.gate);
    node.settle();
  }
  CHECK(worker.done == numbers(1, 20));
  node.scheduler.fibers().cancel_all();
  node.settle();
}

TEST_CASE("waiting senders are served in order of arrival, and none overtakes them",
          "[runtime][mailbox]") {
  Node node;
  Worker worker(node);
  worker.busy = true;
  worker.start();
  node.settle();
  // One message is at the gate and four are in the mailbox when the others begin to wait.
  for (int i = 1; i <= 8; ++i) {
    node.start([&node, &worker, i] {
      if (worker.send(Work{i}) == Offered::taken) node.note("sent" + std::to_string(i));
    });
    node.settle();
  }
  CHECK(node.noted == "sent1 sent2 sent3 sent4 sent5 ");
  node.noted.clear();
  for (int freed = 0; freed < 3; ++freed) {
    node.scheduler.fibers().wake_one(worker.gate);
    // Runs after a slot was freed and before its sender: the slot is reserved for that sender.
    node.start([&node, &worker] {
      if (worker.offer(Work{99}) == Offered::rejected) node.note("kept");
    });
    node.settle();
  }
  CHECK(node.noted == "kept sent6 kept sent7 kept sent8 ");
  for (int i = 0; i < 8; ++i) {
    node.scheduler.fibers().wake_all(worker.gate);
    node.settle();
  }
  CHECK(worker.done == numbers(1, 8));
  node.scheduler.fibers().cancel_all();
  node.settle();
}

TEST_CASE("control overtakes data, even while a data handler waits", "[runtime][actor]") {
  Node node;
  Worker worker(node);
  worker.busy = true;
  worker.start();
  for (int i = 1; i <= 3; ++i) CHECK(worker.offer(Work{i}) == Offered::taken);
  CHECK(worker.offer(Stop{}) == Offered::taken);
  node.settle();
  CHECK(node.noted == "stop ");
  CHECK(worker.done.empty());
  node.scheduler.fibers().cancel_all();
  node.settle();
}

TEST_CASE("control has slots of its own however full the data lane is", "[runtime][mailbox]") {
  Node node;
  Worker worker(node);
  for (int i = 1; i <= 4; ++i) CHECK(worker.offer(Work{i}) == Offered::taken);
  for (int i = 1; i <= 2; ++i) CHECK(worker.offer(Hint{i}) == Offered::taken);
  CHECK(worker.offer(Hint{3}) == Offered::rejected);
  CHECK(worker.offer(Work{5}) == Offered::rejected);
  CHECK(worker.offer(Stop{}) == Offered::taken);
  CHECK(worker.offer(Beat{1}) == Offered::taken);
  node.settle();
  CHECK(node.noted == "stop beat1 ");
}

TEST_CASE("a kind that coalesces keeps its position and its latest content", "[runtime][mailbox]") {
  Node node;
  Worker worker(node);
  CHECK(worker.offer(Beat{1}) == Offered::taken);
  CHECK(worker.offer(Stop{}) == Offered::taken);
  CHECK(worker.offer(Beat{2}) == Offered::taken);
  CHECK(worker.offer(Beat{3}) == Offered::taken);
  CHECK(worker.waiting() == 2);
  node.settle();
  CHECK(node.noted == "beat3 stop ");
}

TEST_CASE("a full mailbox aborts the process if the kind's reaction is fail",
          "[runtime][mailbox]") {
  const test::End end = test::end_of([] {
    Node node;
    Worker worker(node);
    if (worker.offer(Stop{}) == Offered::taken && worker.offer(Stop{}) == Offered::taken) return;
  });
  CHECK(end.signal == SIGABRT);
  CHECK(end.standard_error.find("full of a kind that may not wait") != std::string::npos);
}

TEST_CASE("a sender that is cancelled while it waits has sent nothing", "[runtime][mailbox]") {
  Node node;
  Worker worker(node);
  for (int i = 1; i <= 4; ++i) CHECK(worker.offer(Work{i}) == Offered::taken);
  const FiberId sender = node.start([&] {
    if (worker.send(Work{5}) == Offered::cancelled) node.note("cancelled");
  });
  node.settle();
  node.scheduler.fibers().cancel(sender);
  node.settle();
  CHECK(node.noted == "cancelled ");
  worker.start();
  node.settle();
  CHECK(worker.done == numbers(1, 4));
  CHECK(worker.offer(Work{6}) == Offered::taken);
  node.settle();
  CHECK(worker.done.back() == 6);
  node.scheduler.fibers().cancel_all();
  node.settle();
}

TEST_CASE("an actor may have one lane only", "[runtime][actor]") {
  Node node;
  Sink sink(node.scheduler);
  Bell bell(node.scheduler);
  sink.start();
  node.start([&sink] {
    for (int i = 1; i <= 10; ++i)
      if (sink.send(Work{i}) != Offered::taken) return;
  });
  CHECK(bell.offer(Beat{7}) == Offered::taken);
  node.settle();
  CHECK(sink.sum == 55);
  CHECK(bell.last == 7);
  node.scheduler.fibers().cancel_all();
  node.settle();
}

TEST_CASE("an actor with a long queue lets other fibers run in between", "[runtime][actor]") {
  Node node;
  Sink sink(node.scheduler);
  sink.start();
  bool stop = false;
  int turns_of_other = 0;
  node.start([&] {
    while (!stop && node.scheduler.fibers().yield() == Wake::woken) ++turns_of_other;
  });
  node.start([&] {
    for (int i = 1; i <= 1000; ++i)
      if (sink.send(Work{1}) != Offered::taken) return;
    stop = true;
  });
  node.settle();
  CHECK(sink.sum == 1000);
  CHECK(turns_of_other > 30);
  node.scheduler.fibers().cancel_all();
  node.settle();
}

TEST_CASE("an actor is started before the seal", "[runtime][actor]") {
  const test::End end = test::end_of([] {
    Node node;
    Worker worker(node);
    node.scheduler.seal();
    worker.start();
  });
  CHECK(end.standard_error.find("after the seal") != std::string::npos);
}
