// luxodus render: pictures from a finished run, without tracing particles again.
#include <filesystem>

#include "actors/cli/command.hpp"
#include "actors/cli/commands.hpp"
#include "actors/cli/findings.hpp"
#include "actors/cli/finished_run.hpp"
#include "actors/cli/load_scene.hpp"
#include "actors/cli/picture_limits.hpp"
#include "actors/cli/progress_line.hpp"
#include "actors/cli/signals.hpp"
#include "actors/display/pictures.hpp"
#include "actors/display/result_files.hpp"
#include "actors/run/flux_store.hpp"
#include "scenes/transport/compile.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct RenderOptions {
  std::string folder;
  std::string view;
  int threads = default_threads();
  PictureLimits limits;
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
  PictureOptions picture;
  if (auto ok = read_limits(options.limits, picture); !ok) return ok.problem();
  if (auto ok = check_views(*description, options.view, picture); !ok) return ok.problem();
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
  picture.progressive = true;
  picture.gather = !options.full_paths;
  picture.raw = options.raw;
  picture.interrupt = &interrupt_flag();
  std::optional<ProgressLine> line("pictures");
  const auto rendered =
      render_views(out->path(), run, options.view, picture,
                   [&](const PictureProgress& progress) { show_pictures(*line, progress); });
  line.reset();
  if (!rendered) return rendered.problem();
  tell_rendered(rendered.value());
  return rendered->interrupted ? ExitCode::interrupted : ExitCode::success;
}

}  // namespace

namespace {

std::vector<Option> render_options(RenderOptions& o) {
  std::vector<Option> all{
      {"dir", &o.folder, "Folder of a finished run", {.form = Form::folder, .required = true}},
      {"--view", &o.view, "Name of one camera", {.form = Form::name, .otherwise = "all cameras"}}};
  for (Option& option : options_of(o.limits, "--paths")) all.push_back(std::move(option));
  const std::vector<Option> more{
      {"--full-paths", &o.full_paths,
       "Paths traced to their end instead of to the run's flux: slower and noisier, free of the "
       "patches' size"},
      {"--raw", &o.raw, "PNG files of the light as traced, with its noise"},
      {"--threads",
       &o.threads,
       "Number of threads",
       {.otherwise = "all cores", .range = Range{1, 1024}}}};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace

Command render_command() {
  const auto o = std::make_shared<RenderOptions>();
  return {
      .name = "render",
      .summary = "Make pictures from a finished run, without tracing it again",
      .heading = "Results",
      .options = render_options(*o),
      .notes =
          "Reads DIR/result.json, DIR/flux.lux and the scene file; refuses if the scene has "
          "changed. A first picture of each view is there after seconds; it is replaced by better "
          "ones. Equal paths give equal pictures, bit for bit, however they came together. Ctrl-C "
          "keeps the pictures of the paths that all of their pixels have.",
      .run = [o] { return exit_code_of(render(*o)); }};
}

}  // namespace luxodus::cli
