// luxodus render: pictures from a finished run, without tracing particles again.
#include <filesystem>

#include "actors/cli/command.hpp"
#include "actors/cli/commands.hpp"
#include "actors/cli/findings.hpp"
#include "actors/cli/finished_run.hpp"
#include "actors/cli/load_scene.hpp"
#include "actors/cli/progress_line.hpp"
#include "actors/cli/signals.hpp"
#include "actors/display/pictures.hpp"
#include "actors/display/result_files.hpp"
#include "actors/run/flux_store.hpp"
#include "runtime/core/log.hpp"
#include "scenes/transport/compile.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct RenderOptions {
  std::string folder;
  std::string view;
  int threads = default_threads();
  int paths = 32;
  bool full_paths = false;
  bool raw = false;
};

Result<ExitCode> render(const RenderOptions& options) {
  const fs::path folder = options.folder;
  const auto finished = read_finished_run(folder);
  if (!finished) return finished.problem();
  const auto description =
      load_scene(finished->scene_file, ReadingWarnings::left_to_inspection, finished->at_s);
  if (!description)
    return problem_in(finished->scene_file, "the run's scene cannot be read any more");
  const std::string name = description->scenarios.empty() ? "" : finished->scenario;
  auto scenario = find_scenario(*description, name);
  if (!scenario) return scenario.problem();
  auto scene = compile_scene(description, scenario.value(),
                             {finished->cells, finished->error_of, finished->batch_shares});
  if (!scene) return scene.problem();
  if (description->cameras.empty())
    return problem_in(finished->scene_file, "the scene has no [[camera]] to render");
  if (!passes_inspection(description, {scenario.value()}, options.threads))
    return problem_in(finished->scene_file, "the scene has errors, told above");
  OutputPlan plan{{}, {"views"}};
  for (size_t i = 0; i < description->cameras.size(); ++i)
    for (std::string& file : files_of_view(*description, i)) plan.files.push_back(std::move(file));
  const auto out = OutputFolder::claim(folder, plan);
  if (!out) return out.problem();
  LocalRun run(scene.value(), finished->seed, options.threads);
  if (auto ok = load_flux(out->path() / "flux.lux", run); !ok) return ok.problem();
  install_interrupt_handler();
  ProgressLine line("pictures");
  PictureOptions picture;
  picture.paths_per_pixel = options.paths;
  picture.gather = !options.full_paths;
  picture.raw = options.raw;
  picture.interrupt = &interrupt_flag();
  const auto drawn = render_views(out->path(), run, options.view, picture,
                                  [&](double share) { line.show_share(share); });
  if (!drawn) return drawn.problem();
  if (!interrupt_flag()) return ExitCode::success;
  log_warning("interrupted; the pictures that were whole are there");
  return ExitCode::interrupted;
}

}  // namespace

Command render_command() {
  const auto o = std::make_shared<RenderOptions>();
  return {
      .name = "render",
      .summary = "Make pictures from a finished run, without tracing it again",
      .heading = "Results",
      .options =
          {{"dir",
            &o->folder,
            "Folder of a finished run",
            {.form = Form::folder, .required = true}},
           {"--view",
            &o->view,
            "Name of one camera",
            {.form = Form::name, .otherwise = "all cameras"}},
           {"--paths", &o->paths, "Number of paths per pixel", {.range = Range{1, 100'000}}},
           {"--full-paths", &o->full_paths,
            "Paths traced to their end instead of to the run's flux: slower and noisier, free of "
            "the patches' size"},
           {"--raw", &o->raw, "PNG files of the light as traced, with its noise"},
           {"--threads",
            &o->threads,
            "Number of threads",
            {.otherwise = "all cores", .range = Range{1, 1024}}}},
      .notes =
          "Reads DIR/result.json, DIR/flux.lux and the scene file; refuses if the scene has "
          "changed.",
      .run = [o] { return exit_code_of(render(*o)); }};
}

}  // namespace luxodus::cli
