#include "actors/cast/tally/flush_codec.hpp"

#include <catch2/catch.hpp>

#include "runtime/core/random.hpp"
#include "tests/kit/encode_flush.hpp"

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

/// Sums and squares of all magnitudes, some bins zero.
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
  gain.balance.emitted = static_cast<Int128>(1) << 100;
  gain.balance.roulette_loss = 12345;
  gain.balance.rays = UINT64_MAX;
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

bool same(const Totals& a, const Totals& b) {
  for (int g = 0; g < groups; ++g) {
    const auto& x = a.state(g);
    const auto& y = b.state(g);
    if (x.batches != y.batches) return false;
    for (size_t i = 0; i < x.totals.size(); ++i) {
      if (x.totals[i].sum != y.totals[i].sum || x.totals[i].squares != y.totals[i].squares)
        return false;
    }
  }
  return a.balance().emitted == b.balance().emitted &&
         a.balance().roulette_loss == b.balance().roulette_loss &&
         a.balance().rays == b.balance().rays;
}

}  // namespace

TEST_CASE("a flush is read back unchanged, packed in steps of any length", "[flush]") {
  for (const int64_t step : {1, 7, 999, 1000, 5000}) {
    const auto back = decode_flush(some_flush(step), groups, totals);
    REQUIRE(back.ok());
    const TallyLayout layout = layout_of(totals);
    Totals sent(layout, groups, photopic), taken(layout, groups, photopic);
    sent.add(some_gain());
    back->add_to(taken);
    CHECK(same(sent, taken));
    CHECK(back->batches() == 15);
    CHECK(back->bins() == static_cast<int64_t>(some_gain().groups[0].bins.size() +
                                               some_gain().groups[1].bins.size()));
  }
}

TEST_CASE("a flush in parts, each a range of bins, equals the whole flush", "[flush]") {
  const TallyLayout layout = layout_of(totals);
  Totals sent(layout, groups, photopic), whole(layout, groups, photopic);
  Totals taken(layout, groups, photopic);
  sent.add(some_gain());
  whole.add(some_gain());
  FlushEncoder encoder(groups, totals);
  for (const BinRange& bins : {BinRange{300, 999}, BinRange{999, 1000}, BinRange{0, 300}}) {
    const bool counts = bins.first == 0;
    encoder.begin(sent, bins, counts ? FlushCounts::with : FlushCounts::without);
    while (!encoder.step(100)) {
    }
    const auto part = decode_flush(encoder.bytes(), groups, bins);
    REQUIRE(part.ok());
    CHECK((part->batches() == 0) == !counts);
    part->add_to(taken);
    if (bins.first == 300) CHECK_FALSE(decode_flush(encoder.bytes(), groups, {300, 600}).ok());
  }
  CHECK(same(whole, taken));
}

TEST_CASE("a flush of another layout, truncated or damaged is rejected whole", "[flush]") {
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
    const TallyLayout layout = layout_of(totals);
    Totals holder(layout, groups, photopic);
    read->add_to(holder);  // within its bins: otherwise the sanitizers report it
  }
}

TEST_CASE("reading a long flush yields between its parts, and can be stopped", "[flush]") {
  const TallyLayout layout = layout_of(100'000);
  Totals node(layout, 1, photopic), other(layout, 1, photopic);
  TotalsGain gain;
  gain.groups.resize(1);
  for (int64_t i = 0; i < 100'000; ++i) gain.groups[0].bins.push_back({i, {i, 1}});
  node.add(gain);
  const auto bytes = test::encode_flush(node);
  int rests = 0;
  const auto read = decode_flush(bytes, 1, 100'000, [&] { return ++rests > 0; });
  REQUIRE(read.ok());
  CHECK(rests >= 6);
  rests = 0;
  read->add_to(other, [&] { return ++rests > 0; });
  CHECK(rests >= 6);
  CHECK(other.state(0).totals[99'999].sum == 99'999);
  const auto broken = decode_flush(bytes, 1, 100'000, [] { return false; });
  REQUIRE_FALSE(broken.ok());
}

TEST_CASE("totals that add others' gains equal the totals of all batches", "[flush]") {
  TallyLayout layout(1);
  layout.add_block({"patches", 50, 2, ScoreUnit::weight});
  const std::vector<std::vector<int64_t>> one{{1 << 24}};
  Totals whole(layout, 1, one), here(layout, 1, one), there(layout, 1, one);
  Random random(5, RandomStream::test);
  random.start(0);
  for (int batch = 0; batch < 20; ++batch) {
    BatchScores scores;
    scores.reset(layout);
    for (int i = 0; i < 30; ++i) scores.scores.data()[random.bits() % 100] += random.bits();
    scores.balance.emitted = 5;
    scores.scores.find_touched();
    BatchScores copy = scores;
    whole.merge(scores, 0);
    (batch % 3 == 0 ? here : there).merge(copy, 0);
    if (batch % 7 == 6) decode_flush(test::encode_flush(there), 1, layout.totals())->add_to(here);
  }
  decode_flush(test::encode_flush(there), 1, layout.totals())->add_to(here);
  CHECK(decode_flush(test::encode_flush(there), 1, layout.totals())->bins() == 0);
  REQUIRE(here.batches(0) == 20);
  for (size_t i = 0; i < whole.state(0).totals.size(); ++i) {
    CHECK(here.state(0).totals[i].sum == whole.state(0).totals[i].sum);
    CHECK(here.state(0).totals[i].squares == whole.state(0).totals[i].squares);
  }
  CHECK(here.balance().emitted == whole.balance().emitted);
}
