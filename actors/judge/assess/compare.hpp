// Compares two assessments: verdicts of checks and views, and values with their distance in
// standard errors. Plain values and pure functions; any thread.
#pragma once

#include "actors/judge/record/assessment_record.hpp"

namespace luxodus {

/// Words or a verdict that differ; none where only the other assessment has them.
struct ChangedWords {
  std::string what;
  std::optional<std::string> before, after;
  static constexpr void fields(auto&& field, auto& m) {
    field("what", m.what);
    field("before", m.before, {.or_null = true})("after", m.after, {.or_null = true});
  }
};

struct ChangedNumber {
  std::string what;
  double before = 0, after = 0;
  std::optional<std::string> unit;
  std::optional<double> standard_errors;  // between them
  static constexpr void fields(auto&& field, auto& m) {
    field("what", m.what)("before", m.before)("after", m.after);
    field("unit", m.unit)("standard_errors", m.standard_errors);
  }
};

struct Comparison {
  std::vector<ChangedWords> state, checks;
  std::vector<ChangedNumber> values;  // of checks
  std::vector<ChangedWords> sights;
  std::vector<ChangedNumber> levels;  // visibility levels that differ significantly
  static constexpr void fields(auto&& field, auto& m) {
    field("state", m.state)("checks", m.checks)("values", m.values)("sights", m.sights);
    field("levels", m.levels);
  }
};

Comparison comparison_of(const AssessmentRecord& before, const AssessmentRecord& after);
Json comparison_json(const Comparison& comparison);
/// Lines for a terminal.
std::string comparison_text(const Comparison& comparison);

}  // namespace luxodus
