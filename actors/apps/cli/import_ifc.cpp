// luxodus import ifc: turns an IFC model into a scene that the user goes on with.
#include <fmt/format.h>

#include <filesystem>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/library.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/import/building.hpp"
#include "actors/import/ifc_shapes.hpp"
#include "actors/import/write_building.hpp"
#include "runtime/core/printable.hpp"
#include "runtime/core/reading_share.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/formats/ifc/ifc_model.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct ImportIfcOptions {
  std::string model;
  std::string out;
  std::string photometry;
  double seconds = 600;
};

/// ifc_shapes.mjs of an installed program, else of the source tree of this build.
fs::path shapes_script() {
  const fs::path installed = shared_folder() / "ifc/ifc_shapes.mjs";
  std::error_code ignored;
  return fs::is_regular_file(installed, ignored) ? installed : fs::path(LUX_IFC_SHAPES);
}

void print_list(const char* title, const std::vector<std::string>& lines) {
  constexpr size_t most = 12;
  if (lines.empty()) return;
  std::printf("%s: %zu\n", title, lines.size());
  for (size_t i = 0; i < std::min(lines.size(), most); ++i)
    std::printf("  %s\n", printable(lines[i]).c_str());
  if (lines.size() > most) std::printf("  ... all in import.txt\n");
}

void tell(const IfcBuilding& building, const WrittenBuilding& written, const std::string& out) {
  std::printf("storeys %zu, parts %zu, door leaves %zu, rooms %zu, luminaires %zu, signs %zu\n",
              building.storeys.size(), written.parts, written.doors, written.rooms,
              written.luminaires, written.signs);
  if (building.volumes_compared == 0)
    std::printf("volumes: the model states none that shapes could be held against\n");
  else
    std::printf("volumes: %zu of %zu authored ones within %g %%\n",
                building.volumes_compared - building.differences.size(), building.volumes_compared,
                100 * limits::volume_difference);
  std::vector<std::string> differences;
  for (const VolumeDifference& d : building.differences)
    differences.push_back(fmt::format("#{} {} {}: {:.4g} m3 authored, {:.4g} m3 as a shape", d.id,
                                      d.name, d.guid, d.authored_m3, d.mesh_m3));
  print_list("volumes that differ", differences);
  print_list("not read", building.unread);
  print_list("solids that are not closed", written.open_solids);
  print_list("rooms that are not closed", written.open_rooms);
  print_list("fixtures that fixtures.toml asks for", written.asked);
  print_list("changed by hand in building.toml", written.by_hand);
  print_list("also", building.notes);
  std::printf("%s%s\n", (fs::path(out) / "building.toml").c_str(),
              written.kept_scene ? ", and scene.toml as it was" : " and scene.toml");
}

Result<ExitCode> import_ifc(const ImportIfcOptions& options) {
  auto bytes = read_regular_file(options.model, limits::step_bytes);
  if (!bytes) return bytes.problem();
  const auto step = [&] {
    ReadingShare share;
    const WaitingLine waiting("reading " + options.model, &share);
    return StepFile::of(std::move(bytes).value(), options.model, &share);
  }();
  if (!step) return step.problem();
  const auto model = ifc_model_of(step.value(), options.model);
  if (!model) return model.problem();
  auto shapes = [&] {
    ReadingShare share;
    const WaitingLine waiting("computing the shapes of " + options.model, &share);
    return shapes_of_model(step.value(), model.value(), shapes_script(), options.seconds, &share);
  }();
  if (!shapes) return shapes.problem();
  ProgressLine line("import");
  const IfcBuilding building = building_of(
      model.value(), std::move(shapes).value(),
      [&](const std::string& what, double share) { line.show_share(share, ", " + what); });
  const auto written = write_building(building, options.out, options.photometry);
  if (!written) return written.problem();
  tell(building, written.value(), options.out);
  return ExitCode::success;
}

}  // namespace

Command import_ifc_command() {
  const auto o = std::make_shared<ImportIfcOptions>();
  return {
      .name = "ifc",
      .summary = "Make a scene of an IFC model: building, rooms, doors, luminaires, signs",
      .options =
          {{"model", &o->model, "Model (.ifc)", {.form = Form::file, .required = true}},
           {"-o,--out", &o->out, "Folder of the scene", {.form = Form::folder, .required = true}},
           {"--photometry",
            &o->photometry,
            "Folder of photometric files (.ldt, .ies, .gldf), found by the names of types",
            {.form = Form::folder}},
           {"--seconds",
            &o->seconds,
            "Longest time that the shapes may take to compute",
            {.range = Range{1, 86400}}}},
      .notes =
          "Shapes are computed by @ifc-lite/wasm under Node.js. building.toml and import.txt are "
          "written anew by every import; scene.toml, materials.toml and fixtures.toml are yours. "
          "What could not be read is listed with its number in the model.\n"
          "  luxodus import ifc house.ifc --out house --photometry luminaires\n"
          "  luxodus check house/scene.toml",
      .run = [o] { return exit_code_of(import_ifc(*o)); }};
}

}  // namespace luxodus::cli
