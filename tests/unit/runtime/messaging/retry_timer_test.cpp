#include "runtime/messaging/retry_timer.hpp"

#include <catch2/catch.hpp>

using namespace luxodus;

namespace {
constexpr Nanoseconds least = seconds(2), most = seconds(30);
}

TEST_CASE("a question is asked again after the least wait, then each time after twice as long",
          "[messaging]") {
  RetryTimer timer(least, most);
  CHECK_FALSE(timer.is_open());
  CHECK_FALSE(timer.is_due(seconds(100)));  // nothing was asked
  Nanoseconds now = 0;
  for (const Nanoseconds wait : {seconds(2), seconds(4), seconds(8), seconds(16), most, most}) {
    timer.asked(now);
    CHECK(timer.is_open());
    CHECK_FALSE(timer.is_due(now + wait - 1));
    CHECK(timer.is_due(now + wait));
    now += wait;
  }
}

TEST_CASE("the first wait is twice what the last answer took since it was first asked for",
          "[messaging]") {
  RetryTimer timer(least, most);
  timer.asked(0);
  timer.asked(seconds(2));
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

TEST_CASE("what is asked in place of a question that was given up begins with the first wait",
          "[messaging]") {
  RetryTimer timer(least, most);
  timer.asked(0);
  timer.asked(seconds(2));
  timer.forget();
  CHECK_FALSE(timer.is_open());
  timer.asked(seconds(3));
  CHECK(timer.is_due(seconds(5)));
}

TEST_CASE("what can wait rests for eight times as long as the last answer took", "[messaging]") {
  RetryTimer timer(least, most);
  CHECK(timer.has_rested(0));  // nothing was asked
  timer.asked(0);
  CHECK_FALSE(timer.has_rested(seconds(100)));  // it is asked
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
