// One rule applied to one thing: what it asks, what was found, where it is worst. Whoever assesses
// never says that a building complies: so many checks pass, fail, or cannot be made. Plain values;
// any thread.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

namespace luxodus {

enum class CheckVerdict { pass, fail, not_assessed, information };
const char* name_of(CheckVerdict verdict);

/// A rule of a code.
struct Rule {
  std::string id;       // of ours: "E1"
  std::string edition;  // "EN 1838:2013"
  std::string clause;   // "4.2.1"; "" where it is not known
  std::string title;
  std::string source;  // what it is quoted from: the codes themselves are not at hand
};

struct Check {
  Rule rule;
  std::string subject;    // route "corridor"
  std::string condition;  // "without furniture"
  std::optional<double> value, limit;
  bool at_least = true;  // the value shall not be below its limit; else not above
  std::string unit;
  std::optional<glm::dvec3> worst;  // where [m]
  CheckVerdict verdict = CheckVerdict::not_assessed;
  std::string reason;

  /// How far the value is on the right side of its limit, as a share of it; negative on the wrong.
  std::optional<double> margin() const;
};

/// Judged by its limit.
Check judged(Rule rule, std::string subject, double value, double limit, bool at_least,
             std::string unit, std::optional<glm::dvec3> worst = std::nullopt);
Check not_assessed(Rule rule, std::string subject, std::string reason);

/// How many of each verdict, by CheckVerdict.
using CheckCounts = std::array<size_t, 4>;
CheckCounts counts_of(const std::vector<Check>& checks);
/// "12 checks pass, 3 fail, 2 not assessed".
std::string words_of(const CheckCounts& counts);

}  // namespace luxodus
