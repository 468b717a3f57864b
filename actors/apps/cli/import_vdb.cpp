// luxodus import vdb: lists the grids of an OpenVDB file, or imports one as the smoke of a scene.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/library.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/import/write_smoke.hpp"
#include "runtime/core/printable.hpp"
#include "runtime/core/reading_share.hpp"
#include "scenes/formats/vdb/vdb.hpp"
#include "scenes/light/geometry/transform.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct ImportVdbOptions {
  std::string file, out, grid;
  double extinction_per_unit = 0;
  uint32_t seconds = 0;  // 0: chosen by the file's size
  std::string units = "m", up = "z";
};

/// luxodus_vdb of an installed program, else the one beside this program.
fs::path vdb_program() {
  std::error_code ignored;
  const fs::path installed =
      shared_folder().parent_path().parent_path() / "lib/luxodus/luxodus_vdb";
  if (fs::is_regular_file(installed, ignored)) return installed;
  return fs::read_symlink("/proc/self/exe", ignored).parent_path() / "luxodus_vdb";
}

void list_grids(const std::vector<VdbGrid>& grids) {
  for (const VdbGrid& grid : grids) {
    const std::string cells = grid.cells > 0 ? fmt::format(", {} cells", grid.cells) : "";
    const std::string fault = grid.fault.empty() ? "" : "; not read: " + printable(grid.fault);
    std::printf("grid \"%s\": %s, %s%s%s\n", printable(grid.name).c_str(),
                printable(grid.type).c_str(), printable(grid.kind).c_str(), cells.c_str(),
                fault.c_str());
  }
}

/// The requested grid; else "density", the usual name of smoke, or the only grid.
Result<std::string> chosen_grid(const ImportVdbOptions& options,
                                const std::vector<VdbGrid>& grids) {
  if (!options.grid.empty()) return options.grid;
  const auto density = std::find_if(grids.begin(), grids.end(),
                                    [](const VdbGrid& g) { return g.name == "density"; });
  if (density != grids.end()) return density->name;
  if (grids.size() == 1) return grids.front().name;
  return problem_in(options.file, grids.empty() ? "there is no grid in it"
                                                : "there are several grids: say --grid");
}

Result<ExitCode> import_vdb(const ImportVdbOptions& options) {
  VdbProgram program{vdb_program()};
  if (options.seconds > 0) program.processor_s = options.seconds;
  const auto grids = list_vdb(options.file, program);
  if (!grids) return grids.problem();
  list_grids(grids.value());
  if (options.out.empty()) return ExitCode::success;
  if (!(options.extinction_per_unit > 0))
    return problem_in(options.file,
                      "densities of OpenVDB have no unit: state by --extinction-per-unit what "
                      "extinction a value of 1 has, in 1/m");
  const auto grid = chosen_grid(options, grids.value());
  if (!grid) return grid.problem();
  const auto smoke = [&] {
    std::error_code unknown;
    ReadingShare share;
    ReadingPart part(&share, fs::file_size(options.file, unknown));
    VdbProgram telling = program;
    telling.told = [&](double read) { part.at_share(read); };
    const WaitingLine waiting("reading " + options.file, &share);
    return read_vdb(options.file, grid.value(), up_axis_named(options.up).value(), telling);
  }();
  if (!smoke) return smoke.problem();
  const SmokeOrigin origin{options.file, grid.value(), options.extinction_per_unit,
                           metres_per_unit(options.units).value()};
  const auto kept = [&] {
    const WaitingLine waiting("writing " + (fs::path(options.out) / "smoke.nrrd").string());
    return write_smoke(smoke.value(), origin, options.out);
  }();
  if (!kept) return kept.problem();
  const glm::dvec3 size =
      smoke->spacing * glm::dvec3(smoke->nx, smoke->ny, smoke->nz) * origin.metres_per_unit;
  std::printf("cells %llu x %llu x %llu, %.4g x %.4g x %.4g m\n",
              static_cast<unsigned long long>(smoke->nx),
              static_cast<unsigned long long>(smoke->ny),
              static_cast<unsigned long long>(smoke->nz), size.x, size.y, size.z);
  std::printf("%s%s\n", (fs::path(options.out) / "smoke.nrrd").c_str(),
              kept.value() ? ", and smoke.toml as it was" : " and smoke.toml");
  return ExitCode::success;
}

}  // namespace

Command import_vdb_command() {
  const auto o = std::make_shared<ImportVdbOptions>();
  return {
      .name = "vdb",
      .summary = "List the grids of an OpenVDB file, and make smoke of one",
      .options =
          {{"file", &o->file, "File (.vdb)", {.form = Form::file, .required = true}},
           {"-o,--out",
            &o->out,
            "Folder of smoke.nrrd and smoke.toml; without it nothing is written",
            {.form = Form::folder}},
           {"--grid", &o->grid, "Grid of the smoke", {.otherwise = "density, or the only one"}},
           {"--extinction-per-unit",
            &o->extinction_per_unit,
            "Extinction of a value of 1 at 633 nm, in 1/m; mandatory with --out",
            {.otherwise = "none", .range = Range{0, 1e9}}},
           {"--units",
            &o->units,
            "Unit of length of the file",
            {.choices = {"m", "cm", "mm", "km", "in", "ft"}}},
           {"--up",
            &o->up,
            "Axis that points up in the file; y in Houdini",
            {.choices = {"y", "z"}}},
           {"--seconds",
            &o->seconds,
            "Longest that reading may take, in seconds of a processor",
            {.otherwise = "30, and 1 more for each 4 MiB of the file", .range = Range{1, 86400}}}},
      .notes =
          "Float grids that are fog volumes are read; level sets, turned axes, and boxes of more "
          "than 134 million cells are refused. Of several frames each is imported to a folder of "
          "its own.\n"
          "  luxodus import vdb smoke.vdb\n"
          "  luxodus import vdb smoke.vdb --out smoke --extinction-per-unit 2 --up y",
      .run = [o] { return exit_code_of(import_vdb(*o)); }};
}

}  // namespace luxodus::cli
