// A run's totals as a file: sums, squares and balance of every group, so that the file is both a
// result and a checkpoint, bit for bit. It holds no timings, threads or machines. Any thread, while
// the run does not trace.
#pragma once

#include <filesystem>

#include "actors/results/formats/flux_file.hpp"
#include "actors/results/run/local_run.hpp"

namespace luxodus {

namespace limits {
inline constexpr int flux_schema_version = 1;
}

/// The totals as a flux file.
FluxFile flux_of(const LocalRun& run);
/// Errors: as write_flux_file.
Result<void> save_flux(const std::filesystem::path& path, const LocalRun& run);

/// Loads the totals of a file into a run that has traced nothing yet.
/// Errors: as read_flux_file; another scene, scenario, seed, partition or layout, each named.
Result<void> load_flux(const std::filesystem::path& path, LocalRun& run);
/// Takes the totals of a file that was read; messages name `place`.
Result<void> take_flux(const FluxFile& file, const SourcePlace& place, LocalRun& run);

}  // namespace luxodus
