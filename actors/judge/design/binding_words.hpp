// Binding demands in words: how many luminaires each demand costs. Pure functions; any thread.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/design/design_record.hpp"
#include "actors/judge/texts/texts.hpp"

namespace luxodus {

/// A sentence for each binding demand, in the language of `t`.
std::vector<std::string> because_words(const Texts& t, const DesignRecord& design);

/// The requirement of a group of constraints, in the language of `t`.
std::string demand_text(const Texts& t, const ConstraintRecord& group);

}  // namespace luxodus
