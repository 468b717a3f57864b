// The second stage of a design as JSON, as sentences, and as a section of the page. Pure; any
// thread.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/design/design.hpp"
#include "actors/judge/texts/texts.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// The file of a layout, within the folder of the design; "" of one that is none of its own.
std::string file_of(const JudgedLayout& layout);

Json smoke_json(const SmokeStage& stage);

/// What follows from it, in the language. `smoke`: of smoke_json.
std::vector<std::string> smoke_words(const Texts& texts, const Json& smoke);

/// Sentences, the plot of legible share against the objective, and a table, as HTML.
/// `design`: the whole JSON of a design, whose "smoke" is there.
std::string smoke_section(const Texts& texts, const Json& design);

}  // namespace luxodus
