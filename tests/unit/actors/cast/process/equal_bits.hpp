// Uninterrupted runs without reports, and a comparison of their totals. One thread.
#pragma once

#include <atomic>
#include <catch2/catch.hpp>

#include "actors/results/run/local_run.hpp"

namespace luxodus {

inline const std::atomic<bool> nobody{false};
inline void ignore(const Progress&) {}

/// Number of bins that differ in any bit.
inline int64_t differences(const LocalRun& a, const LocalRun& b) {
  int64_t count = 0;
  for (int g = 0; g < a.totals().groups(); ++g) {
    const auto& x = a.totals().state(g);
    const auto& y = b.totals().state(g);
    CHECK(x.batches == y.batches);
    REQUIRE(x.totals.size() == y.totals.size());
    for (size_t i = 0; i < x.totals.size(); ++i)
      count += x.totals[i].sum != y.totals[i].sum || x.totals[i].squares != y.totals[i].squares;
  }
  CHECK(a.totals().balance().rays == b.totals().balance().rays);
  CHECK(b.totals().balance().closes());
  return count;
}

}  // namespace luxodus
