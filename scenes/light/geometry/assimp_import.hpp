// The one door to Assimp: parts of a mesh, read in the process that calls. Assimp has crashed, and
// filled the memory, on files that were made to do that, so only the job of import.cpp calls this,
// in a process of its own. Internal to import.cpp.
#pragma once

#include "scenes/light/geometry/import.hpp"

namespace luxodus {

/// As import_mesh; `files_read` gets every file that was opened, also where reading failed.
Result<std::vector<ImportedPart>> import_by_assimp(const std::string& path, double metres_per_unit,
                                                   UpAxis up, std::vector<std::string>& files_read);

}  // namespace luxodus
