// A profile as a file, so that all processes of a cluster plan from the same counts without tracing
// them again: `luxodus profile` writes it, `profile` in [run] names it. The container is that of
// flux files (actors/results/formats/flux_file.hpp): whole and checked, or refused. Plain values;
// any thread.
#pragma once

#include <filesystem>

#include "actors/cast/parts/reference_profile.hpp"
#include "runtime/core/atomic_file.hpp"

namespace luxodus {

/// Errors: as write_flux_file.
Result<void> write_profile(const std::filesystem::path& path, const ReferenceProfile& profile);

/// `objects`: how many parts the scene has. Errors: as read_flux_file; a file that is no
/// profile; one of another scene, scenario or partition.
Result<ReferenceProfile> read_profile(const std::filesystem::path& path, const CompiledScene& scene,
                                      size_t objects);

}  // namespace luxodus
