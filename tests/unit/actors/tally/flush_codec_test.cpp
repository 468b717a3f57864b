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
  FlushEncoder encoder(holder.groups(), holder.layout().totals());
  encoder.begin(holder);
  while (!encoder.step(step)) {
  }
  return encoder.bytes();
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
    CHECK(same(some_gain(), back.value()));
  }
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
    for (const auto& group : read.value().groups)
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
    if (batch % 7 == 6) here.add(decode_flush(encode_flush(there), 1, layout.totals()).value());
  }
  here.add(decode_flush(encode_flush(there), 1, layout.totals()).value());
  CHECK(decode_flush(encode_flush(there), 1, layout.totals()).value().groups[0].bins.empty());
  REQUIRE(here.batches(0) == 20);
  for (size_t i = 0; i < whole.state(0).totals.size(); ++i) {
    CHECK(here.state(0).totals[i].sum == whole.state(0).totals[i].sum);
    CHECK(here.state(0).totals[i].squares == whole.state(0).totals[i].squares);
  }
  CHECK(here.ledger().emitted == whole.ledger().emitted);
}
