#include "actors/cast/coordinator/lease_book.hpp"

#include <catch2/catch.hpp>
#include <set>

using namespace luxodus;

namespace {
constexpr NodeId ann{1}, bob{2};
}

TEST_CASE("a late batch gets twice the time, until it is counted", "[leases]") {
  LeaseBook book(0);
  book.open_until(1);
  Nanoseconds now = 0;
  for (const Nanoseconds span : {100, 200, 400, 800}) {
    REQUIRE(book.lend(NodeId{1}, 1, now, 100).count == 1);
    CHECK(book.fence_late(now + span - 1).empty());
    now += span;
    REQUIRE(book.fence_late(now).size() == 1);
  }
  const uint64_t lease = book.lend(NodeId{1}, 1, now, 100).first_lease;
  book.commit({lease}, now);
  book.open_until(2);
  REQUIRE(book.lend(NodeId{1}, 1, now, 100).count == 1);
  CHECK(book.fence_late(now + 100).size() == 1);
}

TEST_CASE(
    "after a batch that took longer than a lease, later leases last half as long again as it did",
    "[leases]") {
  LeaseBook book(0);
  book.open_until(3);
  const auto lent_for = [&](Nanoseconds now) {
    REQUIRE(book.lend(ann, 1, now, 100).count == 1);
    return *book.next_deadline() - now;
  };
  CHECK(lent_for(0) == 100);
  CHECK(book.fence_late(100).size() == 1);
  CHECK(lent_for(100) == 200);
  book.commit({2}, 260);  // it took 160
  CHECK(lent_for(300) == 240);
  book.commit({3}, 310);  // a quick one changes nothing
  CHECK(lent_for(400) == 240);
}

TEST_CASE("a book without rounds leases added batches, and no removed ones", "[leases]") {
  LeaseBook book(0);
  for (const int64_t batch : {7, 8, 11}) book.add(batch);
  CHECK(book.waiting() == 3);
  const LentBatches first = book.lend(ann, 5, 0, 100);
  CHECK(first.first_batch == 7);
  CHECK(first.count == 2);
  std::set<int64_t> batches{8, 11};
  const std::vector<Lease> fenced = book.remove(batches);
  REQUIRE(fenced.size() == 1);  // the other one was not leased
  CHECK(fenced.front().id == first.first_lease + 1);
  CHECK(batches.empty());
  CHECK(book.lend(bob, 5, 0, 100).count == 0);
  book.hold({first.first_lease});
  batches = {7};
  CHECK(book.remove(batches).empty());
  CHECK(batches == std::set<int64_t>{7});  // it is being counted
  book.commit({first.first_lease}, 0);
  CHECK(book.remove(batches).empty());
  CHECK(book.standing() == 0);
  CHECK(book.waiting() == 0);
}

TEST_CASE("renewed leases are not late while their node makes progress", "[leases]") {
  LeaseBook book(0);
  book.open_until(4);
  book.lend(ann, 2, 0, 100);
  book.lend(bob, 2, 0, 100);
  book.renew(ann, 150);
  CHECK(book.fence_late(120).size() == 2);
  CHECK(book.fence_late(149).empty());
  CHECK(book.fence_late(150).size() == 2);
}

TEST_CASE("batches that no node can trace are removed from the book", "[leases]") {
  LeaseBook book(0);
  book.add(3);
  const uint64_t lease = book.lend(ann, 1, 0, 100).first_lease;
  book.give_back(ann, {lease});
  CHECK(book.lose_what_all_gave_back({ann}) == 1);
  CHECK(book.take_lost() == std::set<int64_t>{3});
  CHECK(book.lost() == 0);
  CHECK(book.waiting() == 0);
  CHECK_FALSE(book.has_given_back());
  book.add(3);  // of another state
  CHECK(book.lend(ann, 1, 0, 100).count == 1);
}

TEST_CASE("a continued book leases the missing batches first, and lists them", "[lease]") {
  LeaseBook book(10, {3, 7}, 1000);
  CHECK(book.committed() == 8);
  CHECK(book.missing() == std::vector<int64_t>{3, 7});
  book.open_until(12);
  const LentBatches first = book.lend(NodeId{1}, 5, 0, 100);
  CHECK(first.first_lease == 1000);
  CHECK(first.first_batch == 3);
  CHECK(first.count == 1);
  CHECK(book.lend(NodeId{1}, 5, 0, 100).first_batch == 7);
  const LentBatches fresh = book.lend(NodeId{2}, 5, 0, 100);
  CHECK(fresh.first_batch == 10);
  CHECK(fresh.count == 2);
  book.commit({1000}, 0);
  CHECK(book.missing() == std::vector<int64_t>{7, 10, 11});
  CHECK(book.fence_leases(NodeId{2}, {1001, 1002}).size() == 1);  // the other lease is node 1's
  CHECK(book.lend(NodeId{1}, 1, 0, 100).first_batch == 10);
}

TEST_CASE("a lease book leases every batch of a round once and none beyond it", "[lease]") {
  LeaseBook book(3);
  CHECK(book.lend(ann, 4, 0, 100).count == 0);
  book.open_until(10);
  const LentBatches first = book.lend(ann, 4, 0, 100);
  const LentBatches second = book.lend(bob, 4, 0, 100);
  CHECK(first.first_batch == 3);
  CHECK(first.count == 4);
  CHECK(second.first_batch == 7);
  CHECK(second.count == 3);
  CHECK(second.first_lease == first.first_lease + 4);
  CHECK(book.lend(ann, 4, 0, 100).count == 0);
  CHECK_FALSE(book.round_done());
  for (uint64_t i = 0; i < 7; ++i) book.commit({first.first_lease + i}, 0);
  CHECK(book.round_done());
  CHECK(book.committed() == 10);
}

TEST_CASE("a lease book counts the waiting batches of the round", "[lease]") {
  LeaseBook book(0, {}, 1, 8);
  CHECK(book.waiting() == 0);
  book.open_until(10);
  CHECK(book.waiting() == 10);
  book.lend({0}, 3, 0, 100);
  CHECK(book.waiting() == 7);
  book.lend({1}, 1, 50, 100, [](int64_t batch) { return batch == 6 ? 0u : 1u; });  // out of turn
  CHECK(book.waiting() == 6);
  book.fence_late(120);  // the first three wait again
  CHECK(book.waiting() == 9);
  CHECK(book.lend({1}, 3, 130, 100).first_batch == 0);
}

TEST_CASE("a late lease is fenced, leased again first, and can no longer be counted", "[lease]") {
  LeaseBook book(0);
  book.open_until(8);
  const LentBatches late = book.lend(ann, 2, 0, 100);
  book.lend(bob, 2, 0, 300);
  CHECK(book.next_deadline() == Nanoseconds{100});
  CHECK(book.fence_late(99).empty());
  CHECK(book.fence_late(100).size() == 2);
  CHECK_FALSE(book.stand(ann, {late.first_lease}));
  const LentBatches again = book.lend(bob, 3, 0, 200);  // 0 and 1 are not adjacent to 4
  CHECK(again.first_batch == 0);
  CHECK(again.count == 2);
  CHECK(book.lend(bob, 8, 0, 200).first_batch == 4);
}

TEST_CASE("a flush counts only for the node that has all its leases, each named once", "[lease]") {
  LeaseBook book(0);
  book.open_until(8);
  const uint64_t one = book.lend(ann, 2, 0, 100).first_lease;
  const uint64_t other = book.lend(bob, 1, 0, 100).first_lease;
  CHECK(book.stand(ann, {one, one + 1}));
  CHECK_FALSE(book.stand(ann, {one, one}));
  CHECK_FALSE(book.stand(ann, {one, other}));
  CHECK_FALSE(book.stand(bob, {one}));
  CHECK(book.fence_node(ann).size() == 2);
  CHECK_FALSE(book.stand(ann, {one}));
  CHECK(book.standing() == 1);
}

TEST_CASE("a closed round ends with the leased batches", "[lease]") {
  LeaseBook book(0);
  book.open_until(100);
  const LentBatches lent = book.lend(ann, 2, 0, 100);
  book.close();
  CHECK(book.lend(ann, 5, 0, 100).count == 0);
  CHECK_FALSE(book.round_done());
  book.commit({lent.first_lease, lent.first_lease + 1}, 0);
  CHECK(book.round_done());
  CHECK(book.lent_end() == 2);
}

namespace {
/// Alternating batches of two groups, of which a node prefers one.
LeaseBook::Rank likes(int64_t group) {
  return [group](int64_t batch) { return batch % 2 == group ? 0u : 1u; };
}
}  // namespace

TEST_CASE("a node gets preferred batches within reach, then the rest", "[lease]") {
  LeaseBook book(0, {}, 1, 6);
  book.open_until(8);
  const auto next = [&](int64_t group) {
    const LentBatches lent = book.lend(ann, 4, 0, 100, likes(group));
    CHECK(lent.count == 1);  // its neighbours are of the other group
    return lent.first_batch;
  };
  CHECK(next(1) == 1);
  CHECK(next(1) == 3);
  CHECK(next(1) == 5);
  CHECK(next(1) == 0);  // 7 is too far ahead of 0
  CHECK(next(1) == 7);
  CHECK(next(0) == 2);
  CHECK(next(1) == 4);
  CHECK(next(1) == 6);
  CHECK(book.lend(ann, 1, 0, 100, likes(0)).count == 0);
}

TEST_CASE("preferences change which node traces a batch, never the batches of a round", "[lease]") {
  LeaseBook book(5, {}, 1, 8);
  book.open_until(25);
  std::set<int64_t> seen;
  for (int turn = 0; seen.size() < 20; ++turn) {
    const bool first = turn % 3 == 0;
    const LentBatches lent = book.lend(first ? ann : bob, 1, 0, 100, likes(first ? 0 : 1));
    REQUIRE(lent.count == 1);
    CHECK(lent.first_batch < 25);
    CHECK(seen.insert(lent.first_batch).second);
    book.commit({lent.first_lease}, 0);
  }
  CHECK(*seen.begin() == 5);
  CHECK(book.round_done());
  CHECK(book.lend(bob, 1, 0, 100, likes(0)).count == 0);
}

TEST_CASE("a closed round has no gaps, since skipped batches are still leased", "[lease]") {
  LeaseBook book(0, {}, 1, 10);
  book.open_until(100);
  const uint64_t first = book.lend(ann, 1, 0, 100, likes(1)).first_lease;   // 1
  const uint64_t second = book.lend(ann, 1, 0, 100, likes(1)).first_lease;  // 3
  book.close();
  CHECK(book.lent_end() == 4);
  book.commit({first, second}, 0);
  CHECK_FALSE(book.round_done());
  const LentBatches zero = book.lend(bob, 9, 0, 100);
  const LentBatches two = book.lend(bob, 9, 0, 100, likes(1));
  CHECK(zero.first_batch == 0);
  CHECK(two.first_batch == 2);
  CHECK(book.lend(bob, 9, 0, 100).count == 0);
  book.commit({zero.first_lease, two.first_lease}, 0);
  CHECK(book.round_done());
}

TEST_CASE("fenced batches are leased again before preferred ones", "[lease]") {
  LeaseBook book(0, {}, 1, 10);
  book.open_until(10);
  book.lend(ann, 1, 0, 100, likes(0));
  book.fence_late(100);
  CHECK(book.lend(bob, 1, 0, 200, likes(1)).first_batch == 0);
  CHECK(book.lend(bob, 1, 0, 200, likes(1)).first_batch == 1);
}

TEST_CASE(
    "a batch that a node gives back is leased to others, and lost when all have given it back",
    "[lease]") {
  LeaseBook book(0);
  book.open_until(4);
  const LentBatches lent = book.lend(ann, 2, 0, 100);
  REQUIRE(lent.count == 2);
  const auto back = book.give_back(ann, {lent.first_lease, 999});
  REQUIRE(back.size() == 1);
  CHECK(back.front().batch == 0);
  CHECK(book.give_back(ann, {lent.first_lease}).empty());  // the lease is no longer valid
  CHECK(book.lose_what_all_gave_back({ann, bob}) == 0);

  // Ann gets what comes next, bob what she gave back.
  CHECK(book.lend(ann, 1, 0, 100).first_batch == 2);
  const LentBatches of_bob = book.lend(bob, 1, 0, 100);
  CHECK(of_bob.first_batch == 0);
  SECTION("it is counted where another can trace it") {
    book.commit({of_bob.first_lease}, 0);
    CHECK(book.lose_what_all_gave_back({ann}) == 0);
    CHECK(book.lost() == 0);
  }
  SECTION("it is lost where nobody can, and the round ends without it") {
    book.give_back(bob, {of_bob.first_lease});
    CHECK(book.lose_what_all_gave_back({ann, bob}) == 1);
    CHECK(book.lose_what_all_gave_back({ann, bob}) == 0);  // reported once
    CHECK(book.lost() == 1);
    CHECK(book.missing() == std::vector<int64_t>{0, 1, 2});
    const LentBatches last = book.lend(bob, 5, 0, 100);
    CHECK(last.first_batch == 3);
    CHECK(last.count == 1);
    book.commit({lent.first_lease + 1, of_bob.first_lease - 1, last.first_lease}, 0);
    CHECK(book.round_done());
    CHECK(book.missing() == std::vector<int64_t>{0});
  }
  SECTION("a node that begins anew may try it again") {
    book.give_back(bob, {of_bob.first_lease});
    book.forgive(ann);
    CHECK(book.lose_what_all_gave_back({ann, bob}) == 0);
    CHECK(book.lend(ann, 1, 0, 100).first_batch == 0);
  }
}

TEST_CASE(
    "a lease whose flush is being journaled cannot be fenced, and its batch is not leased again",
    "[lease]") {
  LeaseBook book(0);
  book.open_until(4);
  const LentBatches lent = book.lend(ann, 4, 0, 100);
  const uint64_t first = lent.first_lease;
  book.hold({first, first + 1});
  CHECK(book.fence_late(1000).size() == 2);
  CHECK(book.fence_node(ann).empty());
  CHECK(book.fence_leases(ann, {first, first + 1}).empty());
  CHECK(book.give_back(ann, {first}).empty());
  CHECK_FALSE(book.round_done());
  const LentBatches again = book.lend(bob, 4, 1000, 100);
  CHECK(again.first_batch == 2);
  CHECK(again.count == 2);
  book.commit({first, first + 1}, 0);
  CHECK(book.committed() == 2);
  book.commit({again.first_lease, again.first_lease + 1}, 0);
  CHECK(book.round_done());
}
