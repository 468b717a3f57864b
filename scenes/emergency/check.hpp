// One rule applied to one thing: what it asks, what was found, where it is worst. Whoever assesses
// never says that a building complies: so many checks pass, fail, or cannot be made. Plain values;
// any thread.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scenes/emergency/remark.hpp"

namespace luxodus {

/// not_verified: a value was found, but the limit that it was held against is known from memory
/// alone, so that it can neither pass nor fail.
enum class CheckVerdict { pass, fail, not_assessed, information, not_verified };
const char* name_of(CheckVerdict verdict);

/// A rule of a code.
struct Rule {
  std::string set;               // "en1838-2024"; "" for what is of no code
  std::string deviation;         // "de-asr-a3.4-3"; "" where the set itself has it
  std::string id;                // of ours: "E1"
  std::string edition;           // "EN 1838:2013"
  std::string clause;            // "4.2.1"; "" where it is not known
  Remarks sources;               // what it is quoted from: the codes themselves are not at hand
  std::optional<Remark> status;  // where there is something to say

  /// Whether its limit was read nowhere.
  bool recollected() const;
  /// Whether the set of 2024 has it from that of 2013, whose clause it names.
  bool carried_over() const { return status && status->id == RemarkId::carried_over; }
};

struct Check {
  Rule rule;
  Subject subject;
  Remarks conditions;  // under which it holds
  std::optional<double> value, limit;
  bool at_least = true;  // the value shall not be below its limit; else not above
  std::string unit;
  std::optional<glm::dvec3> worst;  // where [m]
  CheckVerdict verdict = CheckVerdict::not_assessed;
  Remarks reasons;

  /// How far the value is on the right side of its limit, as a share of it; negative on the wrong.
  std::optional<double> margin() const;
};

/// Judged by its limit; not verified where that is known from memory alone.
Check judged(Rule rule, Subject subject, double value, double limit, bool at_least,
             std::string unit, std::optional<glm::dvec3> worst = std::nullopt);
Check not_assessed(Rule rule, Subject subject, Remark reason);

/// How many of each verdict, by CheckVerdict.
using CheckCounts = std::array<size_t, 5>;
CheckCounts counts_of(const std::vector<Check>& checks);
size_t count_of(const CheckCounts& counts, CheckVerdict verdict);
/// "3 checks fail, 2 not assessed", "no check made fails, 2 not assessed, 1 not verified": what
/// passes is no verdict on the whole.
std::string words_of(const CheckCounts& counts);

}  // namespace luxodus
