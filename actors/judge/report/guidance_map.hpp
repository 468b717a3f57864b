// A route over time as a drawing: places from left to right, time upwards, coloured by whether a
// guiding sign is read there, with walkers as lines. Between two states the worse one is drawn.
// Pure function; any thread.
#pragma once

#include <string>

#include "actors/judge/record/guidance_record.hpp"
#include "actors/judge/texts/texts.hpp"

namespace luxodus {

/// `route`: one of `over_time`. Returns an SVG whose unit is 1 mm on paper.
std::string guidance_map(const OverTime& over_time, const RouteOverTime& route, const Texts& texts,
                         double width_mm);

}  // namespace luxodus
