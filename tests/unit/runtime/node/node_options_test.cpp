// Each mistake of a user of the library, and the sentence that he gets at the start.
#include "runtime/node/node_options.hpp"

#include <catch2/catch.hpp>

#include "tests/kit/taken_port.hpp"
#include "tests/unit/runtime/node/app_kit.hpp"

using namespace luxodus;

namespace {

/// What start() says of a node of two, in a network that no mistake reaches.
std::string refusal_of(const std::function<void(NodeOptions&)>& change,
                       const std::function<void(Node&)>& furnish = {}) {
  test::SimNet net;
  const ManualClock clock(seconds(1));
  NodeOptions options = test::options_of(0, 2);
  if (change) change(options);
  test::SimTransport transport(net, {0});
  Node node(options, clock, transport);
  if (furnish) furnish(node);
  const auto started = node.start();
  return started ? "" : started.problem().what;
}

bool says(const std::string& text, const std::string& part) {
  INFO(text);
  CHECK(text.find(part) != std::string::npos);
  return text.find(part) != std::string::npos;
}

void ignore(Mail&) {}

}  // namespace

TEST_CASE("the options as they are by default have no mistake", "[runtime][node][options]") {
  CHECK(refusal_of({}).empty());
}

TEST_CASE("a mistake in the nodes or links is told with its place", "[runtime][node][options]") {
  CHECK(says(refusal_of([](NodeOptions& o) { o.nodes.clear(); }), "nodes has 0 endpoints"));
  CHECK(says(refusal_of([](NodeOptions& o) { o.self = 2; }), "self is 2, but the 2 nodes have"));
  CHECK(says(refusal_of([](NodeOptions& o) { o.nodes[1] = "127.0.0.1:7400"; }),
             "nodes[1] is '127.0.0.1:7400': an endpoint is tcp://HOST:PORT"));
  CHECK(says(refusal_of([](NodeOptions& o) { o.nodes[1] = "tcp://127.0.0.1:7401"; }),
             "nodes[1] is 'tcp://127.0.0.1:7401', which another node has already"));
  CHECK(says(refusal_of([](NodeOptions& o) {
               o.links = {{{0}, {2}}};
             }),
             "links has one from 0 to 2"));
  CHECK(says(refusal_of([](NodeOptions& o) {
               o.nodes.push_back("tcp://127.0.0.1:7410");
               o.links = {{{0}, {1}}};
             }),
             "links do not join all 3 nodes"));
  CHECK(says(refusal_of([](NodeOptions& o) { o.keys = KeyPair{}; }),
             "public_keys has 0 keys for 2 nodes"));
}

TEST_CASE("a budget that does not fit is told with what it needs", "[runtime][node][options]") {
  CHECK(says(refusal_of([](NodeOptions& o) { o.cache_bytes = 1'500'000; }),
             "cache_bytes is 1500000, and the largest object may have 1048576: a cache needs room "
             "for two of them"));
  CHECK(says(refusal_of([](NodeOptions& o) { o.max_message_bytes = 100; }),
             "max_message_bytes is 100: give 4096 to 1073741824"));
  CHECK(says(refusal_of([](NodeOptions& o) { o.waiting_bytes = 1000; }), "waiting_bytes is 1000"));
  CHECK(says(refusal_of([](NodeOptions& o) { o.objects = 0; }), "objects is 0"));
  CHECK(says(refusal_of({}, [](Node& node) { node.hold("big", std::string(2 << 20, 'x')); }),
             "object 'big': it has 2097152 bytes, and max_object_bytes is 1048576"));
}

TEST_CASE("a mistake in an actor is told with its name", "[runtime][node][options]") {
  CHECK(says(refusal_of({},
                        [](Node& node) {
                          node.actor("twice", ignore);
                          node.actor("twice", ignore);
                        }),
             "actor 'twice': another actor of this node has this name"));
  CHECK(says(refusal_of({}, [](Node& node) { node.actor("deaf", ignore, {.mailbox = 0}); }),
             "actor 'deaf': its mailbox has 0 places: give 1 to 1000000"));
  CHECK(says(refusal_of({}, [](Node& node) { node.actor("", ignore); }),
             "a name has 1 to 100 characters"));
  CHECK(says(refusal_of({}, [](Node& node) { node.actor("empty", {}); }), "it has no handler"));
  CHECK(says(refusal_of([](NodeOptions& o) { o.fibers = 0; },
                        [](Node& node) { node.fiber("one", [] {}); }),
             "1 fibers begin at the start, and NodeOptions::fibers is 0"));
}

TEST_CASE("all mistakes are told at once", "[runtime][node][options]") {
  const std::string text = refusal_of(
      [](NodeOptions& o) {
        o.cache_bytes = 1;
        o.objects = 0;
      },
      [](Node& node) { node.actor("deaf", ignore, {.mailbox = 0}); });
  CHECK(says(text, "cache_bytes is 1"));
  CHECK(says(text, "objects is 0"));
  CHECK(says(text, "its mailbox has 0 places"));
}

TEST_CASE("a message that is too long, or for no node, is refused where it is sent",
          "[runtime][node][options]") {
  test::AppCluster nodes(2);
  nodes[0].actor("any", ignore);
  nodes.start();
  const std::string long_text((16 << 20) + 1, 'x');
  const auto sent = nodes[0].send(actor_at(1, "any"), std::string_view(long_text));
  REQUIRE_FALSE(sent.ok());
  CHECK(says(sent.problem().what,
             "a message of 16777217 bytes to node 1: max_message_bytes is "
             "16777216"));
  CHECK(says(nodes[0].send(actor_at(7, "any"), "x").problem().what,
             "node 7 is none of the cluster: its 2 nodes have the numbers 0 to 1"));
}

TEST_CASE("a port in use ends the start with its endpoint", "[runtime][node][options]") {
  spdlog::set_level(spdlog::level::off);
  const test::TakenPort taken;
  NodeOptions options;
  options.nodes = {"tcp://127.0.0.1:" + std::to_string(taken.number())};
  Node node(options);
  const auto started = node.start();
  REQUIRE_FALSE(started.ok());
  CHECK(says(started.problem().text(), options.nodes[0] + ": cannot listen there"));
}
