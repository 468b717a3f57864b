#include "actors/lab/study/study_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "actors/results/formats/file_names.hpp"

namespace luxodus {

namespace {

/// Columns by which simulations are compared with real runs.
constexpr std::array compared_columns{
    "particles_per_s", "busy_us_per_particle", "fetches_per_particle", "builds_per_particle",
    "hit_rate",        "wait_p50_ms",          "wait_p99_ms"};

/// The index of an axis.
size_t number_of(const Study& study, const StudyAxis& axis) {
  return static_cast<size_t>(&axis - study.axes.data());
}

/// A point's values on the varied axes except `without`.
std::string label_of(const Study& study, const StudyPoint& point, std::string_view without) {
  std::string label;
  for (const StudyAxis* axis : study.varied()) {
    if (axis->key == without) continue;
    const std::string value = axis->text(point.values[number_of(study, *axis)]);
    label += (label.empty() ? "" : ", ") +
             (axis->of_words() ? value : fmt::format("{} {}", axis->key, value));
  }
  return label.empty() ? "measured" : label;
}

/// Groups the points that differ only on one axis, labelled by what they share; in the order of the
/// study.
std::vector<std::pair<std::string, std::vector<StudyPoint>>> series_of(const Study& study,
                                                                       std::string_view along) {
  std::vector<std::pair<std::string, std::vector<StudyPoint>>> out;
  for (const StudyPoint& point : study.points()) {
    const std::string label = label_of(study, point, along);
    auto at = std::find_if(out.begin(), out.end(), [&](auto& s) { return s.first == label; });
    if (at == out.end()) at = out.insert(out.end(), {label, {}});
    at->second.push_back(point);
  }
  return out;
}

}  // namespace

StudySpread spread_of(const StudyOutcome& outcome, const StudyPoint& point,
                      const StudyColumn& column) {
  StudySpread spread;
  double sum = 0, squares = 0;
  for (const StudyRow& row : outcome.rows) {
    if (!row.result || row.point.values != point.values) continue;
    const double value = column.value(*row.result);
    ++spread.runs;
    sum += value;
    squares += value * value;
  }
  if (spread.runs == 0) return spread;
  const auto n = static_cast<double>(spread.runs);
  spread.mean = sum / n;
  if (spread.runs > 1)
    spread.deviation =
        std::sqrt(std::max(0.0, (squares - n * spread.mean * spread.mean) / (n - 1)));
  return spread;
}

std::vector<StudyComparison> comparisons_of(const StudyOutcome& outcome) {
  const Study& study = outcome.study;
  const StudyAxis& on = study.axis("on");
  std::vector<StudyComparison> out;
  const auto has = [&](const char* word) {
    return std::find(on.words.begin(), on.words.end(), word) - on.words.begin();
  };
  const auto all = static_cast<std::ptrdiff_t>(on.size());
  for (const auto& [of, against] :
       {std::pair{"simulation", "nodes"}, std::pair{"simulation", "processes"},
        std::pair{"replay", "simulation"}, std::pair{"replay", "nodes"},
        std::pair{"replay", "processes"}}) {
    if (has(of) == all || has(against) == all) continue;
    StudyComparison comparison{of, against, {}};
    for (const auto& [label, points] : series_of(study, "on"))
      for (const char* name : compared_columns) {
        const StudyColumn& column = study_column(name);
        const auto a = spread_of(outcome, points[static_cast<size_t>(has(of))], column);
        const auto b = spread_of(outcome, points[static_cast<size_t>(has(against))], column);
        if (a.runs > 0 && b.runs > 0) comparison.rows.push_back({label, name, a.mean, b.mean});
      }
    out.push_back(std::move(comparison));
  }
  return out;
}

std::vector<StudyComparison::Error> StudyComparison::errors() const {
  std::vector<Error> out;
  for (const char* name : compared_columns) {
    Error error{name, 0, 0};
    int count = 0;
    for (const Row& row : rows) {
      if (row.column != name) continue;
      ++count;
      error.mean += std::abs(row.error());
      error.most = std::max(error.most, std::abs(row.error()));
    }
    if (count == 0) continue;
    error.mean /= count;
    out.push_back(error);
  }
  return out;
}

CsvTable study_table(const StudyOutcome& outcome) {
  std::vector<std::string> names;
  for (const StudyAxis& axis : outcome.study.axes) names.push_back(axis.key);
  names.emplace_back("seed");
  for (const StudyColumn& column : study_columns()) names.emplace_back(column.name);
  names.emplace_back("refused");
  CsvTable table(names);
  for (const StudyRow& row : outcome.rows) {
    for (const StudyAxis& axis : outcome.study.axes) {
      const size_t value = row.point.values[number_of(outcome.study, axis)];
      if (axis.of_words())
        table.cell(axis.words[value]);
      else
        table.cell(axis.numbers[value]);
    }
    table.cell(static_cast<int64_t>(row.seed));
    for (const StudyColumn& column : study_columns()) {
      if (row.result)
        table.cell(column.value(*row.result));
      else
        table.empty_cell();
    }
    table.cell(row.refused);
    table.end_row();
  }
  return table;
}

Json study_json(const StudyOutcome& outcome) {
  Json columns = Json::array();
  for (const StudyColumn& column : study_columns())
    columns.push_back({{"name", column.name}, {"unit", column.unit}, {"meaning", column.meaning}});
  Json rows = Json::array();
  for (const StudyRow& row : outcome.rows) {
    Json one;
    for (const StudyAxis& axis : outcome.study.axes) {
      const size_t value = row.point.values[number_of(outcome.study, axis)];
      if (axis.of_words())
        one[axis.key] = axis.words[value];
      else
        one[axis.key] = axis.numbers[value];
    }
    one["seed"] = row.seed;
    for (const StudyColumn& column : study_columns())
      if (row.result) one[std::string(column.name)] = number_json(column.value(*row.result));
    if (!row.result) one["refused"] = row.refused;
    rows.push_back(std::move(one));
  }
  Json compared = Json::array();
  for (const StudyComparison& comparison : comparisons_of(outcome)) {
    Json errors = Json::array();
    for (const auto& error : comparison.errors())
      errors.push_back({{"column", error.column},
                        {"mean_error", number_json(error.mean)},
                        {"largest_error", number_json(error.most)}});
    compared.push_back(
        {{"of", comparison.of}, {"against", comparison.against}, {"errors", errors}});
  }
  return {{"title", outcome.study.title},
          {"question", outcome.study.question},
          {"costs_of", outcome.measured.machine},
          {"columns", columns},
          {"comparisons", compared},
          {"runs", rows}};
}

SvgPlot study_plot(const StudyOutcome& outcome, const StudyPlot& plot) {
  const Study& study = outcome.study;
  const StudyColumn& column = study_column(plot.y);
  const StudyAxis& x = study.axis(plot.x);
  SvgPlot out;
  out.title = plot.title;
  out.label_x = plot.x;
  out.label_y = column.unit.empty() ? plot.y : fmt::format("{} [{}]", plot.y, column.unit);
  out.log_x = plot.log_x;
  out.log_y = plot.log_y;
  for (const auto& [label, points] : series_of(study, plot.x)) {
    PlotSeries series;
    series.name = label;
    for (const StudyPoint& point : points) {
      const StudySpread spread = spread_of(outcome, point, column);
      if (spread.runs == 0) continue;
      series.x.push_back(x.numbers[point.values[number_of(study, x)]]);
      series.y.push_back(spread.mean);
      series.error.push_back(spread.deviation);
    }
    if (!series.x.empty() && out.series.size() < limits::max_plot_series)
      out.series.push_back(std::move(series));
  }
  return out;
}

OutputPlan study_output(const Study& study) {
  OutputPlan plan{{"results.csv", "results.json", "index.html"}, {}};
  for (const StudyPlot& plot : study.plots) plan.files.push_back(file_name_of(plot.name) + ".svg");
  return plan;
}

Result<void> write_study(const std::filesystem::path& folder, const StudyOutcome& outcome) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return system_problem(folder, "cannot make this folder", error.value());
  if (auto ok = write_csv(folder / "results.csv", study_table(outcome)); !ok) return ok.problem();
  if (auto ok = write_json(folder / "results.json", study_json(outcome)); !ok) return ok.problem();
  for (const StudyPlot& plot : outcome.study.plots) {
    const auto ok =
        write_svg_plot(folder / (file_name_of(plot.name) + ".svg"), study_plot(outcome, plot));
    if (!ok) return ok.problem();
  }
  const auto page = study_page(outcome);
  if (!page) return page.problem();
  return write_file_atomically(folder / "index.html", page.value());
}

}  // namespace luxodus
