#include "actors/import/write_fire.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "actors/import/import_files.hpp"
#include "actors/import/own_tables.hpp"
#include "actors/import/write_building.hpp"
#include "runtime/core/atomic_file.hpp"
#include "runtime/core/printable.hpp"

namespace luxodus {
namespace {

namespace fs = std::filesystem;

constexpr const char* fire_materials_head =
    "# What the surfaces of the building are made of, by their names in FDS. This file is yours: "
    "an\n# import adds what is new at its end and changes nothing else.\n"
    "# Colours are those of Smokeview, which are for display: FDS knows no reflectances. State "
    "them.\n";

/// Writes lines as comments, without characters that would end a line.
std::string comment_lines(const char* what, const std::vector<std::string>& lines) {
  std::string out;
  for (const std::string& line : lines) out += fmt::format("# {}{}\n", what, printable(line));
  return out;
}

/// `[[import]]` of the bodies, whose materials are those of the scene with the same names.
std::string bodies_table(const std::vector<FireBody>& bodies) {
  std::set<std::string> materials;
  for (const FireBody& body : bodies) materials.insert(body.material);
  std::string out =
      "[[import]]\nname = \"bodies\"\nfile = \"geometry.glb\"\nunits = \"m\"\nup = \"y\"\n"
      "[import.materials]\n";
  for (const std::string& name : materials)
    out += fmt::format("{} = {}\n", toml_text(name), toml_text(name));
  return out;
}

Result<void> write_bodies(const std::vector<FireBody>& bodies, const fs::path& folder) {
  std::vector<BuildingPart> parts;
  for (const FireBody& body : bodies) {
    BuildingPart& part = parts.emplace_back();
    part.name = body.name;
    part.material = body.material;
    part.mesh = body.mesh;
  }
  const auto glb = glb_of(parts, glm::dvec3(0));
  if (!glb) return glb.problem();
  return write_file_atomically(folder / "geometry.glb", std::string_view(glb.value()));
}

std::string fire_geometry(const FireBuilding& building, const FireOrigin& source) {
  std::string out = fmt::format(
      "# {}, at {}.\n# Made by `luxodus import fds`, which writes this file anew: change "
      "scene.toml "
      "and materials.toml\n# instead.\n",
      printable(source.made_of), source.at_text);
  out += comment_lines("Not there at this time, but at others: ", building.absent);
  out += comment_lines("", building.notes);
  out += "include = [\"materials.toml\"]\n\n" + building.tables.text();
  return building.bodies.empty() ? out : out + bodies_table(building.bodies);
}

std::string smoke_text(const std::string& index) {
  return fmt::format(R"(
# FDS computes extinction only. How smoke scatters is for you to say.
[[medium]]
name = "fire"
kind = "fds"
file = {}
albedo = 0.2      # soot of flaming fires: 0.15 to 0.3
g = 0.6           # smoke: 0.5 to 0.8
angstrom = 1      # extinction follows 1/wavelength

# The light of the flames, where the case has HRRPUV:
# [medium.flames]
# radiant_fraction = 0.35
# soot_temperature_k = 1400
)",
                     index);
}

/// The clock of smoke and obstructions.
std::string clock_text(double at_s) {
  return fmt::format(R"(
# The state that is taken; --at gives another. With a later 'to', `assess` follows routes over the
# states, and `view` has a slider of them.
[time]
from = {0:g}
to = {0:g}
step = 10
)",
                     at_s);
}

constexpr const char* no_smoke_text =
    "\n# There are no results beside the input file, so there is no smoke. When FDS has run, name\n"
    "# its index:\n# [[medium]]\n# name = \"fire\"\n# kind = \"fds\"\n# file = \"CASE.smv\"\n"
    "# albedo = 0.2\n# g = 0.6\n# angstrom = 1\n";

/// The scene that the user goes on with: the smoke, a light, and what is left to do.
std::string fire_scene(const FireBuilding& building, const FireOrigin& source,
                       const std::string& index) {
  std::string sides, exits;
  for (const std::string& side : building.open_sides)
    sides += fmt::format("{}\"{}\"", sides.empty() ? "" : ", ", side);
  for (const glm::dvec3& exit : building.exits)
    exits += fmt::format("#   [{:.10g}, {:.10g}, {:.10g}]\n", exit.x, exit.y, exit.z);
  if (!exits.empty())
    exits = "\n# Openings that reach the floor, where exits and their signs may be:\n" + exits;
  return fmt::format(
      R"(title = {}
include = ["geometry.toml"]
open_sides = [{}]
{}{}
# A stand-in, so that there is light: put your luminaires here.
[[emitter]]
name = "stand-in"
shape = "point"
distribution = "isotropic"
position = [{:.10g}, {:.10g}, {:.10g}]
flux_lm = 1000
{})",
      toml_text(source.title), sides, clock_text(source.at_s),
      index.empty() ? no_smoke_text : smoke_text(index), building.lamp.x, building.lamp.y,
      building.lamp.z, exits);
}

}  // namespace

Result<bool> write_fire(const FireBuilding& building, const FireOrigin& source,
                        const std::string& out) {
  std::string index;
  if (source.index) {
    const auto quoted = quoted_from(out, *source.index);
    if (!quoted) return quoted.problem();
    index = quoted.value();
  }
  const auto folder = import_folder(out);
  if (!folder) return folder.problem();
  auto materials = own_tables(folder.value() / "materials.toml", {"material"});
  if (!materials) return materials.problem();
  for (const FireMaterial& one : building.tables.materials())
    if (!materials->has("material", one.name)) materials->added += "\n" + material_table(one);
  if (auto ok = save(materials.value(), fire_materials_head); !ok) return ok.problem();
  if (!building.bodies.empty())
    if (auto ok = write_bodies(building.bodies, folder.value()); !ok) return ok.problem();
  const std::string geometry = fire_geometry(building, source);
  if (auto ok = write_file_atomically(folder.value() / "geometry.toml", std::string_view(geometry));
      !ok)
    return ok.problem();
  return write_unless_there(folder.value() / "scene.toml", fire_scene(building, source, index));
}

}  // namespace luxodus
