#include "actors/tally/flush_codec.hpp"

#include <zstd.h>

#include <stdexcept>

namespace luxodus {

namespace {

constexpr int fast = 1;  // of zstd's levels: a flush is packed on the node's own thread
constexpr size_t longest_number = 19;  // bytes of 128 bits, seven at a time
constexpr size_t numbers_of_ledger = 11;

class Writer {
 public:
  void put(UInt128 v) {
    while (v >= 0x80) {
      bytes_.push_back(static_cast<std::byte>(static_cast<uint8_t>(v) | 0x80));
      v >>= 7;
    }
    bytes_.push_back(static_cast<std::byte>(static_cast<uint8_t>(v)));
  }
  void put_signed(Int128 v) {
    put((static_cast<UInt128>(v) << 1) ^ static_cast<UInt128>(v >> 127));
  }
  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

/// Reads numbers; once one is missing or too long, all that follow are 0 and ok() is false.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  UInt128 get() {
    UInt128 v = 0;
    for (size_t i = 0; i < longest_number; ++i) {
      if (bytes_.empty()) break;
      const auto byte = static_cast<uint8_t>(bytes_.front());
      bytes_ = bytes_.subspan(1);
      v |= static_cast<UInt128>(byte & 0x7f) << (7 * i);
      if (byte < 0x80) return v;
    }
    ok_ = false;
    return 0;
  }
  uint64_t get_up_to(uint64_t most) {
    const UInt128 v = get();
    if (v > most) ok_ = false;
    return ok_ ? static_cast<uint64_t>(v) : 0;
  }
  Int128 get_signed() {
    const UInt128 v = get();
    return static_cast<Int128>(v >> 1) ^ -static_cast<Int128>(v & 1);
  }
  bool ok() const { return ok_; }
  bool at_end() const { return bytes_.empty(); }

 private:
  std::span<const std::byte> bytes_;
  bool ok_ = true;
};

void put_ledger(Writer& out, const Ledger& l) {
  for (const Int128 v : {l.emitted, l.roulette_gain, l.absorbed_surfaces, l.absorbed_media,
                         l.escaped, l.roulette_loss, l.lost_too_long})
    out.put_signed(v);
  for (const uint64_t v : {l.particles, l.rays, l.hits, l.collisions}) out.put(v);
}

Ledger get_ledger(Reader& in) {
  Ledger l;
  for (Int128* v : {&l.emitted, &l.roulette_gain, &l.absorbed_surfaces, &l.absorbed_media,
                    &l.escaped, &l.roulette_loss, &l.lost_too_long})
    *v = in.get_signed();
  for (uint64_t* v : {&l.particles, &l.rays, &l.hits, &l.collisions}) *v = in.get_up_to(UINT64_MAX);
  return l;
}

/// The most bytes that totals of this size can take.
size_t bytes_most(int groups, int64_t totals) {
  const auto bins = static_cast<size_t>(groups) * static_cast<size_t>(totals);
  return (bins * 3 + static_cast<size_t>(groups) * 2 + numbers_of_ledger + 1) * longest_number;
}

Result<std::vector<std::byte>> unpack(std::span<const std::byte> bytes, size_t most) {
  const unsigned long long size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  if (size == ZSTD_CONTENTSIZE_UNKNOWN || size == ZSTD_CONTENTSIZE_ERROR || size > most)
    return Problem{{}, "the flush is no packed totals of this scene"};
  std::vector<std::byte> out(size);
  if (ZSTD_decompress(out.data(), out.size(), bytes.data(), bytes.size()) != size)
    return Problem{{}, "the flush is damaged"};
  return out;
}

}  // namespace

std::vector<std::byte> encode_gain(const TotalsGain& gain) {
  Writer out;
  out.put(gain.groups.size());
  for (const TotalsGain::GroupGain& group : gain.groups) {
    out.put(static_cast<uint64_t>(group.batches));
    out.put(group.bins.size());
    int64_t next = 0;
    for (const TotalsGain::Bin& bin : group.bins) {
      out.put(static_cast<uint64_t>(bin.index - next));
      out.put_signed(bin.total.sum);
      out.put(bin.total.squares);
      next = bin.index + 1;
    }
  }
  put_ledger(out, gain.ledger);
  std::vector<std::byte> packed(ZSTD_compressBound(out.bytes().size()));
  const size_t size =
      ZSTD_compress(packed.data(), packed.size(), out.bytes().data(), out.bytes().size(), fast);
  if (ZSTD_isError(size)) throw std::runtime_error("flush: zstd could not pack it");
  packed.resize(size);
  return packed;
}

Result<TotalsGain> decode_gain(std::span<const std::byte> bytes, int groups, int64_t totals) {
  auto raw = unpack(bytes, bytes_most(groups, totals));
  if (!raw.ok()) return raw.problem();
  Reader in(raw.value());
  const Problem wrong{{}, "the flush does not fit this scene's totals"};
  if (in.get_up_to(static_cast<uint64_t>(groups)) != static_cast<uint64_t>(groups)) return wrong;
  TotalsGain gain;
  for (int g = 0; g < groups; ++g) {
    TotalsGain::GroupGain& group = gain.groups.emplace_back();
    group.batches = static_cast<int64_t>(in.get_up_to(uint64_t{1} << 40));
    const uint64_t bins = in.get_up_to(static_cast<uint64_t>(totals));
    uint64_t next = 0;
    for (uint64_t i = 0; i < bins && in.ok(); ++i) {
      TotalsGain::Bin bin;
      const uint64_t index = next + in.get_up_to(static_cast<uint64_t>(totals));
      bin.total.sum = in.get_signed();
      bin.total.squares = in.get();
      if (index >= static_cast<uint64_t>(totals)) return wrong;
      bin.index = static_cast<int64_t>(index);
      next = index + 1;
      group.bins.push_back(bin);
    }
  }
  gain.ledger = get_ledger(in);
  if (!in.ok() || !in.at_end()) return wrong;
  return gain;
}

}  // namespace luxodus
