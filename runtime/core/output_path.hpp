// Where files are written: never through a symbolic link that stands in the place of a result, and
// what that means for files that a person has named. Any thread.
#pragma once

#include <filesystem>

#include "runtime/core/result.hpp"

struct stat;

namespace luxodus {

/// Whether what stands at a file's place can be replaced: only a regular file can.
Result<void> can_be_replaced(const struct stat& about);

/// The same file by a folder without symbolic links, for a file that a person has named: behind a
/// link of his own is where he wants it. What has no folder stays as it is.
std::filesystem::path behind_links(const std::filesystem::path& path);

/// Removes temporary files of writers that were killed; those of living ones are locked and stay.
void remove_stale_temporaries(const std::filesystem::path& folder);

}  // namespace luxodus
