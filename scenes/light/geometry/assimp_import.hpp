// Reads the parts of a mesh with Assimp, in the calling process. Assimp has crashed, and used up
// all memory, on files made for that purpose. So only the job of import.cpp calls this function, in
// a process of its own. Internal to import.cpp. Keeps no state between calls; that process has one
// thread.
#pragma once

#include "scenes/light/geometry/import.hpp"

namespace luxodus {

/// Same contract as import_mesh; `files_read` gets every file that was opened, also if reading
/// fails.
Result<std::vector<ImportedPart>> import_by_assimp(const std::string& path, double metres_per_unit,
                                                   UpAxis up, std::vector<std::string>& files_read);

}  // namespace luxodus
