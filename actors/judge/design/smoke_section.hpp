// Results in smoke of a design as sentences, and as a section of the page. Pure functions;
// any thread.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/design/design_record.hpp"
#include "actors/judge/texts/texts.hpp"

namespace luxodus {

/// Conclusions as sentences in the language of `texts`.
std::vector<std::string> smoke_words(const Texts& texts, const SmokeRecord& smoke);

/// Sentences, a plot of the legible share against the objective, and a table, as HTML.
/// Requires: layouts were judged in smoke.
std::string smoke_section(const Texts& texts, const DesignRecord& design);

}  // namespace luxodus
