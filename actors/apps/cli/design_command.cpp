// luxodus design: places emergency luminaires, with the smallest number or cost.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/load_scene.hpp"
#include "actors/apps/cli/nodes_option.hpp"
#include "actors/apps/cli/people_asked.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/apps/cli/quantities.hpp"
#include "actors/apps/cli/signals.hpp"
#include "actors/apps/cli/version.hpp"
#include "actors/judge/design/binding_words.hpp"
#include "actors/judge/design/design_files.hpp"
#include "actors/judge/design/record_design.hpp"
#include "actors/judge/design/sign_files.hpp"
#include "actors/judge/design/smoke_section.hpp"
#include "actors/judge/report/pdf.hpp"
#include "actors/results/formats/file_names.hpp"
#include "actors/results/formats/output_folder.hpp"
#include "runtime/core/log.hpp"
#include "runtime/core/output_text.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/light/world/design.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct DesignCommandOptions {
  std::string scene, out;
  std::string time = "2m", smoke_time = "10m";
  std::string language = "en";
  DesignOptions design;
  std::string gap, trajectories;
  bool people = false, overwrite = false, pdf = false;
};

const std::vector<std::string> design_files{"design.html",    "design.json", "layout.toml",
                                            "luminaires.csv", "signs.csv",   "design.pdf"};

std::string names_of_sets() {
  std::string out;
  for (const NamedRules& row : rule_sets()) out += (out.empty() ? "" : ", ") + std::string(row.id);
  return out;
}

/// Errors: a file with a name of a design's files exists, and no design has written it.
Result<void> refuse_designs_of_others(const fs::path& folder) {
  constexpr uint64_t max_bytes = uint64_t{64} << 20;
  std::error_code failed;
  const auto ours = read_regular_file(folder / "design.json", max_bytes);
  if (ours && ours.value().find(design_format) != std::string::npos) return {};
  for (const std::string& file : design_files)
    if (fs::exists(folder / file, failed))
      return problem_in((folder / file).string(),
                        "this file is there, and no design has written it; take another folder, "
                        "or give --overwrite");
  return {};
}

void print_design(const SceneDescription& scene, const DesignResult& result) {
  std::printf("%s\n", outcome_words(scene, result).c_str());
  const LayoutAnswer& answer = result.answer;
  if (answer.greedy)
    std::printf("greedy choice: objective %s\n",
                readable_number(answer.greedy_objective, 4).c_str());
  std::printf("%zu places, %zu candidates, %zu points; first layout after %.1f s, search %.1f s\n",
              result.places, result.candidates, result.points,
              result.prepared_seconds + answer.first_seconds, answer.seconds);
  if (result.signs)
    for (const std::string& line : sign_words(*result.signs)) std::printf("%s\n", line.c_str());
  if (result.refined)
    std::printf("moved %zu luminaires: the least is %.1f %% of a planned minimum, before %.1f %%\n",
                result.refined->moved, 100 * result.refined->after, 100 * result.refined->before);
  if (result.tolerance && !result.tolerance->demands.empty())
    std::printf("%s\n", tolerance_words(*result.tolerance).c_str());
  if (result.between.added > 0)
    std::printf(
        "%zu points were added between those of the grid; near the least it is %.1f %% of what is "
        "planned\n",
        result.between.added, 100 * result.between.least);
  std::printf("the layout, assessed: %s\n", words_of(counts_of(result.assessment.checks)).c_str());
  for (const std::string& line : others_words(result.others)) std::printf("  %s\n", line.c_str());
  for (const UnusedType& one : result.unused) std::printf("  %s\n", unused_words(one).c_str());
  for (const std::string& name : result.unlit_stair_flights)
    std::printf(
        "  not planned, as no candidate lights all of its treads: flight of stairs \"%s\"\n",
        name.c_str());
  for (const HiddenByFurniture& one : joined_by_subject(result.hidden))
    std::printf("  planned without furniture, which hides %zu points from all candidates: %s, %s\n",
                one.points, english().subject(one.subject).c_str(), one.rule.c_str());
  for (size_t i = 0; i < result.groups.size(); ++i) {
    constexpr double binding = 0.05;
    const double share = answer.share_of_group.empty() ? 0 : answer.share_of_group[i];
    if (share > binding)
      std::printf("  binds (%s of the objective): %s\n", readable_number(share, 2).c_str(),
                  demand_words(result.groups[i]).c_str());
  }
}

void print_because(const SceneDescription& scene, const DesignResult& result) {
  for (const std::string& words : because_words(english(), record_of(scene, result, "")))
    std::printf("  %s\n", words.c_str());
}

void print_smoke(const DesignResult& result) {
  for (const std::string& words : smoke_words(english(), record_of(*result.smoke)))
    std::printf("in smoke: %s\n", words.c_str());
  std::printf("%zu layouts judged in smoke in %.1f s, by %zu trace%s\n",
              result.smoke->layouts.size(), result.smoke->seconds, result.smoke->traces,
              result.smoke->traces == 1 ? "" : "s");
}

Result<ExitCode> tell_none(const SceneDescription& scene, const DesignResult& result) {
  if (result.answer.end == LayoutEnd::infeasible) {
    std::printf("no layout exists:\n");
    for (const std::string& line : conflict_words(scene, result))
      std::printf("  %s\n", line.c_str());
    return ExitCode::failure;
  }
  if (interrupt_flag()) {
    log_warning("interrupted before a layout was found; nothing was written");
    return ExitCode::interrupted;
  }
  std::printf("%s; a longer --time may find one\n", outcome_words(scene, result).c_str());
  return ExitCode::failure;
}

/// A pack has no design of its own.
bool judges_in_smoke(const DesignCommandOptions& o, const SceneDescription& scene) {
  return !o.design.in_smoke.empty() || (scene.design && !scene.design->in_smoke.empty());
}

/// Who are followed with the layouts that are judged in smoke; nobody unless asked for.
Result<std::vector<PlacedPerson>> people_of(const DesignCommandOptions& o,
                                            const SceneDescription& scene) {
  if (!o.people && o.trajectories.empty()) return std::vector<PlacedPerson>();
  if (!judges_in_smoke(o, scene))
    return problem("people rank the layouts that are judged in smoke: add --in-smoke SCENARIO");
  auto people = people_asked(scene, o.scene, o.trajectories);
  if (!people) return people.problem();
  return std::move(people->people);
}

Result<ExitCode> design_scene(DesignCommandOptions o) {
  const auto seconds = parse_seconds(o.time);
  if (!seconds) return seconds.problem();
  o.design.seconds = seconds.value();
  const auto smoke_seconds = parse_seconds(o.smoke_time);
  if (!smoke_seconds) return smoke_seconds.problem();
  o.design.smoke_seconds = smoke_seconds.value();
  if (!o.gap.empty()) {
    const auto gap = parse_share(o.gap);
    if (!gap) return gap.problem();
    o.design.gap = gap.value();
  }
  const auto [scene, told] =
      load_scene(o.scene, ReadingWarnings::told, std::nullopt, FireFrames::nearest);
  if (!scene) return exit_code_of(told);
  o.design.scene_at = reader_of_times(o.scene, *scene, FireFrames::nearest);
  auto people = people_of(o, *scene);
  if (!people) return people.problem();
  o.design.people = std::move(people).value();
  const fs::path folder =
      o.out.empty() ? fs::path("out") / file_name_of(scene->name + "-designed") : fs::path(o.out);
  const auto out = OutputFolder::claim(folder, {design_files, {"plans", "alternatives"}});
  if (!out) return out.problem();
  if (!o.overwrite)
    if (auto ok = refuse_designs_of_others(out->path()); !ok) return ok.problem();
  install_interrupt_handler();
  ProgressLine line("design");
  const auto result = design(
      scene, o.design, interrupt_flag(), [&](const std::string& what, double best, double bound) {
        const std::string found =
            std::isfinite(best) ? readable_number(best, 4) : std::string("none yet");
        line.put(bound > 0 || std::isfinite(best)
                     ? fmt::format("{}: best {}, bound {}", what, found, readable_number(bound, 4))
                     : what,
                 false);
      });
  if (!result) return result.problem();
  if (result->answer.layout.empty()) return tell_none(*scene, result.value());
  if (auto ok =
          write_design(out->path(), *scene, result.value(), language_of(o.language), build.version);
      !ok)
    return ok.problem();
  if (o.pdf)
    if (auto ok = print_pdf(out->path() / "design.html", out->path() / "design.pdf"); !ok)
      return ok.problem();
  print_design(*scene, result.value());
  print_because(*scene, result.value());
  if (result->smoke) print_smoke(result.value());
  if (result->smoke && !o.design.people.empty() && !result->smoke->layouts.front().people)
    log_warning(
        "--smoke-time was over before people were followed with every layout: the routes rank "
        "them");
  if (!result->smoke && judges_in_smoke(o, *scene) && !interrupt_flag())
    log_warning("no layout was judged in smoke before --smoke-time was over");
  for (const char* file : {"design.html", "design.pdf", "layout.toml"})
    if (o.pdf || std::string_view(file) != "design.pdf")
      std::printf("written to %s\n", (out->named() / file).string().c_str());
  if (result->answer.end == LayoutEnd::interrupted || interrupt_flag()) {
    log_warning("interrupted; the best layout so far was written");
    return ExitCode::interrupted;
  }
  return ExitCode::success;
}

}  // namespace

Command design_command() {
  const auto o = std::make_shared<DesignCommandOptions>();
  o->design.threads = default_threads();
  return {
      .name = "design",
      .summary = "Find where emergency luminaires go: the fewest, or those of least cost",
      .heading = "Assess",
      .options =
          {{"scene", &o->scene, "Scene file", {.form = Form::scene, .required = true}},
           {"--out",
            &o->out,
            "Folder of the results",
            {.form = Form::folder, .otherwise = "out/NAME-designed"}},
           {"--scenario",
            &o->design.scenario,
            "State of the building: its doors and circuits",
            {.form = Form::name, .otherwise = "the scenario in emergency operation"}},
           {"--rules",
            &o->design.rules,
            "Rule sets: " + names_of_sets(),
            {.form = Form::name, .otherwise = "those of the scene", .comma_separated = true}},
           {"--deviation",
            &o->design.deviations,
            "National deviations from the rule sets, as of assess",
            {.form = Form::name, .otherwise = "those of the scene", .comma_separated = true}},
           {"--in-smoke",
            &o->design.in_smoke,
            "Scenarios in whose smoke the best layout and others are judged, by what people read "
            "of the signs",
            {.form = Form::name, .otherwise = "those of the scene", .comma_separated = true}},
           {"--people", &o->people,
            "People of [[people]] followed with each layout that is judged in smoke; layouts are "
            "then ranked by how long these people are without a sign that they read"},
           trajectories_option(o->trajectories),
           {"--smoke-time",
            &o->smoke_time,
            "Time of judging layouts in smoke, e.g. 2m; what is undecided then is told. In a scene "
            "with [time], or with people, 60 % of it are for comparing, the rest for how long "
            "layouts "
            "guide",
            {.form = Form::duration}},
           {"--time", &o->time, "Time of the search, e.g. 30s, 5m", {.form = Form::duration}},
           {"--gap",
            &o->gap,
            "Distance to the best possible layout at which the search ends, e.g. 3%",
            {.form = Form::share, .otherwise = "none: until it is the best"}},
           {"--refine", &o->design.refine,
            "Luminaires moved between the places of the grid, where minima are kept with more to "
            "spare; up to as long again as --time"},
           {"--seed", &o->design.seed, "Seed of the random number generator"},
           threads_option(o->design.threads),
           {"--language",
            &o->language,
            "Language of the page",
            {.choices = {language_words.begin(), language_words.end()}}},
           {"--pdf", &o->pdf, "Page as design.pdf, too, by Chromium where one is installed"},
           {"--overwrite", &o->overwrite,
            "Replacement of files in the folder that no design has written"}},
      .notes =
          "Needs routes or areas in the scene; [design] says what may be placed where, and has "
          "defaults. Writes layout.toml, a variant that assess, compare, run and view take, "
          "design.html, design.json, luminaires.csv and plans/ (SVG, DXF); with --in-smoke also "
          "alternatives/, other layouts as variants. Ctrl-C keeps the best layout so far. Exit "
          "code 1 where no layout exists, with what cannot hold.\n"
          "  luxodus design scenes/library/office_floor.toml --out out/layout\n"
          "  luxodus design office.toml --rules en1838-2024 --time 30s --gap 3%\n"
          "  luxodus design office.toml --in-smoke smoke_emergency\n"
          "  luxodus design office.toml --in-smoke fire --trajectories people.sqlite\n"
          "  luxodus assess out/layout/layout.toml",
      .run = [o] { return exit_code_of(design_scene(*o)); }};
}

}  // namespace luxodus::cli
