// The rules of the codes, each in one row: where it is quoted from, its limit, and what decides it.
// The codes' texts were not at hand: every rule says what it is quoted from. Constant data; any
// thread.
#pragma once

#include <array>
#include <string_view>

#include "scenes/emergency/check.hpp"
#include "scenes/emergency/rule_sets.hpp"

namespace luxodus {

/// What a rule is quoted from.
struct RuleSource {
  RemarkId id = RemarkId::count;
  const char* name = nullptr;  // that the remark takes
};

/// What has to change for a check of a rule to change: a design asks which rules it decides.
enum class DecidedBy {
  nothing,      // of a design
  luminaires,   // the layout of emergency luminaires
  sign,         // the sign that is hung
  lit_sign,     // the sign that is hung, if it is lit from within; else the luminaires
  placed_signs  // where signs hang
};

struct RuleRow {
  RuleId id;
  std::string_view name;
  const char* edition;
  const char* clause;                 // "" where it is not known
  std::array<RuleSource, 2> sources;  // those with an id
  std::optional<double> limit;        // none where it depends on the building (rule_limits.hpp)
  bool at_least;                      // whether values shall not be below it; else not above
  const char* unit;
  DecidedBy decided_by;
  std::optional<Deviation> deviation = std::nullopt;  // that has the rule; else the set itself
};

/// Requires: not RuleId::none (a programmer's mistake throws).
const RuleRow& row_of(RuleId id);
/// The limit that a rule states, in its unit. Requires: it states one.
double limit_of(RuleId id);

/// As a part of a set: a rule of EN 1838:2013 that the set of 2024 takes over says so.
Rule rule_of(RuleId id, const CodeChoice& codes);
/// One that is of no code.
Rule own_rule(RuleId id);

}  // namespace luxodus
