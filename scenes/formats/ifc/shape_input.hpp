// An IFC model as the library that computes shapes is to read it: the bodies of products and no
// other representation, and in place of profiles, solids, indices and placements that the library
// does not read, equal ones that it does. Points far from the origin of their product, which it
// would round to single precision, are moved near it, and the product's placement back. Pure
// function; any thread.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scenes/formats/ifc/ifc_model.hpp"
#include "scenes/formats/ifc/step_solids.hpp"

namespace luxodus {

namespace limits {
/// Points of a shape beyond this distance from the origin of its product are moved [m]: single
/// precision then has a step of 0.06 mm.
inline constexpr double ifc_far_m = 1000;
/// Notes about items without a shape.
inline constexpr size_t ifc_shape_notes = 200;
}  // namespace limits

struct IfcShapeInput {
  StepFile file;
  std::vector<std::string> notes;  // what has no shape, or a simplified one
};

/// Errors: as StepFile::of.
Result<IfcShapeInput> ifc_shape_input(const StepFile& file, const IfcModel& model);

struct IfcSolidVolume {
  double m3 = 0;              // 0: its own half spaces cut it away entirely
  bool has_openings = false;  // which are not taken off
};

struct IfcSolidVolumes {
  std::map<uint64_t, IfcSolidVolume> known;  // by the number of the product
  size_t beyond_budget = 0;                  // products left out after the work was spent
};

/// Volumes of products whose solids are known here.
/// `prepared`: the file of ifc_shape_input. `max_work`: as limits::solid_work.
IfcSolidVolumes ifc_solid_volumes(const StepFile& prepared, const IfcModel& model,
                                  uint64_t max_work = limits::solid_work);

struct IfcMendedInput {
  StepFile file;
  std::set<uint64_t> products;  // those whose bodies were changed
};

/// The file with the bodies of these products, where they are known here, as breps.
/// Nothing if none is. `prepared`: the file of ifc_shape_input.
std::optional<IfcMendedInput> ifc_mended_input(const StepFile& prepared, const IfcModel& model,
                                               const std::set<uint64_t>& products);

}  // namespace luxodus
