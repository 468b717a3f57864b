// Paired comparison of two layouts in smoke: the difference of the shares of the routes' length
// from which a sign is read. Errors of layouts that share paths are correlated, so the error of
// their difference is smaller than the range of either. Pure functions; any thread. Design:
// docs/decisions/0074-differences-between-layouts.md.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "actors/judge/design/smoke_verdicts.hpp"

namespace luxodus {

/// Standard errors at which views of layouts get their verdicts. A report needs far more, since
/// each of its verdicts counts; a comparison of layouts sums many views and has an interval of its
/// own.
inline constexpr double sure_errors_of_races = 2;

/// Interval of the difference of two layouts' legible shares, in shares of the routes' length. Each
/// end excludes 2.3 %, as two standard errors do.
struct ShareDifference {
  double least = -1, most = 1;  // [1]
  static constexpr void fields(auto&& field, auto& m) { field("least", m.least)("most", m.most); }

  /// `rounding` is the tolerance for equal shares.
  bool surely_more() const { return least > rounding; }
  bool surely_no_less() const { return least >= -rounding; }
  bool surely_no_more() const { return most <= rounding; }

 private:
  static constexpr double rounding = 1e-9;
};

/// Intersection of two intervals.
ShareDifference both_of(const ShareDifference& a, const ShareDifference& b);
/// Interval of a third layout relative to a second, from those of both relative to the first.
ShareDifference chained(const ShareDifference& second, const ShareDifference& third);
/// Interval from the separate ranges of two layouts.
ShareDifference by_ranges(const LegibleShare& first, const LegibleShare& other);

/// Traced views of one layout in one scenario.
struct LayoutViews {
  const SeenPlaces& places;
  const std::vector<SightRow>& rows;
};

/// For a view: the standard error of its reading level with the other layout minus that with the
/// first. None if it is not known, as for views that different paths decided.
using ErrorOfDifference = std::function<std::optional<double>(size_t row)>;

/// Interval of the other layout relative to the first. `error_of`: empty unless the layouts share
/// paths, and so have the same views in the same order. Requires: the same places on routes.
ShareDifference difference_of(const LayoutViews& first, const LayoutViews& other,
                              const ErrorOfDifference& error_of);

/// Probability that two standard normal variables with this correlation are below `a` and `b`.
double chance_below(double a, double b, double correlation);

}  // namespace luxodus
