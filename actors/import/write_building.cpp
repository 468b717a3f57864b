#include "actors/import/write_building.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "actors/import/hand_changes.hpp"
#include "actors/import/import_files.hpp"
#include "actors/import/own_tables.hpp"
#include "actors/results/formats/write_glb.hpp"
#include "runtime/core/atomic_file.hpp"
#include "runtime/core/printable.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/formats/photometry/gldf.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"

namespace luxodus {
namespace {

namespace fs = std::filesystem;

/// The limit of every scene file.
constexpr uint64_t max_building_bytes = uint64_t{16} << 20;

/// Rounds to a tenth of a millimetre, the precision of shapes.
double rounded(double metres) {
  return std::round(metres * 1e4) / 1e4 + 0.0;  // no negative zero
}

std::string point_text(const glm::dvec3& p) {
  return fmt::format("[{:.12g}, {:.12g}, {:.12g}]", rounded(p.x), rounded(p.y), rounded(p.z));
}

std::string axis_text(const glm::dvec3& v) {
  const auto number = [](double x) { return std::abs(x) < 1e-9 ? 0.0 : x; };
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", number(v.x), number(v.y), number(v.z));
}

// ---- a person's tables
// ---------------------------------------------------------------------------

void add_materials(const IfcBuilding& building, OwnTables& tables) {
  for (const auto& [name, material] : building.materials) {
    if (tables.has("material", name)) continue;
    tables.added += fmt::format("\n[[material]]\nname = {}\n", toml_text(name));
    tables.added += material.clear ? std::string("kind = \"glass\"\n")
                                   : fmt::format("reflectance = {:.2f}\n", material.grey);
  }
}

constexpr const char* materials_head =
    "# What the surfaces of the building are made of, by the material's name in the model. This "
    "file "
    "is\n# yours: an import adds what is new at its end and changes nothing else.\n"
    "# The numbers are luminances of display colours: a model knows no reflectances. State them.\n";

constexpr const char* fixtures_head =
    "# Types of the luminaires and signs of the model. This file is yours: an import adds what is "
    "new at\n# its end and changes nothing else. A type that is commented out is not placed: give "
    "it "
    "a file and\n# take the signs away, then import again. Types that are no lights stay as they "
    "are.\n";

// ---- fixtures
// --------------------------------------------------------------------------------------

/// The photometric file of a type: by the name in the model, or by names of the type and of its
/// fixtures.
std::optional<fs::path> photometry_of(const std::map<std::string, fs::path>& files,
                                      const std::vector<const BuildingFixture*>& of_type) {
  std::vector<std::string> names;
  for (const BuildingFixture* f : of_type) {
    names.push_back(fs::path(f->document).stem().string());
    names.push_back(f->type);
    names.push_back(f->name);
  }
  for (const std::string& name : names)
    if (const auto it = files.find(letters_and_digits(name));
        it != files.end() && !letters_and_digits(name).empty())
      return it->second;
  return std::nullopt;
}

/// Whether a file says one luminaire by itself. Errors: it is damaged, or a container in which one
/// is chosen.
Result<void> says_one_luminaire(const fs::path& file) {
  if (letters_and_digits(file.extension().string()) != "gldf") {
    const auto read = read_photometric_file(file);
    return read ? Result<void>() : read.problem();
  }
  const auto product = read_gldf(file);
  if (!product) return product.problem();
  const auto luminaire = luminaire_of(product.value(), {});
  return luminaire ? Result<void>() : luminaire.problem();
}

std::string says_text(const BuildingFixture& fixture) {
  std::string out;
  for (const std::string& words : fixture.says) out += (out.empty() ? "" : ", ") + words;
  return out.empty() ? out : "# The model says: " + out + ".\n";
}

std::string luminaire_type_text(const BuildingFixture& fixture, size_t count,
                                const std::string& file) {
  const char* off = file.empty() ? "# " : "";
  std::string out = fmt::format("\n# {} in the model.\n{}", count, says_text(fixture));
  if (file.empty())
    out += fmt::format("# Its photometric file is asked for{}.\n",
                       fixture.document.empty() ? "" : ": the model names " + fixture.document);
  out += fmt::format("{0}[[luminaire_type]]\n{0}name = {1}\n{0}file = {2}\n", off,
                     toml_text(fixture.type), file.empty() ? "\"\"" : file);
  if (fixture.says.empty()) return out;
  return out +
         "# emergency = \"non-maintained\"\n# emergency_factor =        # or emergency_flux, or a "
         "GLDF container\n# emergency_flux_is =       # \"rated\", or \"initial\" with an "
         "end_of_duration_factor\n# maintenance_factor = \n";
}

std::string sign_type_text(const BuildingFixture& fixture, size_t count) {
  return fmt::format(
      "\n# {} in the model.\n{}"
      "# What its face shows and how bright it is, no model says.\n"
      "# [[sign_type]]\n# name = {}\n# file = \"\"            # drawing of its face, or text = \n"
      "# smallest_detail = \n# mains_white = \n# mains_green = \n# emergency_white = \n"
      "# emergency_green = \n",
      count, says_text(fixture), toml_text(fixture.type));
}

using FixtureTypes = std::map<std::pair<bool, std::string>, std::vector<const BuildingFixture*>>;

/// The file of the intensities that the model states for a type: the same name in every import.
fs::path own_photometry_file(const std::string& type) {
  uint32_t hash = 2166136261u;  // FNV-1a
  for (const char c : type) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return fs::path("building") /
         fmt::format("light-{}-{:08x}.ies", letters_and_digits(type).substr(0, 40), hash);
}

/// Writes the intensities of a type that the model states; "" where it states none.
Result<std::string> own_photometry(const std::string& type,
                                   const std::vector<const BuildingFixture*>& of_type,
                                   const fs::path& folder) {
  for (const BuildingFixture* f : of_type) {
    if (f->is_sign || f->photometry.empty()) continue;
    const fs::path file = own_photometry_file(type);
    std::error_code failed;
    fs::create_directories(folder / "building", failed);
    if (auto ok = write_file_atomically(folder / file, std::string_view(f->photometry)); !ok)
      return ok.problem();
    return file.generic_string();
  }
  return std::string();
}

/// The kind of a type's table: a sign and a luminaire may have types with the same name.
const char* table_of(bool is_sign) {
  return is_sign ? "sign_type" : "luminaire_type";
}

FixtureTypes types_of(const IfcBuilding& building) {
  FixtureTypes types;
  for (const BuildingFixture& f : building.fixtures) types[{f.is_sign, f.type}].push_back(&f);
  return types;
}

Result<void> add_types(const FixtureTypes& types, const std::map<std::string, fs::path>& files,
                       const fs::path& folder, OwnTables& tables, WrittenBuilding& written) {
  for (const auto& [kind, fixtures] : types) {
    const auto& [is_sign, type] = kind;
    const std::string table = table_of(is_sign);
    const auto own = own_photometry(type, fixtures, folder);
    if (!own) return own.problem();
    if (tables.has(table, type)) continue;
    const BuildingFixture& one = *fixtures.front();
    auto found = is_sign ? std::nullopt : photometry_of(files, fixtures);
    std::string why = one.document.empty() ? "" : ": the model names " + one.document;
    if (found)
      if (auto ok = says_one_luminaire(*found); !ok) {
        why = ": " + ok.problem().text();
        found.reset();
      }
    if (!found && !own->empty()) found = folder / own.value();
    if (!found)
      written.asked.push_back(fmt::format("{} \"{}\" ({}){}", is_sign ? "sign" : "luminaire", type,
                                          fixtures.size(), why));
    if (!found && tables.mentions(table, type)) continue;
    std::string file;
    if (found) {
      const auto name = quoted_from(folder, *found);
      if (!name) return name.problem();
      file = name.value();
      tables.named.insert({table, type});
    }
    tables.added += is_sign ? sign_type_text(one, fixtures.size())
                            : luminaire_type_text(one, fixtures.size(), file);
  }
  return {};
}

std::string fixture_text(const BuildingFixture& f) {
  if (f.is_sign)
    return fmt::format(
        "\n[[sign]]\nname = {}\ntype = {}\nposition = {}\nfacing = {}\nwidth = {:.4g}\n"
        "height = {:.4g}\ndouble_sided = {}\nifc_guid = {}\n",
        toml_text(f.name), toml_text(f.type), point_text(f.position), axis_text(f.direction),
        f.width_m, f.height_m, f.double_sided, toml_text(f.guid));
  const bool down = f.direction.z < -0.999999;
  return fmt::format(
      "\n[[luminaire]]\nname = {}\ntype = {}\nposition = {}\n{}rotation_deg = {:.6g}\n"
      "ifc_guid = {}\n",
      toml_text(f.name), toml_text(f.type), point_text(f.position),
      down ? "" : "direction = " + axis_text(f.direction) + "\n", f.rotation_deg,
      toml_text(f.guid));
}

// ---- the building
// ----------------------------------------------------------------------------------

std::string door_text(const BuildingPart& part) {
  return fmt::format(
      "\n[[import.part]]\nmatch = {}\n[import.part.door]\nhinge = {}\n"
      "open_angle_deg = {:g}\n",
      toml_text(part.name), point_text(part.hinge->point), part.hinge->open_angle_deg);
}

/// The table of a storey; its materials are those of the scene with the same names.
std::string storey_text(const BuildingStorey& storey, const std::string& file,
                        const glm::dvec3& origin) {
  std::set<std::string> materials;
  for (const BuildingPart& part : storey.parts) materials.insert(part.material);
  std::string out = fmt::format(
      "\n# Elevation {:.6g} m.\n[[import]]\nname = {}\nfile = {}\nunits = \"m\"\n"
      "up = \"y\"\n",
      storey.elevation_m, toml_text(storey.name), toml_text(file));
  if (origin != glm::dvec3(0)) out += "translate = " + point_text(origin) + "\n";
  out += "[import.materials]\n";
  for (const std::string& name : materials)
    out += fmt::format("{} = {}\n", toml_text(name), toml_text(name));
  if (std::any_of(storey.parts.begin(), storey.parts.end(),
                  [](const BuildingPart& p) { return p.furniture; }))
    out += "\n[[import.part]]\nmatch = \"furniture *\"\ntags = [\"furniture\"]\n";
  for (const BuildingPart& part : storey.parts) {
    if (part.open)
      out += fmt::format("\n[[import.part]]\nmatch = {}\ntags = [\"open solid\"]\n",
                         toml_text(part.name));
    if (part.hinge) out += door_text(part);
  }
  return out;
}

std::string room_text(const BuildingRoom& room) {
  std::string corners;
  for (const glm::dvec2& p : room.outline)
    corners += fmt::format("{}[{:.12g}, {:.12g}]", corners.empty() ? "" : ", ", rounded(p.x),
                           rounded(p.y));
  return fmt::format("\n[[open_area]]\nname = {}\noutline = [{}]\nz = {:.12g}\nifc_guid = {}\n",
                     toml_text(room.name), corners, rounded(room.z_m), toml_text(room.guid));
}

std::string exit_text(const BuildingExit& exit) {
  return fmt::format("\n[[emphasis]]\nname = {}\nkind = \"{}\"\nposition = {}\nifc_guid = {}\n",
                     toml_text(exit.name), exit.final_exit ? "final_exit" : "exit_door",
                     point_text(exit.position), toml_text(exit.guid));
}

/// The point, of a grid over the first room or the building, that is farthest from all surfaces.
glm::dvec3 free_place(const IfcBuilding& building) {
  Bounds box;
  if (!building.rooms.empty()) {
    const BuildingRoom& room = building.rooms.front();
    for (const glm::dvec2& p : room.outline) box.extend(glm::dvec3(p, room.z_m));
    box.high.z += room.height_m;
  } else {
    for (const BuildingStorey& storey : building.storeys)
      for (const BuildingPart& part : storey.parts) box.extend(bounds_of(part.mesh));
  }
  if (box.empty()) return glm::dvec3(0);
  constexpr int steps = 5;
  const PartRays rays(building.storeys);
  glm::dvec3 best = (box.low + box.high) / 2.0;
  double farthest = -1;
  for (int i = 0; i < steps * steps * steps; ++i) {
    const glm::dvec3 share(i % steps + 1, i / steps % steps + 1, i / steps / steps + 1);
    const glm::dvec3 at = box.low + (box.high - box.low) * share / (steps + 1.0);
    double nearest = 10;  // a larger distance is no better
    for (glm::length_t axis = 0; axis < 3; ++axis)
      for (const double sign : {1.0, -1.0}) {
        glm::dvec3 way(0);
        way[axis] = sign;
        nearest = std::min(nearest, rays.first(at, way).value_or(nearest));
      }
    if (nearest <= farthest) continue;
    farthest = nearest;
    best = at;
  }
  // A single body has no place inside; takes one above it.
  constexpr double near_m = 0.2;
  return farthest < near_m ? glm::dvec3(best.x, best.y, box.high.z + 1) : best;
}

std::string scene_head(const IfcBuilding& building, bool any_light) {
  std::string out = fmt::format(
      "title = {}\ninclude = [\"building.toml\"]\n\n"
      "# Yours: an import writes this file only where there is none. What the model gave is in\n"
      "# building.toml, and written anew by every import; materials.toml and fixtures.toml are "
      "yours,\n# too. import.txt says what could not be read.\n",
      toml_text(building.title.empty() ? "A building from IFC" : building.title));
  if (!any_light) {
    const glm::dvec3 lamp = free_place(building);
    out +=
        "\n# A stand-in, so that there is light: take it out when fixtures.toml has a type.\n"
        "[[emitter]]\nname = \"stand-in\"\nshape = \"point\"\ndistribution = \"isotropic\"\n"
        "position = " +
        point_text(lamp) + "\nflux_lm = 1000\n";
  }
  out +=
      "\n# Doors of the building stand as drawn, closed, until a scenario opens them:\n"
      "# [[scenario]]\n# name = \"doors open\"\n# doors_open = [\n";
  // Names of parts begin with that of their import.
  constexpr size_t most = 50;
  size_t leaves = 0;
  for (const BuildingStorey& storey : building.storeys)
    for (const BuildingPart& part : storey.parts)
      if (part.hinge && ++leaves <= most)
        out += "#   " + toml_text(storey.name + "." + part.name) + ",\n";
  if (leaves > most) out += fmt::format("#   and {} more in building.toml\n", leaves - most);
  return out + "# ]\n";
}

std::string lines_of(const std::string& title, const std::vector<std::string>& lines) {
  std::string out = "\n" + title + "\n";
  for (const std::string& line : lines) out += "  " + printable(line) + "\n";
  return lines.empty() ? out + "  nothing\n" : out;
}

std::string report_text(const IfcBuilding& building, const WrittenBuilding& written) {
  std::vector<std::string> volumes;
  for (const VolumeDifference& d : building.differences)
    volumes.push_back(fmt::format(
        "#{} {} {}: {:.6g} m3 as authored, {:.6g} m3 as a shape ({:+.1f} %)", d.id, d.name, d.guid,
        d.authored_m3, d.mesh_m3, 100 * (d.mesh_m3 / d.authored_m3 - 1)));
  return fmt::format("What `luxodus import ifc` made of {}, schema {}\n",
                     printable(fs::path(building.file).filename().string()),
                     printable(building.schema)) +
         lines_of("Not read", building.unread) +
         lines_of(fmt::format("Volumes that differ by more than {:g} %, of {} that are authored",
                              100 * limits::volume_difference, building.volumes_compared),
                  volumes) +
         lines_of("Solids that are not closed", written.open_solids) +
         lines_of("Rooms that are not closed", written.open_rooms) +
         lines_of("Types of fixtures that fixtures.toml asks for", written.asked) +
         lines_of("Changed by hand in building.toml", written.by_hand) +
         lines_of("Also", building.notes);
}

/// Single precision must resolve a tenth of a millimetre, which it does up to a kilometre.
glm::dvec3 origin_of(const IfcBuilding& building) {
  constexpr double far_m = 1000;
  Bounds bounds;
  for (const BuildingStorey& storey : building.storeys)
    for (const BuildingPart& part : storey.parts) bounds.extend(bounds_of(part.mesh));
  if (bounds.empty()) return glm::dvec3(0);
  const glm::dvec3 farthest = glm::max(glm::abs(bounds.low), glm::abs(bounds.high));
  return std::max({farthest.x, farthest.y, farthest.z}) < far_m ? glm::dvec3(0)
                                                                : glm::floor(bounds.low);
}

}  // namespace

std::string letters_and_digits(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (std::isalnum(code) || code >= 0x80) out += static_cast<char>(std::tolower(code));
  }
  return out;
}

Result<std::map<std::string, fs::path>> photometry_by_name(const std::string& folder) {
  std::map<std::string, fs::path> out;
  if (folder.empty()) return out;
  std::error_code failed;
  std::vector<fs::path> files;
  for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
    if (files.size() >= limits::photometric_files)
      return problem_in(folder, fmt::format("more than {} files: name a folder of the photometric "
                                            "files of this building",
                                            limits::photometric_files));
    files.push_back(at->path());
  }
  if (failed) return system_problem(folder, "the folder cannot be read", failed.value());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    const std::string ending = letters_and_digits(file.extension().string());
    if (ending == "ldt" || ending == "ies" || ending == "gldf")
      out.emplace(letters_and_digits(file.stem().string()), file);
  }
  return out;
}

namespace {

/// Shapes of storeys, and the bodies of fixtures that are not placed.
std::vector<BuildingStorey> with_bodies(const IfcBuilding& building, const OwnTables& fixtures) {
  std::vector<BuildingStorey> storeys = building.storeys;
  for (const BuildingFixture& fixture : building.fixtures) {
    if (fixtures.has(table_of(fixture.is_sign), fixture.type)) continue;
    for (BuildingStorey& storey : storeys)
      if (storey.name == fixture.storey)
        storey.parts.insert(storey.parts.end(), fixture.body.begin(), fixture.body.end());
  }
  std::erase_if(storeys, [](const BuildingStorey& s) { return s.parts.empty(); });
  return storeys;
}

Result<std::string> write_storeys(const std::vector<BuildingStorey>& storeys,
                                  const glm::dvec3& origin, const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder / "building", failed);
  if (!fs::is_directory(folder / "building", failed))
    return problem_in((folder / "building").string(), "this is no folder, and none can be made");
  std::string tables;
  for (size_t i = 0; i < storeys.size(); ++i) {
    const std::string file = fmt::format("building/storey-{}.glb", i + 1);
    const auto glb = glb_of(storeys[i].parts, origin);
    if (!glb) return glb.problem();
    if (auto ok = write_file_atomically(folder / file, std::string_view(glb.value())); !ok)
      return ok.problem();
    tables += storey_text(storeys[i], file, origin);
  }
  return tables;
}

/// The text of building.toml with what a person has changed in it, and the copy against which the
/// next import finds such changes.
Result<std::string> with_changes_kept(const std::string& fresh, const fs::path& folder,
                                      WrittenBuilding& written) {
  const fs::path file = folder / "building.toml", copy = folder / "building/as-written.toml";
  std::error_code failed;
  HandChanges changes{fresh, {}};
  if (fs::exists(file, failed) && fs::exists(copy, failed)) {
    const auto now = read_regular_file(file, max_building_bytes);
    if (!now) return now.problem();
    const auto before = read_regular_file(copy, max_building_bytes);
    if (!before) return before.problem();
    changes = with_hand_changes(fresh, now.value(), before.value());
  }
  // The copy has the tables of the model, so that a change is one in the next import, too.
  if (auto ok = write_file_atomically(copy, std::string_view(fresh)); !ok) return ok.problem();
  written.by_hand = changes.notes;
  return changes.text;
}

void note_solids(const IfcBuilding& building, WrittenBuilding& written) {
  for (const OpenSolid& solid : building.open_solids)
    written.open_solids.push_back(
        fmt::format("#{} {} {}: faces of {:.3g} m2 are missing; light passes there", solid.id,
                    solid.name, solid.guid, solid.area_m2));
}

void note_rooms(const IfcBuilding& building, WrittenBuilding& written) {
  constexpr double crack = 0.002;  // one ray of 500
  for (const BuildingRoom& room : building.rooms)
    if (room.open_share >= crack)
      written.open_rooms.push_back(
          fmt::format("\"{}\" {}: {:.1f} % of the directions from its middle "
                      "meet nothing, most of them {}",
                      room.name, room.guid, 100 * room.open_share, room.open_towards));
}

}  // namespace

Result<WrittenBuilding> write_building(const IfcBuilding& building, const std::string& out,
                                       const std::string& photometry) {
  WrittenBuilding written;
  const auto files = photometry_by_name(photometry);
  if (!files) return files.problem();
  const auto folder = import_folder(out);
  if (!folder) return folder.problem();
  auto materials = own_tables(folder.value() / "materials.toml", {"material"});
  if (!materials) return materials.problem();
  auto fixtures = own_tables(folder.value() / "fixtures.toml", {"luminaire_type", "sign_type"});
  if (!fixtures) return fixtures.problem();
  add_materials(building, materials.value());
  if (auto ok =
          add_types(types_of(building), files.value(), folder.value(), fixtures.value(), written);
      !ok)
    return ok.problem();
  const auto storeys = with_bodies(building, fixtures.value());
  const auto tables = write_storeys(storeys, origin_of(building), folder.value());
  if (!tables) return tables.problem();
  std::string text = fmt::format(
      "# The building of {}.\n# Made by `luxodus import ifc`, which writes this file anew: change "
      "scene.toml, materials.toml\n# and fixtures.toml instead. Only tables with an ifc_guid that "
      "you change or remove stay so.\n# Names of parts end in their GlobalId.\ninclude = "
      "[\"materials.toml\", \"fixtures.toml\"]\n",
      as_name(fs::path(building.file).filename().string(), "an IFC model"));
  text += tables.value();
  for (const BuildingStorey& storey : storeys) {
    written.parts += storey.parts.size();
    for (const BuildingPart& part : storey.parts) written.doors += part.hinge ? 1 : 0;
  }
  for (const BuildingRoom& room : building.rooms) text += room_text(room);
  for (const BuildingExit& exit : building.exits) text += exit_text(exit);
  for (const BuildingFixture& fixture : building.fixtures) {
    if (!fixtures->has(table_of(fixture.is_sign), fixture.type)) continue;
    text += fixture_text(fixture);
    ++(fixture.is_sign ? written.signs : written.luminaires);
  }
  written.rooms = building.rooms.size();
  note_rooms(building, written);
  note_solids(building, written);
  if (auto ok = save(materials.value(), materials_head); !ok) return ok.problem();
  if (auto ok = save(fixtures.value(), fixtures_head); !ok) return ok.problem();
  const auto kept_text = with_changes_kept(text, folder.value(), written);
  if (!kept_text) return kept_text.problem();
  if (auto ok = write_file_atomically(folder.value() / "building.toml",
                                      std::string_view(kept_text.value()));
      !ok)
    return ok.problem();
  const std::string report = report_text(building, written);
  if (auto ok = write_file_atomically(folder.value() / "import.txt", std::string_view(report)); !ok)
    return ok.problem();
  const bool any_light = written.luminaires + written.signs > 0;
  const auto kept =
      write_unless_there(folder.value() / "scene.toml", scene_head(building, any_light));
  if (!kept) return kept.problem();
  written.kept_scene = kept.value();
  return written;
}

Result<std::string> glb_of(const std::vector<BuildingPart>& parts, const glm::dvec3& origin) {
  GlbScene scene;
  scene.generator = "Luxodus";
  for (const BuildingPart& part : parts) {
    GlbMesh& mesh = scene.meshes.emplace_back();
    mesh.name = part.name;
    mesh.material = part.material;
    for (const glm::dvec3& p : part.mesh.positions) mesh.points.emplace_back(p - origin);
    for (const glm::uvec3& t : part.mesh.triangles)
      mesh.triangles.insert(mesh.triangles.end(), {t.x, t.y, t.z});
  }
  return glb_bytes_of(scene);
}

}  // namespace luxodus
