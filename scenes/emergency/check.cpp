#include "scenes/emergency/check.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/emergency/rule_table.hpp"

namespace luxodus {

const char* name_of(CheckVerdict verdict) {
  switch (verdict) {
    case CheckVerdict::pass:
      return "pass";
    case CheckVerdict::fail:
      return "fail";
    case CheckVerdict::not_assessed:
      return "not assessed";
    case CheckVerdict::information:
      return "information";
    case CheckVerdict::not_verified:
      return "not verified";
  }
  return "";
}

bool Rule::recollected() const {
  return std::any_of(sources.begin(), sources.end(),
                     [](const Remark& r) { return r.id == RemarkId::source_recollection; });
}

std::optional<double> Check::margin() const {
  if (!value || !limit || *limit == 0) return std::nullopt;
  return (at_least ? *value - *limit : *limit - *value) / std::abs(*limit);
}

Check judged(Rule rule, Subject subject, double value, std::optional<glm::dvec3> worst) {
  const RuleRow& row = row_of(rule.id);
  const Limit limit{row.limit.value(), row.at_least};
  return judged(std::move(rule), std::move(subject), value, limit, worst);
}

Check judged(Rule rule, Subject subject, double value, Limit limit,
             std::optional<glm::dvec3> worst) {
  Check check;
  check.unit = row_of(rule.id).unit;
  check.rule = std::move(rule);
  check.subject = std::move(subject);
  check.value = value;
  check.limit = limit.value;
  check.at_least = limit.at_least;
  check.worst = worst;
  if (std::isinf(value)) check.reasons = {remark(RemarkId::beyond_measure)};
  if (std::isnan(value)) {
    check.reasons = {remark(RemarkId::no_value)};
    return check;
  }
  // A value that is its limit to rounding is the limit: 500.00000000000006 of 500 cd is no excess.
  constexpr double rounding = 1e-9;
  if (std::abs(value - limit.value) <= rounding * std::abs(limit.value))
    check.value = value = limit.value;
  const bool holds = limit.at_least ? value >= limit.value : value <= limit.value;
  check.verdict = holds ? CheckVerdict::pass : CheckVerdict::fail;
  if (check.rule.recollected()) {
    check.verdict = CheckVerdict::not_verified;
    check.reasons.push_back(
        remark(holds ? RemarkId::keeps_unread_limit : RemarkId::breaks_unread_limit));
  }
  return check;
}

Check not_assessed(Rule rule, Subject subject, Remark reason) {
  Check check;
  check.rule = std::move(rule);
  check.subject = std::move(subject);
  check.reasons = {std::move(reason)};
  return check;
}

CheckCounts counts_of(const std::vector<Check>& checks) {
  CheckCounts counts{};
  for (const Check& check : checks) ++counts[static_cast<size_t>(check.verdict)];
  return counts;
}

size_t count_of(const CheckCounts& counts, CheckVerdict verdict) {
  return counts[static_cast<size_t>(verdict)];
}

std::string words_of(const CheckCounts& counts) {
  const size_t fail = count_of(counts, CheckVerdict::fail);
  const size_t unverified = count_of(counts, CheckVerdict::not_verified);
  const size_t made = fail + unverified + count_of(counts, CheckVerdict::pass);
  std::string out = made == 0   ? "no check could be made"
                    : fail == 0 ? "no check made fails"
                    : fail == 1 ? "1 check fails"
                                : std::to_string(fail) + " checks fail";
  out += ", " + std::to_string(count_of(counts, CheckVerdict::not_assessed)) + " not assessed";
  if (unverified > 0) out += ", " + std::to_string(unverified) + " not verified";
  return out;
}

}  // namespace luxodus
