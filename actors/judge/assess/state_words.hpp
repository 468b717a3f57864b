// What an assessment is of, in words: the judged state, the verdict on the whole, and what was not
// assessed. For a terminal, from assessment.json alone; reports (actors/judge/report)
// have their own words in several languages. Pure; any thread.
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
/// "not_verified"}. `first` is the sentence that stands first wherever the assessment is shown:
/// what was judged, by which rules, and what came of it, views of signs included.
Json verdict_json(const AssessedState& state, const CheckCounts& counts,
                  const std::map<std::string, size_t>& sights);

/// The "first" of the verdict; of an assessment without one, its words.
std::string first_words(const Json& assessment);

/// Of what a row is, and what it says: ("operation", "emergency, 600 s after the failure of the
/// mains"); "" where it goes on from the one before. Of an assessment without a "state", made
/// before it was written, one row that says so.
using StateRow = std::pair<std::string, std::string>;
std::vector<StateRow> state_rows(const Json& assessment);

/// The rows, then the remarks, each on a line of its own, for a terminal.
std::string state_text(const Json& assessment);

/// The verdict on all checks; of an assessment without one, from its counts.
std::string verdict_words(const Json& assessment);

/// Whether a check fails, or a check or a view is not assessed, not verified or undecided.
bool anything_open(const Json& assessment);

}  // namespace luxodus
