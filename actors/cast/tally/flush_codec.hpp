// A flush on its way: what a node's batches have added to its totals, as bytes. Numbers are LEB128
// (signed ones zigzag), indices as differences, the whole packed by zstd. A million bins take tens
// of milliseconds, so they are packed in steps, between which the node does other things. Bytes
// come from other machines: they are read into a value first, and taken or refused whole.
// Thread rule: a FlushEncoder belongs to one thread; decoding is pure.
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

/// The most that one bin of totals takes in a flush before it is packed [B]: a distance below 2^40,
/// a sum below 2^90 (2^26 batches of 2^63, signed) and squares of 128 bits, seven bits a byte.
inline constexpr uint64_t flush_bytes_of_bin = 6 + 13 + 19;

/// Whether a flush carries its batches and their balance: of several parts one does.
enum class FlushCounts { with, without };

/// Empties totals into bytes, step by step, one flush after another in the same memory.
class FlushEncoder {
 public:
  /// Takes room for flushes of so many source groups and totals each: address space, which becomes
  /// memory as it is used.
  FlushEncoder(int groups, int64_t totals);
  ~FlushEncoder();

  /// Begins a flush; the bytes of the one before are gone. Requires: `totals` are of that size, and
  /// nobody else touches them until the last step.
  void begin(Totals& totals) { begin(totals, {0, totals.layout().totals()}, FlushCounts::with); }
  /// The same for some of the bins, of all groups.
  void begin(Totals& totals, const BinRange& bins, FlushCounts counts);
  /// The same, of totals that keep what they have.
  void begin_copy(const Totals& totals, const BinRange& bins, FlushCounts counts);

  /// Goes through the next `bins` bins; true when there are no more.
  bool step(int64_t bins);
  /// The whole flush, until begin(). Requires: step() has returned true.
  const std::vector<std::byte>& bytes() const { return packed_; }
  /// What flushes have taken in memory so far: that of the longest, and what packs it.
  size_t memory_bytes() const;

 private:
  void pack(bool last);
  size_t pack_more(ZSTD_inBuffer_s& in, int how);

  uint64_t batches_of_group();
  EnergyBalance balance();

  void begin_bins(const BinRange& bins, FlushCounts counts);

  const Totals* totals_ = nullptr;
  Totals* emptied_ = nullptr;  // the same, where they are emptied
  BinRange bins_;
  FlushCounts counts_ = FlushCounts::with;
  int group_ = 0;
  int64_t next_ = 0;        // bin of the group
  int64_t after_last_ = 0;  // the index behind the last bin that was written
  std::vector<std::byte> raw_;
  std::vector<std::byte> packed_;
  size_t longest_raw_ = 0;
  size_t longest_packed_ = 0;
  struct Zstd;
  std::unique_ptr<Zstd> zstd_;
};

/// Called now and then while a long flush is read or added; false: break off. On a fiber it yields.
using FlushRest = std::function<bool()>;
inline bool no_rest() {
  return true;
}

/// What a flush adds, read and found right. A bin is read twice, and never kept: a million of them
/// would be 48 MB.
class FlushGain {
 public:
  /// Of all groups.
  int64_t batches() const;
  int64_t bins() const { return bins_; }
  const EnergyBalance& balance() const { return ledger_; }

  /// Adds all of it; `rest` cannot break this off. Requires: totals of the layout it was read for.
  void add_to(Totals& totals, const FlushRest& rest = no_rest) const;

 private:
  friend class FlushReader;

  std::vector<std::byte> raw_;
  std::vector<size_t> begins_;  // of each group's bins, in raw_
  std::vector<int64_t> batches_;
  BinRange range_;
  int64_t bins_ = 0;
  EnergyBalance ledger_;
  mutable TotalsGain piece_;  // of what is being added
};

/// Reads flushes, one after another in the same memory. Thread rule: one thread.
class FlushReader {
 public:
  FlushReader();
  ~FlushReader();
  FlushReader(FlushReader&&) noexcept;

  /// Errors: not such bytes; more groups than `groups` or an index outside `bins`; indices that do
  /// not ascend; more bytes than such totals can have; `rest` said so.
  Result<FlushGain> read(std::span<const std::byte> bytes, int groups, const BinRange& bins,
                         const FlushRest& rest = no_rest);
  /// What was read is done with: the next flush is read into its memory.
  void take_back(FlushGain&& gain) { spare_.push_back(std::move(gain)); }

 private:
  struct Zstd;
  Result<void> unpack(std::span<const std::byte> bytes, size_t most, const FlushRest& rest,
                      std::vector<std::byte>& out);

  std::unique_ptr<Zstd> zstd_;
  std::vector<std::byte> piece_;
  std::vector<FlushGain> spare_;
};

/// The same, of one flush.
inline Result<FlushGain> decode_flush(std::span<const std::byte> bytes, int groups,
                                      const BinRange& bins, const FlushRest& rest = no_rest) {
  return FlushReader().read(bytes, groups, bins, rest);
}
inline Result<FlushGain> decode_flush(std::span<const std::byte> bytes, int groups, int64_t totals,
                                      const FlushRest& rest = no_rest) {
  return decode_flush(bytes, groups, BinRange{0, totals}, rest);
}

}  // namespace luxodus
