// Checks of output paths: nothing is written through a symbolic link in place of a result. Any
// thread.
#pragma once

#include <filesystem>

#include "runtime/core/result.hpp"

struct stat;

namespace luxodus {

/// Whether what stands at a file's place can be replaced: only a regular file can.
Result<void> can_be_replaced(const struct stat& about);

/// Resolves symbolic links in the folder of a path that the user named: he may place his results
/// behind a link of his own. A path without a folder is returned unchanged.
std::filesystem::path behind_links(const std::filesystem::path& path);

/// Removes temporary files of writers that were killed; files of living writers are locked and
/// stay.
void remove_stale_temporaries(const std::filesystem::path& folder);

}  // namespace luxodus
