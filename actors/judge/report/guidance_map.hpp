// A route over time as a drawing: places from left to right, time upwards, coloured by whether a
// guiding sign is read there, with walkers as lines. Between two states the worse one is drawn.
// Requires: "over_time" of an assessment that check_assessment has passed. Pure function; any
// thread.
#pragma once

#include <string>

#include "actors/judge/texts/texts.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// `route`: an entry of over_time["routes"]. Returns an SVG whose unit is 1 mm on paper.
std::string guidance_map(const Json& over_time, const Json& route, const Texts& texts,
                         double width_mm);

}  // namespace luxodus
