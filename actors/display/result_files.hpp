// What a run leaves in its folder, so that the next run there can clear it away. Only files that
// the folder's own result.json names are ever removed; what else lies there is somebody's own. Not
// for two runs into one folder at a time.
#pragma once

#include <filesystem>

#include "scenes/format/atomic_file.hpp"

namespace luxodus {

namespace limits {
/// Largest result.json that is read back [bytes]: 1 GiB, far above a million surfaces in 40 bands.
inline constexpr uint64_t result_bytes_most = uint64_t{1} << 30;
}  // namespace limits

/// Removes the maps and pictures of an earlier run: those of the planes and cameras that
/// result.json names, patches.vtp and volume.vti. Keeps flux.lux and result.json, which the next
/// run replaces whole. A folder without a result of ours is left as it is.
/// Errors: a file that cannot be removed, with the system's reason.
Result<Done> remove_old_maps(const std::filesystem::path& folder);

}  // namespace luxodus
