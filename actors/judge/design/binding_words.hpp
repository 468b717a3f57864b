// Binding demands in words: how many luminaires each demand costs. Pure functions; any thread.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/design/design.hpp"
#include "actors/judge/texts/texts.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// An entry for each binding demand, the costliest first.
Json because_json(const DesignResult& result);

/// A sentence for each, in the language of `t`. Requires: `design` is a design_json.
std::vector<std::string> because_words(const Texts& t, const Json& design);

/// The requirement of a group of constraints of a design_json, in the language of `t`.
std::string demand_text(const Texts& t, const Json& group);

}  // namespace luxodus
