#include "scenes/emergency/extremes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scenes/emergency/rule_table.hpp"

namespace luxodus {

namespace {

void take(const LitPoint& point, const LuminaireFactors& factors, Spread& spread) {
  const double lux = std::inner_product(point.lux.begin(), point.lux.end(), factors.begin(), 0.0);
  spread.most = std::max(spread.most, lux);
  if (lux < spread.least) {
    spread.least = lux;
    spread.darkest = point.place;
  }
}

}  // namespace

Spread spread_of(const std::vector<LitPoint>& points, const LuminaireFactors& factors) {
  Spread spread;
  for (const LitPoint& point : points) {
    take(point, factors, spread);
    spread.mean += std::inner_product(point.lux.begin(), point.lux.end(), factors.begin(), 0.0) /
                   static_cast<double>(points.size());
  }
  return spread;
}

SpreadInterval spread_of(const JudgedPoints& points, const LuminaireFactors& factors) {
  SpreadInterval out;
  out.grid = out.all = spread_of(points.grid, factors);
  for (const LitPoint& point : points.between) take(point, factors, out.all);
  return out;
}

bool is_one_value(double on_grid, double of_all) {
  constexpr double one_value_share = 0.01;
  return std::abs(of_all - on_grid) <= one_value_share * std::abs(on_grid);
}

Check judged_between(const Rule& rule, const Subject& subject, const SpreadInterval& spread,
                     double (*number_of)(const Spread&), std::optional<Limit> limit) {
  const auto check_of = [&](const Spread& one) {
    return limit ? judged(rule, subject, number_of(one), *limit, one.darkest)
                 : judged(rule, subject, number_of(one), one.darkest);
  };
  Check grid = check_of(spread.grid);
  const double on_grid = number_of(spread.grid), worse = number_of(spread.all);
  // Infinite on the grid: nothing is worse.
  if (worse == on_grid || !std::isfinite(on_grid)) return grid;
  Check all = check_of(spread.all);
  if (is_one_value(on_grid, worse) && all.verdict == grid.verdict && all.reasons == grid.reasons)
    return grid;
  all.reasons.push_back(remark(RemarkId::value_on_grid, on_grid));
  return all;
}

}  // namespace luxodus
