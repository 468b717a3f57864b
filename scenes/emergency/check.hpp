// The result of one rule applied to one subject: value, limit, worst place and verdict. No function
// here says that a building complies with a code; the verdict on the whole only counts checks that
// pass, that fail and that could not be made. Plain values and pure functions; any thread.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scenes/emergency/remark.hpp"

namespace luxodus {

/// not_verified: the value was compared with a limit that is known from memory alone, so the check
/// neither passes nor fails.
enum class CheckVerdict { pass, fail, not_assessed, information, not_verified };
const char* name_of(CheckVerdict verdict);

/// A rule of a code.
struct Rule {
  std::string set;        // "en1838-2024"; "" for a rule that belongs to no code
  std::string deviation;  // "de-asr-a3.4-3"; "" if the rule belongs to the set itself
  std::string id;         // our own id: "E1"
  std::string edition;    // "EN 1838:2013"
  std::string clause;     // "4.2.1"; "" if the clause is not known
  Remarks sources;        // documents that quote it: the codes themselves were not at hand
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

/// A check that compares a value with a limit; not verified if the limit is known from memory
/// alone.
Check judged(Rule rule, Subject subject, double value, double limit, bool at_least,
             std::string unit, std::optional<glm::dvec3> worst = std::nullopt);
Check not_assessed(Rule rule, Subject subject, Remark reason);

/// Number of checks with each verdict, indexed by CheckVerdict.
using CheckCounts = std::array<size_t, 5>;
CheckCounts counts_of(const std::vector<Check>& checks);
size_t count_of(const CheckCounts& counts, CheckVerdict verdict);
/// "3 checks fail, 2 not assessed", "no check made fails, 2 not assessed, 1 not verified". Never
/// says that the building passes.
std::string words_of(const CheckCounts& counts);

}  // namespace luxodus
