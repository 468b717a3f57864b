// The report of an assessment from its record: report.html, report.pdf, plans (SVG, DXF) and
// schedules (CSV) in the assessment's folder. It calculates nothing and certifies nothing. Any
// thread; one report of a folder at a time.
#pragma once

#include <filesystem>

#include "actors/judge/report/page.hpp"

namespace luxodus {

struct ReportOptions {
  Language language = Language::en;
  bool letter = false;  // paper size Letter instead of A4
  bool grid_values = false;
  bool pdf = false;
};

/// What stands in the folder of an assessment besides it, and comes into its report.
struct Enclosures {
  std::vector<ReportPicture> pictures;
  std::optional<FollowedPeople> people;  // of luxodus walk, in the folder "people"
};

/// The HTML page only.
std::string report_html(const AssessmentRecord& assessment, const Enclosures& enclosures,
                        const ReportOptions& options, const std::map<std::string, int>& pages = {});

/// Writes all files of a report. Errors: people that cannot be read; a file that cannot be written;
/// with `pdf` also a missing
/// Chromium (all other files are written).
Result<void> write_report(const std::filesystem::path& folder, const AssessmentRecord& assessment,
                          const ReportOptions& options);

}  // namespace luxodus
