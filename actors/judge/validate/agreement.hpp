// How thresholds of the program are held against those of people. The rules were fixed before the
// experiments were run, from the scatter between people and between papers. A rule is kept or
// failing only if its value lies two standard errors within or beyond its limit. Pure functions;
// any thread.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "scenes/emergency/uncertain.hpp"

namespace luxodus::light {

namespace limits {
/// Distance of the program's threshold of seeing from the observed one, in optical depth: a factor
/// of 2 in luminance, which is about the scatter between people.
inline constexpr double seen_within = 0.7;
/// The same for the mean over all thresholds of seeing.
inline constexpr double mean_seen_within = 0.4;
/// How far beyond the threshold of the detail people may read, in optical depth.
inline constexpr double read_beyond = 0.5;
/// Thresholds that are called about equal differ by less, in optical depth.
inline constexpr double about_equal = 0.7;
/// Reading that is promised less than this before people stop reading is listed.
inline constexpr double thin_margin = 0.7;
/// Visibility level of a detail at the limit of acuity: a factor of 2 about the threshold.
inline constexpr double least_acuity_level = 0.5, most_acuity_level = 2;
}  // namespace limits

/// An end of an interval that is no limit.
inline constexpr double unlimited = std::numeric_limits<double>::infinity();

/// Both ends included.
struct Interval {
  double low = 0, high = 0;

  double middle() const { return (low + high) / 2; }
};

enum class Agreement { kept, failing, not_answered };
const char* name_of(Agreement agreement);

/// What a rule says, and why.
struct RuleResult {
  Agreement agreement = Agreement::not_answered;
  std::string reason;
};

/// The value lies in the interval.
RuleResult within(const Uncertain& value, const Interval& allowed);

/// Rule S: the optical depth at which a target is just seen is the observed one, or lies in the
/// observed interval, within limits::seen_within.
RuleResult seen_agrees(const Uncertain& seen, const Interval& observed);
/// Difference from the observed value: of an interval, from its nearer end; 0 within it.
double deviation(double value, const Interval& observed);
/// The mean difference of all thresholds of seeing from the observed ones.
RuleResult mean_seen_agrees(std::span<const double> deviations);

/// Rule R: nothing is promised that people did not read, and nothing denied that they read. `read`
/// and `seen`: optical depths at levels 7 and 1 of the smallest detail. Of an observed interval the
/// lower end counts for the promise, the upper end for the denial.
RuleResult read_agrees(const Uncertain& read, const Uncertain& seen, const Interval& observed);

/// Rule O: one threshold lies beyond another.
RuleResult is_beyond(const Uncertain& far, const Uncertain& near);
/// Rule O: one threshold lies so far beyond another that they are not about equal.
RuleResult is_much_beyond(const Uncertain& far, const Uncertain& near);
/// Rule O: two thresholds are about equal.
RuleResult is_about_equal(const Uncertain& a, const Uncertain& b);

/// Rule A: the level of a detail at the limit of acuity.
RuleResult acuity_agrees(const Uncertain& level);

/// Slope of the least-squares line through points whose y have errors. Requires: two different x.
Uncertain slope_of(std::span<const double> x, std::span<const Uncertain> y);
/// Quotient of independent values. Requires: the divisor is not 0.
Uncertain quotient(const Uncertain& a, const Uncertain& b);

/// "failing" if any part fails, else "not answered" if any part is not, else "kept"; the reasons of
/// the parts that decide it.
RuleResult all_of(std::span<const RuleResult> parts);

}  // namespace luxodus::light
