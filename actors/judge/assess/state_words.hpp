// The judged state, the verdict on the whole and what was not assessed, in English for a terminal
// and as JSON. Texts are made from assessment.json alone. Reports have their own texts in several
// languages (actors/judge/report). Pure functions; any thread.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "actors/judge/assess/judged_state.hpp"
#include "actors/results/formats/json_out.hpp"
#include "scenes/emergency/check.hpp"

namespace luxodus {

/// "state" of assessment.json.
Json state_json(const AssessedState& state);

/// "verdict" of assessment.json: {"first", "words", "pass", "fail", "not_assessed",
/// "not_verified"}. `first` is the sentence that every output shows first: the judged state, the
/// rules, and counts of checks and views.
Json verdict_json(const AssessedState& state, const CheckCounts& counts,
                  const std::map<std::string, size_t>& sights);

/// "first" of the verdict; for an assessment without it, the verdict's words.
std::string first_words(const Json& assessment);

/// Name and text of a row: ("operation", "emergency, 600 s after the failure of the mains"). The
/// name is "" if the row continues the one before. An old assessment without "state" gives one row
/// that says so.
using StateRow = std::pair<std::string, std::string>;
std::vector<StateRow> state_rows(const Json& assessment);

/// The rows and then the remarks, one per line, for a terminal.
std::string state_text(const Json& assessment);

/// Verdict on all checks; for an assessment without one, from its counts.
std::string verdict_words(const Json& assessment);

/// Whether a check fails, or a check or a view is not assessed, not verified or undecided.
bool anything_open(const Json& assessment);

}  // namespace luxodus
