// The visible share of a black body's light, by the series of Planck's integral. Pure; any thread.
#pragma once

#include <cmath>
#include <numbers>

namespace luxodus::test {

/// Share of a black body's total radiant power in [380, 780] nm.
inline double visible_share_of_black_body(double kelvin) {
  constexpr double c2_nm_k = 1.438776877e7;
  // Share of the power at wavelengths below c2 / (x kelvin).
  const auto tail = [](double x) {
    double total = 0;
    for (int n = 1; n < 400; ++n)
      total += std::exp(-n * x) * (x * x * x / n + 3 * x * x / (n * n) + 6 * x / (1.0 * n * n * n) +
                                   6 / (1.0 * n * n * n * n));
    return total * 15 / std::pow(std::numbers::pi, 4);
  };
  return tail(c2_nm_k / (780 * kelvin)) - tail(c2_nm_k / (380 * kelvin));
}

}  // namespace luxodus::test
