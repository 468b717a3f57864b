#include <catch2/catch.hpp>
#include <csignal>
#include <set>
#include <string>
#include <vector>

#include "runtime/core/fixed_pool.hpp"
#include "runtime/core/intrusive_list.hpp"
#include "runtime/core/memory_plan.hpp"
#include "runtime/core/ring.hpp"
#include "runtime/core/task.hpp"
#include "tests/unit/runtime/core/forked_end.hpp"

using namespace luxodus;

namespace {

struct Member : ListHook {
  explicit Member(int n) : number(n) {}
  int number;
};

std::vector<int> drained(IntrusiveList<Member>& list) {
  std::vector<int> numbers;
  while (const Member* member = list.pop_front()) numbers.push_back(member->number);
  return numbers;
}

struct Pooled {
  int state = 0;
};

}  // namespace

TEST_CASE("a pool lends each object once, the last given back first", "[core][pool]") {
  FixedPool<Pooled> pool("test", 3, WhenEmpty::wait);
  std::set<Pooled*> lent;
  for (int i = 0; i < 3; ++i) lent.insert(pool.take());
  CHECK(lent.size() == 3);
  CHECK(lent.count(nullptr) == 0);
  CHECK(pool.take() == nullptr);
  Pooled& middle = pool.at(1);
  middle.state = 42;
  pool.give(middle);
  CHECK(pool.in_use() == 2);
  CHECK(pool.take() == &middle);
  CHECK(middle.state == 42);
  CHECK(pool.max_in_use() == 3);
  CHECK(pool.index_of(middle) == 1);
}

TEST_CASE("a Loan finds its object while it is lent, and nothing afterwards", "[core][pool]") {
  FixedPool<Pooled> pool("test", 2, WhenEmpty::wait);
  Pooled* object = pool.take();
  const Loan first = pool.loan_of(*object);
  CHECK(pool.find(first) == object);
  pool.give(*object);
  CHECK(pool.find(first) == nullptr);
  REQUIRE(pool.take() == object);
  CHECK(pool.find(first) == nullptr);
  CHECK(pool.find(pool.loan_of(*object)) == object);
  CHECK(pool.find(~Loan{0}) == nullptr);
}

TEST_CASE("an empty pool that the memory plan rules out aborts the process and names itself",
          "[core][pool]") {
  const test::End end = test::end_of([] {
    FixedPool<Pooled> pool("requests", 1, WhenEmpty::mistake);
    if (pool.take() != nullptr && pool.take() != nullptr) return;
  });
  CHECK(end.signal == SIGABRT);
  CHECK(end.standard_error.find("memory plan: requests") != std::string::npos);
}

TEST_CASE("giving back twice, or to another pool, is detected", "[core][pool]") {
  CHECK(test::end_of([] {
          FixedPool<Pooled> pool("test", 2, WhenEmpty::wait);
          Pooled* object = pool.take();
          pool.give(*object);
          pool.give(*object);
        }).standard_error.find("twice") != std::string::npos);
  CHECK(test::end_of([] {
          FixedPool<Pooled> pool("test", 2, WhenEmpty::wait);
          Pooled stranger;
          pool.give(stranger);
        }).standard_error.find("another pool") != std::string::npos);
}

TEST_CASE("a ring returns its elements in order across its end, and says when it is full",
          "[core][ring]") {
  Ring<int> ring(3);
  int pushed = 0, popped = 0;
  for (int round = 0; round < 10; ++round) {
    while (ring.push(pushed)) ++pushed;
    CHECK(ring.full());
    CHECK(ring[0] == popped);
    CHECK(ring[2] == pushed - 1);
    for (int i = 0; i < 2; ++i) REQUIRE(ring.pop() == popped++);
  }
  CHECK(ring.size() == 1);
  CHECK(pushed == popped + 1);
}

TEST_CASE("members leave a list from any position, explicitly or by destruction", "[core][list]") {
  IntrusiveList<Member> list;
  Member a(1), b(2), c(3);
  {
    Member passing(9);
    for (Member* m : {&a, &b, &passing, &c}) list.push_back(*m);
    b.unlink();
    CHECK_FALSE(b.linked());
  }
  CHECK(drained(list) == std::vector<int>{1, 3});
  CHECK(list.empty());
}

TEST_CASE("a list that is destroyed before its members leaves them unlinked", "[core][list]") {
  Member a(1);
  {
    IntrusiveList<Member> list;
    list.push_back(a);
  }
  CHECK_FALSE(a.linked());
}

TEST_CASE("a task carries its captures with it when it is copied", "[core][task]") {
  int sum = 0;
  Task copy;
  CHECK_FALSE(static_cast<bool>(copy));
  {
    const int a = 3, b = 4;
    const Task task = [&sum, a, b] { sum += a * b; };
    copy = task;
  }
  copy();
  copy();
  CHECK(sum == 24);
}

TEST_CASE("a memory plan names its terms and compares their sum with the budget",
          "[core][memory]") {
  MemoryPlan plan;
  plan.add("timers", 1 << 20, "8192 timers x 128 B");
  plan.add("stacks", 9 << 20, "288 fibers x 32 KB");
  CHECK(plan.total_bytes() == 10 << 20);
  CHECK(plan.fits(10 << 20));
  const auto fits = plan.fits(8 << 20);
  REQUIRE_FALSE(fits);
  CHECK(fits.problem().kind == ProblemKind::no_room);
  const std::string& what = fits.problem().what;
  CHECK(what.find("2.0 more than the budget of 8.0 MiB") != std::string::npos);
  CHECK(what.find("stacks, 9.0 MiB (288 fibers x 32 KB)") != std::string::npos);
  const std::string table = plan.table(8 << 20);
  CHECK(table.find("stacks") < table.find("timers"));
  CHECK(table.find("8192 timers x 128 B") != std::string::npos);
}
