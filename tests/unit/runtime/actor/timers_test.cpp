#include "runtime/actor/timers.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <utility>
#include <vector>

#include "runtime/core/random.hpp"

using namespace luxodus;

namespace {

constexpr size_t no_limit = 1'000'000;

/// The specification of the wheel, as slow as can be: a list sorted by deadline, then by order of
/// setting.
class Model {
 public:
  void set(Nanoseconds deadline, int name) {
    const Nanoseconds from = std::max(deadline, now_);
    const auto behind = std::upper_bound(list_.begin(), list_.end(), from,
                                         [](Nanoseconds t, const Entry& e) { return t < e.at; });
    list_.insert(behind, {from, name});
  }
  bool cancel(int name) {
    const auto found =
        std::find_if(list_.begin(), list_.end(), [&](const Entry& e) { return e.name == name; });
    if (found == list_.end()) return false;
    list_.erase(found);
    return true;
  }
  std::vector<int> run_due(Nanoseconds now) {
    std::vector<int> fired;
    while (!list_.empty() && list_.front().at <= now) {
      fired.push_back(list_.front().name);
      list_.erase(list_.begin());
    }
    now_ = now;
    return fired;
  }
  Nanoseconds next() const { return list_.empty() ? never : list_.front().at; }

 private:
  struct Entry {
    Nanoseconds at;
    int name;
  };
  Nanoseconds now_ = 0;
  std::vector<Entry> list_;
};

struct Wheel {
  explicit Wheel(size_t capacity = 16) : timers(capacity, 0) {}

  TimerId set(Nanoseconds deadline, int name) {
    return timers.set(deadline, [this, name] { fired.push_back(name); });
  }
  std::vector<int> run(Nanoseconds now) {
    fired.clear();
    timers.run_due(now, no_limit);
    return fired;
  }

  Timers timers;
  std::vector<int> fired;
};

}  // namespace

TEST_CASE("a timer fires at its deadline, never before, and once", "[runtime][timers]") {
  Wheel wheel;
  wheel.set(1000, 1);
  CHECK(wheel.run(999).empty());
  CHECK(wheel.run(1000) == std::vector<int>{1});
  CHECK(wheel.run(5000).empty());
  CHECK(wheel.timers.set_now() == 0);
}

TEST_CASE("a cancelled timer does not fire, and its id is useless afterwards",
          "[runtime][timers]") {
  Wheel wheel(1);
  const TimerId first = wheel.set(1000, 1);
  CHECK(wheel.timers.cancel(first));
  CHECK_FALSE(wheel.timers.cancel(first));
  wheel.set(1000, 2);
  CHECK_FALSE(wheel.timers.cancel(first));
  CHECK(wheel.run(1000) == std::vector<int>{2});
}

TEST_CASE("a deadline in the past counts as now, after timers that were set for now",
          "[runtime][timers]") {
  Wheel wheel;
  wheel.run(5000);
  wheel.set(5000, 1);
  wheel.set(7, 2);
  wheel.set(5000, 3);
  CHECK(wheel.timers.next() == 5000);
  CHECK(wheel.run(5000) == std::vector<int>{1, 2, 3});
}

TEST_CASE("the farthest deadline stays in its slot", "[runtime][timers]") {
  Wheel wheel;
  wheel.set(never, 1);
  wheel.set(never - 1, 2);
  CHECK(wheel.run(seconds(1'000'000)).empty());
  CHECK(wheel.run(never - 2).empty());
  CHECK(wheel.run(never) == std::vector<int>{2, 1});
}

TEST_CASE("a timer that sets itself again for now cannot block the loop", "[runtime][timers]") {
  Timers timers(4, 0);
  struct Again {
    Timers& timers;
    int fired = 0;
    void operator()() {
      ++fired;
      timers.set(0, [this] { (*this)(); });
    }
  } again{timers};
  again();
  CHECK(timers.run_due(0, 10) == 10);
  CHECK(again.fired == 11);
}

TEST_CASE("random settings, cancellations and steps fire as a sorted list would",
          "[runtime][timers]") {
  constexpr int actions = 40'000;
  Wheel wheel(actions);
  Model model;
  Random random(20, RandomStream::test);
  random.start(1);
  std::vector<std::pair<TimerId, int>> known;
  Nanoseconds now = 0;
  const auto span = [&] {  // of any order of magnitude, to 18 minutes
    const auto width = static_cast<int>(random.bits() % 40);
    return static_cast<Nanoseconds>(random.bits64() >> (63 - width));
  };
  for (int i = 0; i < actions; ++i) {
    const uint32_t action = random.bits() % 8;
    if (action < 4) {
      const Nanoseconds deadline = now + span();
      known.emplace_back(wheel.set(deadline, i), i);
      model.set(deadline, i);
    } else if (action < 6 && !known.empty()) {
      const auto [id, name] = known[random.bits() % known.size()];
      REQUIRE(wheel.timers.cancel(id) == model.cancel(name));
    } else {
      now += span() >> 10;
      REQUIRE(wheel.run(now) == model.run_due(now));
    }
    REQUIRE(wheel.timers.next() <= model.next());
    REQUIRE((wheel.timers.next() == never) == (model.next() == never));
  }
  REQUIRE(wheel.run(never) == model.run_due(never));
  CHECK(wheel.timers.set_now() == 0);
}
