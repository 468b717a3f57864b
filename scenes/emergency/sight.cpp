#include "scenes/emergency/sight.hpp"

#include <algorithm>
#include <cmath>

namespace luxodus {

namespace {

/// Adrian's k for detection in 99.9 % of cases, and the time from which time no longer counts [s].
constexpr double detection = 2.6, long_enough_s = 2;
/// Smallest background of the law [cd/m2]: far below the dimmest background of its data, and above
/// zero, since the law takes its logarithm.
constexpr double darkness = 1e-6;

double squared(double x) {
  return x * x;
}

/// Terms of the law by Ricco (complete spatial summation) and by Weber.
struct Summation {
  double flux;       // square root of the luminous flux function
  double luminance;  // square root of the luminance function
};

Summation summation(double background) {
  const double lg = std::log10(background);
  if (background >= 0.6)
    return {
        std::log10(4.1925 * std::pow(background, 0.1556)) + 0.1684 * std::pow(background, 0.5867),
        0.05946 * std::pow(background, 0.466)};
  if (background > 0.00418)
    return {std::pow(10, -0.072 + 0.3372 * lg + 0.0866 * lg * lg),
            std::pow(10, -1.256 + 0.319 * lg)};
  return {std::pow(10, 0.028 + 0.173 * lg), std::pow(10, -0.891 + 0.5275 * lg + 0.0227 * lg * lg)};
}

/// Targets that are darker than their background have a lower threshold.
double polarity_factor(double background, double size_arcmin, double brighter_threshold) {
  if (background <= 0.004) return 1;
  const double f = background >= 0.1 ? 0.125 : 0.075;
  const double lg = std::log10(background);
  const double m = std::pow(10, -std::pow(10, -(f * squared(lg + 1) + 0.0245)));
  const double beta = 0.6 * std::pow(background, -0.1488);
  return std::max(0.0, 1 - m * std::pow(size_arcmin, -beta) / (2.4 * brighter_threshold));
}

double time_factor(double background, double size_arcmin, double exposure_s) {
  if (exposure_s >= long_enough_s) return 1;
  const double u = std::log10(std::min(size_arcmin, 60.0)) + 0.523;
  const double w = std::log10(background) + 6;
  const double of_size = 0.36 - 0.0972 * u * u / (u * u - 2.513 * u + 2.7895);
  const double of_light = 0.355 - 0.1217 * w * w / (w * w - 10.4 * w + 52.28);
  const double a = std::hypot(of_size, of_light) / 2.1;
  return (a + exposure_s) / exposure_s;
}

}  // namespace

double age_factor(double age_years) {
  if (age_years <= 64) return squared(age_years - 19) / 2160 + 0.99;
  return squared(age_years - 56.6) / 116.3 + 1.43;
}

double luminance_threshold(double background_cd_m2, double size_arcmin, bool darker,
                           const Eye& eye) {
  const double background = std::max(background_cd_m2 + eye.bleached_cd_m2, darkness);
  const Summation s = summation(background);
  const double brighter = detection * squared(s.flux / size_arcmin + s.luminance);
  return brighter * (darker ? polarity_factor(background, size_arcmin, brighter) : 1) *
         time_factor(background, size_arcmin, eye.exposure_s) * age_factor(eye.age_years);
}

double visibility_level(double target_cd_m2, double background_cd_m2, double size_arcmin,
                        const Eye& eye) {
  const double difference = target_cd_m2 - background_cd_m2;
  return std::abs(difference) /
         luminance_threshold(background_cd_m2, size_arcmin, difference < 0, eye);
}

}  // namespace luxodus
