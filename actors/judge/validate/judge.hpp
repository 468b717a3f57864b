// Pass or fail, by a rule that was written down before any run: README.md of this folder has it in
// full, rule_text() gives it for every page. Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/validate/statistics.hpp"
#include "actors/judge/validate/suite.hpp"

namespace luxodus::light {

namespace rule {
/// Probability that a correct program fails each of the four tests below.
inline constexpr double false_alarm = 1e-3;
/// A quantity is judged only if at least this many particles, each with its unit, would make its
/// reference: with fewer the distribution is not normal.
inline constexpr double min_count = 1000;
/// Declared biases below this share of the standard error do not affect the distribution of z.
inline constexpr double unbiased = 0.1;
/// A case that knows none of its quantities better than this is no test.
inline constexpr double min_known = 0.05;
/// Fewer independent z are too few for a distribution.
inline constexpr size_t min_leads = 20;
}  // namespace rule

enum class Judgement {
  passed,
  failed,
  rare,  // too few particles to be judged
};

struct QuantityVerdict {
  Judgement judgement = Judgement::passed;
  double z = 0;       // NaN without a statistical error
  bool lead = false;  // the case's representative in the distribution of z
};

/// One of the tests over all cases.
struct OverallTest {
  std::string name;
  std::string found;
  std::string allowed;
  bool passed = true;
};

struct Verdict {
  std::vector<std::vector<QuantityVerdict>> judged;  // by case and finding
  double max_z = 0;                                  // limit for one quantity
  size_t statistical = 0, computed = 0, rare = 0, failed = 0;
  double z_largest = 0;
  std::string z_largest_of;  // case and quantity
  std::vector<double> z;     // of all quantities without a bias that matters
  Sample all, leads;
  size_t lead_count = 0;
  std::vector<OverallTest> checks;
  bool passed = true;
};

Verdict judge(const std::vector<CaseResult>& results);

/// The rule in sentences, one for each test.
std::vector<std::string> rule_text();

}  // namespace luxodus::light
