#include "actors/judge/validate/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace luxodus::light {

double normal_below(double z) {
  return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

double normal_exceeded(double p) {
  // The library has no inverse of erfc; since it is monotonic, bisection finds it to the last
  // relevant bit.
  double low = -40, high = 40;
  for (int step = 0; step < 80; ++step) {
    const double middle = 0.5 * (low + high);
    (normal_below(-middle) > p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double normal_of_student(double t, double freedom) {
  const double size =
      (8 * freedom + 1) / (8 * freedom + 3) * std::sqrt(freedom * std::log1p(t * t / freedom));
  return std::copysign(size, t);
}

double chi_square_exceeded(double p, double freedom) {
  const double spread = 2 / (9 * freedom);
  return std::pow(1 - spread + normal_exceeded(p) * std::sqrt(spread), 3);
}

namespace {

/// Probability of a Kolmogorov-Smirnov distance of n numbers (M. A. Stephens, JRSS B 32, 1970).
double probability_of_distance(double distance, double n) {
  const double root = std::sqrt(n);
  const double x = (root + 0.12 + 0.11 / root) * distance;
  if (x < 0.2) return 1;  // the series is 1 to 1e-12 there, and converges slowly
  double sum = 0;
  for (int k = 1; k <= 100; ++k) sum += (k % 2 == 1 ? 2 : -2) * std::exp(-2.0 * k * k * x * x);
  return std::clamp(sum, 0.0, 1.0);
}

}  // namespace

Sample sample_of(std::vector<double> z) {
  std::sort(z.begin(), z.end());
  const auto n = static_cast<double>(z.size());
  Sample sample;
  for (size_t i = 0; i < z.size(); ++i) {
    sample.mean += z[i] / n;
    sample.variance += z[i] * z[i] / n;
    const double below = normal_below(z[i]);
    sample.distance = std::max({sample.distance, static_cast<double>(i + 1) / n - below,
                                below - static_cast<double>(i) / n});
  }
  sample.probability = probability_of_distance(sample.distance, n);
  return sample;
}

double log_slope(const std::vector<double>& x, const std::vector<double>& y,
                 const std::vector<double>& weight) {
  int points = 0;
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    if (!(x[i] > 0 && y[i] > 0)) continue;
    const double lx = std::log(x[i]), ly = std::log(y[i]), w = weight[i];
    ++points;
    n += w;
    sx += w * lx;
    sy += w * ly;
    sxx += w * lx * lx;
    sxy += w * lx * ly;
  }
  if (points < 2) return std::numeric_limits<double>::quiet_NaN();
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace luxodus::light
