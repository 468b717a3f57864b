// Least squares by normal equations, which are small and positive here; a negative cost is set to
// zero.
#include <algorithm>
#include <cmath>

#include "actors/lab/study/calibrate.hpp"

namespace luxodus {

namespace {

constexpr int rounds = 3;

/// Solves a x = b by elimination with pivots; undetermined unknowns are 0.
std::vector<double> solved(std::vector<std::vector<double>> a, std::vector<double> b) {
  const size_t n = b.size();
  std::vector<double> x(n, 0);
  std::vector<size_t> order;
  for (size_t column = 0; column < n; ++column) {
    size_t pivot = order.size();
    for (size_t row = pivot; row < n; ++row)
      if (std::abs(a[row][column]) > std::abs(a[pivot][column])) pivot = row;
    if (pivot >= n || std::abs(a[pivot][column]) < 1e-12) continue;
    std::swap(a[pivot], a[order.size()]);
    std::swap(b[pivot], b[order.size()]);
    const size_t at = order.size();
    for (size_t row = 0; row < n; ++row) {
      if (row == at) continue;
      const double factor = a[row][column] / a[at][column];
      for (size_t i = column; i < n; ++i) a[row][i] -= factor * a[at][i];
      b[row] -= factor * b[at];
    }
    order.push_back(column);
  }
  for (size_t row = 0; row < order.size(); ++row) x[order[row]] = b[row] / a[row][order[row]];
  return x;
}

double product(const std::vector<double>& row, const std::vector<double>& x) {
  double sum = 0;
  for (size_t i = 0; i < x.size(); ++i) sum += row[i] * x[i];
  return sum;
}

/// Rows are weighted by their relative errors, not by their duration.
std::vector<double> fit(const std::vector<std::vector<double>>& rows,
                        const std::vector<double>& values, const std::vector<bool>& taken,
                        const std::vector<bool>& free) {
  const size_t n = free.size();
  std::vector<std::vector<double>> a(n, std::vector<double>(n, 0));
  std::vector<double> b(n, 0);
  for (size_t r = 0; r < rows.size(); ++r) {
    if (!taken[r] || values[r] <= 0) continue;
    const double weight = 1 / (values[r] * values[r]);
    for (size_t i = 0; i < n; ++i) {
      if (!free[i]) continue;
      b[i] += weight * rows[r][i] * values[r];
      for (size_t j = 0; j < n; ++j)
        if (free[j]) a[i][j] += weight * rows[r][i] * rows[r][j];
    }
  }
  return solved(std::move(a), std::move(b));
}

}  // namespace

std::vector<double> fitted_costs(const std::vector<std::vector<double>>& rows,
                                 const std::vector<double>& values, double disturbed) {
  if (rows.empty()) return {};
  std::vector<bool> taken(rows.size(), true);
  std::vector<double> x;
  for (int round = 0; round < rounds; ++round) {
    std::vector<bool> free(rows.front().size(), true);
    for (;;) {
      x = fit(rows, values, taken, free);
      const auto least = std::min_element(x.begin(), x.end());
      if (*least >= 0) break;
      free[static_cast<size_t>(least - x.begin())] = false;
    }
    for (size_t r = 0; r < rows.size(); ++r)
      taken[r] = values[r] <= disturbed * product(rows[r], x);
  }
  double said = 0, fitted = 0;
  for (size_t r = 0; r < rows.size(); ++r) {
    if (!taken[r]) continue;
    said += values[r];
    fitted += product(rows[r], x);
  }
  for (double& cost : x) cost *= fitted > 0 ? said / fitted : 1;
  return x;
}

}  // namespace luxodus
