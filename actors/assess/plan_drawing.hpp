// Plans of an assessment as SVG, from its JSON. Pure; any thread.
#pragma once

#include <string>

#include "scenes/format/json_out.hpp"

namespace luxodus {

/// Illuminance on the floor in false colour, with a scale.
std::string plan_of_light(const Json& assessment);
/// What people with eyes at this height read, place by place: the best of all signs, or one sign.
std::string plan_of_sights(const Json& assessment, double eye_height_m, const std::string& sign);

}  // namespace luxodus
