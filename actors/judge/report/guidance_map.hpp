// A route over time as a drawing: places from left to right, time upwards, coloured by whether a
// sign that leads on is read there; walkers as lines across it. Between two states stands the
// worse. Requires: the "over_time" of an assessment that was checked. Pure; any thread.
#pragma once

#include <string>

#include "actors/judge/texts/texts.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// `route`: one of over_time["routes"]. An SVG, its units millimetres on paper.
std::string guidance_map(const Json& over_time, const Json& route, const Texts& texts,
                         double width_mm);

}  // namespace luxodus
