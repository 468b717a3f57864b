#include "actors/judge/assess/compare.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "actors/judge/assess/state_words.hpp"

namespace luxodus {

namespace {

/// Differences below these count as none: in standard errors of the difference; for exact values as
/// a share.
constexpr double different_errors = 3, different_share = 1e-6;

/// The edition is part of the key: two rule sets have a check each of the same rule.
std::string key_of(const CheckRecord& check) {
  return fmt::format("{} ({}) {} {}", name_of(check.rule.id), check.rule.edition,
                     english().subject(check.subject), english().remarks(check.conditions));
}

std::string key_of(const SightRecord& sight) {
  return fmt::format("{}, {:.2f} m along, eye {:.2f} m, sign \"{}\"{}",
                     english().subject(sight.from), sight.along_m, sight.eye_height_m, sight.sign,
                     sight.back_face ? " (back)" : "");
}

template <class Row>
std::map<std::string, const Row*> by_key(const std::vector<Row>& rows) {
  std::map<std::string, const Row*> out;
  for (const Row& row : rows) out.emplace(key_of(row), &row);
  return out;
}

/// Words that differ; either side may lack some.
std::vector<ChangedWords> changed_words(const std::map<std::string, std::string>& before,
                                        const std::map<std::string, std::string>& after) {
  std::vector<ChangedWords> out;
  const auto words_in = [](const auto& words, const std::string& key) {
    const auto at = words.find(key);
    return at == words.end() ? std::nullopt : std::optional(at->second);
  };
  for (const auto& [key, words] : before)
    if (auto now = words_in(after, key); now != words) out.push_back({key, words, std::move(now)});
  for (const auto& [key, words] : after)
    if (!before.contains(key)) out.push_back({key, std::nullopt, words});
  return out;
}

template <class Row>
std::vector<ChangedWords> changed_verdicts(const std::vector<Row>& before,
                                           const std::vector<Row>& after) {
  const auto verdicts = [](const std::vector<Row>& rows) {
    std::map<std::string, std::string> out;
    for (const Row& row : rows) out.emplace(key_of(row), name_of(row.verdict));
    return out;
  };
  return changed_words(verdicts(before), verdicts(after));
}

std::vector<ChangedNumber> changed_values(const std::vector<CheckRecord>& before,
                                          const std::vector<CheckRecord>& after) {
  const auto old_rows = by_key(before);
  std::vector<ChangedNumber> out;
  for (const CheckRecord& row : after) {
    const auto at = old_rows.find(key_of(row));
    if (at == old_rows.end() || !row.value || !at->second->value) continue;
    const double was = *at->second->value, is = *row.value;
    if (std::abs(is - was) <= different_share * std::max(std::abs(is), std::abs(was))) continue;
    out.push_back({at->first, was, is, row.unit, std::nullopt});
  }
  return out;
}

std::vector<ChangedNumber> changed_levels(const std::vector<SightRecord>& before,
                                          const std::vector<SightRecord>& after) {
  const auto old_rows = by_key(before);
  std::vector<ChangedNumber> out;
  for (const SightRecord& row : after) {
    const auto at = old_rows.find(key_of(row));
    if (at == old_rows.end() || !row.seen || !at->second->seen) continue;
    const Uncertain& was = at->second->seen->look.reading_level;
    const Uncertain& is = row.seen->look.reading_level;
    const double error = std::hypot(was.error, is.error), change = is.value - was.value;
    if (!(error > 0 && std::isfinite(error)) || !(std::abs(change) >= different_errors * error))
      continue;
    out.push_back({at->first, was.value, is.value, std::nullopt, change / error});
  }
  return out;
}

/// What is said of the judged state and of all checks. The place of a medium in its file does not
/// count.
std::map<std::string, std::string> said_of(AssessmentRecord assessment) {
  if (assessment.state.smoke)
    for (StatedMedium& medium : assessment.state.smoke->media) {
      medium.place.clear();
      medium.notes.clear();
    }
  std::map<std::string, std::string> out;
  for (const auto& [what, words] : state_rows(assessment))
    if (!what.empty() && what != "not assessed") out[what] = words;
  out["verdict"] = assessment.verdict.words;
  return out;
}

std::string shown(const std::optional<std::string>& words, const char* where) {
  return words ? *words : std::string("not assessed ") + where;
}

}  // namespace

Comparison comparison_of(const AssessmentRecord& before, const AssessmentRecord& after) {
  return {
      changed_words(said_of(before), said_of(after)), changed_verdicts(before.checks, after.checks),
      changed_values(before.checks, after.checks), changed_verdicts(before.sights, after.sights),
      changed_levels(before.sights, after.sights)};
}

Json comparison_json(const Comparison& comparison) {
  return json_of(comparison);
}

std::string comparison_text(const Comparison& comparison) {
  std::string out;
  const auto words = [&](const std::vector<ChangedWords>& rows, const char* title) {
    out += fmt::format("{}: {}\n", title, rows.size());
    for (const ChangedWords& row : rows)
      out += fmt::format("  {}: {} -> {}\n", row.what, shown(row.before, "before"),
                         shown(row.after, "after"));
  };
  const auto numbers = [&](const std::vector<ChangedNumber>& rows, const char* title) {
    out += fmt::format("{}: {}\n", title, rows.size());
    for (const ChangedNumber& row : rows) {
      out += fmt::format("  {}: {:.4g} -> {:.4g}", row.what, row.before, row.after);
      if (row.unit && *row.unit != "1") out += " " + *row.unit;
      if (row.standard_errors)
        out += fmt::format(" ({:+.1f} standard errors)", *row.standard_errors);
      out += "\n";
    }
  };
  words(comparison.state, "what is said of the judged state, and of all checks, differently");
  words(comparison.checks, "checks whose verdict changed");
  numbers(comparison.values, "values of checks that changed");
  words(comparison.sights, "views of signs whose verdict changed");
  numbers(comparison.levels, "visibility levels that changed by three standard errors or more");
  return out;
}

}  // namespace luxodus
