#include "runtime/net/credit.hpp"

#include <catch2/catch.hpp>
#include <deque>

#include "runtime/core/random.hpp"
#include "runtime/net/frame_ring.hpp"

using namespace luxodus;

namespace {

struct SentFrame {
  uint64_t total, bytes;
};

}  // namespace

TEST_CASE("nothing is sent before the first grant", "[runtime][credit]") {
  CreditOut out(1000);
  CHECK_FALSE(out.allows(1));
  CreditIn in(1000);
  out.grant(in.announce());
  CHECK(out.allows(1000));
  CHECK_FALSE(out.allows(1001));
}

TEST_CASE("held bytes never exceed the window, and credit returns", "[runtime][credit]") {
  Random random(5, RandomStream::test);
  random.start(0);
  CreditOut out(1000);
  CreditIn in(1000);
  std::deque<SentFrame> wire;
  std::deque<uint64_t> held;
  uint64_t sent_frames = 0;
  for (int i = 0; i < 20000; ++i) {
    const uint64_t bytes = 1 + random.bits() % 300;
    if (out.allows(bytes)) {
      out.spend(bytes);
      ++sent_frames;
      if (random.uniform() >= 0.2f) wire.push_back({out.sent(), bytes});  // a fifth is lost
    }
    if (!wire.empty() && random.uniform() < 0.5f) {
      // in order: never beyond the window
      CHECK(in.arrive(wire.front().total, wire.front().bytes));
      held.push_back(wire.front().bytes);
      wire.pop_front();
    }
    REQUIRE(in.held() <= in.window());
    if (!held.empty() && random.uniform() < 0.5f) {
      in.release(held.front());
      held.pop_front();
    }
    if (random.uniform() < 0.2f) out.grant(in.announce());
    if (wire.empty() && random.uniform() < 0.05f) in.settle(out.sent());  // a beat
  }
  CHECK(sent_frames > 2000);  // losses did not use up the credit
}

TEST_CASE("a frame sent beyond the window is lost", "[runtime][credit]") {
  CreditIn in(1000);
  CHECK(in.arrive(600, 600));
  CHECK_FALSE(in.arrive(1200, 600));
  CHECK(in.held() == 600);
}

TEST_CASE("a late or duplicate grant takes nothing back", "[runtime][credit]") {
  CreditOut out(1000);
  out.grant(500);
  out.spend(100);
  out.grant(200);
  CHECK(out.allows(400));
}

TEST_CASE("no grant allows more than the window to be outstanding", "[runtime][credit]") {
  CreditOut out(1000);
  for (int i = 0; i < 3; ++i) out.grant(~uint64_t{0} - static_cast<uint64_t>(i));
  CHECK(out.allows(1000));
  CHECK_FALSE(out.allows(1001));
  out.spend(1000);
  CHECK_FALSE(out.allows(1));
  out.restart();
  CHECK_FALSE(out.allows(1));
}

TEST_CASE("a ring keeps frames in order, whole and aligned, within its window", "[runtime][ring]") {
  constexpr size_t window = 2048, max_body = 500;
  FrameRing frames(window, max_body);
  Random random(9, RandomStream::test);
  random.start(0);
  std::deque<std::vector<std::byte>> expected;
  size_t held = 0, pushed = 0, popped = 0;
  for (int i = 0; i < 50000; ++i) {
    std::vector<std::byte> body(random.bits() % (max_body + 1),
                                static_cast<std::byte>(random.bits()));
    if (held + frame_charge(body.size()) <= window) {
      Envelope envelope;
      envelope.id.sequence = pushed++;
      frames.push(envelope, body);
      held += frame_charge(body.size());
      expected.push_back(std::move(body));
    } else if (!frames.empty()) {
      const auto front = frames.front();
      REQUIRE(front.envelope.id.sequence == popped++);
      REQUIRE(std::equal(front.body.begin(), front.body.end(), expected.front().begin(),
                         expected.front().end()));
      REQUIRE(reinterpret_cast<uintptr_t>(front.body.data()) % 8 == 0);
      held -= frame_charge(front.body.size());
      frames.pop();
      expected.pop_front();
    }
  }
  CHECK(popped > 1000);
}
