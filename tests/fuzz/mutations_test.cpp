// The short run of the fuzzers in every test run: the codec alone, a whole node, a node in every
// state of a link, payloads. The seed is LUXODUS_SEED, or 1; a failure prints it.
// tests/tools/fuzz.sh runs the same without end.
#include <catch2/catch.hpp>
#include <cstdlib>

#include "tests/fuzz/fuzz_codec.hpp"
#include "tests/fuzz/fuzz_flush.hpp"
#include "tests/fuzz/fuzz_session.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/fuzz/samples.hpp"
#include "tests/unit/runtime/net/net_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

uint64_t seed() {
  const char* text = std::getenv("LUXODUS_SEED");
  return text != nullptr ? std::strtoull(text, nullptr, 0) : 1;
}

Random numbers() {
  Random random(seed(), RandomStream::test);
  random.start(0);
  return random;
}

const Bytes& any(const std::vector<Bytes>& corpus, Random& random) {
  return corpus[random.bits() % corpus.size()];
}

}  // namespace

TEST_CASE("the codec decodes or rejects any bytes", "[fuzz]") {
  Codec codec;
  std::vector<Bytes> corpus;
  for (const Message& message : sample_messages()) corpus.push_back(sample_frame(codec, message));
  for (const Bytes& frame : corpus) REQUIRE(fuzz_one(frame));
  Random random = numbers();
  INFO("seed " << seed());
  int understood = 0;
  constexpr int tries = 60'000;
  for (int i = 0; i < tries; ++i)
    understood += fuzz_one(mutated(any(corpus, random), any(corpus, random), random));
  CHECK(understood > tries / 100);  // mutations that reach deep, not only the segment table
  CHECK(understood < tries);
}

TEST_CASE("corrupted frames leave a node up and working", "[fuzz]") {
  INFO("seed " << seed());
  Cluster trio(3, ring(3));
  trio.net.max_record = 400;
  trio.bring_up();
  trio[0].network.send({1}, trio[0].network.next_id(), FetchObject{{1}, 2, 3});
  trio[2].network.send({1}, trio[2].network.next_id(), Flush{1, 2, {3, 4, 5}},
                       share(pattern(100'000)));
  trio.run(seconds(1));
  const std::vector<Bytes> corpus = trio.net.recorded;
  REQUIRE(corpus.size() > 50);
  trio.net.max_record = 0;

  Random random = numbers();
  for (int i = 0; i < 30'000; ++i) {
    const NodeId from{static_cast<uint16_t>(random.bits() % 3)};
    const Lane lane = random.bits() % 2 == 0 ? Lane::control : Lane::bulk;
    Bytes forged = mutated(any(corpus, random), any(corpus, random), random);
    // Half of them corrupted in transit, half forged with a valid check.
    if (random.bits() % 2 == 0 && forged.size() >= limits::check_bytes) Codec::seal(forged);
    trio.net.send(from, {1}, lane, forged, {});
    if (i % 100 == 99) trio.turn(milliseconds(10));
  }
  CHECK(trio[1].network.counters().dropped_malformed > 3'000);

  // Forged frames have refused links, granted too much and reported links as down: all of that
  // recovers without a restart.
  trio.run(seconds(70));
  for (const uint16_t other : {uint16_t{0}, uint16_t{2}})
    CHECK(trio[1].network.phase({other}) == LinkPhase::up);
  const size_t before = trio[1].handler.count<AskStatus>();
  trio[0].network.send({1}, trio[0].network.next_id(), AskStatus{});
  trio[2].network.send({1}, trio[2].network.next_id(), AskStatus{});
  trio.run(seconds(1));
  CHECK(trio[1].handler.count<AskStatus>() == before + 2);
}

TEST_CASE("any message in any state of a link leaves a node's memory unchanged", "[fuzz]") {
  INFO("seed " << seed());
  Random random = numbers();
  const auto byte = [&] { return static_cast<std::byte>(random.bits()); };
  uint64_t understood = 0, frames = 0;
  constexpr int sessions = 60;
  for (int i = 0; i < sessions; ++i) {
    Bytes script{byte()};
    for (int frame = 0; frame < 100; ++frame, ++frames) {
      script.push_back(byte());
      // Mostly of this session and with a valid check, as a neighbour can make them.
      const bool made = random.uniform() < 0.8f;
      script.push_back(byte() |
                       static_cast<std::byte>(made ? session::addressed | session::sealed : 0));
      const size_t harms = random.uniform() < 0.3f ? 0 : 1 + random.bits() % 3;
      script.push_back(static_cast<std::byte>(harms));
      for (size_t h = 0; h < 3 * harms; ++h) script.push_back(byte());
    }
    understood += fuzz_session(script);
  }
  CHECK(understood > frames / 10);
  CHECK(understood < frames);
}

TEST_CASE("flushes are decoded or rejected, whatever bytes they are", "[fuzz]") {
  INFO("seed " << seed());
  Random random = numbers();
  const Bytes whole = sample_flush();
  REQUIRE(fuzz_flush(whole, true));
  int understood = 0;
  constexpr int tries = 20'000;
  for (int i = 0; i < tries; ++i) understood += fuzz_flush(mutated(whole, whole, random), true);
  for (int i = 0; i < tries / 10; ++i) fuzz_flush(mutated(whole, whole, random), false);
  CHECK(understood > tries / 100);
  CHECK(understood < tries);
}
