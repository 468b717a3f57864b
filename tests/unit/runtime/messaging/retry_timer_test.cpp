#include "runtime/messaging/retry_timer.hpp"

#include <catch2/catch.hpp>

using namespace luxodus;

namespace {
constexpr Nanoseconds least = seconds(2), most = seconds(30);
}

TEST_CASE("a question is retried after the least wait, then after twice as long each time",
          "[messaging]") {
  RetryTimer timer(least, most);
  CHECK(timer.may_ask(0));
  CHECK_FALSE(timer.is_due(seconds(100)));  // nothing was asked
  Nanoseconds now = 0;
  for (const Nanoseconds wait : {seconds(2), seconds(4), seconds(8), seconds(16), most, most}) {
    timer.asked(now);
    CHECK_FALSE(timer.may_ask(now + wait - 1));
    CHECK(timer.may_ask(now + wait));
    CHECK_FALSE(timer.is_due(now + wait - 1));
    CHECK(timer.is_due(now + wait));
    now += wait;
  }
}

TEST_CASE("the first wait is twice what the last answer took", "[messaging]") {
  RetryTimer timer(least, most);
  timer.asked(0);
  timer.answered(seconds(5));
  CHECK(timer.took() == seconds(5));
  CHECK(timer.first_wait() == seconds(10));
  CHECK_FALSE(timer.is_due(seconds(100)));  // it is answered
  timer.asked(seconds(100));
  CHECK_FALSE(timer.is_due(seconds(110) - 1));
  CHECK(timer.is_due(seconds(110)));

  SECTION("quick answers bring it back to the least") {
    timer.answered(seconds(100) + 1);
    CHECK(timer.first_wait() == least);
  }
  SECTION("no answer takes it beyond the most") {
    timer.answered(seconds(200));
    CHECK(timer.first_wait() == most);
  }
  SECTION("an answer that nobody waits for teaches nothing") {
    timer.forget();
    timer.answered(seconds(100) + 1);
    CHECK(timer.first_wait() == seconds(10));
  }
}

TEST_CASE("a question that replaces an abandoned one begins with the first wait", "[messaging]") {
  RetryTimer timer(least, most);
  timer.asked(0);
  timer.asked(seconds(2));
  timer.forget();
  CHECK(timer.may_ask(seconds(2)));
  timer.asked(seconds(3));
  CHECK(timer.is_due(seconds(5)));
}

TEST_CASE("among several copies the answered one is inferred from earlier answers", "[messaging]") {
  RetryTimer timer(least, most);
  timer.asked(0);
  timer.answered(seconds(3));
  const auto answered_after = [&](Nanoseconds last_copy, Nanoseconds answer) {
    const Nanoseconds begun = seconds(1000);
    timer.asked(begun);
    timer.asked(begun + last_copy);
    timer.answered(begun + answer);
    return timer.took();
  };
  CHECK(answered_after(seconds(6), seconds(7)) == seconds(3));   // the first may have been late
  CHECK(answered_after(seconds(6), seconds(10)) == seconds(4));  // the second took no less
  CHECK(answered_after(seconds(1), seconds(2)) == seconds(2));   // the first took no more
}

TEST_CASE("losing the first copy each time does not lengthen the waits", "[messaging]") {
  RetryTimer timer(least, most);
  for (int question = 0; question < 10; ++question) {
    const Nanoseconds begun = seconds(100) * question;
    timer.asked(begun);
    CHECK(timer.is_due(begun + least));
    timer.asked(begun + least);
    timer.answered(begun + least + milliseconds(1));
  }
  CHECK(timer.first_wait() == least);
}

TEST_CASE("the pause after an answer is eight times as long as the answer took", "[messaging]") {
  RetryTimer timer(least, most);
  CHECK(timer.has_rested(0));  // nothing was asked
  timer.asked(0);
  CHECK_FALSE(timer.has_rested(seconds(100)));  // a question is in flight
  timer.answered(seconds(1));
  CHECK(timer.rest() == seconds(8));
  CHECK_FALSE(timer.has_rested(seconds(9) - 1));
  CHECK(timer.has_rested(seconds(9)));
  timer.asked(seconds(10));
  timer.answered(seconds(20));
  CHECK(timer.rest() == most);
  timer.asked(seconds(60));
  timer.answered(seconds(60) + 1);
  CHECK(timer.rest() == least);
}
