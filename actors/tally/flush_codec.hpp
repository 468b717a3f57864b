// A flush on its way: what a node's batches have added to its totals, as bytes. Numbers are LEB128
// (signed ones zigzag), indices as differences, the whole packed by zstd. A million bins take tens
// of milliseconds, so they are packed in steps, between which the node does other things. Bytes
// come from other machines: they are read into a value first, and taken or refused whole.
// Thread rule: a FlushEncoder belongs to one thread; decoding is pure.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/tally/totals.hpp"

namespace luxodus {

/// The most that one bin of totals takes in a flush before it is packed [B]: a distance below 2^40,
/// a sum below 2^90 (2^26 batches of 2^63, signed) and squares of 128 bits, seven bits a byte.
inline constexpr uint64_t flush_bytes_of_bin = 6 + 13 + 19;

/// Empties totals into bytes, step by step.
class FlushEncoder {
 public:
  /// Requires: nobody else touches `totals` until the last step.
  explicit FlushEncoder(Totals& totals);
  ~FlushEncoder();

  /// Goes through the next `bins` bins; true when there are no more.
  bool step(int64_t bins);
  /// Requires: step() has returned true.
  std::vector<std::byte> take_bytes() { return std::move(packed_); }

 private:
  void pack(bool last);

  Totals& totals_;
  int group_ = 0;
  int64_t next_ = 0;        // bin of the group
  int64_t after_last_ = 0;  // the index behind the last bin that was written
  std::vector<std::byte> raw_;
  std::vector<std::byte> packed_;
  struct Zstd;
  std::unique_ptr<Zstd> zstd_;
};

/// All at once.
std::vector<std::byte> encode_flush(Totals& totals);

/// Errors: not such bytes; more groups than `groups` or an index beyond `totals`; indices that do
/// not ascend; more bytes than such totals can have.
Result<TotalsGain> decode_flush(std::span<const std::byte> bytes, int groups, int64_t totals);

}  // namespace luxodus
