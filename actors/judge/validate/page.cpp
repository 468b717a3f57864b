// The page of a validation: the verdict and its rule, the distribution of z, and every case with
// its quantities and the course of its error. It is one file, including drawings.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "actors/judge/validate/validation_report.hpp"
#include "actors/results/formats/html_page.hpp"
#include "actors/results/formats/svg_plot.hpp"
#include "runtime/core/output_text.hpp"

namespace luxodus::light {

namespace {

constexpr const char* title = "How accurate Luxodus is";
constexpr const char* style =
    "td:first-child, th:first-child { text-align: left; }\n"
    "tr.failed, p.failed { background: #fbb; } p.passed { background: #bfb; }\n"
    "tr.rare { color: #888; }\n"
    "p.passed, p.failed { padding: 0.5rem; font-size: 1.2rem; }\n"
    "svg.large { max-width: 44rem; height: auto; } svg.small { vertical-align: middle; }\n"
    "summary { cursor: pointer; margin: 0.3rem 0; }\n";

std::string limit_text(const SuiteRecord& record, size_t short_of_error) {
  if (!std::isfinite(record.case_seconds)) return "";
  return fmt::format(
      ", each case for {:g} s at most: {} of them would have needed longer, and say so",
      record.case_seconds, short_of_error);
}

std::string verdict_part(const Verdict& verdict, const SuiteRecord& record,
                         const std::vector<CaseResult>& results) {
  const size_t short_of_error = cases_short_of_error(results);
  std::string out = fmt::format(
      "<p class=\"{0}\">{1}: {2} statistical and {3} computed quantities, {4} out of bounds.</p>\n",
      verdict.passed ? "passed" : "failed", verdict.passed ? "Passed" : "Failed",
      verdict.statistical, verdict.computed, verdict.failed);
  const std::string how = record.error > 0
                              ? fmt::format("to a relative standard error of {:g} %{}",
                                            100 * record.error, limit_text(record, short_of_error))
                              : std::string("quickly");
  out += fmt::format("<p>Run {}, seed {}, {} threads{}{}.</p>\n", how, record.seed, record.threads,
                     record.only.empty() ? "" : ", only " + xml_escape(record.only),
                     record.interrupted ? "; interrupted: later cases are missing" : "");
  out += "<p>" + precision_text(precision_of(results, record.wanted_error())) + ".</p>\n";
  out += "<h2>The rule, written down beforehand</h2>\n<ul>\n";
  for (const std::string& sentence : rule_text()) out += "<li>" + xml_escape(sentence) + "</li>\n";
  out += "</ul>\n<table>\n<tr><th>test</th><th>found</th><th>allowed</th><th></th></tr>\n";
  for (const OverallTest& c : verdict.checks)
    out += fmt::format("<tr class=\"{}\"><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                       c.passed ? "" : "failed", c.name, c.found, c.allowed,
                       c.passed ? "passed" : "failed");
  return out + "</table>\n";
}

// ---- the distribution of z ---------------------------------------------------------------------

/// Shares of z in steps of half a standard deviation, against the normal curve.
SvgPlot histogram_of(const std::vector<double>& z) {
  constexpr double step = 0.5, most = 5;
  SvgPlot plot;
  plot.title = "Distances from the references, in standard errors";
  plot.label_x = "z";
  plot.label_y = "density";
  PlotSeries found{"found", {}, {}, {}, true, false};
  PlotSeries normal{"normal", {}, {}, {}, true, false};
  for (double low = -most; low < most; low += step) {
    const auto in = [&](double v) { return v >= low && v < low + step; };
    const double density = static_cast<double>(std::count_if(z.begin(), z.end(), in)) /
                           (static_cast<double>(z.size()) * step);
    for (const double x : {low, low + step}) {
      found.x.push_back(x);
      found.y.push_back(density);
    }
  }
  for (double x = -most; x <= most; x += 0.1) {
    normal.x.push_back(x);
    normal.y.push_back(std::exp(-0.5 * x * x) / std::sqrt(2 * std::numbers::pi));
  }
  plot.series = {std::move(found), std::move(normal)};
  return plot;
}

std::string sample_row(const std::string& name, const Sample& s, size_t count) {
  return fmt::format(
      "<tr><td>{}</td><td>{}</td><td>{:+.3f}</td><td>{:.3f}</td><td>{:.3f}</td><td>{:.3g}</td>"
      "</tr>\n",
      name, count, s.mean, s.variance, s.distance, s.probability);
}

Result<std::string> distribution_part(const Verdict& verdict) {
  std::string out = "<h2>How z is distributed</h2>\n";
  if (verdict.z.empty()) return out + "<p>Nothing here is a matter of chance.</p>\n";
  const auto svg = svg_plot_text(histogram_of(verdict.z), {"validate.html", 0});
  if (!svg) return svg.problem();
  const size_t from = svg->find("<svg");
  out += "<svg class=\"large\"" + svg->substr(from + 4);
  out +=
      "<table>\n<tr><th>z of</th><th>count</th><th>mean</th><th>variance</th>"
      "<th>distance</th><th>p</th></tr>\n";
  out +=
      sample_row("all quantities (those of a case are correlated)", verdict.all, verdict.z.size());
  out += sample_row("one quantity of each case (judged)", verdict.leads, verdict.lead_count);
  out += "</table>\n";
  return out + fmt::format("<p>The largest: {:+.2f}, {}.</p>\n", verdict.z_largest,
                           xml_escape(verdict.z_largest_of));
}

// ---- cases -------------------------------------------------------------------------------------

/// Standard error (line) and deviation (dots) over particles or seconds, decades on both axes.
std::string course_drawing(const std::vector<CoursePoint>& course, bool by_seconds) {
  constexpr double width = 220, height = 120, margin = 14;
  std::vector<std::pair<double, double>> error, deviation;
  double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
  for (const CoursePoint& p : course) {
    const double x = std::log10(by_seconds ? p.seconds : static_cast<double>(p.particles));
    for (const bool is_error : {true, false}) {
      const double y = std::log10(is_error ? p.standard_error : p.deviation);
      if (!std::isfinite(x) || !std::isfinite(y)) continue;
      (is_error ? error : deviation).emplace_back(x, y);
      x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
    }
  }
  if (error.size() < 2) return "";
  const auto at = [&](const std::pair<double, double>& p) {
    const double x = margin + (width - 2 * margin) * (p.first - x0) / std::max(1e-9, x1 - x0);
    const double y =
        height - margin - (height - 2 * margin) * (p.second - y0) / std::max(1e-9, y1 - y0);
    return std::pair(x, y);
  };
  std::string out = fmt::format(
      "<svg class=\"small\" xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\" "
      "stroke=\"#bbb\"/>\n<polyline fill=\"none\" stroke=\"#06c\" stroke-width=\"1.5\" points=\"",
      width, height);
  for (const auto& p : error) out += fmt::format("{:.1f},{:.1f} ", at(p).first, at(p).second);
  out += "\"/>\n";
  for (const auto& p : deviation)
    out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\" fill=\"#c30\"/>\n",
                       at(p).first, at(p).second);
  const auto label = [&](double x, double y, const char* anchor, const std::string& text) {
    out += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"9\" text-anchor=\"{}\">{}</text>\n", x,
                       y, anchor, text);
  };
  label(width - 2, height - 3, "end",
        by_seconds ? fmt::format("{} to {} s", readable_number(std::pow(10, x0), 2),
                                 readable_number(std::pow(10, x1), 2))
                   : fmt::format("{} to {} particles", readable_number(std::pow(10, x0), 2),
                                 readable_number(std::pow(10, x1), 2)));
  label(2, 10, "start",
        fmt::format("{} % to {} %", readable_number(100 * std::pow(10, y1), 2),
                    readable_number(100 * std::pow(10, y0), 2)));
  return out + "</svg>\n";
}

std::string finding_row(const QuantityResult& f, const QuantityVerdict& j,
                        const CaseResult& result) {
  const bool failed = j.judgement == Judgement::failed, rare = j.judgement == Judgement::rare;
  const auto number = [](double v, int digits) {
    return std::isfinite(v) ? readable_number(v, digits) : std::string();
  };
  const double merit = figure_of_merit(f, result.seconds);
  const double difference = f.estimate.value - f.reference;
  return fmt::format(
      "<tr class=\"{}\"><td>{}{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
      "<td>{}</td><td>{}</td><td>{}</td></tr>\n",
      failed ? "failed"
      : rare ? "rare"
             : "",
      xml_escape(f.quantity), j.lead ? " *" : "", number(f.reference, 7),
      number(f.estimate.value, 7),
      f.statistical ? number(f.estimate.standard_error, 2) : std::string("none"),
      std::isfinite(j.z) ? fmt::format("{:+.2f}", j.z) : std::string(),
      f.reference != 0 ? fmt::format("{:+.4f} %", 100 * difference / f.reference) : std::string(),
      number(f.bias, 2), merit > 0 ? number(merit, 3) : std::string(),
      failed ? "failed"
      : rare ? "too rare"
             : "passed");
}

std::string case_part(const CaseResult& result, const std::vector<QuantityVerdict>& judged) {
  const bool failed = std::any_of(judged.begin(), judged.end(), [](const QuantityVerdict& j) {
    return j.judgement == Judgement::failed;
  });
  double largest = 0;
  for (const QuantityVerdict& j : judged)
    if (std::abs(j.z) > largest) largest = std::abs(j.z);
  std::string facts = fmt::format("{} quantities", result.findings.size());
  if (result.particles > 0)
    facts += fmt::format(", {} particles, {:.2f} s, largest |z| {:.2f}, slope {:.2f}",
                         readable_number(static_cast<double>(result.particles)), result.seconds,
                         largest, result.slope_particles);
  std::string out =
      fmt::format("<details{}><summary><b>{}</b>{}: {}</summary>\n", failed ? " open" : "",
                  xml_escape(result.name), failed ? " FAILED" : "", facts);
  out += "<p>Reference: " + xml_escape(result.source) + ".";
  if (result.short_of > 1)
    out += fmt::format(
        " Ended before all quantities had the error: {} times as many particles "
        "would bring it.",
        readable_number(result.short_of, 2));
  if (std::isfinite(result.slope_particles)) {
    out += fmt::format(
        " Slope of the standard error: {:.3f} over particles, {:.3f} over seconds (Monte Carlo: "
        "-0.5); of the deviation, which is a matter of chance: {:.2f} over particles.",
        result.slope_particles, result.slope_seconds, result.slope_deviation);
  }
  out += "</p>\n" + course_drawing(result.course, false) + course_drawing(result.course, true);
  out +=
      "<table>\n<tr><th>quantity</th><th>reference</th><th>result</th><th>standard error</th>"
      "<th>z</th><th>relative error</th><th>declared bias or tolerance</th>"
      "<th>merit [1/s]</th><th></th></tr>\n";
  for (size_t i = 0; i < result.findings.size(); ++i)
    out += finding_row(result.findings[i], judged[i], result);
  return out + "</table>\n</details>\n";
}

}  // namespace

Result<std::string> suite_page(const std::vector<CaseResult>& results, const Verdict& verdict,
                               const SuiteRecord& record) {
  std::string page = fmt::format("<h1>{}</h1>\n", title) + verdict_part(verdict, record, results);
  const auto distribution = distribution_part(verdict);
  if (!distribution) return distribution.problem();
  page += distribution.value();
  page +=
      "<h2>Cases</h2>\n<p>A star marks the quantity that stands for its case. Drawings: relative "
      "standard error (blue) and deviation from the references (red dots), root mean squares over "
      "the case's quantities, over particles and over seconds, both axes logarithmic. The merit is "
      "1 / (relative error<sup>2</sup> &times; seconds).</p>\n";
  if (const Slopes slopes = slopes_of(results); std::isfinite(slopes.deviation))
    page += fmt::format(
        "<p>Over all cases together standard errors fall with particles by a slope of {:.3f}, "
        "deviations from the references by {:.3f} (Monte Carlo: -0.5).</p>\n",
        slopes.standard_error, slopes.deviation);
  std::string group;
  for (size_t i = 0; i < results.size(); ++i) {
    if (results[i].group != group) page += "<h3>" + xml_escape(results[i].group) + "</h3>\n";
    group = results[i].group;
    page += case_part(results[i], verdict.judged[i]);
  }
  return html_page({"en", title, std::string(html_table_style) + style}, page);
}

}  // namespace luxodus::light
