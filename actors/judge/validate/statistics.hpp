// Distributions for judging many estimates. Pure; any thread.
#pragma once

#include <vector>

namespace luxodus::light {

/// Probability that a standard normal number is at most z.
double normal_below(double z);
/// The z that a standard normal number exceeds with this probability. Requires: 0 < p < 1.
double normal_exceeded(double p);
/// The normal deviate with the same probability as Student's t with these degrees of freedom, to
/// 0.01 in the tails for 10 degrees and far better for 100 (D. L. Wallace, Annals of Mathematical
/// Statistics 30, 1959).
double normal_of_student(double t, double freedom);
/// Chi-square / freedom that is exceeded with probability p (E. B. Wilson, M. M. Hilferty, 1931).
double chi_square_exceeded(double p, double freedom);

struct Sample {
  double mean = 0;
  double variance = 0;     // about 0, the expected mean
  double distance = 0;     // Kolmogorov-Smirnov distance from the standard normal distribution
  double probability = 1;  // of a distance at least as large, if the numbers are standard normal
};
/// Statistics of numbers that should be standard normal. Requires: not empty.
Sample sample_of(std::vector<double> z);

/// Weighted least-squares slope of log y over log x; NaN for fewer than two points above zero.
double log_slope(const std::vector<double>& x, const std::vector<double>& y,
                 const std::vector<double>& weight);

}  // namespace luxodus::light
