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

struct ZSTD_inBuffer_s;  // of zstd.h

namespace luxodus {

/// The most that one bin of totals takes in a flush before it is packed [B]: a distance below 2^40,
/// a sum below 2^90 (2^26 batches of 2^63, signed) and squares of 128 bits, seven bits a byte.
inline constexpr uint64_t flush_bytes_of_bin = 6 + 13 + 19;

/// Empties totals into bytes, step by step, one flush after another in the same memory.
class FlushEncoder {
 public:
  /// Takes room for flushes of so many source groups and totals each: address space, which becomes
  /// memory as it is used.
  FlushEncoder(int groups, int64_t totals);
  ~FlushEncoder();

  /// Begins a flush; the bytes of the one before are gone. Requires: `totals` are of that size, and
  /// nobody else touches them until the last step.
  void begin(Totals& totals);

  /// Goes through the next `bins` bins; true when there are no more.
  bool step(int64_t bins);
  /// The whole flush, until begin(). Requires: step() has returned true.
  const std::vector<std::byte>& bytes() const { return packed_; }

 private:
  void pack(bool last);
  size_t pack_more(ZSTD_inBuffer_s& in, int how);

  Totals* totals_ = nullptr;
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
