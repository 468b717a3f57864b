// Results in smoke of a design as JSON, as sentences, and as a section of the page. Pure functions;
// any thread.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/design/design.hpp"
#include "actors/judge/texts/texts.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// File of a layout, relative to the folder of the design; "" if the layout has no file of its own.
std::string file_of(const JudgedLayout& layout);

Json smoke_json(const SmokeStage& stage);

/// Conclusions as sentences in the language of `texts`. `smoke`: a smoke_json.
std::vector<std::string> smoke_words(const Texts& texts, const Json& smoke);

/// Sentences, a plot of the legible share against the objective, and a table, as HTML.
/// `design`: the JSON of a design, which has "smoke".
std::string smoke_section(const Texts& texts, const Json& design);

}  // namespace luxodus
