// The wire format of a flush: what a node's batches have added to its totals. Numbers are LEB128
// (signed ones zigzag), indices are differences, and all of it is packed by zstd. A million bins
// take tens of milliseconds, so packing is done in steps, between which the node does other work.
// Bytes come from other machines: they are decoded into a value first, and accepted or rejected
// whole. Thread rule: a FlushEncoder belongs to one thread; decoding is pure.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/tally/totals.hpp"

struct ZSTD_inBuffer_s;  // of zstd.h

namespace luxodus {

/// Most bytes of one bin in an unpacked flush [B]: a distance below 2^40, a sum below 2^90 (2^26
/// batches of 2^63, signed) and squares of 128 bits, seven bits a byte.
inline constexpr uint64_t flush_bytes_of_bin = 6 + 13 + 19;

/// Whether a flush carries its batches and their energy balance: one of several parts does.
enum class FlushCounts { with, without };

/// Moves totals into bytes, step by step, one flush after another in the same memory.
class FlushEncoder {
 public:
  /// Reserves room for flushes of this many source groups and totals each: address space, which
  /// becomes memory as it is used.
  FlushEncoder(int groups, int64_t totals);
  ~FlushEncoder();

  /// Begins a flush and invalidates the bytes of the previous one. Requires: `totals` have that
  /// size, and are not touched otherwise until the last step.
  void begin(Totals& totals) { begin(totals, {0, totals.layout().totals()}, FlushCounts::with); }
  /// A flush of some of the bins, of all groups.
  void begin(Totals& totals, const BinRange& bins, FlushCounts counts);
  /// Likewise, but the totals keep their values.
  void begin_copy(const Totals& totals, const BinRange& bins, FlushCounts counts);

  /// Processes the next `bins` bins; true when there are no more.
  bool step(int64_t bins);
  /// The whole flush, valid until begin(). Requires: step() has returned true.
  const std::vector<std::byte>& bytes() const { return packed_; }
  /// Largest memory of flushes so far: of the longest, and for packing.
  size_t memory_bytes() const;

 private:
  void pack(bool last);
  size_t pack_more(ZSTD_inBuffer_s& in, int how);

  uint64_t batches_of_group();
  EnergyBalance balance();

  void begin_bins(const BinRange& bins, FlushCounts counts);

  const Totals* totals_ = nullptr;
  Totals* emptied_ = nullptr;  // the same totals if they are to be emptied
  BinRange bins_;
  FlushCounts counts_ = FlushCounts::with;
  int group_ = 0;
  int64_t next_ = 0;        // bin of the group
  int64_t after_last_ = 0;  // one past the index of the last bin written
  std::vector<std::byte> raw_;
  std::vector<std::byte> packed_;
  size_t longest_raw_ = 0;
  size_t longest_packed_ = 0;
  struct Zstd;
  std::unique_ptr<Zstd> zstd_;
};

/// Called now and then while a long flush is read or added; on a fiber it yields. False: stop.
using FlushRest = std::function<bool()>;
inline bool no_rest() {
  return true;
}

/// A decoded and validated flush. Its bins are decoded twice and never stored: a million of them
/// would take 48 MB.
class FlushGain {
 public:
  /// Batches of all groups.
  int64_t batches() const;
  int64_t bins() const { return bins_; }
  const EnergyBalance& balance() const { return ledger_; }

  /// Adds all of it; `rest` cannot stop this. Requires: totals of the layout for which it was read.
  void add_to(Totals& totals, const FlushRest& rest = no_rest) const;

 private:
  friend class FlushReader;

  std::vector<std::byte> raw_;
  std::vector<size_t> begins_;  // of each group's bins, in raw_
  std::vector<int64_t> batches_;
  BinRange range_;
  int64_t bins_ = 0;
  EnergyBalance ledger_;
  mutable TotalsGain piece_;  // being added
};

/// Reads flushes, one after another in the same memory. Thread rule: one thread.
class FlushReader {
 public:
  FlushReader();
  ~FlushReader();
  FlushReader(FlushReader&&) noexcept;

  /// Errors: invalid bytes; more groups than `groups` or an index outside `bins`; indices that do
  /// not ascend; more bytes than such totals can have; `rest` returned false.
  Result<FlushGain> read(std::span<const std::byte> bytes, int groups, const BinRange& bins,
                         const FlushRest& rest = no_rest);
  /// Returns the memory of a processed flush, for the next one.
  void take_back(FlushGain&& gain) { spare_.push_back(std::move(gain)); }

 private:
  struct Zstd;
  Result<void> unpack(std::span<const std::byte> bytes, size_t most, const FlushRest& rest,
                      std::vector<std::byte>& out);

  std::unique_ptr<Zstd> zstd_;
  std::vector<std::byte> piece_;
  std::vector<FlushGain> spare_;
};

/// Reads one flush.
inline Result<FlushGain> decode_flush(std::span<const std::byte> bytes, int groups,
                                      const BinRange& bins, const FlushRest& rest = no_rest) {
  return FlushReader().read(bytes, groups, bins, rest);
}
inline Result<FlushGain> decode_flush(std::span<const std::byte> bytes, int groups, int64_t totals,
                                      const FlushRest& rest = no_rest) {
  return decode_flush(bytes, groups, BinRange{0, totals}, rest);
}

}  // namespace luxodus
