// The page of experiments in Markdown, and its plot. Its numbers are those of the run; what is said
// of them in words is in experiment_words.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "actors/judge/validate/experiment_report.hpp"
#include "actors/judge/validate/experiment_scene.hpp"
#include "actors/judge/validate/experiment_words.hpp"

namespace luxodus::light {

namespace {

/// Width of the page's text, as of all documents [columns].
constexpr size_t page_columns = 100;

/// The words of a text in lines of at most page_columns; lines after the first begin with `indent`.
std::string filled(const std::string& text, const std::string& indent = "") {
  std::string out;
  size_t column = 0, at = 0;
  while (at < text.size()) {
    const size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    at = end + 1;
    if (word.empty()) continue;
    if (column > 0 && column + 1 + word.size() > page_columns) {
      out += "\n" + indent;
      column = indent.size();
    } else if (column > 0) {
      out += " ";
      ++column;
    }
    out += word;
    column += word.size();
  }
  return out + "\n";
}

std::string item(const std::string& text) {
  return filled("- " + text, "  ");
}

std::string luminance_text(const Uncertain& value) {
  return fmt::format("{:.2g}", std::abs(value.value));
}

// ---- one experiment ----------------------------------------------------------------------------

std::string thresholds_table(const ExperimentResult& result) {
  const std::vector<Trial>& trials = result.experiment.trials;
  std::string out =
      "| trial | observed | its scatter | seen (level 1) | read (level 7) | luminance factor | "
      "verdict at the observed threshold |\n|---|---|---|---|---|---|---|\n";
  for (size_t i = 0; i < trials.size(); ++i) {
    const Trial& trial = trials[i];
    const TrialResult& found = result.trials[i];
    out += fmt::format(
        "| {} | {} | {} | {} | {} | {} | {} |\n", trial.name, observed_text(trial), trial.scatter,
        crossing_text(found.crossings[0], trial), crossing_text(found.crossings[1], trial),
        luminance_factor_text(trial, found), found.at_observed ? found.at_observed->verdict : "");
  }
  return out;
}

std::string levels_table(const ExperimentResult& result) {
  std::string out = "| trial | visibility level of the detail |\n|---|---|\n";
  const std::vector<Trial>& trials = result.experiment.trials;
  for (size_t i = 0; i < trials.size(); ++i)
    out += fmt::format("| {} | {:.2f} |\n", trials[i].name, result.trials[i].level.value);
  return out;
}

/// What limits the eye at the threshold of seeing.
std::string limits_table(const ExperimentResult& result) {
  const std::vector<Trial>& trials = result.experiment.trials;
  std::string out =
      "| trial | detail [arcmin] | ground at the eye [cd/m2] | difference at the eye [cd/m2] | an "
      "endless target would gain |\n|---|---|---|---|---|\n";
  for (size_t i = 0; i < trials.size(); ++i) {
    if (!result.trials[i].seen[0]) continue;
    const TargetSeen& seen = *result.trials[i].seen[0];
    out += fmt::format("| {} | {:.1f} | {} | {} | {:.2f} |\n", trials[i].name, seen.detail_arcmin,
                       luminance_text(seen.ground), luminance_text(seen.difference),
                       std::log(seen.size_saves));
  }
  return out;
}

std::string claims_table(const ExperimentResult& result) {
  std::string out = "| claim | verdict | value |\n|---|---|---|\n";
  for (size_t i = 0; i < result.claims.size(); ++i)
    out += fmt::format("| {} | {} | {} |\n", result.experiment.claims[i].says,
                       name_of(result.claims[i].agreement), result.claims[i].reason);
  return out;
}

// ---- all ---------------------------------------------------------------------------------------

std::string summary_part(const std::vector<ExperimentResult>& results) {
  const ExperimentSummary summary = summary_of(results);
  std::string out = "## Summary\n\n";
  out += "| experiment | kept | failing | not answered |\n|---|---|---|---|\n";
  for (const ExperimentResult& result : results) {
    const ExperimentSummary one = summary_of({result});
    out += fmt::format("| {}: {} | {} | {} | {} |\n", result.experiment.id, result.experiment.title,
                       one.kept, one.failing, one.not_answered);
  }
  out += fmt::format("| all claims | {} | {} | {} |\n\n", summary.kept, summary.failing,
                     summary.not_answered);
  out += filled(fmt::format(
      "Mean difference of {} thresholds of seeing from the observed ones: {} "
      "({}).",
      summary.deviations.size(), summary.mean_seen.reason, name_of(summary.mean_seen.agreement)));
  out += "\n" + filled(fmt::format("Rule U: the program says \"legible\" where people stop reading "
                                   "in {} trials.",
                                   summary.unsafe.size()));
  if (!summary.unsafe.empty()) out += "\n";
  for (const std::string& name : summary.unsafe) out += item(name);
  if (!summary.thin.empty()) {
    out += "\n" +
           filled(
               "Reading is promised with a margin of less than 0.7 in optical depth, a "
               "factor of 2 in luminance, before people stop reading:") +
           "\n";
    for (const std::string& name : summary.thin) out += item(name);
  }
  return out + "\n";
}

std::string failing_part(const std::vector<ExperimentResult>& results) {
  std::string out = "## What fails\n\n";
  bool any = false;
  for (const ExperimentResult& result : results)
    for (size_t i = 0; i < result.claims.size(); ++i) {
      if (result.claims[i].agreement != Agreement::failing) continue;
      out += item(fmt::format("**{}**, {}: {}.", result.experiment.id,
                              result.experiment.claims[i].says, result.claims[i].reason));
      any = true;
    }
  if (!any) out += "Nothing.\n";
  return out + "\n";
}

}  // namespace

std::string experiment_section(const ExperimentResult& result) {
  const Experiment& e = result.experiment;
  std::string out = fmt::format("### {}: {}\n\n", e.id, e.title);
  out += item("Source: " + e.source + ".");
  out += item("Read: " + e.read);
  for (const std::string& one : e.assumed) out += item("Assumed: " + one);
  if (!e.beer.empty()) out += item("Beer's law alone: " + e.beer);
  const bool levels = !e.trials.empty() && e.trials.front().varied == Varied::nothing;
  out += "\n";
  if (levels) {
    out += levels_table(result);
  } else {
    out += filled(fmt::format("Thresholds: {}.", quantity_of(e.trials.front()))) + "\n";
    out += thresholds_table(result) + "\nAt the threshold of seeing:\n\n" + limits_table(result);
  }
  return out + "\n" + claims_table(result) + "\n";
}

SvgPlot experiments_plot(const std::vector<ExperimentResult>& results) {
  constexpr double from = 0, to = 24;
  SvgPlot plot;
  plot.title = "Optical depth at the threshold: the program over people";
  plot.subtitle =
      "Bars: standard error and half of the observed interval. Lines: equal, and ±0.7, a factor of "
      "2 in luminance";
  plot.label_x = "observed optical depth";
  plot.label_y = "predicted optical depth";
  const auto line = [&](const std::string& name, double by) {
    plot.series.push_back({name, {from, to}, {from + by, to + by}, {}, true, false});
  };
  line("equal", 0);
  line("+0.7", limits::seen_within);
  line("−0.7", -limits::seen_within);
  for (const ExperimentResult& result : results) {
    for (const double level : threshold_levels) {
      PlotSeries series{result.experiment.id + (level == level_seen ? " seen" : " read"),
                        {},
                        {},
                        {},
                        false,
                        true};
      for (size_t i = 0; i < result.trials.size(); ++i) {
        const Trial& trial = result.experiment.trials[i];
        const auto& at = result.trials[i].at_level(level).at;
        const bool shown = level == level_seen || trial.of_reading;
        if (!shown || !at || !trial.observed || trial.varied == Varied::nothing) continue;
        if (std::string_view(quantity_of(trial)) != "optical depth") continue;
        series.x.push_back(trial.observed->middle());
        series.y.push_back(at->value);
        series.error.push_back(
            std::hypot(at->error, (trial.observed->high - trial.observed->low) / 2));
      }
      if (!series.x.empty()) plot.series.push_back(std::move(series));
    }
  }
  return plot;
}

std::string experiments_page(const std::vector<ExperimentResult>& results,
                             const ExperimentRecord& record) {
  std::string out = experiments_opening;
  out += summary_part(results);
  out += "![Optical depth at the threshold: the program over people](experiments.svg)\n\n";
  out += failing_part(results);
  out += experiments_findings;
  out += "## The experiments\n" + std::string(experiments_legend);
  for (const ExperimentResult& result : results) out += experiment_section(result);
  out += experiments_objections;
  out += "\n" + filled(fmt::format(
                    "Made by `luxodus validate --experiments{}`, seed {}; levels near a threshold "
                    "are known to {:g} %{}.",
                    record.only.empty() ? "" : " --only \"" + record.only + "\"",
                    record.options.seed, 100 * record.options.level_error,
                    record.interrupted ? "; interrupted: later experiments are missing" : ""));
  return out;
}

}  // namespace luxodus::light
