// luxodus assess, compare: assesses signs and routes, as data and as a report.
#include "actors/apps/cli/assess_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "actors/apps/cli/assess_pictures.hpp"
#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/findings.hpp"
#include "actors/apps/cli/load_scene.hpp"
#include "actors/apps/cli/nodes_option.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/apps/cli/quantities.hpp"
#include "actors/apps/cli/report_options.hpp"
#include "actors/apps/cli/signals.hpp"
#include "actors/apps/cli/version.hpp"
#include "actors/apps/cli/visibility_map_options.hpp"
#include "actors/cast/process/in_process.hpp"
#include "actors/judge/assess/assessment_files.hpp"
#include "actors/judge/assess/check_words.hpp"
#include "actors/judge/assess/compare.hpp"
#include "actors/judge/assess/guidance_words.hpp"
#include "actors/judge/assess/over_time.hpp"
#include "actors/judge/assess/record_assessment.hpp"
#include "actors/judge/assess/state_words.hpp"
#include "actors/judge/assess/threshold_words.hpp"
#include "actors/judge/thresholds/thresholds.hpp"
#include "actors/results/formats/file_names.hpp"
#include "actors/results/formats/output_folder.hpp"
#include "runtime/core/log.hpp"
#include "scenes/emergency/rule_table.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct AssessCommandOptions {
  std::string scene;
  std::string out;
  AssessOptions assess;
  std::string place = "known";
  std::vector<std::string> find;
  int nodes = 0;
  std::vector<std::string> at;
  bool codes_alone = false;
  bool strict = false;
  bool overwrite = false;
  bool no_pictures = false;
  ReportWords report;
  MapWords map;
};

std::string ids_of(std::span<const NamedRules> rows) {
  std::string out;
  for (const NamedRules& row : rows) out += (out.empty() ? "" : ", ") + std::string(row.id);
  return out;
}

/// Prints in a line a check that fails, or whose limit was not measured.
void print_check(const Check& check) {
  if (check.verdict == CheckVerdict::fail)
    std::printf("  fails: %s\n", check_words(check).c_str());
  else
    std::printf("  not verified: %s: %s\n", check_words(check).c_str(),
                english().remarks(check.reasons).c_str());
}

/// Views of signs behind people on routes, which are read after turning round.
std::string behind_words(const AssessmentRecord& a) {
  size_t behind = 0, legible = 0;
  for (const SightRecord& sight : a.sights) {
    if (!(sight.from_gaze_deg > 90)) continue;
    ++behind;
    legible += sight.verdict == SightVerdict::legible ? 1 : 0;
  }
  if (behind == 0) return "";
  return fmt::format("of these {} views are of signs behind the walkers, {} of them legible",
                     behind, legible);
}

/// Whether where signs hang decides a check.
bool is_of_placed_signs(const Check& check) {
  return check.rule.id != RuleId::none &&
         row_of(check.rule.id).decided_by == DecidedBy::placed_signs;
}

void print_summary(const AssessmentRecord& a) {
  std::printf("%s\n%s%s\n", a.verdict.first.c_str(), state_text(a).c_str(),
              a.verdict.words.c_str());
  for (const CheckVerdict verdict : {CheckVerdict::fail, CheckVerdict::not_verified})
    for (const Check& check : a.checks)
      if (check.verdict == verdict) print_check(check);
  for (const Check& check : a.checks)
    if (check.verdict == CheckVerdict::pass && is_of_placed_signs(check) && !check.reasons.empty())
      std::printf("  passes, but: %s: %s\n", check_words(check).c_str(),
                  english().remarks(check.reasons).c_str());
  std::string seen;
  for (const auto& [word, count] : a.sight_counts)
    seen += fmt::format("{}{} {}", seen.empty() ? "" : ", ", count, word);
  if (!seen.empty()) std::printf("signs, from routes and areas: %s\n", seen.c_str());
  if (const std::string behind = behind_words(a); !behind.empty())
    std::printf("%s\n", behind.c_str());
  if (a.over_time) std::printf("%s", guidance_text(*a.over_time).c_str());
  std::printf("%s", thresholds_text(a.thresholds).c_str());
}

/// Estimates the remaining time from the work done.
class Estimate {
 public:
  std::string left(double share) const {
    const double passed =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
    if (!(share > 0.01 && share < 1) || passed < 1) return "";
    return ", about " + time_text(passed * (1 - share) / share) + " left";
  }

 private:
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

/// All thresholds that the job asks for. Errors: as find_thresholds; the interrupt flag.
Result<ThresholdRows> thresholds_of(const AssessmentJob& job, const Assessment& assessed,
                                    ProgressLine& line) {
  if (job.find.empty()) return ThresholdRows{};
  const auto scenario = judged_scenario(*job.scene, job.options.scenario);
  if (!scenario) return scenario.problem();
  const AssessProgress told = [&](const std::string& what, double share) {
    line.put(fmt::format("{}: {:.0f} %", what, 100 * share), false, share);
  };
  return find_thresholds(
      {*job.scene, scenario.value(), assessed, job.options, interrupt_flag(), told}, job.find);
}

/// The given options that a map has no use for: "--strict, --rules"; "" if there is none.
std::string of_assessments_alone(const AssessCommandOptions& options) {
  const ReportWords usual;
  const std::pair<bool, const char*> given[] = {
      {options.codes_alone, "--codes-alone"},
      {!options.find.empty(), "--find"},
      {!options.assess.smoke_factors.empty(), "--smoke-scale"},
      {!options.assess.rules.empty(), "--rules"},
      {!options.assess.deviations.empty(), "--deviation"},
      {options.strict, "--strict"},
      {options.no_pictures, "--no-pictures"},
      {options.report.language != usual.language, "--language"},
      {options.report.paper != usual.paper, "--paper"},
      {options.report.grid_values, "--grid-values"},
      {options.report.pdf, "--pdf"}};
  std::string out;
  for (const auto& [is_given, name] : given)
    if (is_given) out += (out.empty() ? "" : ", ") + std::string(name);
  return out;
}

/// Errors: options of an assessment that a map has not; as map_into.
Result<ExitCode> map_scene(const AssessCommandOptions& options, const AssessedStates& states) {
  if (const std::string others = of_assessments_alone(options); !others.empty())
    return problem("--visibility-map is made instead of the assessment: take " + others + " away");
  AssessOptions asked = options.assess;
  asked.place_unknown = options.place == "unknown";
  const auto nodes = nodes_that_trace(options.nodes);
  asked.executor = nodes.get();
  const fs::path folder = options.out.empty()
                              ? fs::path("out") / file_name_of(states.last->name + "-map")
                              : fs::path(options.out);
  MapWords words = options.map;
  words.overwrite = options.overwrite;
  install_interrupt_handler();
  return map_into(folder,
                  {states.last, states.times,
                   reader_at_times(*states.last, options.scene, FireFrames::nearest)},
                  asked, words);
}

Result<ExitCode> assess_scene(const AssessCommandOptions& options) {
  const auto states = assessed_states(options.scene, times_asked(options.at));
  const auto& scene = states.last;
  if (!scene) return exit_code_of(states.told);
  if (options.map.wanted) return map_scene(options, states);
  AssessmentJob job;
  job.scene = scene;
  job.scene_file = options.scene;
  job.times = states.times;
  job.folder = options.out.empty() ? fs::path("out") / file_name_of(scene->name + "-assessed")
                                   : fs::path(options.out);
  job.options = options.assess;
  job.overwrite = options.overwrite;
  job.strict = options.strict;
  job.report = options.report;
  job.pictures = !options.codes_alone && !options.no_pictures;
  install_interrupt_handler();
  job.options.reality = !options.codes_alone;
  job.options.place_unknown = options.place == "unknown";
  if (options.codes_alone && !options.find.empty())
    return problem(
        "--find looks for thresholds of sight, which --codes-alone leaves out: take one "
        "of the two away");
  for (const std::string& word : options.find) {
    const auto at = std::find(sought_words.begin(), sought_words.end(), word);
    job.find.push_back(static_cast<Sought>(at - sought_words.begin()));
  }
  const auto nodes = nodes_that_trace(options.nodes);
  job.options.executor = nodes.get();
  return assess_into(job);
}

Result<ExitCode> compare_folders(const std::string& before, const std::string& after,
                                 const std::string& json) {
  const auto a = read_assessment(before);
  if (!a) return a.problem();
  const auto b = read_assessment(after);
  if (!b) return b.problem();
  const Comparison comparison = comparison_of(a.value(), b.value());
  std::printf("%s", comparison_text(comparison).c_str());
  if (!json.empty())
    if (auto ok = write_json(behind_links(json), comparison_json(comparison)); !ok)
      return ok.problem();
  return ExitCode::success;
}

}  // namespace

AssessedStates assessed_states(const std::string& file, std::vector<double> times) {
  AssessedStates out{std::move(times), nullptr};
  const auto load = [&](std::optional<double> time) {
    const LoadedScene loaded =
        load_scene(file, ReadingWarnings::left_to_inspection, time, FireFrames::nearest);
    out.last = loaded.scene;
    out.told = loaded.told;
  };
  if (out.times.empty()) {
    load(std::nullopt);
    if (out.last && out.last->time) out.times = times_of(*out.last->time);
    if (out.times.size() < 2) return out;
  }
  load(out.times.back());
  return out;
}

Option scenario_option(AssessOptions& options) {
  return {"--scenario",
          &options.scenario,
          "State of the building",
          {.form = Form::name,
           .otherwise = "the scenario in emergency operation, with smoke where any has it; none is "
                        "guessed"}};
}

Option rounds_option(AssessOptions& options) {
  return {"--rounds",
          &options.rounds,
          "Largest number of rounds of paths, each of four times as many, for what is undecided",
          {.range = Range{1, limits::sight_rounds}}};
}

Option place_option(std::string& place) {
  return {"--place",
          &place,
          "Whether people know where the signs are; a sign of unknown place is seen at 5 times the "
          "contrast",
          {.choices = {"known", "unknown"}}};
}

Result<ExitCode> assess_into(const AssessmentJob& job) {
  const OutputPlan plan{
      {"report.html", "report.pdf", "assessment.json", "checks.csv", "sights.csv", "guided.csv",
       "thresholds.csv", "by_guid.csv", "property_sets.csv", "issues.bcf"},
      {"plans", "schedules", "views"}};
  const auto out = OutputFolder::claim(job.folder, plan);
  if (!out) return out.problem();
  if (!job.overwrite)
    if (auto ok = refuse_files_of_others(out->path(), plan.files); !ok) return ok.problem();
  ProgressLine line("assess");
  std::optional<Estimate> estimate;  // over all times
  auto assessed = assess_states(
      {job.scene, job.times, reader_at_times(*job.scene, job.scene_file, FireFrames::nearest)},
      job.options, interrupt_flag(),
      [&](const std::string& what, double share) {
        line.put(fmt::format("{}: {:.0f} %", what, 100 * share), share >= 1, share);
      },
      [&](const std::string& what, double share) {
        if (!estimate) estimate.emplace();
        line.put(fmt::format("{}: {:.0f} %{}", what, 100 * share, estimate->left(share)),
                 share >= 1, share);
      });
  if (!assessed) {
    if (!interrupt_flag()) return assessed.problem();
    log_warning("interrupted; nothing was written");
    return ExitCode::interrupted;
  }
  tell_findings(assessed->findings);
  for (const StateWarning& one : assessed->warnings) {
    if (one.by_inspection) continue;  // told above
    warn(problem_in(one.place, one.remark ? english().remark(*one.remark) : one.words));
  }
  AssessmentRecord record = record_of(*job.scene, assessed.value(), build.version);
  auto thresholds = thresholds_of(job, assessed.value(), line);
  if (!thresholds) {
    if (!interrupt_flag()) return thresholds.problem();
    log_warning("interrupted; nothing was written");
    return ExitCode::interrupted;
  }
  record.thresholds = std::move(thresholds).value();
  if (auto ok = write_assessment(out->path(), record); !ok) return ok.problem();
  print_summary(record);
  if (job.pictures) {
    if (auto ok = picture_state(job, out->path()); !ok) return ok.problem();
    if (interrupt_flag()) return ExitCode::interrupted;
  }
  if (auto ok = write_report_and_tell(out.value(), record, job.report); !ok) return ok.problem();
  return job.strict && anything_open(record) ? ExitCode::failure : ExitCode::success;
}

Command assess_command() {
  const auto o = std::make_shared<AssessCommandOptions>();
  o->assess.threads = default_threads();
  Command command{
      .name = "assess",
      .summary = "Assess signs and escape routes, by the codes and in smoke",
      .heading = "Assess",
      .options =
          {{"scene", &o->scene, "Scene file", {.form = Form::scene, .required = true}},
           scenario_option(o->assess),
           times_option(o->at),
           {"--out",
            &o->out,
            "Folder of the results",
            {.form = Form::folder, .otherwise = "out/NAME-assessed"}},
           {"--rules",
            &o->assess.rules,
            "Rule sets: " + ids_of(rule_sets()),
            {.form = Form::name, .otherwise = "those of the scene", .comma_separated = true}},
           {"--deviation",
            &o->assess.deviations,
            "National deviations from the rule sets: " + ids_of(deviations()),
            {.form = Form::name, .otherwise = "those of the scene", .comma_separated = true}},
           {"--seed", &o->assess.seed, "Seed of the random number generator"},
           threads_option(o->assess.threads),
           nodes_option(o->nodes),
           rounds_option(o->assess),
           {"--smoke-scale",
            &o->assess.smoke_factors,
            "Factors of a sweep: signs are assessed again with all smoke times each of them",
            {.range = Range{0, 1e6}, .comma_separated = true}},
           {"--find",
            &o->find,
            "Thresholds at which each sign is just read and just seen, from each place",
            {.choices = {sought_words.begin(), sought_words.end()}, .comma_separated = true}},
           place_option(o->place),
           {"--codes-alone", &o->codes_alone,
            "Assessment by the codes only: no smoke, no "
            "reflections"},
           {"--no-pictures", &o->no_pictures, "No pictures from the eye for the report"},
           {"--overwrite", &o->overwrite,
            "Replacement of files in the folder that no assessment has written"},
           {"--strict", &o->strict,
            "Exit code 1 where anything fails, is undecided, not assessed or not verified"}},
      .notes =
          "Needs routes, areas or observers in the scene. Writes report.html, assessment.json, "
          "checks.csv, sights.csv, guided.csv (over time), plans/ (SVG, DXF), schedules/ (CSV), "
          "views/ "
          "(pictures from the cameras of the scene, or from the starts of its routes); of "
          "what came from IFC by_guid.csv, property_sets.csv, issues.bcf (failed checks). Over "
          "several times routes are followed; all else "
          "is of the last of them.\n"
          "--visibility-map writes visibility.npz (for pyFDS-Evac), visibility_all.npz, "
          "visibility.csv, and visibility/ (VTI) instead.\n"
          "  luxodus assess scenes/library/office_floor.toml --out out/office\n"
          "  luxodus assess office.toml --scenario fire --rules en1838-2013 \\\n"
          "    --deviation de-asr-a3.4-3\n"
          "  luxodus assess office.toml --rules en1838-2024,nfpa101 --codes-alone\n"
          "  luxodus assess office.toml --smoke-scale 0.1,0.3,1,3,10\n"
          "  luxodus assess office.toml --find extinction,luminance\n"
          "  luxodus assess office.toml --at 30s,60s,90s\n"
          "  luxodus assess office.toml --visibility-map --map-spacing 0.5 --map-heights 1.6,1",
      .run = [o] { return exit_code_of(assess_scene(*o)); }};
  add_report_options(command, o->report);
  add_map_options(command, o->map);
  return command;
}

Command compare_command() {
  struct Folders {
    std::string before, after, json;
  };
  const auto o = std::make_shared<Folders>();
  return {.name = "compare",
          .summary = "Compare two assessments",
          .heading = "Assess",
          .options = {{"before",
                       &o->before,
                       "Folder of an assessment",
                       {.form = Form::folder, .required = true}},
                      {"after",
                       &o->after,
                       "Folder of the other assessment",
                       {.form = Form::folder, .required = true}},
                      {"--json",
                       &o->json,
                       "File for the comparison as JSON, besides",
                       {.form = Form::file}}},
          .notes = "  luxodus compare out/before out/after",
          .run = [o] { return exit_code_of(compare_folders(o->before, o->after, o->json)); }};
}

}  // namespace luxodus::cli
