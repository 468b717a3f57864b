// A run's totals on disk, whole: sums, squares and balance of every group, so that a file is both a
// result and a place to go on from, bit for bit. It holds no timings, threads or machines.
#pragma once

#include <filesystem>

#include "actors/results/formats/flux_file.hpp"
#include "actors/results/run/local_run.hpp"

namespace luxodus {

namespace limits {
inline constexpr int flux_schema_version = 1;
}

/// The totals as a flux file has them.
FluxFile flux_of(const LocalRun& run);
/// Errors: as write_flux_file.
Result<void> save_flux(const std::filesystem::path& path, const LocalRun& run);

/// Puts the totals of a file into a run that has traced nothing yet.
/// Errors: as read_flux_file; another scene, scenario, seed, partition or layout, each by name.
Result<void> load_flux(const std::filesystem::path& path, LocalRun& run);
/// Likewise of a file that was read; its messages say `place`.
Result<void> take_flux(const FluxFile& file, const SourcePlace& place, LocalRun& run);

}  // namespace luxodus
