// The report of a run, with its progress shown where that takes more than a moment.
#pragma once

#include <filesystem>

#include "actors/display/report.hpp"

namespace luxodus::cli {

/// Errors: as write_report.
Result<Json> write_report_aloud(const std::filesystem::path& folder, const LocalRun& run,
                                const RunRecord& record);

}  // namespace luxodus::cli
