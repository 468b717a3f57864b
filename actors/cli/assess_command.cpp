// luxodus assess, compare: whether signs and routes do their job, as data and as a report.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>

#include "actors/assess/assessment_json.hpp"
#include "actors/assess/check_words.hpp"
#include "actors/assess/state_words.hpp"
#include "actors/cli/command.hpp"
#include "actors/cli/findings.hpp"
#include "actors/cli/report_options.hpp"
#include "actors/output/file_names.hpp"
#include "actors/output/output_folder.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct AssessCommandOptions {
  std::string scene;
  std::string out;
  AssessOptions assess;
  bool codes_alone = false;
  bool strict = false;
  ReportWords report;
};

std::string ids_of(std::span<const NamedRules> rows) {
  std::string out;
  for (const NamedRules& row : rows) out += (out.empty() ? "" : ", ") + std::string(row.id);
  return out;
}

/// A check that fails, or whose limit was read nowhere, in a line.
void print_check(const Json& check) {
  if (check["verdict"] == "fail")
    std::printf("  fails: %s\n", check_words(check).c_str());
  else
    std::printf("  not verified: %s: %s\n", check_words(check).c_str(),
                check.value("reason", "").c_str());
}

void print_summary(const Json& a) {
  std::printf("%s%s\n", state_text(a).c_str(), verdict_words(a).c_str());
  for (const char* verdict : {"fail", "not verified"})
    for (const Json& check : a["checks"])
      if (check["verdict"] == verdict) print_check(check);
  std::string seen;
  for (const auto& [word, count] : a["sight_counts"].items())
    seen += fmt::format("{}{} {}", seen.empty() ? "" : ", ", count.get<int>(), word);
  if (!seen.empty()) std::printf("signs, from routes and areas: %s\n", seen.c_str());
}

Result<ExitCode> assess_scene(const AssessCommandOptions& options) {
  const auto scene = load_scene(options.scene);
  if (!scene) return ExitCode::bad_input;
  const fs::path folder = options.out.empty()
                              ? fs::path("out") / file_name_of(scene->name + "-assessed")
                              : fs::path(options.out);
  const auto out = OutputFolder::claim(
      folder, {{"report.html", "report.pdf", "assessment.json", "checks.csv", "sights.csv"},
               {"plans", "schedules"}});
  if (!out.ok()) return out.problem();
  install_interrupt_handler();
  AssessOptions asked = options.assess;
  asked.reality = !options.codes_alone;
  ProgressLine line("assess");
  const auto assessed =
      assess(scene, asked, interrupt_flag(), [&](const std::string& what, double share) {
        line.put(fmt::format("{}: {:.0f} %", what, 100 * share), share >= 1, share);
      });
  if (!assessed.ok()) {
    if (!interrupt_flag()) {
      tell(assessed.problem());
      return ExitCode::bad_input;
    }
    spdlog::warn("interrupted; nothing was written");
    return ExitCode::interrupted;
  }
  tell_findings(assessed->findings);
  for (const Problem& warning : assessed->warnings)
    if (std::none_of(assessed->findings.begin(), assessed->findings.end(),
                     [&](const Finding& f) { return f.problem.text() == warning.text(); }))
      spdlog::warn("{}", warning.text());
  const Json json = assessment_json(*scene, assessed.value(), LUX_VERSION);
  if (auto ok = write_assessment(out->path(), json); !ok.ok()) return ok.problem();
  print_summary(json);
  if (auto ok = write_report_and_tell(out.value(), json, options.report); !ok.ok())
    return ok.problem();
  return options.strict && anything_open(json) ? ExitCode::failure : ExitCode::success;
}

Result<ExitCode> compare_folders(const std::string& before, const std::string& after,
                                 const std::string& json) {
  const auto a = read_assessment(before);
  if (!a.ok()) return a.problem();
  const auto b = read_assessment(after);
  if (!b.ok()) return b.problem();
  const Json comparison = comparison_of(a.value(), b.value());
  std::printf("%s", comparison_text(comparison).c_str());
  if (!json.empty())
    if (auto ok = write_json(behind_links(json), comparison); !ok.ok()) return ok.problem();
  return ExitCode::success;
}

/// Its exit code, or that of bad input after the problem was told.
int told(const Result<ExitCode>& result) {
  if (result.ok()) return result.value();
  tell(result.problem());
  return ExitCode::bad_input;
}

}  // namespace

void add_assess(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<AssessCommandOptions>();
  options->assess.threads = default_threads();
  CLI::App* command =
      app.add_subcommand("assess", "Judge signs and escape routes, by codes and in smoke");
  command->footer(
      "Needs routes, areas or observers in the scene (keys: scenes/scene_file/README.md). Writes\n"
      "report.html, assessment.json, checks.csv, sights.csv, plans/ (SVG, DXF), schedules/ (CSV).\n"
      "  luxodus assess scenes/library/office_floor.toml --out out/office\n"
      "  luxodus assess office.toml --scenario fire --rules en1838-2013 --deviation de-asr-a3.4-3\n"
      "  luxodus assess office.toml --rules en1838-2024,nfpa101 --codes-alone\n"
      "  luxodus assess office.toml --smoke-scale 0.1,0.3,1,3,10");
  command->add_option("scene", options->scene, "scene file (TOML)")->required();
  command->add_option("--scenario", options->assess.scenario,
                      "state of the building [the one in emergency operation, with smoke where "
                      "any has it; none is guessed]");
  command->add_option("--out", options->out, "folder of the results [out/NAME-assessed]");
  command
      ->add_option("--rules", options->assess.rules,
                   "rule sets: " + ids_of(rule_sets()) + " [those of the scene]")
      ->delimiter(',');
  command
      ->add_option(
          "--deviation", options->assess.deviations,
          "national deviations from them: " + ids_of(deviations()) + " [those of the scene]")
      ->delimiter(',');
  command->add_option("--seed", options->assess.seed, "of all random numbers [1]")
      ->check(seed_number());
  command->add_option("--threads", options->assess.threads, "threads [all]")
      ->check(CLI::Range(1, 1024));
  command
      ->add_option("--rounds", options->assess.rounds,
                   "rounds of paths at most, each of four times as many, for what is undecided [4]")
      ->check(CLI::Range(1, limits::sight_rounds));
  command
      ->add_option("--smoke-scale", options->assess.smoke_factors,
                   "judge signs again with all smoke times these factors")
      ->delimiter(',')
      ->check(CLI::Range(0.0, 1e6));
  command->add_flag("--codes-alone", options->codes_alone, "no smoke, no reflections: codes only");
  add_report_options(*command, options->report);
  command->add_flag("--strict", options->strict,
                    "exit code 1 where anything fails, is undecided, not assessed or not verified");
  command->callback([options, &exit_code] { exit_code = told(assess_scene(*options)); });
}

void add_compare(CLI::App& app, int& exit_code) {
  auto folders = std::make_shared<std::pair<std::string, std::string>>();
  auto json = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("compare", "What two assessments say differently");
  command->footer("  luxodus compare out/before out/after");
  command->add_option("before", folders->first, "folder of luxodus assess")->required();
  command->add_option("after", folders->second, "another")->required();
  command->add_option("--json", *json, "write it to this file, too");
  command->callback([folders, json, &exit_code] {
    exit_code = told(compare_folders(folders->first, folders->second, *json));
  });
}

}  // namespace luxodus::cli
