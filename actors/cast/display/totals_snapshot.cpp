#include "actors/cast/display/totals_snapshot.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace luxodus {

namespace {

/// Bins of all source groups in one piece: about a millisecond to read.
constexpr int64_t bins_of_a_shown_piece = 16384;
/// Resolution of times: microseconds.
constexpr double ticks = 1e6;
/// More than any run has; numbers computed from it still fit 64 bits.
constexpr uint64_t max_batches = uint64_t{1} << 40;

int64_t shown_piece_of(int groups) {
  return std::max<int64_t>(1, bins_of_a_shown_piece / groups);
}

std::shared_ptr<const std::vector<std::byte>> bytes_of(const std::vector<int64_t>& numbers) {
  std::vector<std::byte> bytes(numbers.size() * sizeof(int64_t));
  if (!numbers.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return std::make_shared<const std::vector<std::byte>>(std::move(bytes));
}

}  // namespace

// ---- packing ------------------------------------------------------------------------------------

TotalsSnapshot::TotalsSnapshot(int groups, int64_t totals)
    : encoder_(groups, std::min(totals, shown_piece_of(groups))) {}

void TotalsSnapshot::pack(const LocalRun& run, double seconds) {
  const Totals& totals = run.totals();
  const int64_t end = totals.layout().totals();
  const LocalRun::Timing timing = run.timing();
  head_.batches = static_cast<uint64_t>(run.batches());
  head_.traced_us = static_cast<uint64_t>(std::llround((timing.seconds + seconds) * ticks));
  head_.untimed_batches = static_cast<uint64_t>(timing.untimed_batches);
  head_.untimed_rays = timing.untimed_rays;
  pieces_.clear();
  pieces_.push_back({0, 0, bytes_of(run.missing())});
  FlushCounts counts = FlushCounts::with;  // carried by one piece
  for (int64_t first = 0; first < end;) {
    int64_t begin = end;
    for (int g = 0; g < totals.groups(); ++g) begin = std::min(begin, totals.next_bin(g, first));
    const int64_t next = std::min(end, begin + shown_piece_of(totals.groups()));
    encoder_.begin_copy(totals, {first, next}, counts);
    while (!encoder_.step(bins_of_a_shown_piece)) {
    }
    pieces_.push_back(
        {first, next, std::make_shared<const std::vector<std::byte>>(encoder_.bytes())});
    counts = FlushCounts::without;
    first = next;
  }
}

TotalsShown TotalsSnapshot::head(uint32_t piece) const {
  TotalsShown shown = head_;
  shown.piece = piece;
  shown.pieces = pieces();
  shown.first = static_cast<uint64_t>(pieces_[piece].first);
  shown.next = static_cast<uint64_t>(pieces_[piece].next);
  return shown;
}

SharedBytes TotalsSnapshot::bytes(uint32_t piece) const {
  const auto& bytes = pieces_[piece].bytes;
  return {std::span(*bytes), bytes};
}

// ---- a copy -------------------------------------------------------------------------------------

Result<void> TotalsCopy::take_head(const TotalsShown& shown, std::span<const std::byte> payload) {
  const Problem wrong = problem("what is shown is not of this run");
  if (shown.pieces < 2 || shown.batches > max_batches || shown.untimed_batches > shown.batches ||
      shown.stopped > static_cast<uint8_t>(StopReason::objects_lost) ||
      payload.size() % sizeof(int64_t) != 0 || payload.size() / sizeof(int64_t) > shown.batches)
    return wrong;
  batches_ = static_cast<int64_t>(shown.batches);
  missing_.resize(payload.size() / sizeof(int64_t));
  if (!missing_.empty()) std::memcpy(missing_.data(), payload.data(), payload.size());
  for (size_t i = 0; i < missing_.size(); ++i)
    if (missing_[i] < (i == 0 ? 0 : missing_[i - 1] + 1) || missing_[i] >= batches_) return wrong;
  pieces_ = shown.pieces;
  timing_ = {static_cast<double>(shown.traced_us) / ticks,
             static_cast<int64_t>(shown.untimed_batches), shown.untimed_rays};
  over_ = shown.over;
  reason_ = static_cast<StopReason>(shown.stopped);
  ++next_;
  return {};
}

Result<void> TotalsCopy::take(const TotalsShown& shown, std::span<const std::byte> payload) {
  if (shown.piece != next_) return problem("a piece of what is shown was not asked for");
  if (next_ == 0) return take_head(shown, payload);
  Totals& totals = run_->totals();
  const int64_t end = totals.layout().totals();
  const auto next = static_cast<int64_t>(shown.next);
  if (shown.pieces != pieces_ || shown.first != static_cast<uint64_t>(next_bin_) ||
      next <= next_bin_ || next > end)
    return problem("a piece of what is shown is of other bins");
  const auto gain = decode_flush(payload, totals.groups(), {next_bin_, next});
  if (!gain) return gain.problem();
  gain->add_to(totals);
  next_bin_ = next;
  ++next_;
  return whole() ? this->end() : Result<void>();
}

Result<void> TotalsCopy::end() {
  const Totals& totals = run_->totals();
  int64_t counted = 0;
  for (int g = 0; g < totals.groups(); ++g) counted += totals.batches(g);
  const auto lacks = static_cast<int64_t>(missing_.size());
  if (next_bin_ != totals.layout().totals() || counted != batches_ - lacks ||
      !totals.balance().closes())
    return problem("what is shown does not add up");
  run_->resume(batches_, missing_);
  run_->set_timing(timing_);
  return {};
}

}  // namespace luxodus
