// The file of a profile, so that all processes of a cluster plan from the same counts without
// tracing them again: `luxodus profile` writes it, `profile` in [run] names it. The container is
// that of flux files (actors/results/formats/flux_file.hpp): whole and verified, or rejected. Plain
// values; any thread.
#pragma once

#include <filesystem>

#include "actors/cast/parts/reference_profile.hpp"
#include "runtime/core/atomic_file.hpp"

namespace luxodus {

/// Errors: those of write_flux_file.
Result<void> write_profile(const std::filesystem::path& path, const ReferenceProfile& profile);

/// `objects`: number of parts of the scene. Errors: those of read_flux_file; a file that is no
/// profile, or of another scene, scenario or partition.
Result<ReferenceProfile> read_profile(const std::filesystem::path& path, const CompiledScene& scene,
                                      size_t objects);

}  // namespace luxodus
