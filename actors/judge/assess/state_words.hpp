// The judged state, the verdict on the whole and what was not assessed, in English for a terminal.
// Texts are made from the record of an assessment alone. Reports have their own texts in several
// languages (actors/judge/report). Pure functions; any thread.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "actors/judge/record/assessment_record.hpp"

namespace luxodus {

/// The sentence that every output shows first: the judged state, the rules, the verdict on all
/// checks in words, and counts of views. Requires: the state and the counts of views are
/// recorded.
std::string first_sentence(const AssessmentRecord& assessment, const std::string& verdict);

/// Name and text of a row: ("operation", "emergency, 600 s after the failure of the mains"). The
/// name is "" if the row continues the one before.
using StateRow = std::pair<std::string, std::string>;
std::vector<StateRow> state_rows(const AssessmentRecord& assessment);

/// The rows and then the remarks, one per line, for a terminal.
std::string state_text(const AssessmentRecord& assessment);

/// Whether a check fails, or a check or a view is not assessed, not verified or undecided.
bool anything_open(const AssessmentRecord& assessment);

}  // namespace luxodus
