// An assessment and the folder of its report, for the subcommands that make one.
#pragma once

#include <filesystem>
#include <memory>

#include "actors/assess/assessment.hpp"
#include "actors/cli/command.hpp"
#include "actors/cli/report_options.hpp"

namespace luxodus::cli {

struct AssessmentJob {
  std::shared_ptr<const SceneDescription> scene;
  std::filesystem::path folder;
  AssessOptions options;
  bool overwrite = false;  // files that no assessment has written
  bool strict = false;     // exit code 1 where anything is open
  ReportWords report;
};

/// Assesses, writes the report and prints the summary; until the interrupt flag is set, when
/// nothing is written. Errors: of the folder, of writing; those of the scene are told here.
Result<ExitCode> assess_into(const AssessmentJob& job);

}  // namespace luxodus::cli
