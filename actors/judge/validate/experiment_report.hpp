// The results of experiments: lines for a console, JSON for programs, a plot, and a page in
// Markdown, which stands in docs/validation/experiments.md. Equal results give equal bytes. Files
// are written atomically. Any thread.
#pragma once

#include <filesystem>

#include "actors/judge/validate/experiment_run.hpp"
#include "actors/results/formats/json_out.hpp"
#include "actors/results/formats/svg_plot.hpp"

namespace luxodus::light {

/// What is said over all experiments.
struct ExperimentSummary {
  size_t kept = 0, failing = 0, not_answered = 0;  // claims
  RuleResult mean_seen;                            // over all trials of rule S
  std::vector<double> deviations;                  // of these
  /// Rule U: trials in which the program's verdict is "legible" where people stop reading.
  std::vector<std::string> unsafe;
  /// Trials of reading in smoke that the program promises to within limits::thin_margin of where
  /// people stop.
  std::vector<std::string> thin;

  /// Whether no rule fails; a claim that is not answered is no failure.
  bool passed() const {
    return failing == 0 && unsafe.empty() && mean_seen.agreement != Agreement::failing;
  }
};

ExperimentSummary summary_of(const std::vector<ExperimentResult>& results);

/// How the experiments were run, for the record.
struct ExperimentRecord {
  ExperimentOptions options;
  std::string only;  // "" for all
  bool interrupted = false;
};

/// A table of thresholds and one of claims, and the summary.
std::string experiments_text(const std::vector<ExperimentResult>& results);
Json experiments_json(const std::vector<ExperimentResult>& results, const ExperimentRecord& record);
/// Optical depths: predicted over observed.
SvgPlot experiments_plot(const std::vector<ExperimentResult>& results);
/// Names the plot as experiments.svg beside it.
std::string experiments_page(const std::vector<ExperimentResult>& results,
                             const ExperimentRecord& record);
/// The part of the page on one experiment.
std::string experiment_section(const ExperimentResult& result);

/// Writes experiments.json, experiments.md and experiments.svg into a folder that is made if
/// missing.
Result<void> write_experiments(const std::filesystem::path& folder,
                               const std::vector<ExperimentResult>& results,
                               const ExperimentRecord& record);

// ---- words that the console and the page share -------------------------------------------------

/// "7.61 ± 0.02", "above 16", "none"
std::string crossing_text(const Crossing& crossing, const Trial& trial);
/// "4.6", "6.91 to 8.17", "" if nothing was observed.
std::string observed_text(const Trial& trial);
/// The threshold that a trial's observation is compared with: of reading or of seeing.
const Crossing& compared(const Trial& trial, const TrialResult& result);
/// exp(difference of optical depths), of which the program needs less luminance than people (above
/// 1) or more; "" if there is none.
std::string luminance_factor_text(const Trial& trial, const TrialResult& result);

}  // namespace luxodus::light
