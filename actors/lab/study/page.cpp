// The page of a study: self-contained, including its drawings.
#include <fmt/format.h>

#include <algorithm>

#include "actors/lab/study/study_report.hpp"
#include "actors/results/formats/html_page.hpp"
#include "runtime/core/output_text.hpp"

namespace luxodus {

namespace {

std::string paragraph(std::string_view text) {
  return "<p>" + xml_escape(text) + "</p>\n";
}

std::string fixed_values(const Study& study) {
  std::string text;
  for (const StudyAxis& axis : study.axes)
    if (axis.size() == 1) text += (text.empty() ? "" : ", ") + axis.key + " " + axis.text(0);
  return text;
}

std::string table_of(const StudyOutcome& outcome, const std::vector<std::string>& columns) {
  const Study& study = outcome.study;
  std::string out = "<table>\n<tr>";
  for (const StudyAxis* axis : study.varied()) out += "<th>" + xml_escape(axis->key) + "</th>";
  for (const std::string& name : columns) {
    const std::string_view unit = study_column(name).unit;
    out += "<th>" + xml_escape(name) + (unit.empty() ? "" : fmt::format(" [{}]", unit)) + "</th>";
  }
  out += "</tr>\n";
  for (const StudyPoint& point : study.points()) {
    out += "<tr>";
    for (const StudyAxis* axis : study.varied())
      out += "<td>" +
             xml_escape(axis->text(point.values[static_cast<size_t>(axis - study.axes.data())])) +
             "</td>";
    for (const std::string& name : columns) {
      const StudySpread spread = spread_of(outcome, point, study_column(name));
      out += spread.runs == 0 ? "<td></td>"
                              : fmt::format("<td>{} &plusmn; {}</td>", readable_number(spread.mean),
                                            readable_number(spread.deviation, 2));
    }
    out += "</tr>\n";
  }
  return out + "</table>\n";
}

std::string comparison_part(const StudyComparison& comparison) {
  std::string out =
      fmt::format("<h2>{} against {}</h2>\n<table>\n", comparison.of, comparison.against);
  out += "<tr><th>column</th><th>mean error</th><th>largest error</th></tr>\n";
  for (const auto& error : comparison.errors())
    out += fmt::format("<tr><td>{}</td><td>{:.1f} %</td><td>{:.1f} %</td></tr>\n", error.column,
                       100 * error.mean, 100 * error.most);
  out += "</table>\n<table>\n<tr><th>point</th><th>column</th>";
  out +=
      fmt::format("<th>{}</th><th>{}</th><th>error</th></tr>\n", comparison.of, comparison.against);
  for (const StudyComparison::Row& row : comparison.rows)
    out += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{:+.1f} %</td></tr>\n",
                       xml_escape(row.point), row.column, readable_number(row.of),
                       readable_number(row.against), 100 * row.error());
  return out + "</table>\n";
}

/// Reasons of points without a result, each once.
std::string refusals(const StudyOutcome& outcome) {
  std::vector<std::string> told;
  for (const StudyRow& row : outcome.rows)
    if (!row.result && std::find(told.begin(), told.end(), row.refused) == told.end())
      told.push_back(row.refused);
  if (told.empty()) return "";
  std::string out = "<h2>Points without a result</h2>\n<ul>\n";
  for (const std::string& why : told) out += "<li>" + xml_escape(why) + "</li>\n";
  return out + "</ul>\n";
}

}  // namespace

Result<std::string> study_page(const StudyOutcome& outcome) {
  const Study& study = outcome.study;
  std::string page = "<h1>" + xml_escape(study.title) + "</h1>\n";
  if (!study.question.empty()) page += paragraph(study.question);
  page += paragraph("Scene " + study.scene.filename().string() + "; " + fixed_values(study) + ".");
  page += paragraph(fmt::format(
      "Each point is the mean of {} runs of different chance; bars are one standard deviation "
      "of a run.",
      study.seeds));
  if (!outcome.measured.machine.empty())
    page += paragraph("Simulated time is charged from costs measured on " +
                      outcome.measured.machine + ", scene " + outcome.measured.scene + ".");
  std::vector<std::string> columns;
  for (const StudyPlot& plot : study.plots) {
    const auto svg = svg_plot_text(study_plot(outcome, plot), {study.file.string(), 0});
    if (!svg) return svg.problem();
    page += "<h2>" + xml_escape(plot.title) + "</h2>\n";
    const size_t from = svg->find("<svg");
    page += svg->substr(from == std::string::npos ? 0 : from);
    const StudyColumn& column = study_column(plot.y);
    page += paragraph(plot.explain);
    page += paragraph(fmt::format("{}: {}.", plot.y, column.meaning));
    if (std::find(columns.begin(), columns.end(), plot.y) == columns.end())
      columns.push_back(plot.y);
  }
  for (const StudyComparison& comparison : comparisons_of(outcome))
    page += comparison_part(comparison);
  page += "<h2>All points</h2>\n" + table_of(outcome, columns) + refusals(outcome);
  const std::string style = std::string(html_table_style) + "svg { width: 100%; height: auto; }\n";
  return html_page({"en", study.title, style}, page);
}

}  // namespace luxodus
