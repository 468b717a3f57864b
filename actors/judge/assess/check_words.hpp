// One check as one line of English for the console, from assessment.json. Pure function; any
// thread.
#pragma once

#include <string>

#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// "route "to the stairs": A sign within its viewing distance, everywhere on a route: 1.4 of the
/// viewing distance, at most 1 (S4, without furniture)". Requires: `check` is one of an assessment.
std::string check_words(const Json& check);

}  // namespace luxodus
