// luxodus assess, report, compare: whether signs and routes do their job, as a page and as data.
#include <fmt/format.h>
#include <spawn.h>
#include <spdlog/spdlog.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "actors/assess/assessment_json.hpp"
#include "actors/assess/check_words.hpp"
#include "actors/assess/state_words.hpp"
#include "actors/cli/command.hpp"
#include "actors/cli/findings.hpp"
#include "scenes/format/file_names.hpp"
#include "scenes/format/output_folder.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct AssessCommandOptions {
  std::string scene;
  std::string out;
  AssessOptions assess;
  bool codes_alone = false;
  bool strict = false;
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

void print_summary(const Json& a, const fs::path& out) {
  std::printf("%s%s\n", state_text(a).c_str(), verdict_words(a).c_str());
  for (const char* verdict : {"fail", "not verified"})
    for (const Json& check : a["checks"])
      if (check["verdict"] == verdict) print_check(check);
  std::string seen;
  for (const auto& [word, count] : a["sight_counts"].items())
    seen += fmt::format("{}{} {}", seen.empty() ? "" : ", ", count.get<int>(), word);
  if (!seen.empty()) std::printf("signs, from routes and areas: %s\n", seen.c_str());
  std::printf("written to %s\n", (out / "report.html").string().c_str());
}

Result<ExitCode> assess_scene(const AssessCommandOptions& options) {
  const auto scene = load_scene(options.scene);
  if (!scene) return ExitCode::bad_input;
  const fs::path folder = options.out.empty()
                              ? fs::path("out") / file_name_of(scene->name + "-assessed")
                              : fs::path(options.out);
  const auto out = OutputFolder::claim(
      folder, {{"report.html", "assessment.json", "checks.csv", "sights.csv"}, {}});
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
  print_summary(json, folder);
  return options.strict && anything_open(json) ? ExitCode::failure : ExitCode::success;
}

/// How a program ended: whether all went well, and else what it said.
struct Ended {
  bool well = false;
  std::string said;
};

/// Runs a program and waits. What it prints is kept and not shown. A program that is not there
/// fails and says nothing.
Ended ended(const std::vector<std::string>& words) {
  constexpr size_t most_said = 2000;  // of the end [bytes]
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const int kept = ::memfd_create("said", MFD_CLOEXEC);
  posix_spawn_file_actions_t redirect;
  ::posix_spawn_file_actions_init(&redirect);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    ::posix_spawn_file_actions_adddup2(&redirect, kept, stream);
  pid_t pid = 0;
  int status = 0;
  Ended out;
  if (::posix_spawnp(&pid, arguments[0], &redirect, nullptr, arguments.data(), environ) == 0) {
    out.well = ::waitpid(pid, &status, 0) == pid && status == 0;
    const auto bytes = static_cast<size_t>(std::max<off_t>(::lseek(kept, 0, SEEK_END), 0));
    out.said.resize(std::min(bytes, most_said));
    const ssize_t n = ::pread(kept, out.said.data(), out.said.size(),
                              static_cast<off_t>(bytes - out.said.size()));
    out.said.resize(n > 0 ? static_cast<size_t>(n) : 0);
  }
  ::posix_spawn_file_actions_destroy(&redirect);
  ::close(kept);
  return out;
}

/// Prints a page as PDF by whichever Chromium is installed.
Result<Done> print_pdf(const fs::path& page, const fs::path& pdf) {
  const std::string address = "file://" + fs::absolute(page).string();
  std::error_code ignored;
  fs::remove(pdf, ignored);
  std::string said;
  for (const char* browser : {"chromium", "chromium-browser", "google-chrome"}) {
    std::vector<std::string> words{
        browser,         "--headless=new",         "--disable-gpu",
        "--log-level=3", "--no-pdf-header-footer", "--print-to-pdf=" + pdf.string()};
    // It has no sandbox for root; the page is ours and fetches nothing.
    if (::geteuid() == 0) words.emplace_back("--no-sandbox");
    words.push_back(address);
    const Ended printed = ended(words);
    if (printed.well && fs::exists(pdf, ignored)) return Done{};
    if (!printed.said.empty()) said = "; " + std::string(browser) + " said: " + printed.said;
  }
  return Problem{
      {pdf.string(), 0},
      "no Chromium printed it: install one (Debian: chromium), or print report.html" + said};
}

Result<ExitCode> report_again(const std::string& folder, bool pdf) {
  const auto read = read_assessment(folder);
  if (!read.ok()) return read.problem();
  const fs::path page = fs::path(folder) / "report.html";
  if (auto ok = write_file_atomically(behind_links(page),
                                      assessment_page(read.value(), pictures_in(folder)));
      !ok.ok())
    return ok.problem();
  std::printf("written to %s\n", page.string().c_str());
  if (!pdf) return ExitCode::success;
  const fs::path printed = fs::path(folder) / "report.pdf";
  if (auto ok = print_pdf(page, printed); !ok.ok()) return ok.problem();
  std::printf("written to %s\n", printed.string().c_str());
  return ExitCode::success;
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
      "Needs routes, areas or observers in the scene (keys: scenes/format/README.md). Writes\n"
      "report.html, assessment.json, checks.csv and sights.csv.\n"
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
  command->add_flag("--strict", options->strict,
                    "exit code 1 where anything fails, is undecided, not assessed or not verified");
  command->callback([options, &exit_code] { exit_code = told(assess_scene(*options)); });
}

void add_report(CLI::App& app, int& exit_code) {
  auto folder = std::make_shared<std::string>();
  auto pdf = std::make_shared<bool>(false);
  CLI::App* command =
      app.add_subcommand("report", "Write the page of an assessment again, with new pictures");
  command->footer("Takes in the pictures of FOLDER/views, as `luxodus render` makes them.");
  command->add_option("folder", *folder, "folder of luxodus assess")->required();
  command->add_flag("--pdf", *pdf,
                    "print it as report.pdf, too, by Chromium where one is installed");
  command->callback([folder, pdf, &exit_code] { exit_code = told(report_again(*folder, *pdf)); });
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
