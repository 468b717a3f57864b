// luxodus pack: writes a scene as one file that many machines can share.
#include <filesystem>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/findings.hpp"
#include "actors/apps/cli/load_scene.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/apps/cli/quantities.hpp"
#include "actors/apps/cli/signals.hpp"
#include "actors/results/formats/file_names.hpp"
#include "actors/results/formats/json_out.hpp"
#include "actors/results/formats/output_folder.hpp"
#include "scenes/formats/pack/scene_pack.hpp"
#include "scenes/light/transport/compile.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct PackOptions {
  std::string scene;
  std::string out;
  std::string scenario;
  std::string at;
  double cell_kib = 1024;
  bool skeleton_only = false;
  bool json = false;
};

/// The number of cells that keeps each at `cell_kib` or below; cells differ by one triangle.
int cells_for(uint64_t triangles, double cell_kib) {
  const double per_cell = cell_kib * 1024 / sizeof(TriangleRecord);
  return static_cast<int>(std::max(1.0, std::ceil(static_cast<double>(triangles) / per_cell)));
}

Result<PackReport> pack_scene(const PackOptions& options) {
  if (is_pack(options.scene)) {
    if (options.skeleton_only) return write_skeleton_pack(behind_links(options.out), options.scene);
    return problem_in(options.scene,
                      "this is a pack already: pack the scene file, or add --skeleton-only");
  }
  if (options.skeleton_only) {
    return problem_in(
        options.scene,
        "--skeleton-only copies from a pack, so that both are of the same cells: pack "
        "the scene first");
  }
  const auto [description, told] =
      load_scene(options.scene, ReadingWarnings::left_to_inspection, time_asked(options.at));
  if (!description) return problem_in(options.scene, "the scene has problems, told above", told);
  if (auto ok = check_output_file(options.out); !ok) return ok.problem();
  auto scenario = find_scenario(*description, options.scenario);
  if (!scenario) return scenario.problem();
  if (const auto refused =
          refused_by_inspection(description, {scenario.value()}, default_threads()))
    return problem_in(options.scene, "the scene has errors, told above", *refused);
  // Only compiling gives the number of triangles, from which the number of cells follows.
  auto scene = compile_scene(description, scenario.value(), {});
  if (!scene) return scene.problem();
  const int cells = cells_for(scene.value()->triangles, options.cell_kib);
  if (cells > 1) scene = compile_scene(description, scenario.value(), {cells});
  if (!scene) return scene.problem();
  ProgressLine line("pack");
  install_interrupt_handler();
  return write_pack(behind_links(options.out), *scene.value(), cells, [&](double share) {
    line.show_share(share);
    return !interrupt_flag();
  });
}

Result<ExitCode> pack(PackOptions options) {
  if (options.out.empty())
    options.out = file_name_of(fs::path(options.scene).stem().string()) + ".luxpack";
  const auto report = pack_scene(options);
  if (!report) {
    if (!interrupt_flag()) return report.problem();
    tell(report.problem());
    return ExitCode::interrupted;
  }
  if (options.json) {
    std::fputs(json_text({{"file", options.out},
                          {"file_bytes", report->file_bytes},
                          {"skeleton_bytes", report->skeleton_bytes},
                          {"objects", report->objects},
                          {"object_bytes", report->object_bytes},
                          {"bricks", report->bricks},
                          {"tiles", report->tiles},
                          {"largest_object_bytes", report->largest_object_bytes}})
                   .c_str(),
               stdout);
    return ExitCode::success;
  }
  std::printf(
      "%s: %sB; %zu cells, %zu bricks, %zu tiles of %sB in all, the largest %sB; "
      "skeleton %sB\n",
      options.out.c_str(), short_number(static_cast<double>(report->file_bytes)).c_str(),
      report->objects - report->bricks - report->tiles, report->bricks, report->tiles,
      short_number(static_cast<double>(report->object_bytes)).c_str(),
      short_number(static_cast<double>(report->largest_object_bytes)).c_str(),
      short_number(static_cast<double>(report->skeleton_bytes)).c_str());
  return ExitCode::success;
}

}  // namespace

Command pack_command() {
  const auto o = std::make_shared<PackOptions>();
  return {
      .name = "pack",
      .summary = "Write a scene as one file of scene parts, which many machines can share",
      .heading = "Scenes",
      .options = {{"scene",
                   &o->scene,
                   "Scene file, or a pack with --skeleton-only",
                   {.form = Form::scene, .required = true}},
                  {"--out",
                   &o->out,
                   "File of the pack",
                   {.form = Form::file, .otherwise = "NAME.luxpack"}},
                  {"--scenario",
                   &o->scenario,
                   "Name of the scenario whose doors count",
                   {.form = Form::name, .otherwise = "the first"}},
                  at_option(o->at),
                  {"--cell-kib",
                   &o->cell_kib,
                   "Largest size of a geometry cell [KiB]; built it takes three times as much",
                   {.range = Range{1, 65536}}},
                  {"--skeleton-only", &o->skeleton_only, "Pack without its scene parts"},
                  {"--json", &o->json, "Output as JSON"}},
      .notes =
          "  luxodus pack scenes/library/office_floor.toml --scenario smoke_emergency \\\n"
          "    --out f.luxpack\n"
          "  luxodus run f.luxpack --nodes 2 --fibers 1024 --part-cache-mib 64\n"
          "  luxodus pack f.luxpack --skeleton-only --out f.skeleton.luxpack\n"
          "Scene parts are geometry cells, bricks of smoke data (16^3 cells) and tiles of pictures "
          "(64^2 texels). Every command that takes a scene takes a pack. Only the pages that are "
          "needed are read, so a scene may be larger than a machine's memory. All scenarios that "
          "leave the doors as the packed one does can be run from it. Machines that get all scene "
          "parts from others need the skeleton only.",
      .run = [o] { return exit_code_of(pack(*o)); }};
}

}  // namespace luxodus::cli
