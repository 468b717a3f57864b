// The results of a validation: one self-contained page, and JSON for programs. Files are written
// atomically. Any thread.
#pragma once

#include <filesystem>

#include "actors/judge/validate/judge.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus::light {

/// How a suite was run, for the record.
struct SuiteRecord {
  uint64_t seed = 1;
  int threads = 1;
  double error = 0;                                               // 0: quick
  double case_seconds = std::numeric_limits<double>::infinity();  // of SuiteOptions
  std::string only;                                               // "" for all cases
  bool interrupted = false;
  /// The error that the record refers to: the requested one, or that of a full run.
  double wanted_error() const { return error > 0 ? error : defaults::suite_error; }
};

/// One sentence without its full stop.
std::string precision_text(const Precision& precision);

Json suite_json(const std::vector<CaseResult>& results, const Verdict& verdict,
                const SuiteRecord& record);
/// Errors: as svg_plot_text.
Result<std::string> suite_page(const std::vector<CaseResult>& results, const Verdict& verdict,
                               const SuiteRecord& record);
/// Writes validate.json and validate.html into a folder that is made if missing.
Result<void> write_suite(const std::filesystem::path& folder,
                         const std::vector<CaseResult>& results, const SuiteRecord& record,
                         const Verdict& verdict);

}  // namespace luxodus::light
