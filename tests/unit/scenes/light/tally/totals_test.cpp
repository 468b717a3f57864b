#include "scenes/light/tally/totals.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <thread>

#include "runtime/core/random.hpp"

using namespace luxodus;

namespace {

constexpr int64_t unit = int64_t{1} << 32;

/// Patches (in, out), a surface that is the sum of bins 1 to 3 of them (in, out, absorbed), and a
/// value without bands.
struct Layout {
  TallyLayout layout;
  uint32_t patches, surface, value;

  explicit Layout(int bands) : layout(bands) {
    patches = layout.add_block({"patches", 5, 2, ScoreUnit::weight});
    surface = layout.add_block({"surface", 1, 3, ScoreUnit::weight});
    value = layout.add_block({"value", 2, 1, ScoreUnit::value, false});
    layout.add_aggregate({patches, 1, 3, surface, 0});
  }
  BatchScores batch() const {
    BatchScores scores;
    scores.reset(layout);
    return scores;
  }
  int64_t& at(BatchScores& scores, uint32_t block, uint32_t bin, int band,
              uint32_t quantity) const {
    return scores.scores.data()[layout.score_index(block, bin, band, quantity)];
  }
  /// A batch with a different number for every score, different in every batch.
  BatchScores random_batch(uint64_t number) const {
    BatchScores scores = batch();
    Random random(3, RandomStream::test);
    random.start(number);
    for (uint32_t bin = 0; bin < 5; ++bin) {
      for (int band = 0; band < layout.bands(); ++band) {
        for (uint32_t q = 0; q < 2; ++q) at(scores, patches, bin, band, q) = random.bits();
      }
    }
    return scores;
  }
};

std::vector<std::vector<int64_t>> ones(int groups, int bands) {
  return std::vector<std::vector<int64_t>>(
      static_cast<size_t>(groups), std::vector<int64_t>(static_cast<size_t>(bands), 1 << 24));
}

void check_equal(const Totals& a, const Totals& b) {
  for (size_t i = 0; i < a.state(0).totals.size(); ++i) {
    REQUIRE(a.state(0).totals[i].sum == b.state(0).totals[i].sum);
    REQUIRE(a.state(0).totals[i].squares == b.state(0).totals[i].squares);
  }
  CHECK(a.batches(0) == b.batches(0));
  CHECK(a.balance().emitted == b.balance().emitted);
}

}  // namespace

TEST_CASE("no two scores share an index, and together they fill the array", "[tally]") {
  const Layout l(3);
  std::vector<int> scores(static_cast<size_t>(l.layout.scores()));
  std::vector<int> totals(static_cast<size_t>(l.layout.totals()));
  for (uint32_t block = 0; block < l.layout.blocks().size(); ++block) {
    const TallyBlock& b = l.layout.block(block);
    for (uint32_t bin = 0; bin < b.bins; ++bin) {
      for (uint32_t q = 0; q < b.quantities; ++q) {
        for (int band = 0; band < (b.banded ? 3 : 1); ++band) {
          ++scores.at(static_cast<size_t>(l.layout.score_index(block, bin, band, q)));
        }
        for (int channel = 0; channel < (b.banded ? 4 : 1); ++channel) {
          ++totals.at(static_cast<size_t>(l.layout.total_index(block, bin, channel, q)));
        }
      }
    }
  }
  CHECK(std::all_of(scores.begin(), scores.end(), [](int n) { return n == 1; }));
  CHECK(std::all_of(totals.begin(), totals.end(), [](int n) { return n == 1; }));
}

TEST_CASE("totals are equal for any order of batches and any number of threads", "[tally]") {
  const Layout l(2);
  constexpr uint64_t batches = 40;
  Totals forward(l.layout, 1, ones(1, 2));
  Totals backward(l.layout, 1, ones(1, 2));
  Totals threaded(l.layout, 1, ones(1, 2));
  const auto merge = [&](Totals& totals, uint64_t i) {
    BatchScores b = l.random_batch(i);
    b.balance.emitted = static_cast<Int128>(i);
    totals.merge(b, 0);
  };
  for (uint64_t i = 0; i < batches; ++i) merge(forward, i);
  for (uint64_t i = batches; i-- > 0;) merge(backward, i);
  std::vector<std::thread> threads;
  for (uint64_t t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (uint64_t i = t; i < batches; i += 4) merge(threaded, i);
    });
  }
  for (std::thread& t : threads) t.join();
  check_equal(forward, backward);
  check_equal(forward, threaded);
}

TEST_CASE("the standard error is that of the batches' mean", "[tally]") {
  const Layout l(1);
  Totals totals(l.layout, 1, ones(1, 1));
  // 1, 2, ..., n units: mean (n + 1) / 2, variance n (n + 1) / 12.
  constexpr int n = 12;
  for (int i = 1; i <= n; ++i) {
    if (i < 3) CHECK(std::isnan(totals.mean(0, 0).standard_error));
    BatchScores b = l.batch();
    l.at(b, l.patches, 0, 0, 0) = i * unit;
    totals.merge(b, 0);
  }
  const BatchMean m = totals.mean(0, l.layout.total_index(l.patches, 0, 0, 0));
  CHECK(m.mean / unit == Approx((n + 1) / 2.0));
  CHECK(m.standard_error / unit == Approx(std::sqrt(n * (n + 1) / 12.0 / n)));
  const BatchMean never = totals.mean(0, l.layout.total_index(l.patches, 4, 0, 1));
  CHECK(never.mean == 0);
  CHECK(never.standard_error == 0);
}

TEST_CASE("negative scores, as of a vector flux, have correct means and errors", "[tally]") {
  const Layout l(1);
  Totals totals(l.layout, 1, ones(1, 1));
  for (const int64_t s : {-3 * unit, unit, -unit, 3 * unit, -5 * unit, -7 * unit}) {
    BatchScores b = l.batch();
    l.at(b, l.patches, 2, 0, 1) = s;
    totals.merge(b, 0);
  }
  const BatchMean m = totals.mean(0, l.layout.total_index(l.patches, 2, 0, 1));
  CHECK(m.mean / unit == Approx(-2));
  CHECK(m.standard_error / unit == Approx(std::sqrt((94.0 - 6 * 4) / 5 / 6)));
}

TEST_CASE("an aggregate is the sum of its bins in every batch, and absorbed is in minus out",
          "[tally]") {
  const Layout l(2);
  Totals totals(l.layout, 1, ones(1, 2));
  // Bins that vary in opposite directions: their sum is constant although each of them varies.
  for (int i = 0; i < 10; ++i) {
    BatchScores b = l.batch();
    const int64_t swing = i % 2 == 0 ? unit : -unit;
    for (int band = 0; band < 2; ++band) {
      l.at(b, l.patches, 1, band, 0) = 10 * unit + swing;
      l.at(b, l.patches, 3, band, 0) = 20 * unit - swing;
      l.at(b, l.patches, 2, band, 1) = 12 * unit;
      l.at(b, l.patches, 0, band, 0) = 1000 * unit;  // not part of this surface
      l.at(b, l.patches, 4, band, 1) = 1000 * unit;
    }
    totals.merge(b, 0);
  }
  const double expected[3] = {30, 12, 18};
  for (int band = 0; band < 2; ++band) {
    for (uint32_t q = 0; q < 3; ++q) {
      const BatchMean m = totals.mean(0, l.layout.total_index(l.surface, 0, band, q));
      CHECK(m.mean / unit == Approx(expected[q]));
      CHECK(m.standard_error / unit < 1e-6);
    }
  }
  CHECK(totals.mean(0, l.layout.total_index(l.patches, 1, 0, 0)).standard_error / unit > 0.3);
}

TEST_CASE("the photopic channel weights the bands within each batch", "[tally]") {
  const Layout l(2);
  Totals totals(l.layout, 2, {{1 << 24, 1 << 22}, {0, 1 << 24}});
  // Band 1 compensates band 0, so that the weighted sum of group 0 is 3 units in every batch.
  for (int i = 0; i < 6; ++i) {
    for (int group = 0; group < 2; ++group) {
      BatchScores b = l.batch();
      const int64_t first = i % 3;
      l.at(b, l.patches, 2, 0, 0) = first * unit;
      l.at(b, l.patches, 2, 1, 0) = 4 * (3 - first) * unit;
      totals.merge(b, group);
    }
  }
  const int64_t at = l.layout.total_index(l.patches, 2, l.layout.photopic_channel(), 0);
  CHECK(totals.mean(0, at).mean / unit == Approx(3));
  CHECK(totals.mean(0, at).standard_error / unit < 1e-6);
  CHECK(totals.mean(1, at).mean / unit == Approx(8));
  CHECK(totals.mean(1, at).standard_error > 0);
  const int64_t wall = l.layout.total_index(l.surface, 0, l.layout.photopic_channel(), 0);
  CHECK(totals.mean(0, wall).mean / unit == Approx(3));
  const TallyLayout single(1);
  CHECK(single.photopic_channel() == 0);
}

TEST_CASE("a value is averaged over the batches of all groups alike", "[tally]") {
  const Layout l(1);
  Totals totals(l.layout, 2, ones(2, 1));
  const auto add = [&](int group, int64_t score) {
    BatchScores b = l.batch();
    l.at(b, l.value, 1, 0, 0) = score * unit;
    totals.merge(b, group);
  };
  add(0, 1);
  add(0, 3);
  add(1, 5);
  const BatchMean m = totals.pooled_mean(l.layout.total_index(l.value, 1, 0, 0));
  CHECK(m.mean / unit == Approx(3));
  CHECK(m.standard_error / unit == Approx(std::sqrt(4.0 / 3)));
}

TEST_CASE("a batch merged in steps has the totals of one merged at once", "[tally]") {
  constexpr uint32_t bins = 200'000;
  TallyLayout layout(1);
  const uint32_t patches = layout.add_block({"patches", bins, 2, ScoreUnit::weight});
  const uint32_t surface = layout.add_block({"surface", 1, 3, ScoreUnit::weight});
  layout.add_aggregate({patches, 10, bins - 20, surface, 0});
  Totals at_once(layout, 1, ones(1, 1)), in_steps(layout, 1, ones(1, 1));
  int rests = 0;
  for (int number = 0; number < 2; ++number) {
    BatchScores one, other;
    for (BatchScores* batch : {&one, &other}) {
      batch->reset(layout);
      for (uint32_t bin = 0; bin < bins; ++bin)
        batch->scores.data()[layout.score_index(patches, bin, 0, 0)] = (bin + 7) * (number + 1);
    }
    at_once.merge(one, 0);
    in_steps.merge(other, 0, [&] { ++rests; });
  }
  CHECK(rests >= 2 * 10);  // 200 000 bins in steps of some 16 000
  check_equal(at_once, in_steps);
}

TEST_CASE("batches that touch few pages have the totals of a merge over all bins",
          "[tally][sparse]") {
  constexpr int bands = 3;
  constexpr uint32_t bins = 6000;
  TallyLayout layout(bands);
  const uint32_t patches = layout.add_block({"patches", bins, 2, ScoreUnit::weight});
  const uint32_t surfaces = layout.add_block({"surfaces", 3, 3, ScoreUnit::weight});
  layout.add_block({"values", 70, 7, ScoreUnit::value, false});
  for (uint32_t s = 0; s < 3; ++s) layout.add_aggregate({patches, 2000 * s, 2000, surfaces, s});
  const std::vector<std::vector<int64_t>> weights{{1 << 24, 1 << 23, 3 << 20}};
  Totals sparse(layout, 1, weights, Cleared::given_back);
  std::vector<Total> plain(static_cast<size_t>(layout.totals()));
  const auto add = [&](int64_t at, int64_t score) {
    Total& t = plain[static_cast<size_t>(at)];
    t.sum += score;
    const Int128 scaled = (static_cast<Int128>(score) + 2048) >> 12;
    t.squares += static_cast<UInt128>(scaled * scaled);
  };
  Random random(8, RandomStream::test);
  BatchScores batch;
  for (uint64_t number = 0; number < 20; ++number) {
    random.start(number);
    batch.reset(layout);
    int64_t of_surface[3][bands][3] = {};
    for (int i = 0; i < 4; ++i) {
      const uint32_t bin = (static_cast<uint32_t>(i) * bins + random.bits() % bins) / 4;
      int64_t score[bands][2];
      for (int b = 0; b < bands; ++b) {
        for (uint32_t q = 0; q < 2; ++q) {
          score[b][q] = random.bits() % 3 == 0 ? 0 : static_cast<int64_t>(random.bits64() >> 8);
          *batch.scores.touch(layout.score_index(patches, bin, b, q)) = score[b][q];
        }
      }
      for (int b = 0; b < bands; ++b) {
        for (uint32_t q = 0; q < 2; ++q) {
          add(layout.total_index(patches, bin, b, q), score[b][q]);
          of_surface[bin / 2000][b][q] += score[b][q];
        }
        of_surface[bin / 2000][b][2] += score[b][0] - score[b][1];
      }
      for (uint32_t q = 0; q < 2; ++q) {
        Int128 weighted = 0;
        for (int b = 0; b < bands; ++b)
          weighted += static_cast<Int128>(score[b][q]) * weights[0][static_cast<size_t>(b)];
        add(layout.total_index(patches, bin, bands, q), static_cast<int64_t>(weighted >> 24));
      }
    }
    for (uint32_t s = 0; s < 3; ++s) {
      for (uint32_t q = 0; q < 3; ++q) {
        Int128 weighted = 0;
        for (int b = 0; b < bands; ++b) {
          add(layout.total_index(surfaces, s, b, q), of_surface[s][b][q]);
          weighted += static_cast<Int128>(of_surface[s][b][q]) * weights[0][static_cast<size_t>(b)];
        }
        add(layout.total_index(surfaces, s, bands, q), static_cast<int64_t>(weighted >> 24));
      }
    }
    const size_t before = sparse.bytes();
    batch.scores.find_touched();
    const size_t room = sparse.bytes_to_merge(batch, 0);
    sparse.merge(batch, 0);
    CHECK(sparse.bytes() - before <= room);
  }
  int64_t different = 0;
  for (size_t i = 0; i < plain.size(); ++i)
    different += sparse.state(0).totals[i].sum != plain[i].sum ||
                 sparse.state(0).totals[i].squares != plain[i].squares;
  CHECK(different == 0);
  int64_t taken = 0;
  sparse.take_bins(0, 0, layout.totals(), [&](int64_t, const Total&) { ++taken; });
  CHECK(taken > 0);
  CHECK(sparse.bytes() == 0);
  CHECK(sparse.next_bin(0, 0) == layout.totals());
}

TEST_CASE("totals with a score that was out of range have no mean, whatever is added", "[tally]") {
  const Layout l(1);
  const auto batch_of = [&](int64_t score) {
    BatchScores scores = l.batch();
    l.at(scores, l.value, 0, 0, 0) = score;
    l.at(scores, l.value, 1, 0, 0) = 5;
    return scores;
  };
  const int64_t bin = l.layout.total_index(l.value, 0, 0, 0);
  const auto check_marked = [&](const Totals& totals) {
    CHECK(std::isinf(totals.mean(0, bin).mean));
    CHECK(std::isinf(totals.pooled_mean(bin).standard_error));
    CHECK(totals.mean(0, bin + 1).mean == 5);
  };
  constexpr int64_t most = int64_t{1} << 62;
  for (const std::vector<int64_t>& order : {std::vector<int64_t>{limits::out_of_range, 7, most},
                                            {7, most, limits::out_of_range},
                                            {limits::out_of_range, limits::out_of_range, 7}}) {
    Totals totals(l.layout, 1, ones(1, 1));
    for (const int64_t score : order) {
      BatchScores scores = batch_of(score);
      totals.merge(scores, 0);
    }
    check_marked(totals);
    // Also after they were sent elsewhere.
    Totals there(l.layout, 1, ones(1, 1));
    BatchScores own = batch_of(9);
    there.merge(own, 0);
    TotalsGain gain;
    gain.groups.emplace_back();
    gain.groups.front().batches = totals.take_batches(0);
    totals.take_bins(0, 0, l.layout.totals(), [&](int64_t index, const Total& total) {
      gain.groups.front().bins.push_back({index, total});
    });
    there.add(gain);
    check_marked(there);
  }
  // The largest scores, as many as a run may have, are in range.
  Totals totals(l.layout, 1, ones(1, 1));
  for (int i = 0; i < 64; ++i) {
    BatchScores scores = batch_of(most);
    totals.merge(scores, 0);
  }
  CHECK(totals.mean(0, bin).mean == 0x1p62);
}
