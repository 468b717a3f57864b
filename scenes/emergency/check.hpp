// The result of one rule applied to one subject: value, limit, worst place and verdict. No function
// here says that a building complies with a code; the verdict on the whole only counts checks that
// pass, that fail and that could not be made. Plain values and pure functions; any thread.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/emergency/remark.hpp"

namespace luxodus {

/// not_verified: the value was compared with a limit that is known from memory alone, so the check
/// neither passes nor fails.
enum class CheckVerdict { pass, fail, not_assessed, information, not_verified };
inline constexpr size_t check_verdicts = static_cast<size_t>(CheckVerdict::not_verified) + 1;
const char* name_of(CheckVerdict verdict);

/// The rules that this program knows, by ids of ours. What each asks, and where it is quoted from:
/// rule_table.hpp.
enum class RuleId {
  none,  // what is of no rule
  E1,
  E2,
  E4,
  E5,
  E6,
  E6d,
  E7,
  E7u,
  E8,
  E9,
  E10,
  E10h,
  E10f,
  E10t,
  E11,
  E11n,
  E11u,
  E10g,
  E6k,
  E12,
  E12s,
  E13,
  E14,
  S1,
  S2,
  S3,
  S4,
  S5,
  S6,
  S6l,
  S6a,
  S8,
  S8c,
  N1,
  N1m,
  N2,
  N2m,
  N3,
  I1,
  I1m,
  I2,
  I2m,
  N4,
  N5,
  N6,
  N7,
  N7s,
  N8,
  N10,
  F1,
  count  // of the ids before
};
/// "E1"; "" of none.
std::string_view name_of(RuleId id);
/// None where no rule has this name.
std::optional<RuleId> rule_named(std::string_view name);

/// A rule of a code.
struct Rule {
  std::string set;        // "en1838-2024"; "" for what is of no code
  std::string deviation;  // "de-asr-a3.4-3"; "" where the set itself has it
  RuleId id = RuleId::none;
  std::string edition;  // "EN 1838:2013"
  std::string clause;   // "4.2.1"; "" if the clause is not known
  Remarks sources;      // documents that quote it: the codes themselves were not at hand
  std::optional<Remark> status;

  /// Whether the limit was found in no source.
  bool recollected() const;
  /// Whether the set of 2024 takes this rule over from that of 2013, whose clause it then names.
  bool carried_over() const { return status && status->id == RemarkId::carried_over; }
};

struct Check {
  Rule rule;
  Subject subject;
  Remarks conditions;  // under which the check holds
  std::optional<double> value, limit;
  bool at_least = true;  // the value shall not be below its limit; false: not above it
  std::string unit;
  std::optional<glm::dvec3> worst;  // place of the worst value [m]
  CheckVerdict verdict = CheckVerdict::not_assessed;
  Remarks reasons;

  /// Distance of the value from its limit as a share of the limit; negative if the check fails.
  std::optional<double> margin() const;
};

/// What a value is held against: it shall not be below it, or not above.
struct Limit {
  double value = 0;
  bool at_least = true;
};

/// Judged by a limit; not verified where that is known from memory alone. The unit is the rule's.
Check judged(Rule rule, Subject subject, double value, Limit limit,
             std::optional<glm::dvec3> worst = std::nullopt);
/// Judged by the limit that the rule states. Requires: it states one (a programmer's mistake
/// throws).
Check judged(Rule rule, Subject subject, double value,
             std::optional<glm::dvec3> worst = std::nullopt);
Check not_assessed(Rule rule, Subject subject, Remark reason);

/// Number of checks with each verdict, indexed by CheckVerdict.
using CheckCounts = std::array<size_t, check_verdicts>;
CheckCounts counts_of(const std::vector<Check>& checks);
size_t count_of(const CheckCounts& counts, CheckVerdict verdict);
/// "3 checks fail, 2 not assessed", "no check made fails, 2 not assessed, 1 not verified". Never
/// says that the building passes.
std::string words_of(const CheckCounts& counts);

}  // namespace luxodus
