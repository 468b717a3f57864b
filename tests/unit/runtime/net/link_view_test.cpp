// A node's view of links: changes, and whether two views are equal.
#include "runtime/net/link_view.hpp"

#include <catch2/catch.hpp>

using namespace luxodus;

namespace {

const Edge first{NodeId{0}, NodeId{1}}, second{NodeId{1}, NodeId{2}};

LinkView view_of_two() {
  return LinkView({first, second});
}

}  // namespace

// Nodes once compared sums of versions. Two that had missed different changes then took their views
// for equal, forever.
TEST_CASE("different views with the same number of changes have different hashes", "[net]") {
  LinkView a = view_of_two(), b = view_of_two();
  CHECK(a.hash() == b.hash());
  CHECK(a.set(first, false));
  CHECK(b.set(second, false));
  CHECK(a.epoch() == b.epoch());
  CHECK(a.hash() != b.hash());
  for (const LinkChange& change : b.changes().changes) a.merge(change);
  for (const LinkChange& change : a.changes().changes) b.merge(change);
  CHECK(a.hash() == b.hash());
  CHECK(a.down() == b.down());
}

TEST_CASE("views that received the same changes in another order are equal", "[net]") {
  LinkView a = view_of_two(), b = view_of_two();
  const LinkChange one{first.a, first.b, 3}, other{second.a, second.b, 2};
  CHECK(a.merge(one));
  CHECK(a.merge(other));
  CHECK(b.merge(other));
  CHECK(b.merge(one));
  CHECK(a.hash() == b.hash());
  CHECK_FALSE(a.merge(one));  // no change
  CHECK(a.hash() == b.hash());
}
