#include "actors/judge/validate/agreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace luxodus::light {

namespace {

/// Distance from a limit at which a rule is answered, in standard errors.
constexpr double sure_errors = 2;

std::string allowed_text(const Interval& allowed) {
  if (allowed.low == -unlimited) return fmt::format("at most {:.3g}", allowed.high);
  if (allowed.high == unlimited) return fmt::format("at least {:.3g}", allowed.low);
  return fmt::format("{:.3g} to {:.3g}", allowed.low, allowed.high);
}

std::string value_text(const Uncertain& value) {
  return value.error > 0 ? fmt::format("{:.3g} ± {:.1g}", value.value, value.error)
                         : fmt::format("{:.3g}", value.value);
}

}  // namespace

const char* name_of(Agreement agreement) {
  switch (agreement) {
    case Agreement::kept:
      return "kept";
    case Agreement::failing:
      return "failing";
    case Agreement::not_answered:
      break;
  }
  return "not answered";
}

RuleResult within(const Uncertain& value, const Interval& allowed) {
  const double margin = sure_errors * value.error;
  RuleResult out;
  if (value.value - margin >= allowed.low && value.value + margin <= allowed.high)
    out.agreement = Agreement::kept;
  else if (value.value + margin < allowed.low || value.value - margin > allowed.high)
    out.agreement = Agreement::failing;
  out.reason = fmt::format("{}, allowed {}", value_text(value), allowed_text(allowed));
  return out;
}

double deviation(double value, const Interval& observed) {
  if (value > observed.high) return value - observed.high;
  return std::min(0.0, value - observed.low);
}

RuleResult seen_agrees(const Uncertain& seen, const Interval& observed) {
  return within(seen, {observed.low - limits::seen_within, observed.high + limits::seen_within});
}

RuleResult mean_seen_agrees(std::span<const double> deviations) {
  if (deviations.empty()) return {Agreement::not_answered, "no threshold of seeing was found"};
  double sum = 0;
  for (const double d : deviations) sum += d;
  return within({sum / static_cast<double>(deviations.size()), 0},
                {-limits::mean_seen_within, limits::mean_seen_within});
}

RuleResult read_agrees(const Uncertain& read, const Uncertain& seen, const Interval& observed) {
  RuleResult promise = within(read, {-unlimited, observed.low});
  promise.reason = "promised up to " + promise.reason;
  RuleResult denial = within(seen, {observed.high - limits::read_beyond, unlimited});
  denial.reason = "not denied up to " + denial.reason;
  const RuleResult parts[] = {promise, denial};
  return all_of(parts);
}

RuleResult is_beyond(const Uncertain& far, const Uncertain& near) {
  RuleResult out = within(minus(far, near), {0, unlimited});
  out.reason = "difference " + out.reason;
  return out;
}

RuleResult is_much_beyond(const Uncertain& far, const Uncertain& near) {
  RuleResult out = within(minus(far, near), {limits::about_equal, unlimited});
  out.reason = "difference " + out.reason;
  return out;
}

RuleResult is_about_equal(const Uncertain& a, const Uncertain& b) {
  RuleResult out = within(minus(a, b), {-limits::about_equal, limits::about_equal});
  out.reason = "difference " + out.reason;
  return out;
}

RuleResult acuity_agrees(const Uncertain& level) {
  RuleResult out = within(level, {limits::least_acuity_level, limits::most_acuity_level});
  out.reason = "level " + out.reason;
  return out;
}

Uncertain slope_of(std::span<const double> x, std::span<const Uncertain> y) {
  const auto n = static_cast<double>(x.size());
  double mean_x = 0;
  for (const double one : x) mean_x += one / n;
  double spread = 0, slope = 0, variance = 0;
  for (const double one : x) spread += (one - mean_x) * (one - mean_x);
  for (size_t i = 0; i < x.size(); ++i) {
    const double weight = (x[i] - mean_x) / spread;
    slope += weight * y[i].value;
    variance += weight * weight * y[i].error * y[i].error;
  }
  return {slope, std::sqrt(variance)};
}

Uncertain quotient(const Uncertain& a, const Uncertain& b) {
  const double value = a.value / b.value;
  return {value, std::hypot(a.error, value * b.error) / std::abs(b.value)};
}

RuleResult all_of(std::span<const RuleResult> parts) {
  RuleResult out{Agreement::kept, ""};
  for (const RuleResult& part : parts) {
    if (part.agreement == Agreement::failing) out.agreement = Agreement::failing;
    if (part.agreement == Agreement::not_answered && out.agreement == Agreement::kept)
      out.agreement = Agreement::not_answered;
  }
  for (const RuleResult& part : parts) {
    if (part.agreement != out.agreement) continue;
    if (!out.reason.empty()) out.reason += "; ";
    out.reason += part.reason;
  }
  return out;
}

}  // namespace luxodus::light
