// The report of a run, with its progress shown where that takes more than a moment.
#pragma once

#include <filesystem>

#include "actors/results/files/run_results.hpp"

namespace luxodus::cli {

/// Errors and what is required: as finish_results.
Result<Json> finish_report_aloud(const std::filesystem::path& folder, const LocalRun& run,
                                 const RunRecord& record);

}  // namespace luxodus::cli
