// A study's results: a table of all runs, the same as JSON, a drawing for each plot with the
// spread over seeds, and one self-contained page that explains them. Equal results give equal
// bytes. Files are written atomically. Any thread.
#pragma once

#include <filesystem>

#include "actors/lab/study/results.hpp"
#include "actors/lab/study/study_file.hpp"
#include "actors/results/formats/csv.hpp"
#include "actors/results/formats/json_out.hpp"
#include "actors/results/formats/output_folder.hpp"
#include "actors/results/formats/svg_plot.hpp"

namespace luxodus {

struct StudyRow {
  StudyPoint point;
  uint64_t seed = 0;
  std::optional<StudyResult> result;
  std::string refused;  // why there is no result
};

/// The outcome of a study.
struct StudyOutcome {
  const Study& study;
  MeasuredCosts measured;
  std::vector<StudyRow> rows;
};

/// Statistics over the seeds of a point.
struct StudySpread {
  size_t runs = 0;
  double mean = 0;
  double deviation = 0;  // standard deviation of one run; 0 for a single one
};
StudySpread spread_of(const StudyOutcome& outcome, const StudyPoint& point,
                      const StudyColumn& column);

/// A comparison of two kinds of runs at points that are equal otherwise: simulation against real
/// nodes, or replay against tracing.
struct StudyComparison {
  std::string of, against;  // words of `on`
  struct Row {
    std::string point;  // "nodes 4, fibers 16"
    std::string column;
    double of = 0, against = 0;
    double error() const { return against != 0 ? of / against - 1 : 0; }
  };
  std::vector<Row> rows;
  /// The largest and the mean magnitude of a column's errors.
  struct Error {
    std::string column;
    double mean = 0, most = 0;
  };
  std::vector<Error> errors() const;
};
std::vector<StudyComparison> comparisons_of(const StudyOutcome& outcome);

CsvTable study_table(const StudyOutcome& outcome);
Json study_json(const StudyOutcome& outcome);
SvgPlot study_plot(const StudyOutcome& outcome, const StudyPlot& plot);
/// Errors: those of svg_plot_text.
Result<std::string> study_page(const StudyOutcome& outcome);

/// The files that write_study writes.
OutputPlan study_output(const Study& study);

/// Writes results.csv, results.json, NAME.svg for each plot, and index.html. Errors: those of
/// write_file_atomically; a folder that cannot be made.
Result<void> write_study(const std::filesystem::path& folder, const StudyOutcome& outcome);

}  // namespace luxodus
