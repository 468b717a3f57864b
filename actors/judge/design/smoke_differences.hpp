// By how much more of the routes a sign is read from with one layout than with another. Layouts
// that share their paths err alike, so the error of what they differ by is smaller than the range
// of either. Pure; any thread. Why so: docs/decisions/0074-differences-between-layouts.md.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "actors/judge/design/smoke_verdicts.hpp"

namespace luxodus {

/// By how much the share of one layout is larger than that of another: between these two but for
/// 2.3 % on either side, as by two standard errors, in shares of the routes' length.
struct ShareDifference {
  double least = -1, most = 1;  // [1]

  /// But for what rounding leaves of equal shares.
  bool surely_more() const { return least > rounding; }
  bool surely_no_less() const { return least >= -rounding; }
  bool surely_no_more() const { return most <= rounding; }

 private:
  static constexpr double rounding = 1e-9;
};

/// Where both hold.
ShareDifference both_of(const ShareDifference& a, const ShareDifference& b);
/// Of a third layout beside a second, from what both are beside the first.
ShareDifference chained(const ShareDifference& second, const ShareDifference& third);
/// By the ranges of each layout alone.
ShareDifference by_ranges(const LegibleShare& first, const LegibleShare& other);

/// What paths found of one layout in one scenario: `rows` are its views.
struct LayoutViews {
  const SeenPlaces& places;
  const std::vector<SightRow>& rows;
};

/// Of a view, by number: the standard error of its level of reading with the other layout less that
/// with the first; none where it is not known, as of views that different paths have decided.
using ErrorOfDifference = std::function<std::optional<double>(size_t row)>;

/// The other layout beside the first. `error_of`: where they share their paths, and so have the
/// same views in the same order; else it is empty. Requires: the same places on routes.
ShareDifference difference_of(const LayoutViews& first, const LayoutViews& other,
                              const ErrorOfDifference& error_of);

/// The chance that two standard normal variables of this correlation are below `a` and `b`.
double chance_below(double a, double b, double correlation);

}  // namespace luxodus
