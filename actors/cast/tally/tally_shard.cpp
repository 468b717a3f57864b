#include "actors/cast/tally/tally_shard.hpp"

#include <algorithm>

#include "actors/cast/names/role.hpp"
#include "runtime/core/check.hpp"
#include "runtime/core/hash.hpp"

namespace luxodus {

namespace {
/// Bytes hashed at once: about 0.1 ms.
constexpr size_t bytes_of_a_step = 1 << 20;
/// Bins of all source groups in one answer: about a millisecond to pack.
constexpr int64_t bins_of_a_piece = 16384;

/// Bins per source group: whole pages, so that sent ones can be returned to the system.
int64_t piece_of(int groups) {
  constexpr int64_t page = SparseArray<Total>::page_elements;
  return std::max<int64_t>(1, bins_of_a_piece / groups / page) * page;
}
}  // namespace

TallyShard::TallyShard(const TallyShardConfig& config, const TallyLayout& layout, int groups,
                       Scheduler& scheduler, Sender& sender)
    : NodeActor(scheduler, sender, {config.self, role::tally_shard}, "shard"),
      config_(config),
      totals_(layout, groups, {}),
      encoder_(groups, piece_of(groups)) {}

void TallyShard::add_metrics(Metrics& metrics) const {
  const Counters& c = counters_;
  metrics.add_counter({"shard_slices", "", "Slices of flushes added to this shard.", ""}, c.slices);
  metrics.add_counter({"shard_slices_dropped", "", "Slices of flushes that were refused.", ""},
                      c.slices_dropped);
  metrics.add_counter({"shard_in", "bytes", "Bytes of slices that came.", ""}, c.slice_bytes);
  metrics.add_gauge({"shard_slices_held", "", "Slices not decided about.", ""}, c.held);
  metrics.add_gauge({"shard_totals", "bytes", "Memory of this shard's totals.", ""},
                    c.totals_bytes);
}

uint64_t TallyShard::decided(const Life& life) const {
  const auto at = decided_.find(life);
  return at == decided_.end() ? 0 : at->second;
}

// ---- slices -------------------------------------------------------------------------------------

void TallyShard::on(Letter<FlushSlice>&& slice) {
  // The id is the flush's, so only its worker may send slices of it.
  if (slice.id.node != slice.from.node) return;
  const Life life{slice.id.node, slice.id.incarnation};
  if (slice.id.sequence <= decided(life)) return;  // a late duplicate
  if (const auto at = slices_.find(life); at != slices_.end()) {
    Slice& known = *at->second;
    if (known.flush == slice.id && known.gain) hold(known);
    return;
  }
  counters_.slice_bytes += slice.payload.bytes().size();
  const auto made = std::allocate_shared<Slice>(std::pmr::polymorphic_allocator<Slice>(&memory_));
  made->flush = slice.id;
  made->from = slice.from;
  made->hash = slice.body.payload_hash;
  made->payload = std::move(slice.payload);
  slices_.emplace(life, made);
  counters_.held = slices_.size();
  if (!work_on(*made)) forget(*made);  // the worker sends it again
}

void TallyShard::hold(Slice& slice) {
  sender().send(address(), slice.from, slice.flush, SliceHeld{});
}

/// False: there is no room to queue it.
bool TallyShard::work_on(const Slice& slice) {
  return offer(WorkOnSlice{slice.flush.node, slice.flush.incarnation}) == Offered::taken;
}

/// Runs on the actor's fiber.
void TallyShard::on(const WorkOnSlice& work) {
  const auto at = slices_.find({work.node, work.life});
  if (at == slices_.end()) return;  // it was dropped
  const std::shared_ptr<Slice> slice = at->second;
  if (!slice->gain)
    read(*slice);
  else if (slice->taken)
    add(*slice);
}

/// Yields. A node that is ending still completes what has begun.
bool TallyShard::take_turns() {
  (void)scheduler().fibers().yield();
  return true;
}

/// Holds what the slice says where it is right.
Result<void> TallyShard::take_in(Slice& slice) {
  Hasher hash;
  for (std::span<const std::byte> left = slice.payload.bytes(); !left.empty(); take_turns()) {
    const auto piece = left.first(std::min(left.size(), bytes_of_a_step));
    hash.add(piece.data(), piece.size());
    left = left.subspan(piece.size());
  }
  if (hash.value() != slice.hash) return problem("a slice is not what its hash says");
  auto gain = reader_.read(slice.payload.bytes(), totals_.groups(), config_.bins,
                           [&] { return take_turns() && !slice.dropped; });
  if (!gain) return gain.problem();
  // Batches and the energy balance go to the controller, once.
  if (gain->batches() != 0 || gain->balance().particles != 0)
    return problem("a slice counts batches");
  slice.gain = std::move(gain).value();
  return {};
}

void TallyShard::read(Slice& slice) {
  const Result<void> taken = take_in(slice);
  slice.payload = {};
  if (slice.dropped) return;
  if (taken) return hold(slice);
  sender().send(address(), slice.from, slice.flush,
                FlushRefused{{}, taken.problem().what.substr(0, limits::text_bytes)});
  forget(slice);
}

void TallyShard::forget(Slice& slice) {
  if (slice.gain) reader_.take_back(std::move(*slice.gain));
  slice.gain.reset();
  slices_.erase({slice.flush.node, slice.flush.incarnation});
  counters_.held = slices_.size();
}

// ---- decisions ---------------------------------------------------------------------------------

void TallyShard::on(const Letter<FlushDecided>& letter) {
  if (letter.from.node != config_.controller) return;
  const FlushDecided& decision = letter.body;
  const Life life{decision.flush.node, decision.flush.incarnation};
  if (decision.flush.sequence <= decided(life)) return settle(letter.id, true);
  const auto at = slices_.find(life);
  const std::shared_ptr<Slice> slice = at == slices_.end() ? nullptr : at->second;
  if (!decision.taken) {
    if (slice && slice->flush.sequence <= decision.flush.sequence) {
      slice->dropped = true;
      ++counters_.slices_dropped;
      forget(*slice);
    }
    decided_[life] = decision.flush.sequence;
    return settle(letter.id, true);
  }
  const bool held =
      slice && slice->flush == decision.flush && slice->gain && slice->hash == decision.slice_hash;
  if (!held) return settle(letter.id, false);    // this shard lacks counted work
  if (slice->taken || !work_on(*slice)) return;  // the answer follows, or the controller retries
  slice->taken = letter.id;
}

void TallyShard::settle(const MessageId& decision, bool whole) {
  sender().send(address(), {config_.controller, role::coordinator}, decision, FlushSettled{whole});
}

void TallyShard::add(Slice& slice) {
  slice.gain->add_to(totals_, [this] { return take_turns(); });
  ++counters_.slices;
  counters_.totals_bytes = totals_.bytes();
  decided_[{slice.flush.node, slice.flush.incarnation}] = slice.flush.sequence;
  const MessageId decision = *slice.taken;
  forget(slice);
  settle(decision, true);
}

// ---- totals ------------------------------------------------------------------------------------

void TallyShard::on(const Letter<AskTotals>& letter) {
  if (letter.from.node != config_.controller) return;
  const AskTotals& question = letter.body;
  const bool again = question.gather == told_.gather && question.first == told_.first;
  const bool goes_on = question.gather == told_.gather && question.first == told_.next;
  const bool begins =
      question.gather > told_.gather && question.first == static_cast<uint64_t>(config_.bins.first);
  if (!again || told_.gather == 0) {
    if (!goes_on && !begins) return;  // an old question that arrives late
    told_.gather = question.gather;
    told_.first = question.first;
    pack_next_piece();
  }
  sender().send(address(), letter.from, letter.id, told_, {std::span(*told_bytes_), told_bytes_});
}

/// Moves the next nonzero bins out of the totals.
void TallyShard::pack_next_piece() {
  TotalsTold& told = told_;
  int64_t first = config_.bins.end;
  for (int g = 0; g < totals_.groups(); ++g)
    first = std::min(first, totals_.next_bin(g, static_cast<int64_t>(told.first)));
  const int64_t end = std::min(config_.bins.end, first + piece_of(totals_.groups()));
  encoder_.begin(totals_, {static_cast<int64_t>(told.first), end}, FlushCounts::without);
  while (!encoder_.step(bins_of_a_piece)) {
  }
  told.next = static_cast<uint64_t>(end);
  counters_.totals_bytes = totals_.bytes();
  // Otherwise the last piece has not been sent yet.
  if (told_bytes_.use_count() != 1) told_bytes_ = std::make_shared<std::vector<std::byte>>();
  *told_bytes_ = encoder_.bytes();
}

}  // namespace luxodus
