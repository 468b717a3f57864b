// Reads the parts of a Wavefront OBJ file and its material libraries. Internal to import.cpp, which
// calls it in a process of its own, with limits on memory and time. Keeps no state between calls;
// one thread.
#pragma once

#include "scenes/light/geometry/import.hpp"

namespace luxodus {

/// Same contract as import_mesh; `extras` gets what was found even where reading fails.
Result<std::vector<ImportedPart>> import_obj(const std::string& path, double metres_per_unit,
                                             UpAxis up, MeshExtras& extras);

}  // namespace luxodus
