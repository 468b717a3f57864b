// The examples of the runtime, each on two processes.
#include <catch2/catch.hpp>
#include <string>

#include "tests/kit/process.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus::test;

namespace {

/// Two processes of one example, with endpoints of their own.
class TwoNodes {
 public:
  explicit TwoNodes(std::string example)
      : program_(std::string(LUX_EXAMPLES) + "/" + std::move(example)) {}

  Process start(int node, const std::string& more = "") const {
    std::vector<std::string> words{std::to_string(node), endpoint("0"), endpoint("1")};
    if (!more.empty()) words.push_back(more);
    return Process(program_, words);
  }

 private:
  std::string endpoint(const char* node) const { return "ipc://" + (folder_ / node).string(); }

  const TemporaryFolder folder_;
  const std::string program_;
};

}  // namespace

TEST_CASE("the object example gets its object from the other process", "[library]") {
  const TwoNodes nodes("object");
  Process holder = nodes.start(1), asker = nodes.start(0);
  CHECK(asker.wait() == 0);
  CHECK(asker.text() == "hello from the other node\n");
  CHECK(holder.wait() == 0);
  CHECK(holder.text().empty());
}

TEST_CASE("ping-pong counts its rounds in messages of its own schema", "[library]") {
  const TwoNodes nodes("ping_pong");
  Process pong = nodes.start(1), ping = nodes.start(0, "500");
  CHECK(ping.wait() == 0);
  CHECK(ping.text() == "500 rounds\n");
  CHECK(pong.wait() == 0);
}

TEST_CASE("the key-value store gives every value, within its cache", "[library]") {
  const TwoNodes nodes("key_value");
  Process store = nodes.start(1), reader = nodes.start(0);
  CHECK(reader.wait() == 0);
  INFO(reader.text());
  CHECK(reader.said("400 of 400 values"));
  // 30 values fit beside one that comes in, and the 10 popular ones among them stay.
  CHECK(reader.said("210 found in the cache, 160 evicted, 300000 bytes resident"));
  CHECK(store.wait() == 0);
}

TEST_CASE("the pipeline gives the exact sum although its second stage is killed twice",
          "[library]") {
  const TwoNodes nodes("pipeline");
  constexpr long numbers = 20'000;
  Process giver = nodes.start(0, std::to_string(numbers));
  for (int kill = 0; kill < 2; ++kill) {
    Process squarer = nodes.start(1);
    REQUIRE(giver.says("answered " + std::to_string(5000 * (kill + 1))));
    squarer.kill(SIGKILL);
    CHECK(squarer.wait() == 128 + SIGKILL);
  }
  Process squarer = nodes.start(1);
  CHECK(giver.wait() == 0);
  INFO(giver.text());
  CHECK(giver.said("sum " + std::to_string(numbers * (numbers + 1) * (2 * numbers + 1) / 6)));
  CHECK(squarer.wait() == 0);
}

TEST_CASE("an example that is started without its arguments says so", "[library]") {
  Process lost(std::string(LUX_EXAMPLES) + "/object", {});
  CHECK(lost.wait() == 2);
  CHECK(lost.said("usage: object 0|1 ENDPOINT0 ENDPOINT1"));
}
