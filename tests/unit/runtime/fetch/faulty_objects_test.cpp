#include "runtime/fetch/faulty_objects.hpp"

#include <catch2/catch.hpp>
#include <memory>

using namespace luxodus;

namespace {

/// Has every object: one byte.
class FullStore final : public ObjectStore {
 public:
  SharedBytes find(ObjectId) override { return byte(); }
  SharedBytes find_in_storage(uint32_t) override { return byte(); }

 private:
  static SharedBytes byte() {
    static constexpr std::byte one{1};
    return {std::span(&one, 1), nullptr};
  }
};

Fault failed_read(NodeId node, Nanoseconds at, Nanoseconds lasts) {
  Fault fault;
  fault.kind = Fault::Kind::failed_read;
  fault.node = node;
  fault.at = at;
  fault.lasts = lasts;
  return fault;
}

}  // namespace

TEST_CASE("a node's reads fail while its fault plan says so, and other nodes' do not", "[fetch]") {
  ManualClock clock(seconds(5));
  FullStore store;
  FaultPlan plan;
  plan.faults = {failed_read({1}, seconds(2), seconds(3))};
  FaultyObjects ours(store, {1}, plan, clock), theirs(store, {2}, plan, clock);
  const auto reads = [](ObjectStore& from) {
    return !from.find(ObjectId{7}).bytes.empty() && !from.find_in_storage(0).bytes.empty();
  };
  CHECK(reads(ours));
  clock.advance(seconds(2));
  CHECK(ours.find(ObjectId{7}).bytes.empty());
  CHECK(ours.find_in_storage(0).bytes.empty());
  CHECK(reads(theirs));
  clock.advance(seconds(3));
  CHECK(reads(ours));
}
