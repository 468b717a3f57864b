// Writes the report of a run, and shows progress if that takes more than a moment. One thread.
#pragma once

#include <filesystem>

#include "actors/results/files/run_results.hpp"

namespace luxodus::cli {

/// Errors and requirements: as finish_results.
Result<Json> finish_report_aloud(const std::filesystem::path& folder, const LocalRun& run,
                                 const RunRecord& record);

}  // namespace luxodus::cli
