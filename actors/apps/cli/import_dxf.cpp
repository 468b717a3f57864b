// luxodus import dxf: turns the lines of a plan into walls, and block references into luminaires
// and signs.
#include <filesystem>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/import/write_plan.hpp"
#include "runtime/core/printable.hpp"
#include "runtime/core/reading_share.hpp"
#include "scenes/formats/dxf/dxf_plan.hpp"
#include "scenes/light/geometry/transform.hpp"

namespace luxodus::cli {

namespace {

struct ImportDxfOptions {
  std::string drawing;
  std::string out;
  std::string units;
};

Result<double> unit_of(const ImportDxfOptions& options, const DxfPlan& plan) {
  if (!options.units.empty()) return metres_per_unit(options.units);
  if (plan.metres_per_unit > 0) return plan.metres_per_unit;
  return problem_in(options.drawing, plan.unit_problem + ": say it by --units");
}

Result<ExitCode> import_dxf(const ImportDxfOptions& options) {
  const auto plan = [&] {
    ReadingShare share;
    const WaitingLine waiting("reading " + options.drawing, &share);
    return read_dxf_plan(options.drawing, &share);
  }();
  if (!plan) return plan.problem();
  const auto unit = unit_of(options, plan.value());
  if (!unit) return unit.problem();
  const auto written = write_plan(plan.value(), unit.value(), options.drawing, options.out);
  if (!written) return written.problem();
  std::printf("lines %zu, blocks %zu; walls %zu, luminaires %zu, signs %zu\n", written->lines,
              written->blocks, written->walls, written->luminaires, written->signs);
  for (const std::string& what : written->notes) std::printf("note: %s\n", printable(what).c_str());
  for (const std::string& what : written->asked)
    std::printf("asked for: %s\n", printable(what).c_str());
  std::printf("%s%s\n", (std::filesystem::path(options.out) / "building.toml").c_str(),
              written->kept_scene ? ", and scene.toml as it was" : " and scene.toml");
  return ExitCode::success;
}

}  // namespace

Command import_dxf_command() {
  const auto o = std::make_shared<ImportDxfOptions>();
  return {
      .name = "dxf",
      .summary = "Make a scene of a DXF plan: lines become walls, blocks luminaires and signs",
      .options =
          {{"drawing", &o->drawing, "Plan (.dxf)", {.form = Form::file, .required = true}},
           {"-o,--out", &o->out, "Folder of the scene", {.form = Form::folder, .required = true}},
           {"--units",
            &o->units,
            "Unit of length of the drawing",
            {.otherwise = "that of its header; an error where it has none",
             .choices = {"m", "cm", "mm", "km", "in", "ft"}}}},
      .notes =
          "The first import writes plan.toml, which lists layers and blocks. Say there what they "
          "become, and import again: building.toml is written anew, all other files are yours.\n"
          "  luxodus import dxf plan.dxf --out office --units mm",
      .run = [o] { return exit_code_of(import_dxf(*o)); }};
}

}  // namespace luxodus::cli
