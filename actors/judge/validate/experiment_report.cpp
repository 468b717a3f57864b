#include "actors/judge/validate/experiment_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "actors/judge/validate/experiment_scene.hpp"

namespace luxodus::light {

namespace {

bool in_smoke(const Trial& trial) {
  return std::string_view(quantity_of(trial)) == "optical depth";
}

std::string number_text(double value) {
  return std::abs(value) < 0.1 ? fmt::format("{:.4f}", value) : fmt::format("{:.2f}", value);
}

std::string uncertain_text(const Uncertain& value) {
  if (!(value.error > 0)) return number_text(value.value);
  return fmt::format("{} ± {:.2f}", number_text(value.value), std::max(value.error, 0.01));
}

Json uncertain_json(const Uncertain& value) {
  return {{"value", number_json(value.value)}, {"standard_error", number_json(value.error)}};
}

Json seen_json(const TargetSeen& seen) {
  return {{"visibility_level", uncertain_json(seen.level)},
          {"difference_cd_m2", uncertain_json(seen.difference)},
          {"ground_cd_m2", uncertain_json(seen.ground)},
          {"glare_cd_m2", number_json(seen.veil_cd_m2)},
          {"detail_arcmin", number_json(seen.detail_arcmin)},
          {"threshold_over_that_of_an_endless_target", number_json(seen.size_saves)},
          {"verdict", seen.verdict}};
}

Json crossing_json(const Crossing& crossing, const std::optional<TargetSeen>& seen) {
  if (!crossing.at)
    return {{"found", false}, {"level_stays", crossing.always_above ? "above" : "below"}};
  Json out = uncertain_json(*crossing.at);
  out["there"] = seen ? seen_json(*seen) : Json(nullptr);
  return out;
}

Json trial_json(const Trial& trial, const TrialResult& result) {
  Json out = {{"trial", trial.name}, {"quantity", quantity_of(trial)}};
  out["observed"] = trial.observed ? Json{{"from", number_json(trial.observed->low)},
                                          {"to", number_json(trial.observed->high)},
                                          {"scatter", trial.scatter},
                                          {"people", trial.of_reading ? "read" : "saw"}}
                                   : Json(nullptr);
  if (trial.varied == Varied::nothing) {
    out["visibility_level"] = uncertain_json(result.level);
    return out;
  }
  out["at_level_1"] = crossing_json(result.crossings[0], result.seen[0]);
  out["at_level_7"] = crossing_json(result.crossings[1], result.seen[1]);
  out["at_observed"] = result.at_observed ? seen_json(*result.at_observed) : Json(nullptr);
  const std::string factor = luminance_factor_text(trial, result);
  out["luminance_factor"] = factor.empty() ? Json(nullptr) : Json(factor);
  out["levels_computed"] = result.levels_computed;
  return out;
}

Json experiment_json(const ExperimentResult& result) {
  const Experiment& e = result.experiment;
  Json trials = Json::array(), claims = Json::array();
  for (size_t i = 0; i < e.trials.size(); ++i)
    trials.push_back(trial_json(e.trials[i], result.trials[i]));
  for (size_t i = 0; i < e.claims.size(); ++i)
    claims.push_back({{"claim", e.claims[i].says},
                      {"verdict", name_of(result.claims[i].agreement)},
                      {"reason", result.claims[i].reason}});
  return {{"id", e.id},
          {"title", e.title},
          {"source", e.source},
          {"read", e.read},
          {"assumed", e.assumed},
          {"beers_law_alone", e.beer},
          {"trials", std::move(trials)},
          {"claims", std::move(claims)}};
}

void add_to_summary(ExperimentSummary& out, const ExperimentResult& result) {
  const Experiment& e = result.experiment;
  for (size_t i = 0; i < e.claims.size(); ++i) {
    const Agreement agreement = result.claims[i].agreement;
    out.kept += agreement == Agreement::kept;
    out.failing += agreement == Agreement::failing;
    out.not_answered += agreement == Agreement::not_answered;
    if (e.claims[i].rule != Rule::seen) continue;
    for (const size_t t : e.claims[i].trials)
      if (const auto& at = result.trials[t].at_level(level_seen).at; at && e.trials[t].observed)
        out.deviations.push_back(deviation(at->value, *e.trials[t].observed));
  }
  for (size_t t = 0; t < e.trials.size(); ++t) {
    const Trial& trial = e.trials[t];
    const TrialResult& found = result.trials[t];
    if (!trial.of_reading || !trial.observed || !found.at_observed) continue;
    const std::string name = e.id + ", " + trial.name;
    if (found.at_observed->verdict == name_of(SightVerdict::legible)) out.unsafe.push_back(name);
    const auto& read = found.at_level(level_read).at;
    if (in_smoke(trial) && read && trial.observed->low - read->value < limits::thin_margin)
      out.thin.push_back(fmt::format("{}: {:.2f}", name, trial.observed->low - read->value));
  }
}

std::string trial_line(const Trial& trial, const TrialResult& result) {
  if (trial.varied == Varied::nothing)
    return fmt::format("  {:<34} level {}\n", trial.name, uncertain_text(result.level));
  std::string out = fmt::format(
      "  {:<34} {:<14} {:<16} {:<16} {:<16}", trial.name, quantity_of(trial), observed_text(trial),
      crossing_text(result.crossings[0], trial), crossing_text(result.crossings[1], trial));
  const std::string factor = luminance_factor_text(trial, result);
  if (!factor.empty()) out += "luminance x " + factor;
  out.erase(out.find_last_not_of(' ') + 1);
  return out + "\n";
}

std::string list_text(const std::string& heading, const std::vector<std::string>& names) {
  std::string out = heading + (names.empty() ? " none" : "") + "\n";
  for (const std::string& name : names) out += "  " + name + "\n";
  return out;
}

}  // namespace

const Crossing& compared(const Trial& trial, const TrialResult& result) {
  return result.at_level(trial.of_reading ? level_read : level_seen);
}

std::string crossing_text(const Crossing& crossing, const Trial& trial) {
  if (trial.varied == Varied::nothing) return "";
  if (crossing.at) return uncertain_text(*crossing.at);
  // Contrast makes a target clearer, smoke and distance make it fainter.
  const bool beyond = crossing.always_above != (trial.varied == Varied::contrast);
  return beyond ? fmt::format("above {:g}", trial.searched.high)
                : fmt::format("below {:g}", trial.searched.low);
}

std::string observed_text(const Trial& trial) {
  if (!trial.observed) return "";
  const std::string low = number_text(trial.observed->low);
  return trial.observed->high > trial.observed->low
             ? low + " to " + number_text(trial.observed->high)
             : low;
}

std::string luminance_factor_text(const Trial& trial, const TrialResult& result) {
  const Crossing& found = compared(trial, result);
  if (!in_smoke(trial) || !trial.observed || !found.at) return "";
  return fmt::format("{:.2g}", std::exp(deviation(found.at->value, *trial.observed)));
}

ExperimentSummary summary_of(const std::vector<ExperimentResult>& results) {
  ExperimentSummary out;
  for (const ExperimentResult& result : results) add_to_summary(out, result);
  out.mean_seen = mean_seen_agrees(out.deviations);
  return out;
}

std::string experiments_text(const std::vector<ExperimentResult>& results) {
  std::string out;
  for (const ExperimentResult& result : results) {
    const Experiment& e = result.experiment;
    out += fmt::format("{}  {}\n  {}\n", e.id, e.title, e.source);
    out += fmt::format("  {:<34} {:<14} {:<16} {:<16} {:<16}\n", "trial", "quantity", "observed",
                       "seen (level 1)", "read (level 7)");
    for (size_t i = 0; i < e.trials.size(); ++i) out += trial_line(e.trials[i], result.trials[i]);
    for (size_t i = 0; i < e.claims.size(); ++i)
      out += fmt::format("  {:<12} {}: {}\n", name_of(result.claims[i].agreement), e.claims[i].says,
                         result.claims[i].reason);
  }
  const ExperimentSummary summary = summary_of(results);
  out += fmt::format("{} claims kept, {} failing, {} not answered\n", summary.kept, summary.failing,
                     summary.not_answered);
  out += fmt::format("mean difference of what is seen: {} ({})\n", summary.mean_seen.reason,
                     name_of(summary.mean_seen.agreement));
  out += list_text("legible by the program where people stop reading:", summary.unsafe);
  out += list_text("reading promised to within 0.7 in optical depth of that:", summary.thin);
  return out;
}

Json experiments_json(const std::vector<ExperimentResult>& results,
                      const ExperimentRecord& record) {
  const ExperimentSummary summary = summary_of(results);
  Json experiments = Json::array();
  for (const ExperimentResult& result : results) experiments.push_back(experiment_json(result));
  return {
      {"passed", summary.passed()},
      {"interrupted", record.interrupted},
      {"seed", record.options.seed},
      {"rounds", record.options.rounds},
      {"repeats_at_most", record.options.max_repeats},
      {"relative_error_of_levels", record.options.level_error},
      {"only", record.only},
      {"kept", summary.kept},
      {"failing", summary.failing},
      {"not_answered", summary.not_answered},
      {"mean_difference_of_seen",
       {{"verdict", name_of(summary.mean_seen.agreement)}, {"reason", summary.mean_seen.reason}}},
      {"legible_where_people_stop_reading", summary.unsafe},
      {"reading_promised_with_a_thin_margin", summary.thin},
      {"experiments", std::move(experiments)}};
}

Result<void> write_experiments(const std::filesystem::path& folder,
                               const std::vector<ExperimentResult>& results,
                               const ExperimentRecord& record) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return system_problem(folder, "cannot make this folder", error.value());
  if (auto ok = write_json(folder / "experiments.json", experiments_json(results, record)); !ok)
    return ok.problem();
  if (auto ok = write_svg_plot(folder / "experiments.svg", experiments_plot(results)); !ok)
    return ok.problem();
  const std::string page = experiments_page(results, record);
  return write_file_atomically(folder / "experiments.md", std::string_view(page));
}

}  // namespace luxodus::light
