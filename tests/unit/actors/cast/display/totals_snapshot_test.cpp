// Totals that are packed in pieces and reassembled elsewhere have the same bits, and invalid pieces
// are rejected.
#include "actors/cast/display/totals_snapshot.hpp"

#include <catch2/catch.hpp>
#include <cstring>

#include "tests/unit/actors/cast/process/equal_bits.hpp"
#include "tests/unit/actors/cast/process/library_scene.hpp"

using namespace luxodus;

namespace {

struct Traced {
  explicit Traced(int64_t batches) : run(scene_of("smoke_tank", "", 1), 1, 2) {
    StopRule stop;
    stop.particles = batches * run.scene().batch_particles;
    run.run(stop, nobody, ignore);
    snapshot.pack(run, 2.5);
  }
  LocalRun run;
  TotalsSnapshot snapshot{run.totals().groups(), run.totals().layout().totals()};
};

Result<void> take(TotalsCopy& copy, const TotalsSnapshot& snapshot, uint32_t piece) {
  return copy.take(snapshot.head(piece), snapshot.bytes(piece).bytes);
}

}  // namespace

TEST_CASE("totals copied in pieces have the same bits, and the originals are unchanged",
          "[showing]") {
  Traced traced(6);
  const TotalsSnapshot& snapshot = traced.snapshot;
  REQUIRE(snapshot.pieces() >= 2);
  TotalsCopy copy(traced.run.empty_copy());
  for (uint32_t piece = 0; piece < snapshot.pieces(); ++piece) {
    REQUIRE_FALSE(copy.whole());
    REQUIRE(take(copy, snapshot, piece).ok());
  }
  REQUIRE(copy.whole());
  CHECK_FALSE(copy.run_is_over());
  const auto run = copy.run();
  CHECK(differences(traced.run, *run) == 0);
  CHECK(run->particles() == traced.run.particles());
  CHECK(run->missing().empty());
  CHECK(run->seconds() == Approx(traced.run.seconds() + 2.5).margin(1e-6));
  CHECK(traced.run.totals().balance().closes());
  CHECK(traced.run.totals().balance().particles > 0);
}

TEST_CASE("a run with missing batches is copied with them missing", "[showing]") {
  Traced traced(4);
  traced.run.resume(7, {4, 5, 6});
  traced.snapshot.pack(traced.run, 0);
  const TotalsSnapshot& snapshot = traced.snapshot;
  TotalsCopy copy(traced.run.empty_copy());
  for (uint32_t piece = 0; piece < snapshot.pieces(); ++piece)
    REQUIRE(take(copy, snapshot, piece).ok());
  const auto run = copy.run();
  CHECK(run->batches() == 7);
  CHECK(run->missing() == std::vector<int64_t>{4, 5, 6});
  CHECK(run->traced() == 4);
}

TEST_CASE("an invalid next piece is rejected", "[showing]") {
  Traced traced(3);
  const TotalsSnapshot& snapshot = traced.snapshot;
  TotalsCopy copy(traced.run.empty_copy());
  SECTION("a later piece first") {
    CHECK_FALSE(take(copy, snapshot, 1).ok());
  }
  SECTION("a piece twice") {
    REQUIRE(take(copy, snapshot, 0).ok());
    CHECK_FALSE(take(copy, snapshot, 0).ok());
  }
  SECTION("missing batches that do not ascend, or are none of the run") {
    for (const std::vector<int64_t>& wrong :
         {std::vector<int64_t>{1, 1}, std::vector<int64_t>{-1}, std::vector<int64_t>{3}}) {
      TotalsCopy fresh(traced.run.empty_copy());
      CHECK_FALSE(fresh.take(snapshot.head(0), std::as_bytes(std::span(wrong))).ok());
    }
  }
  SECTION("a first piece cut in the middle of a number") {
    const std::vector<std::byte> cut(5);
    CHECK_FALSE(copy.take(snapshot.head(0), cut).ok());
  }
  SECTION("other bins, no bins, or bytes that are no totals") {
    REQUIRE(take(copy, snapshot, 0).ok());
    TotalsShown head = snapshot.head(1);
    head.next = head.first;
    CHECK_FALSE(copy.take(head, snapshot.bytes(1).bytes).ok());
    head = snapshot.head(1);
    head.next = UINT64_MAX;
    CHECK_FALSE(copy.take(head, snapshot.bytes(1).bytes).ok());
    const std::vector<std::byte> noise(100, std::byte{0x5a});
    CHECK_FALSE(copy.take(snapshot.head(1), noise).ok());
  }
  SECTION("more batches than the totals hold") {
    TotalsShown head = snapshot.head(0);
    head.batches += 1;
    REQUIRE(copy.take(head, {}).ok());
    Result<void> last;
    for (uint32_t piece = 1; piece < snapshot.pieces() && last.ok(); ++piece)
      last = take(copy, snapshot, piece);
    CHECK_FALSE(last.ok());
  }
  SECTION("a reason to stop that there is not") {
    TotalsShown head = snapshot.head(0);
    head.stopped = 200;
    CHECK_FALSE(copy.take(head, {}).ok());
  }
}
