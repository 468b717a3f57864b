// Helpers of the sampler tests: seeded uniform numbers as in the tracer, means with standard
// errors, and chi-square against expected shares. Tests only; each object belongs to one thread.
#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "scenes/light/optics/sampling.hpp"

namespace luxodus::checks {

/// The fixed seed of a test, or LUXODUS_SEED if it is set.
inline uint32_t seed_or(uint32_t fixed) {
  const char* text = std::getenv("LUXODUS_SEED");
  return text != nullptr ? static_cast<uint32_t>(std::strtoul(text, nullptr, 10)) : fixed;
}

class Uniform {
 public:
  explicit Uniform(uint32_t seed) : engine_(seed) {}
  float operator()() { return static_cast<float>(engine_() >> 8) * 0x1p-24F; }

 private:
  std::mt19937 engine_;
};

/// Accumulates a mean and its standard error.
class Mean {
 public:
  void add(double x) {
    ++count_;
    const double step = x - mean_;
    mean_ += step / count_;
    squares_ += step * (x - mean_);
  }
  double value() const { return mean_; }
  double standard_error() const { return std::sqrt(squares_ / (count_ - 1) / count_); }
  /// Distance from the closed form in standard errors.
  double distance(double expected) const {
    return std::fabs(mean_ - expected) / std::max(standard_error(), 1e-300);
  }

 private:
  double count_ = 0;
  double mean_ = 0;
  double squares_ = 0;
};

/// (chi^2 - degrees) / sqrt(2 degrees): about standard normal if the counts have these shares. Bins
/// that expect fewer than 5 are merged.
inline double chi_square_deviations(const std::vector<double>& counts,
                                    const std::vector<double>& shares) {
  double total = 0;
  for (const double c : counts) total += c;
  double chi = 0, bins = 0, rest_count = 0, rest_expected = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double expected = shares[i] * total;
    if (expected < 5) {
      rest_count += counts[i];
      rest_expected += expected;
      continue;
    }
    chi += (counts[i] - expected) * (counts[i] - expected) / expected;
    ++bins;
  }
  if (rest_expected >= 5) {
    chi += (rest_count - rest_expected) * (rest_count - rest_expected) / rest_expected;
    ++bins;
  } else if (rest_count > rest_expected + 20) {
    return 1e9;  // counts in bins that expect none
  }
  const double degrees = bins - 1;
  return (chi - degrees) / std::sqrt(2 * degrees);
}

/// Counts of values that should be uniform in [0, 1]; rounding may put a few outside.
class Histogram {
 public:
  explicit Histogram(int bins) : counts_(static_cast<std::size_t>(bins), 0.0) {}
  void add(double x) {
    const double last = static_cast<double>(counts_.size()) - 1;
    const double bin = std::floor(x * static_cast<double>(counts_.size()));
    ++counts_[static_cast<std::size_t>(std::clamp(bin, 0.0, last))];
  }
  double deviations() const {
    const std::vector<double> shares(counts_.size(), 1.0 / static_cast<double>(counts_.size()));
    return chi_square_deviations(counts_, shares);
  }

 private:
  std::vector<double> counts_;
};

inline double turn_share(double x, double y) {
  const double turn = std::atan2(y, x) / (2 * std::numbers::pi);
  return turn < 0 ? turn + 1 : turn;
}

inline double length_error(const glm::vec3& d) {
  return std::fabs(glm::length(glm::dvec3(d)) - 1.0);
}

/// Allowed deviation in standard errors: with fixed seeds a failure means a change, not chance.
inline constexpr double allowed = 4.0;

}  // namespace luxodus::checks
