// Moves a shape that is far from the origin of its product to that origin, and moves the placement
// of the product the other way, so that the shape stays where it is. The library that computes
// shapes keeps points in single precision: at 5000 km from the origin a wall of 0.2 m would have no
// thickness. Internal to shape_input; pure function.
#pragma once

#include <optional>
#include <string>

#include "scenes/formats/ifc/ifc_model.hpp"

namespace luxodus {

struct NearPointsText {
  std::optional<std::string> file;  // nothing where no shape is far, or they are too many
  size_t left_far = 0;              // far shapes, where the changed file would be too large
};

/// The text of the file with near points. `file` is that of `model`, prepared.
NearPointsText with_near_points(const StepFile& file, const IfcModel& model);

}  // namespace luxodus
