#include "actors/tally/flush_codec.hpp"

#include <catch2/catch.hpp>

#include "runtime/core/random.hpp"

using namespace luxodus;

namespace {

constexpr int groups = 2;
constexpr int64_t totals = 1000;

TallyLayout layout_of(int64_t bins) {
  TallyLayout layout(1);
  layout.add_block({"patches", static_cast<uint32_t>(bins), 1, ScoreUnit::weight});
  return layout;
}
const std::vector<std::vector<int64_t>> photopic(groups, {1 << 24});

/// Sums and squares of all sizes, some bins zero.
TotalsGain some_gain() {
  Random random(3, RandomStream::test);
  random.start(0);
  TotalsGain gain;
  for (int g = 0; g < groups; ++g) {
    auto& group = gain.groups.emplace_back();
    group.batches = 7 + g;
    for (int64_t i = g; i < totals; i += 1 + random.bits() % 5) {
      Total t;
      t.sum = (static_cast<Int128>(random.bits64()) << (i % 60)) * (i % 3 == 0 ? -1 : 1);
      t.squares = static_cast<UInt128>(random.bits64()) << (i % 63);
      group.bins.push_back({i, t});
    }
  }
  gain.ledger.emitted = static_cast<Int128>(1) << 100;
  gain.ledger.roulette_loss = 12345;
  gain.ledger.rays = UINT64_MAX;
  return gain;
}

std::vector<std::byte> some_flush(int64_t step) {
  const TallyLayout layout = layout_of(totals);
  Totals holder(layout, groups, photopic);
  holder.add(some_gain());
  FlushEncoder encoder(holder);
  while (!encoder.step(step)) {
  }
  return encoder.take_bytes();
}

/// The pieces of a flush as one.
TotalsGain joined(const std::vector<TotalsGain>& pieces) {
  TotalsGain whole = pieces.back();
  for (size_t g = 0; g < whole.groups.size(); ++g) {
    whole.groups[g].bins.clear();
    for (const TotalsGain& piece : pieces) {
      const auto& bins = piece.groups[g].bins;
      whole.groups[g].bins.insert(whole.groups[g].bins.end(), bins.begin(), bins.end());
    }
  }
  return whole;
}

void add(Totals& to, const std::vector<std::byte>& flush, int64_t size) {
  const auto pieces = decode_flush(flush, 1, size);
  REQUIRE(pieces.ok());
  for (const TotalsGain& piece : pieces.value()) to.add(piece);
}

bool same(const TotalsGain& a, const TotalsGain& b) {
  if (a.groups.size() != b.groups.size()) return false;
  for (size_t g = 0; g < a.groups.size(); ++g) {
    const auto& x = a.groups[g];
    const auto& y = b.groups[g];
    if (x.batches != y.batches || x.bins.size() != y.bins.size()) return false;
    for (size_t i = 0; i < x.bins.size(); ++i) {
      if (x.bins[i].index != y.bins[i].index || x.bins[i].total.sum != y.bins[i].total.sum ||
          x.bins[i].total.squares != y.bins[i].total.squares)
        return false;
    }
  }
  return a.ledger.emitted == b.ledger.emitted && a.ledger.roulette_loss == b.ledger.roulette_loss &&
         a.ledger.rays == b.ledger.rays;
}

}  // namespace

TEST_CASE("a flush comes back as it was made, in steps of any length", "[flush]") {
  for (const int64_t step : {1, 7, 999, 1000, 5000}) {
    const auto back = decode_flush(some_flush(step), groups, totals);
    REQUIRE(back.ok());
    CHECK(same(some_gain(), joined(back.value())));
  }
}

TEST_CASE("a long flush is read in steps, and its pieces are as long as steps", "[flush]") {
  constexpr int64_t many = 100'000;
  const TallyLayout layout = layout_of(many);
  Totals holder(layout, groups, photopic), taken(layout, groups, photopic);
  TotalsGain gain;
  gain.groups.resize(groups);
  for (int64_t i = 0; i < many; ++i) gain.groups[1].bins.push_back({i, {i + 1, 7}});
  gain.groups[1].batches = 3;
  gain.ledger.rays = 5;
  holder.add(gain);
  const auto bytes = encode_flush(holder);
  FlushDecoder decoder(bytes, groups, many);
  int steps = 1;
  while (!decoder.step()) ++steps;
  CHECK(steps >= 4);
  const auto pieces = decoder.take();
  REQUIRE(pieces.ok());
  CHECK(pieces.value().size() > 4);
  CHECK(same(gain, joined(pieces.value())));
}

TEST_CASE("a flush with more after its end is refused", "[flush]") {
  auto bytes = some_flush(100);
  const auto twice = bytes;
  bytes.insert(bytes.end(), twice.begin(), twice.end());
  CHECK_FALSE(decode_flush(bytes, groups, totals).ok());
}

TEST_CASE("a flush of another layout, cut short or damaged is refused whole", "[flush]") {
  const auto bytes = some_flush(100);
  CHECK_FALSE(decode_flush(bytes, groups + 1, totals).ok());
  CHECK_FALSE(decode_flush(bytes, groups, totals - 10).ok());
  CHECK_FALSE(decode_flush({}, groups, totals).ok());
  for (size_t n = 0; n < bytes.size(); n += 97)
    CHECK_FALSE(decode_flush(std::span(bytes).first(n), groups, totals).ok());
  Random random(4, RandomStream::test);
  random.start(0);
  for (int i = 0; i < 2000; ++i) {
    auto harmed = bytes;
    harmed[random.bits() % harmed.size()] ^= static_cast<std::byte>(1u << (random.bits() % 8));
    const auto read = decode_flush(harmed, groups, totals);
    if (!read.ok()) continue;
    for (const auto& group : joined(read.value()).groups)
      for (const auto& bin : group.bins) REQUIRE((bin.index >= 0 && bin.index < totals));
  }
}

TEST_CASE("totals that take the gains of others are the totals of all batches", "[flush]") {
  TallyLayout layout(1);
  layout.add_block({"patches", 50, 2, ScoreUnit::weight});
  const std::vector<std::vector<int64_t>> one{{1 << 24}};
  Totals whole(layout, 1, one), here(layout, 1, one), there(layout, 1, one);
  Random random(5, RandomStream::test);
  random.start(0);
  for (int batch = 0; batch < 20; ++batch) {
    BatchScores scores;
    scores.reset(layout);
    for (int i = 0; i < 30; ++i) scores.scores[random.bits() % 100] += random.bits();
    scores.ledger.emitted = 5;
    BatchScores copy = scores;
    whole.merge(scores, 0);
    (batch % 3 == 0 ? here : there).merge(copy, 0);
    if (batch % 7 == 6) add(here, encode_flush(there), layout.totals());
  }
  add(here, encode_flush(there), layout.totals());
  CHECK(decode_flush(encode_flush(there), 1, layout.totals()).value().size() == 1);
  REQUIRE(here.batches(0) == 20);
  for (size_t i = 0; i < whole.state(0).totals.size(); ++i) {
    CHECK(here.state(0).totals[i].sum == whole.state(0).totals[i].sum);
    CHECK(here.state(0).totals[i].squares == whole.state(0).totals[i].squares);
  }
  CHECK(here.ledger().emitted == whole.ledger().emitted);
}
