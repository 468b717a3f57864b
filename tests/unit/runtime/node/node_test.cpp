#include "runtime/node/node.hpp"

#include <catch2/catch.hpp>
#include <stdexcept>

#include "tests/unit/runtime/node/app_kit.hpp"

using namespace luxodus;
using test::AppCluster;

namespace {

/// Has the node answer "NAME:" and what it was asked.
void answer_as(Node& node, const std::string& name, ActorOptions options = {}) {
  node.actor(
      name, [&node, name](Mail& mail) { node.answer(mail, name + ":" + std::string(mail.text())); },
      options);
}

/// Runs `body` on a fiber of this node and returns once it has ended.
void on_fiber(AppCluster& nodes, uint16_t node, const std::function<void()>& body) {
  bool done = false;
  REQUIRE(nodes[node]
              .spawn("test",
                     [&] {
                       body();
                       done = true;
                     })
              .ok());
  nodes.until([&] { return done; });
}

}  // namespace

TEST_CASE("an actor is asked by node and name, on its own node and on others", "[runtime][node]") {
  AppCluster nodes(2);
  answer_as(nodes[0], "near");
  answer_as(nodes[1], "far");
  nodes.start();
  on_fiber(nodes, 0, [&] {
    CHECK(nodes[0].ask(actor_at(0, "near"), "a")->text() == "near:a");
    CHECK(nodes[0].ask(actor_at(1, "far"), "b")->text() == "far:b");
  });
}

TEST_CASE("a message of any size up to the limit arrives whole", "[runtime][node]") {
  AppCluster nodes(2);
  nodes[1].actor("mirror", [&](Mail& mail) { nodes[1].answer(mail, mail.bytes()); });
  nodes.start();
  on_fiber(nodes, 0, [&] {
    for (const size_t size : {0u, 1u, 3967u, 3968u, 3969u, 4096u, 65536u, 1'000'000u}) {
      INFO(size);
      std::string text(size, 'x');
      for (size_t i = 0; i < size; ++i) text[i] = static_cast<char>(i * 7);
      const auto answer = nodes[0].ask(actor_at(1, "mirror"), std::string_view(text));
      REQUIRE(answer.ok());
      CHECK(answer->text() == text);
    }
  });
}

TEST_CASE("a request is repeated under its id until it is answered", "[runtime][node]") {
  AppCluster nodes(2);
  nodes.net.faults.loss = 0.3F;
  std::vector<uint64_t> ids;
  nodes[1].actor("far", [&](Mail& mail) {
    ids.push_back(mail.id.sequence);
    nodes[1].answer(mail, mail.bytes());
  });
  nodes.start();
  nodes.run(seconds(5));
  on_fiber(nodes, 0, [&] {
    for (int i = 0; i < 30; ++i)
      CHECK(nodes[0].ask(actor_at(1, "far"), std::to_string(i), seconds(60))->text() ==
            std::to_string(i));
  });
  CHECK(nodes[0].actors().counters().retries > 0);
  std::sort(ids.begin(), ids.end());
  CHECK(std::unique(ids.begin(), ids.end()) - ids.begin() == 30);
}

TEST_CASE("what nobody answers is an error that names the node, after the patience",
          "[runtime][node]") {
  AppCluster nodes(2);
  nodes.start();
  on_fiber(nodes, 0, [&] {
    const Nanoseconds began = nodes[0].now();
    const auto answer = nodes[0].ask(actor_at(1, "nobody"), "?", seconds(3));
    REQUIRE_FALSE(answer.ok());
    CHECK(answer.problem().kind == ProblemKind::lost_peer);
    CHECK(answer.problem().what.find("no answer from node 1 within 3 s") == 0);
    CHECK(nodes[0].now() - began < seconds(3) + milliseconds(10));
  });
  CHECK(nodes[1].actors().counters().no_actor > 1);
}

TEST_CASE("a handler may wait for another actor, and the node's other fibers run meanwhile",
          "[runtime][node]") {
  AppCluster nodes(2);
  nodes[0].actor("relay", [&](Mail& mail) {
    nodes[0].answer(mail, nodes[0].ask(actor_at(1, "far"), mail.bytes()).value().bytes());
  });
  answer_as(nodes[1], "far");
  nodes.start();
  int turns = 0;
  bool done = false;
  REQUIRE(nodes[0]
              .spawn("counts",
                     [&] {
                       while (!done && nodes[0].sleep(milliseconds(1))) ++turns;
                     })
              .ok());
  on_fiber(nodes, 1, [&] { CHECK(nodes[1].ask(actor_at(0, "relay"), "x")->text() == "far:x"); });
  done = true;
  CHECK(turns > 0);
}

TEST_CASE("a full mailbox of the node makes a sending fiber wait and loses nothing",
          "[runtime][node]") {
  AppCluster nodes(1);
  int handled = 0;
  nodes[0].actor("slow",
                 [&](Mail&) {
                   (void)nodes[0].sleep(milliseconds(5));
                   ++handled;
                 },
                 {.mailbox = 2});
  nodes.start();
  on_fiber(nodes, 0, [&] {
    for (int i = 0; i < 20; ++i) CHECK(nodes[0].send(actor_at(0, "slow"), "x").ok());
  });
  nodes.until([&] { return handled == 20; });
}

TEST_CASE("an actor begins anew as often as its options say, and then its node leaves",
          "[runtime][node]") {
  AppCluster nodes(1);
  int resets = 0;
  nodes[0].actor("breaks", [&](Mail&) { throw std::runtime_error("it broke"); },
                 {.restarts = 2, .reset = [&] { ++resets; }});
  nodes.start();
  for (int i = 0; i < 3; ++i) {
    CHECK_FALSE(nodes[0].verdict().has_value());
    CHECK(nodes[0].send(actor_at(0, "breaks"), "x").ok());
    nodes.run(milliseconds(20), milliseconds(1));
  }
  CHECK(resets == 2);
  REQUIRE(nodes[0].verdict().has_value());
  CHECK(nodes[0].verdict()->text ==
        "the actor 'breaks' has failed more than 2 times in 60 s: it broke");
  nodes.until([&] { return nodes[0].finished(); });
}

TEST_CASE("an exception that leaves a fiber makes the node leave and says which",
          "[runtime][node]") {
  AppCluster nodes(1);
  nodes[0].fiber("reader", [] { throw std::runtime_error("no file"); });
  nodes.start();
  nodes.until([&] { return nodes[0].finished(); });
  CHECK(nodes[0].verdict()->text == "the fiber 'reader' has failed: no file");
}

TEST_CASE("a node that leaves cancels its fibers, and its neighbours hear of it",
          "[runtime][node]") {
  AppCluster nodes(2);
  std::string ended;
  nodes[0].fiber("asks", [&] {
    const auto answer = nodes[0].ask(actor_at(1, "nobody"), "?", seconds(1000));
    ended = answer.ok() ? "answered" : answer.problem().what;
  });
  nodes.start();
  nodes.until([&] { return nodes[1].is_up(0); });
  nodes[0].leave();
  nodes.until([&] { return nodes[0].finished(); }, seconds(2));
  CHECK(ended == "the node leaves");
  CHECK_FALSE(nodes[0].verdict().has_value());
  nodes.until([&] { return !nodes[1].is_up(0); }, milliseconds(100));
}

TEST_CASE("a peer that was killed and comes back answers again", "[runtime][node]") {
  AppCluster nodes(2);
  answer_as(nodes[1], "far");
  nodes.start();
  on_fiber(nodes, 0, [&] { CHECK(nodes[0].ask(actor_at(1, "far"), "1").ok()); });
  nodes.kill(1);
  bool answered = false;
  REQUIRE(nodes[0]
              .spawn("asks",
                     [&] { answered = nodes[0].ask(actor_at(1, "far"), "2", seconds(30)).ok(); })
              .ok());
  nodes.run(seconds(3));
  CHECK_FALSE(answered);
  Node& again = nodes.revive(1);
  answer_as(again, "far");
  REQUIRE(again.start().ok());
  nodes.until([&] { return answered; });
}

TEST_CASE("messages between nodes without a link pass through others", "[runtime][node]") {
  AppCluster nodes(4, [](NodeOptions& options) {
    options.links = {{{0}, {1}}, {{1}, {2}}, {{2}, {3}}, {{0}, {3}}};
  });
  answer_as(nodes[2], "far");
  nodes.start();
  on_fiber(nodes, 0, [&] { CHECK(nodes[0].ask(actor_at(2, "far"), "a").ok()); });
  nodes.kill(1);  // the way by node 3 is left
  nodes.run(seconds(5));
  on_fiber(nodes, 0, [&] { CHECK(nodes[0].ask(actor_at(2, "far"), "b")->text() == "far:b"); });
}
