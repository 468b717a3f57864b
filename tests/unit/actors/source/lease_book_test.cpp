#include "actors/source/lease_book.hpp"

#include <catch2/catch.hpp>

using namespace luxodus;

namespace {
constexpr NodeId ann{1}, bob{2};
}

TEST_CASE("a book that goes on lends the batches that are missing first, and tells them",
          "[lease]") {
  LeaseBook book(10, {3, 7}, 1000);
  CHECK(book.committed() == 8);
  CHECK(book.missing() == std::vector<int64_t>{3, 7});
  book.open_until(12);
  const LentBatches first = book.lend(NodeId{1}, 5, 100);
  CHECK(first.first_lease == 1000);
  CHECK(first.first_batch == 3);
  CHECK(first.count == 1);
  CHECK(book.lend(NodeId{1}, 5, 100).first_batch == 7);
  const LentBatches fresh = book.lend(NodeId{2}, 5, 100);
  CHECK(fresh.first_batch == 10);
  CHECK(fresh.count == 2);
  book.commit({1000});
  CHECK(book.missing() == std::vector<int64_t>{7, 10, 11});
  CHECK(book.fence_leases(NodeId{2}, {1001, 1002}).size() == 1);  // the other is of node 1
  CHECK(book.lend(NodeId{1}, 1, 100).first_batch == 10);
}

TEST_CASE("a lease book lends every batch of a round once and none beyond it", "[lease]") {
  LeaseBook book(3);
  CHECK(book.lend(ann, 4, 100).count == 0);
  book.open_until(10);
  const LentBatches first = book.lend(ann, 4, 100);
  const LentBatches second = book.lend(bob, 4, 100);
  CHECK(first.first_batch == 3);
  CHECK(first.count == 4);
  CHECK(second.first_batch == 7);
  CHECK(second.count == 3);
  CHECK(second.first_lease == first.first_lease + 4);
  CHECK(book.lend(ann, 4, 100).count == 0);
  CHECK_FALSE(book.round_done());
  for (uint64_t i = 0; i < 7; ++i) book.commit({first.first_lease + i});
  CHECK(book.round_done());
  CHECK(book.committed() == 10);
}

TEST_CASE("a late lease is fenced, lent again first, and can no longer be counted", "[lease]") {
  LeaseBook book(0);
  book.open_until(8);
  const LentBatches late = book.lend(ann, 2, 100);
  book.lend(bob, 2, 300);
  CHECK(book.next_deadline() == Nanoseconds{100});
  CHECK(book.fence_late(99).empty());
  CHECK(book.fence_late(100).size() == 2);
  CHECK_FALSE(book.stand(ann, {late.first_lease}));
  const LentBatches again = book.lend(bob, 3, 200);  // 0 and 1 are no neighbours of 4
  CHECK(again.first_batch == 0);
  CHECK(again.count == 2);
  CHECK(book.lend(bob, 8, 200).first_batch == 4);
}

TEST_CASE("a flush counts only for the node that has all its leases, each named once", "[lease]") {
  LeaseBook book(0);
  book.open_until(8);
  const uint64_t one = book.lend(ann, 2, 100).first_lease;
  const uint64_t other = book.lend(bob, 1, 100).first_lease;
  CHECK(book.stand(ann, {one, one + 1}));
  CHECK_FALSE(book.stand(ann, {one, one}));
  CHECK_FALSE(book.stand(ann, {one, other}));
  CHECK_FALSE(book.stand(bob, {one}));
  CHECK(book.fence_node(ann).size() == 2);
  CHECK_FALSE(book.stand(ann, {one}));
  CHECK(book.standing() == 1);
}

TEST_CASE("a round that is closed ends with what was lent", "[lease]") {
  LeaseBook book(0);
  book.open_until(100);
  const LentBatches lent = book.lend(ann, 2, 100);
  book.close();
  CHECK(book.lend(ann, 5, 100).count == 0);
  CHECK_FALSE(book.round_done());
  book.commit({lent.first_lease, lent.first_lease + 1});
  CHECK(book.round_done());
  CHECK(book.lent_end() == 2);
}
