// Options of a report, shared by `luxodus assess` and `luxodus report`. One thread.
#pragma once

#include <string>

#include "actors/apps/cli/options.hpp"
#include "actors/judge/report/report.hpp"
#include "actors/results/formats/output_folder.hpp"

namespace luxodus::cli {

struct ReportWords {
  std::string language = "en", paper = "a4";
  bool grid_values = false, pdf = false;

  ReportOptions options() const;
};

/// --language, --paper, --grid-values, --pdf. Requires: `words` outlives the command.
void add_report_options(Command& command, ReportWords& words);

/// Writes the report and prints where it is. Errors: as write_report.
Result<void> write_report_and_tell(const OutputFolder& folder, const AssessmentRecord& assessment,
                                   const ReportWords& words);

}  // namespace luxodus::cli
