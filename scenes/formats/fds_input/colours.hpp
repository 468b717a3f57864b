// Names of colours that FDS knows. They are for display only. Pure functions; any thread.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string_view>

namespace luxodus::fds_input {

/// Encoded sRGB, 0 to 1, of a name in capitals ("INDIAN RED", "GRAY 60"); nothing for an unknown
/// name. Numbered shades ("BROWN 3") are darker shades of the name, as in X11, to about 10 % of
/// white.
std::optional<glm::dvec3> colour_rgb(std::string_view name);

}  // namespace luxodus::fds_input
