// luxodus validate: runs every case with a known answer, or every experiment with people, and
// judges by rules written down beforehand.
#include <fmt/format.h>

#include <cmath>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/nodes_option.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/apps/cli/quantities.hpp"
#include "actors/apps/cli/signals.hpp"
#include "actors/cast/process/in_process.hpp"
#include "actors/judge/validate/experiment_report.hpp"
#include "actors/judge/validate/validation_report.hpp"
#include "actors/results/formats/output_folder.hpp"
#include "runtime/core/log.hpp"

namespace luxodus::cli {

namespace {

struct ValidateOptions {
  bool quick = false;
  bool full = false;
  bool list = false;
  bool experiments = false;
  std::string only;
  std::string error = "0.01%";
  std::string case_time;
  std::string out = "out/validate";
  uint64_t seed = 1;
  int threads = default_threads();
  int nodes = 0;
};

std::string seconds_text(double seconds) {
  if (!std::isfinite(seconds)) return "unknown";
  return seconds < 600 ? fmt::format("{:.0f} s", seconds) : fmt::format("{:.1f} h", seconds / 3600);
}

void print_verdict(const light::Verdict& verdict, const std::string& out, bool interrupted) {
  for (const light::OverallTest& c : verdict.checks)
    std::printf("%-36s %-28s (allowed: %s) %s\n", c.name.c_str(), c.found.c_str(),
                c.allowed.c_str(), c.passed ? "passed" : "FAILED");
  std::printf("%zu statistical quantities, %zu computed, %zu too rare to be judged\n",
              verdict.statistical, verdict.computed, verdict.rare);
  if (!verdict.z.empty())
    std::printf("largest z %+.2f: %s\n", verdict.z_largest, verdict.z_largest_of.c_str());
  std::printf("%s%s; the page is %s/validate.html\n", verdict.passed ? "passed" : "FAILED",
              interrupted ? " so far; interrupted" : "", out.c_str());
}

/// Prints every quantity that is out of bounds on standard error.
void tell_failures(const std::vector<light::CaseResult>& results, const light::Verdict& verdict) {
  for (size_t i = 0; i < results.size(); ++i) {
    for (size_t k = 0; k < results[i].findings.size(); ++k) {
      const light::QuantityResult& f = results[i].findings[k];
      if (verdict.judged[i][k].judgement != light::Judgement::failed) continue;
      log_error("{}: {}: {} +- {}, reference {}, z {:.2f}", results[i].name, f.quantity,
                f.estimate.value, f.estimate.standard_error, f.reference, verdict.judged[i][k].z);
    }
  }
}

/// Options that experiments have no use for.
Result<void> check_options_of_experiments(const ValidateOptions& options) {
  if (options.quick) return problem("--experiments excludes --quick");
  if (options.nodes > 0) return problem("--experiments excludes --nodes: threads trace them");
  return {};
}

Result<ExitCode> validate_by_experiments(const ValidateOptions& options) {
  if (auto ok = check_options_of_experiments(options); !ok) return ok.problem();
  const light::Experiments experiments = light::experiments_named(options.only);
  if (experiments.empty())
    return problem("no experiment has \"" + options.only +
                   "\" in its id or title; --experiments --list tells them");
  if (options.list) {
    for (const light::Experiment& e : experiments)
      std::printf("%s  %s  (%s)\n", e.id.c_str(), e.title.c_str(), e.source.c_str());
    return ExitCode::success;
  }
  const auto out = OutputFolder::claim(
      options.out, {{"experiments.md", "experiments.json", "experiments.svg"}, {}});
  if (!out) return out.problem();
  install_interrupt_handler();
  light::ExperimentRecord record;
  record.options.seed = options.seed;
  record.options.threads = options.threads;
  record.only = options.only;
  ProgressLine line("validate");
  const auto show = [&](const std::string& what, double share) { line.put(what, false, share); };
  const auto results = light::run_experiments(experiments, record.options, interrupt_flag(), show);
  if (!results) return results.problem();
  line.put(fmt::format("{} of {} experiments", results->size(), experiments.size()), true);
  record.interrupted = interrupt_flag().load();
  if (auto ok = light::write_experiments(out->path(), results.value(), record); !ok)
    return ok.problem();
  std::printf("%sthe page is %s/experiments.md\n", light::experiments_text(results.value()).c_str(),
              options.out.c_str());
  if (record.interrupted) return ExitCode::interrupted;
  return light::summary_of(results.value()).passed() ? ExitCode::success : ExitCode::failure;
}

Result<ExitCode> validate(const ValidateOptions& options) {
  if (options.experiments) return validate_by_experiments(options);
  const auto error = parse_share(options.error);
  if (!error) return error.problem();
  if (!(error.value() > 0)) return problem("--error must be above 0");
  const light::Cases cases = light::cases_named(options.only);
  if (cases.empty())
    return problem("no case has \"" + options.only + "\" in its name; --list tells them");
  if (options.list) {
    for (const light::Case& c : cases) std::printf("%s  (%s)\n", c.name.c_str(), c.source.c_str());
    return ExitCode::success;
  }
  const auto out = OutputFolder::claim(options.out, {{"validate.html", "validate.json"}, {}});
  if (!out) return out.problem();
  install_interrupt_handler();
  light::SuiteRecord record;
  record.seed = options.seed;
  record.threads = options.threads;
  record.only = options.only;
  if (options.full) record.error = error.value();
  if (!options.case_time.empty()) {
    const auto most = parse_seconds(options.case_time);
    if (!most) return most.problem();
    record.case_seconds = most.value();
  }
  light::SuiteOptions suite;
  suite.seed = record.seed;
  suite.threads = record.threads;
  suite.error = record.error;
  suite.case_seconds = record.case_seconds;
  const auto nodes = nodes_that_trace(options.nodes);
  suite.executor = nodes.get();
  ProgressLine line("validate");
  const auto show = [&](const light::SuiteProgress& p) {
    line.put(fmt::format("{} of {} cases, {}, about {} left: {}", p.done, p.cases,
                         seconds_text(p.seconds), seconds_text(p.seconds_left), p.name),
             false,
             static_cast<double>(p.done) / static_cast<double>(std::max<size_t>(p.cases, 1)));
  };
  const auto results = light::run_suite(cases, suite, interrupt_flag(), show);
  line.put(fmt::format("{} of {} cases", results.size(), cases.size()), true);
  record.interrupted = interrupt_flag().load();
  const light::Verdict verdict = light::judge(results);
  if (auto ok = light::write_suite(out->path(), results, record, verdict); !ok) return ok.problem();
  tell_failures(results, verdict);
  if (const size_t short_of_error = light::cases_short_of_error(results); short_of_error > 0)
    std::printf("%zu of %zu cases ended before all of their quantities had the error\n",
                short_of_error, results.size());
  std::printf("%s\n",
              light::precision_text(light::precision_of(results, record.wanted_error())).c_str());
  if (const light::Slopes slopes = light::slopes_of(results); std::isfinite(slopes.deviation))
    std::printf("slopes over particles: standard errors %.3f, deviations %.3f\n",
                slopes.standard_error, slopes.deviation);
  print_verdict(verdict, options.out, record.interrupted);
  if (record.interrupted) return ExitCode::interrupted;
  return verdict.passed ? ExitCode::success : ExitCode::failure;
}

}  // namespace

Command validate_command() {
  const auto o = std::make_shared<ValidateOptions>();
  return {
      .name = "validate",
      .summary = "Compare the light with reference solutions: a page, a verdict",
      .heading = "Tools",
      .options =
          {{"--quick", &o->quick, "As many particles as are quick: the default"},
           {"--full",
            &o->full,
            "Particles until every quantity has the error",
            {.excludes = "--quick"}},
           {"--error",
            &o->error,
            "Relative standard error of --full, as 0.1% or 0.001",
            {.form = Form::share}},
           {"--case-time",
            &o->case_time,
            "Longest time for a case, as 20s or 5m",
            {.form = Form::duration, .otherwise = "until it has the error", .needs = "--full"}},
           {"--experiments",
            &o->experiments,
            "Experiments with people, instead of cases with known light",
            {.excludes = "--full"}},
           {"--only",
            &o->only,
            "Part of the names of the cases to run, or the id of an experiment",
            {.form = Form::name, .otherwise = "all"}},
           {"--list", &o->list, "Names of the cases or experiments, and their sources"},
           {"--out",
            &o->out,
            "Folder for validate.html and .json, or experiments.md, .json and .svg",
            {.form = Form::folder}},
           {"--seed", &o->seed, "Seed of the random number generator"},
           threads_option(o->threads),
           nodes_option(o->nodes)},
      .notes =
          "Cases are scenes whose light is known: closed forms, deterministic solvers, published "
          "values. Each is run at growing numbers of particles. The page shows every quantity with "
          "its standard error and distance z from the reference, how z is distributed, and how "
          "errors fall. Pass or fail follows from a rule that stands on the page and in "
          "docs/validation/rule.md.\n"
          "Experiments are thresholds at which people saw or read signs in smoke and dim light. "
          "The program's own verdicts are held against them, by rules that stand in "
          "docs/validation/experiments.md.\n"
          "Exit code: 0 passed, 1 failed, 2 wrong options, 130 interrupted.\n"
          "  luxodus validate                        quickly, some two minutes of one core\n"
          "  luxodus validate --full                 to 0.01 %; says how long it will take\n"
          "  luxodus validate --full --error 0.1% --only \"cube\"\n"
          "  luxodus validate --full --case-time 1m  at most a minute a case: says what that "
          "misses\n"
          "  luxodus validate --experiments          all, some minutes of two cores\n"
          "  luxodus validate --experiments --only T8",
      .run = [o] { return exit_code_of(validate(*o)); }};
}

}  // namespace luxodus::cli
