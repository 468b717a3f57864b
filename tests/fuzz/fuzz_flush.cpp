#include "tests/fuzz/fuzz_flush.hpp"

#include <zstd.h>

#include "actors/cast/tally/flush_codec.hpp"
#include "tests/fuzz/must.hpp"
#include "tests/kit/encode_flush.hpp"

namespace luxodus::test {

namespace {

constexpr int groups = 2;
constexpr int64_t bins = 500;

TallyLayout layout() {
  TallyLayout made(1);
  made.add_block({"patches", static_cast<uint32_t>(bins), 1, ScoreUnit::weight});
  return made;
}

Totals no_totals() {
  static const TallyLayout of_all = layout();
  return Totals(of_all, groups, std::vector<std::vector<int64_t>>(groups, {1 << 24}));
}

std::vector<std::byte> packed(std::span<const std::byte> raw) {
  std::vector<std::byte> out(ZSTD_compressBound(raw.size()));
  out.resize(ZSTD_compress(out.data(), out.size(), raw.data(), raw.size(), 1));
  return out;
}

}  // namespace

std::vector<std::byte> sample_flush() {
  Totals totals = no_totals();
  TotalsGain gain;
  for (int g = 0; g < groups; ++g) {
    auto& group = gain.groups.emplace_back();
    group.batches = 3;
    for (int64_t i = g; i < bins; i += 7)
      group.bins.push_back({i, {static_cast<Int128>(i) << 20, static_cast<UInt128>(i) << 40}});
  }
  gain.balance.emitted = gain.balance.escaped = 1000;
  totals.add(gain);
  const auto bytes = encode_flush(totals);
  std::vector<std::byte> raw(1 << 20);
  const size_t length = ZSTD_decompress(raw.data(), raw.size(), bytes.data(), bytes.size());
  must(ZSTD_isError(length) == 0, "a flush does not unpack");
  raw.resize(length);
  return raw;
}

bool fuzz_flush(std::span<const std::byte> bytes, bool raw) {
  const std::vector<std::byte> whole =
      raw ? packed(bytes) : std::vector<std::byte>(bytes.begin(), bytes.end());
  const auto gain = decode_flush(whole, groups, bins);
  const auto part = decode_flush(whole, groups, BinRange{100, 300});
  if (part.ok()) must(part->bins() <= groups * 200, "a part has more bins than its range");
  if (!gain.ok()) return false;
  must(gain->bins() <= groups * bins, "a flush has more bins than there are");
  must(gain->batches() >= 0, "a flush counts less than nothing");
  if (!gain->balance().closes()) return true;  // the controller refuses it
  Totals totals = no_totals();
  gain->add_to(totals);
  return true;
}

}  // namespace luxodus::test
