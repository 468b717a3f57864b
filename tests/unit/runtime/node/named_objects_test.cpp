#include "runtime/node/named_objects.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/runtime/node/app_kit.hpp"

using namespace luxodus;
using test::AppCluster;

namespace {

/// The text of an object, or what is wrong, as node 0 gets it.
std::string got(AppCluster& nodes, const std::string& name, uint16_t at = 0) {
  std::string text;
  bool done = false;
  REQUIRE(nodes[at]
              .spawn("gets",
                     [&] {
                       const auto bytes = nodes[at].get(name);
                       text = bytes ? std::string(as_text(bytes.value()))
                                    : "! " + bytes.problem().what;
                       done = true;
                     })
              .ok());
  nodes.until([&] { return done; });
  return text;
}

}  // namespace

TEST_CASE("an object is got by its name, whoever holds it", "[runtime][node][objects]") {
  AppCluster nodes(3);
  nodes[2].hold("greeting", "hello");
  nodes.start();
  REQUIRE(nodes[1].put("later", "put while it runs").ok());
  CHECK(got(nodes, "greeting") == "hello");
  CHECK(got(nodes, "later") == "put while it runs");
  CHECK(got(nodes, "later", 1) == "put while it runs");
  // The second time it is in the cache.
  const uint64_t fetches = nodes[0].objects().server().fetcher().counters().fetches;
  CHECK(got(nodes, "greeting") == "hello");
  CHECK(nodes[0].objects().server().fetcher().counters().fetches == fetches);
}

TEST_CASE("an object that no node holds is not found, as soon as all have said so",
          "[runtime][node][objects]") {
  AppCluster nodes(3);
  nodes.start();
  nodes.until([&] { return nodes[0].is_up(1) && nodes[0].is_up(2); });
  const Nanoseconds began = nodes.clock.now();
  CHECK(got(nodes, "nothing") == "! object 'nothing': no node holds it");
  CHECK(nodes.clock.now() - began < seconds(1));
}

TEST_CASE("a node that does not answer leaves the question open", "[runtime][node][objects]") {
  AppCluster nodes(3);
  nodes.start();
  nodes.until([&] { return nodes[0].is_up(1) && nodes[0].is_up(2); });
  nodes.kill(2);
  CHECK(got(nodes, "nothing")
            .find("! object 'nothing': 1 of 2 other nodes do not hold it, and the "
                  "others did not answer within 10 s") == 0);
}

TEST_CASE("fibers that want one object at once find and fetch it once",
          "[runtime][node][objects]") {
  AppCluster nodes(2);
  nodes[1].hold("one", "once");
  nodes.start();
  int had = 0;
  for (int i = 0; i < 20; ++i)
    REQUIRE(nodes[0].spawn("gets", [&] { had += nodes[0].get("one").ok() ? 1 : 0; }).ok());
  nodes.until([&] { return had == 20; });
  CHECK(nodes[0].objects().server().fetcher().counters().fetches == 1);
}

TEST_CASE("thousands of names at once are found within some round trips",
          "[runtime][node][objects]") {
  constexpr size_t many = 2000;
  AppCluster nodes(2, [](NodeOptions& options) { options.fibers = many; });
  for (size_t i = 0; i < many; ++i) nodes[1].hold("object " + std::to_string(i), std::to_string(i));
  nodes.start();
  nodes.until([&] { return nodes[0].is_up(1); });
  const Nanoseconds began = nodes.clock.now();
  size_t had = 0;
  for (size_t i = 0; i < many; ++i)
    REQUIRE(nodes[0]
                .spawn("gets",
                       [&, i] {
                         const auto bytes = nodes[0].get("object " + std::to_string(i));
                         had += bytes && as_text(bytes.value()) == std::to_string(i) ? 1 : 0;
                       })
                .ok());
  nodes.until([&] { return had == many; });
  CHECK(nodes.clock.now() - began < seconds(1));
}

TEST_CASE("the cache evicts what was used longest ago, and names are forgotten for others",
          "[runtime][node][objects]") {
  AppCluster nodes(2, [](NodeOptions& options) {
    options.max_object_bytes = 1000;
    options.cache_bytes = 4000;  // three objects beside one that comes in
    options.objects = 5;
  });
  for (int i = 0; i < 40; ++i)
    nodes[1].hold(std::to_string(i), std::string(1000, static_cast<char>('a' + i)));
  nodes.start();
  for (int round = 0; round < 2; ++round)
    for (int i = 0; i < 40; ++i) {
      CHECK(got(nodes, std::to_string(i)) == std::string(1000, static_cast<char>('a' + i)));
      CHECK(nodes[0].objects().server().cache().counters().resident_bytes <= 3000);
    }
  CHECK(nodes[0].objects().server().cache().counters().evictions >= 70);
}

TEST_CASE("an object is had from another holder when the first one has ended",
          "[runtime][node][objects]") {
  AppCluster nodes(3);
  for (const size_t holder : {1, 2}) nodes[holder].hold("twice", "held");
  nodes[1].hold("filler", "x");
  nodes.start();
  nodes.until([&] { return nodes[0].is_up(1) && nodes[0].is_up(2); });
  nodes.kill(1);
  CHECK(got(nodes, "twice") == "held");
}

TEST_CASE("a fiber that finds everything in the cache lets others run",
          "[runtime][node][objects]") {
  AppCluster nodes(2);
  nodes[1].hold("hot", "x");
  nodes.start();
  CHECK(got(nodes, "hot") == "x");
  bool other_ran = false;
  int before_other = 0;
  REQUIRE(nodes[0]
              .spawn("hits",
                     [&] {
                       while (!other_ran && before_other < 100'000) {
                         CHECK(nodes[0].get("hot").ok());
                         ++before_other;
                       }
                     })
              .ok());
  REQUIRE(nodes[0].spawn("other", [&] { other_ran = true; }).ok());
  nodes.until([&] { return other_ran; });
  CHECK(before_other <= 32);
}

TEST_CASE("what cannot be put is refused with its reason", "[runtime][node][objects]") {
  AppCluster nodes(1, [](NodeOptions& options) {
    options.max_object_bytes = 100;
    options.store_bytes = 150;
  });
  nodes.start();
  const auto why = [&](const char* name, const std::string& bytes) {
    const auto held = nodes[0].put(name, std::string_view(bytes));
    return held ? std::string() : held.problem().what;
  };
  CHECK(why("empty", "") == "object 'empty': it has no bytes");
  CHECK(why("long", std::string(101, 'x')).find("it has 101 bytes, and max_object_bytes is 100") !=
        std::string::npos);
  CHECK(why("a", std::string(100, 'x')).empty());
  CHECK(why("a", std::string(100, 'x')).empty());
  CHECK(why("a", "other").find("an object never changes") != std::string::npos);
  CHECK(why("b", std::string(100, 'y')).find("100 of store_bytes, 150") != std::string::npos);
}
