// What binds in a layout, in words: which demand takes how many luminaires more.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/design/design.hpp"
#include "actors/judge/texts/texts.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// By demand, the one that takes most first.
Json because_json(const DesignResult& result);

/// A sentence for each, in the language. Requires: `design` is a design_json.
std::vector<std::string> because_words(const Texts& t, const Json& design);

/// What a group of constraints of a design_json asks for, in the language.
std::string demand_text(const Texts& t, const Json& group);

}  // namespace luxodus
