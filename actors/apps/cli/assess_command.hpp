// Makes an assessment and the folder of its report, for the commands that need one. One thread.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/options.hpp"
#include "actors/apps/cli/report_options.hpp"
#include "actors/judge/assess/assessment.hpp"
#include "runtime/core/result.hpp"

namespace luxodus::cli {

/// The times of the assessed states, and the scene at the last of them.
struct AssessedStates {
  std::vector<double> times;                     // none: the scene does not change in time
  std::shared_ptr<const SceneDescription> last;  // null after every problem was told
  ProblemKind told = ProblemKind::bad_input;     // of the problems together
};

/// Without times those that the scene says.
AssessedStates assessed_states(const std::string& file, std::vector<double> times);

// Options of commands that assess. Requires: what each is given outlives it.
Option scenario_option(AssessOptions& options);
Option rounds_option(AssessOptions& options);
/// --place: "known" or "unknown".
Option place_option(std::string& place);

struct AssessmentJob {
  std::shared_ptr<const SceneDescription> scene;  // with several states, the last
  std::string scene_file;
  std::vector<double> times;  // of the states; at most one: a single state
  std::filesystem::path folder;
  AssessOptions options;
  std::vector<Sought> find;  // thresholds to find besides
  bool overwrite = false;    // even files that no assessment has written
  bool strict = false;       // exit code 1 if anything is undecided
  bool pictures = false;     // of the state, for the report
  ReportWords report;
};

/// Assesses, writes the report and prints the summary; if the interrupt flag is set, nothing is
/// written. Errors: of the folder, of writing; those of the scene are printed here.
Result<ExitCode> assess_into(const AssessmentJob& job);

}  // namespace luxodus::cli
