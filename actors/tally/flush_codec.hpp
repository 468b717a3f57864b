// A flush on its way: what a node's batches have added to its totals, as bytes. Numbers are LEB128
// (signed ones zigzag), indices as differences, the whole packed by zstd. A million bins take tens
// of milliseconds, so they are packed and unpacked in steps, between which the node does other
// things. Bytes come from other machines: they are read into a value first, and taken or refused
// whole.
// Thread rule: an encoder and a decoder belong to one thread each.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/tally/totals.hpp"

namespace luxodus {

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

/// Reads what a FlushEncoder wrote, step by step.
class FlushDecoder {
 public:
  /// Requires: `bytes` outlive this; so many source groups, of so many totals each.
  FlushDecoder(std::span<const std::byte> bytes, int groups, int64_t totals);
  ~FlushDecoder();

  /// Unpacks and reads some ten thousand bins; true when there are no more, or they are wrong.
  bool step();

  /// What is to be added, in pieces of as many bins as a step has; batches and ledger are in the
  /// last. Requires: step() has returned true. Errors: not such bytes; more groups, or an index
  /// beyond the totals.
  Result<std::vector<TotalsGain>> take();

 private:
  enum class State : uint8_t { count, batches, bins, ledger, done, failed };
  class Reader;

  bool unpack();
  bool read_item(Reader& in);
  bool read_bin(Reader& in);
  bool fail(const char* why);

  const int groups_;
  const int64_t totals_;
  State state_ = State::count;
  Problem problem_;
  std::vector<std::byte> buffer_;  // unpacked, not read
  size_t group_ = 0;
  size_t group_of_piece_ = 0;
  uint64_t next_ = 0;  // bin of the group
  std::vector<TotalsGain> pieces_;
  TotalsGain last_;
  struct Zstd;
  std::unique_ptr<Zstd> zstd_;
};

/// All at once. Errors: as FlushDecoder::take.
Result<std::vector<TotalsGain>> decode_flush(std::span<const std::byte> bytes, int groups,
                                             int64_t totals);

}  // namespace luxodus
