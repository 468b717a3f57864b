// luxodus export: writes a finished run for programs that read glTF.
#include <fmt/format.h>

#include <filesystem>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/finished_run.hpp"
#include "actors/apps/cli/version.hpp"
#include "actors/results/files/glb_export.hpp"
#include "actors/results/formats/output_folder.hpp"
#include "actors/results/run/flux_store.hpp"
#include "runtime/core/output_text.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct ExportOptions {
  std::string folder, out;
  double white_cd_m2 = 0;
};

/// Errors: a folder without a run, a scene that has changed, flux that cannot be read.
Result<std::unique_ptr<LocalRun>> traced_run(const fs::path& folder) {
  const auto finished = read_finished_run(folder);
  if (!finished) return finished.problem();
  const auto of_run = scene_of_run(finished.value());
  if (!of_run) return of_run.problem();
  auto run = std::make_unique<LocalRun>(of_run->scene, finished->seed, 1);
  if (auto ok = load_flux(folder / "flux.lux", *run); !ok) return ok.problem();
  return run;
}

Result<ExitCode> export_run(const ExportOptions& options) {
  const fs::path file =
      options.out.empty() ? fs::path(options.folder) / "building.glb" : fs::path(options.out);
  if (file.extension() != ".glb")
    return problem_in(file, "GLB is the one format that is written: give a name that ends in .glb");
  if (auto ok = check_output_file(file); !ok) return ok.problem();
  const auto run = traced_run(options.folder);
  if (!run) return run.problem();
  const auto scene =
      glb_scene_of(*run.value(), {fmt::format("luxodus {}", build.version), options.white_cd_m2});
  if (!scene) return scene.problem();
  if (auto ok = write_glb(file, scene.value()); !ok) return ok.problem();
  size_t triangles = 0;
  for (const GlbMesh& mesh : scene->meshes) triangles += mesh.triangles.size() / 3;
  std::printf("%zu surfaces, %zu triangles, %zu lights, %zu cameras; white is %s cd/m2\n",
              scene->meshes.size(), triangles, scene->lights.size(), scene->cameras.size(),
              readable_number(scene->extras["white_cd_m2"].get<double>(), 3).c_str());
  std::printf("written to %s\n", file.string().c_str());
  return ExitCode::success;
}

}  // namespace

Command export_command() {
  const auto o = std::make_shared<ExportOptions>();
  return {
      .name = "export",
      .summary = "Write a finished run as glTF, for Blender and web viewers",
      .heading = "Results",
      .options =
          {{"dir",
            &o->folder,
            "Folder of a finished run",
            {.form = Form::folder, .required = true}},
           {"--out", &o->out, "GLB file", {.form = Form::file, .otherwise = "DIR/building.glb"}},
           {"--white",
            &o->white_cd_m2,
            "Luminance that is shown as white [cd/m2]",
            {.otherwise = "that which 98 % of the lit area stay below",
             .range = Range{1e-9, 1e9}}}},
      .notes =
          "Surfaces carry the light that they send back as linear colours of their corners; "
          "luminaires are punctual lights, and cameras are those of the scene. Reads "
          "DIR/result.json, DIR/flux.lux and the scene file; refuses if the scene has changed.\n"
          "  luxodus run scenes/library/office_floor.toml --out out/office\n"
          "  luxodus export out/office --out office.glb",
      .run = [o] { return exit_code_of(export_run(*o)); }};
}

}  // namespace luxodus::cli
