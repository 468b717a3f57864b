// Moves points of shapes that are far from the origin of their product near it, and the placement
// of the product back. The library that computes shapes keeps points in single precision, where a
// wall of 0.2 m at 5000 km has no thickness. Internal to shape_input; pure function.
#pragma once

#include <optional>
#include <string>

#include "scenes/formats/ifc/ifc_model.hpp"

namespace luxodus {

/// The text of the changed file; nothing where no shape is far. `products`: their ids.
std::optional<std::string> with_near_points(const StepFile& file, const IfcModel& model);

}  // namespace luxodus
