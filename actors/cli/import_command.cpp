// luxodus import: what other programs know of a building, as a scene that a person goes on with.
#include <fmt/format.h>

#include <filesystem>

#include "actors/cli/command.hpp"
#include "actors/cli/commands.hpp"
#include "actors/cli/load_scene.hpp"
#include "actors/import/import_files.hpp"
#include "runtime/core/atomic_file.hpp"
#include "scenes/fields/fds_building.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct ImportOptions {
  std::string index;
  std::string out;
  std::string at = "60s";
};

std::string geometry_text(const ImportOptions& options, const FireBuilding& building) {
  std::string out = fmt::format(
      "# The building of {} as FDS computed it, snapped to its grid, at {}.\n"
      "# Made by `luxodus import fds`, which writes this file anew: change scene.toml instead.\n"
      "# Colours are those of Smokeview, which are for display: FDS knows no reflectances.\n",
      fs::path(options.index).filename().string(), options.at);
  for (const std::string& name : building.absent)
    out += fmt::format("# Not there at this time: {}\n", name);
  return out + "\n" + building.objects;
}

/// What a person goes on with: the smoke, a light, and what is left to do.
std::string scene_text(const ImportOptions& options, const FireBuilding& building,
                       const std::string& index) {
  std::string sides, exits;
  for (const std::string& side : building.open_sides)
    sides += fmt::format("{}\"{}\"", sides.empty() ? "" : ", ", side);
  for (const glm::dvec3& exit : building.exits)
    exits += fmt::format("#   [{:.4g}, {:.4g}, {:.4g}]\n", exit.x, exit.y, exit.z);
  if (!exits.empty())
    exits = "\n# Openings that reach the floor, where exits and their signs may be:\n" + exits;
  return fmt::format(
      R"(title = "{} from FDS"
include = ["geometry.toml"]
open_sides = [{}]

# FDS computes extinction only. How smoke scatters is for you to say.
[[medium]]
name = "fire"
kind = "fds"
file = {}
at_s = {:g}
albedo = 0.2      # soot of flaming fires: 0.15 to 0.3
g = 0.6           # smoke: 0.5 to 0.8
angstrom = 1      # extinction follows 1/wavelength

# The light of the flames, where the case has HRRPUV:
# [medium.flames]
# radiant_fraction = 0.35
# soot_temperature_k = 1400

# A stand-in, so that there is light: put your luminaires here.
[[emitter]]
name = "stand-in"
shape = "point"
distribution = "isotropic"
position = [{:.6g}, {:.6g}, {:.6g}]
flux_lm = 1000
{})",
      fs::path(options.index).stem().string(), sides, index, time_asked(options.at).value_or(0),
      building.lamp.x, building.lamp.y, building.lamp.z, exits);
}

Result<ExitCode> import_fds(const ImportOptions& options) {
  const auto building = read_fire_building(options.index, time_asked(options.at).value_or(0));
  if (!building) return building.problem();
  const auto index = quoted_from(options.out, options.index);
  if (!index) return index.problem();
  const auto folder = import_folder(options.out);
  if (!folder) return folder.problem();
  const std::string geometry = geometry_text(options, building.value());
  if (auto ok = write_file_atomically(folder.value() / "geometry.toml", std::string_view(geometry));
      !ok)
    return ok.problem();
  const auto kept = write_unless_there(folder.value() / "scene.toml",
                                       scene_text(options, building.value(), index.value()));
  if (!kept) return kept.problem();
  std::printf(
      "boxes %zu, plates %zu, rectangles of walls, floors and ceilings %zu; obstructions that are "
      "not there at %s: %zu\n%s%s\n",
      building->solids, building->plates, building->faces, options.at.c_str(),
      building->absent.size(), (fs::path(options.out) / "geometry.toml").c_str(),
      kept.value() ? ", and scene.toml as it was" : " and scene.toml");
  return ExitCode::success;
}

}  // namespace

Command import_command() {
  const auto o = std::make_shared<ImportOptions>();
  Command fds{
      .name = "fds",
      .summary = "Make a scene of an FDS case: its building, and its smoke by reference",
      .options =
          {{"index", &o->index, "Index of the case (.smv)", {.form = Form::file, .required = true}},
           {"-o,--out", &o->out, "Folder of the scene", {.form = Form::folder, .required = true}},
           {"--at", &o->at, "Time at which obstructions count, and of the smoke",
            at_option(o->at).traits}},
      .notes =
          "Obstructions become boxes as FDS has snapped them to its grid, the closed faces of "
          "meshes rectangles. geometry.toml is written anew by every import; scene.toml, which is "
          "yours, only where there is none.\n"
          "  luxodus import fds results/corridor.smv --out corridor\n"
          "  luxodus check corridor/scene.toml",
      .run = [o] { return exit_code_of(import_fds(*o)); }};
  return {.name = "import",
          .summary = "Make a scene of what other programs know",
          .heading = "Scenes",
          .commands = {std::move(fds), import_gldf_command(), import_ifc_command(),
                       import_dxf_command()}};
}

}  // namespace luxodus::cli
