// What the page of experiments says in words, beside the numbers of a run: Markdown. Constants.
#pragma once

namespace luxodus::light {

/// Title, what is compared, and the rules.
extern const char* const experiments_opening;
/// What the numbers of the shipped experiments mean.
extern const char* const experiments_findings;
/// How to read the tables.
extern const char* const experiments_legend;
/// What a scientist would object to, and what is not tested.
extern const char* const experiments_objections;

}  // namespace luxodus::light
