#include "actors/judge/validate/judge.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace luxodus::light {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Whether too few particles contribute to the quantity, or, if no error was observed, to the
/// difference from the unit: a run may meet none of the few that are not absorbed, and then has no
/// error bar.
bool is_rare(const QuantityResult& f, int64_t particles) {
  const auto few = [&](double value) {
    return value > 0 && value * static_cast<double>(particles) < rule::min_count * f.unit;
  };
  return few(std::abs(f.reference)) ||
         (f.estimate.standard_error == 0 && few(f.unit - std::abs(f.reference)));
}

/// Whether it has a statistical error: an estimate that is equal in every batch has no error bar,
/// and is judged like a computed one.
bool by_chance(const QuantityResult& f) {
  return f.statistical && f.estimate.standard_error > 0;
}

double z_of(const QuantityResult& f, int64_t batches) {
  const double t = (f.estimate.value - f.reference) / f.estimate.standard_error;
  return normal_of_student(t, static_cast<double>(batches - 1));
}

/// The deviation beyond the declared bias, as a normal deviate.
double excess_z(const QuantityResult& f, int64_t batches) {
  const double excess = std::abs(f.estimate.value - f.reference) - f.bias;
  return normal_of_student(excess / f.estimate.standard_error, static_cast<double>(batches - 1));
}

bool unbiased(const QuantityResult& f) {
  return f.bias <= rule::unbiased * f.estimate.standard_error;
}

/// The first of the largest references among a case's statistical quantities.
size_t lead_of(const CaseResult& result) {
  size_t lead = result.findings.size();
  double largest = 0;
  for (size_t i = 0; i < result.findings.size(); ++i) {
    const QuantityResult& f = result.findings[i];
    const double share = f.unit > 0 ? std::abs(f.reference) / f.unit : 0;
    if (!by_chance(f) || !unbiased(f) || is_rare(f, result.particles) || share <= largest) continue;
    largest = share;
    lead = i;
  }
  return lead;
}

void judge_findings(const CaseResult& result, double max_z, Verdict& verdict) {
  std::vector<QuantityVerdict>& judged = verdict.judged.emplace_back();
  for (const QuantityResult& f : result.findings) {
    QuantityVerdict j{Judgement::passed, nan, false};
    if (f.statistical && is_rare(f, result.particles)) {
      j.judgement = Judgement::rare;
      ++verdict.rare;
    } else if (by_chance(f)) {
      j.z = z_of(f, result.batches);
      // Written so that NaN fails.
      if (!(excess_z(f, result.batches) <= max_z)) j.judgement = Judgement::failed;
      if (unbiased(f)) verdict.z.push_back(j.z);
      if (std::abs(j.z) > std::abs(verdict.z_largest) && unbiased(f)) {
        verdict.z_largest = j.z;
        verdict.z_largest_of = result.name + ": " + f.quantity;
      }
      ++verdict.statistical;
    } else {
      if (!(std::abs(f.estimate.value - f.reference) <= f.bias)) j.judgement = Judgement::failed;
      ++verdict.computed;
    }
    if (j.judgement == Judgement::failed) ++verdict.failed;
    judged.push_back(j);
  }
}

/// Whether a traced case knows one of its quantities well enough to be a test.
bool known(const CaseResult& result) {
  bool chance = false;
  for (const QuantityResult& f : result.findings) {
    if (!by_chance(f)) continue;
    chance = true;
    if (f.estimate.standard_error <= rule::min_known * std::abs(f.reference)) return true;
  }
  return !chance;
}

void check_distribution(const std::vector<double>& leads, Verdict& verdict) {
  verdict.lead_count = leads.size();
  if (!verdict.z.empty()) verdict.all = sample_of(verdict.z);
  if (!leads.empty()) verdict.leads = sample_of(leads);
  if (leads.size() < rule::min_leads) return;
  const auto n = static_cast<double>(leads.size());
  const double max_mean = normal_exceeded(rule::false_alarm / 2) / std::sqrt(n);
  const double low = chi_square_exceeded(1 - rule::false_alarm / 2, n);
  const double high = chi_square_exceeded(rule::false_alarm / 2, n);
  const Sample& s = verdict.leads;
  verdict.checks.push_back({"mean of z", fmt::format("{:+.3f}", s.mean),
                            fmt::format("within {:.3f}", max_mean), std::abs(s.mean) <= max_mean});
  verdict.checks.push_back({"variance of z", fmt::format("{:.3f}", s.variance),
                            fmt::format("{:.3f} to {:.3f}", low, high),
                            s.variance >= low && s.variance <= high});
  verdict.checks.push_back({"Kolmogorov and Smirnov's test of z",
                            fmt::format("distance {:.3f}, p {:.3g}", s.distance, s.probability),
                            fmt::format("p at least {}", rule::false_alarm),
                            s.probability >= rule::false_alarm});
}

}  // namespace

Verdict judge(const std::vector<CaseResult>& results) {
  Verdict verdict;
  size_t quantities = 0, unknown = 0;
  for (const CaseResult& r : results) {
    for (const QuantityResult& f : r.findings) quantities += f.statistical ? 1 : 0;
    unknown += known(r) ? 0 : 1;
  }
  // Bonferroni: whatever the correlation of a case's quantities, all of them pass with 1 - alarm.
  const double each = rule::false_alarm / static_cast<double>(std::max<size_t>(1, quantities));
  verdict.max_z = normal_exceeded(each / 2);
  std::vector<double> leads;
  for (const CaseResult& r : results) {
    judge_findings(r, verdict.max_z, verdict);
    const size_t lead = lead_of(r);
    if (lead == r.findings.size()) continue;
    verdict.judged.back()[lead].lead = true;
    leads.push_back(verdict.judged.back()[lead].z);
  }
  verdict.checks.push_back({"quantities out of bounds", std::to_string(verdict.failed),
                            fmt::format("none; |z| at most {:.2f}", verdict.max_z),
                            verdict.failed == 0});
  verdict.checks.push_back(
      {"cases that know nothing to 5 %", std::to_string(unknown), "none", unknown == 0});
  check_distribution(leads, verdict);
  for (const OverallTest& c : verdict.checks) verdict.passed = verdict.passed && c.passed;
  return verdict;
}

std::vector<std::string> rule_text() {
  return {
      "z is the normal deviate that is as probable as (estimate - reference) / standard error, "
      "which follows Student's t of so many batches less one.",
      fmt::format(
          "Each estimate differs from its reference by no more than its declared bias and z_max "
          "standard errors; z_max is such that a right program fails with probability {} "
          "(Bonferroni over all statistical quantities).",
          rule::false_alarm),
      "What is computed without chance differs by no more than its stated tolerance; the ledger "
      "closes in integers, no history is endless, closed rooms lose nothing.",
      fmt::format("Quantities that fewer than {} particles would bring are told, not judged.",
                  rule::min_count),
      fmt::format("Each case knows one of its quantities to {:g} %, so that none passes by being "
                  "noisy.",
                  100 * rule::min_known),
      fmt::format(
          "Of each case the quantity with the largest reference (of those whose declared bias is "
          "below {} standard errors) stands for it, for quantities of a case are correlated and "
          "cases are not. Over these the mean and the variance of z and Kolmogorov and Smirnov's "
          "test are within what a right program exceeds with probability {} each; fewer than {} "
          "are not judged.",
          rule::unbiased, rule::false_alarm, rule::min_leads)};
}

}  // namespace luxodus::light
