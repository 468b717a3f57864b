// One check as one line of English for the console. Pure function; any thread.
#pragma once

#include <string>

#include "scenes/emergency/check.hpp"

namespace luxodus {

/// "route "to the stairs": A sign within its viewing distance, everywhere on a route: 1.4 of the
/// viewing distance, at most 1 (S4, without furniture)".
std::string check_words(const Check& check);

}  // namespace luxodus
