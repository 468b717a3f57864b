// Products are processed in file order, so that the same model gives the same bytes.
#include "actors/import/building.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <set>
#include <unordered_map>

#include "actors/import/import_files.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"
#include "scenes/light/geometry/polygon.hpp"

namespace luxodus {
namespace {

/// A part below this opacity is taken for glass.
constexpr double clear_below = 0.95;

std::string small(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

/// Whether the words of a name call it a light: "Lighting Fixture 3", "Notleuchte", "Table lamp".
bool is_called_light(const std::string& name) {
  static const std::array<std::string_view, 13> words{
      "light fixture",  "lighting fixture", "light-fixture", "lightfixture",
      "luminaire",      "leuchte",          "lampe",         "downlight",
      "spotlight",      "exit sign",        "exit light",    "emergency light",
      "rettungszeichen"};
  const std::string lower = small(name);
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  const size_t lamp = lower.find("lamp");  // no clamp
  if (lamp != std::string::npos && (lamp == 0 || !is_letter(lower[lamp - 1])) &&
      (lamp + 4 == lower.size() || !is_letter(lower[lamp + 4])))
    return true;
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return lower.find(word) != std::string::npos; });
}

/// Lamps count as luminaires where they are parts of none. Kinds that may be anything count by
/// their names.
bool is_fixture(const IfcProduct& p) {
  static const std::set<std::string, std::less<>> by_name{
      "BUILDINGELEMENTPROXY",    "FLOWTERMINAL",      "DISTRIBUTIONELEMENT",
      "DISTRIBUTIONFLOWELEMENT", "ELECTRICAPPLIANCE", "PROXY"};
  if (p.kind == "LIGHTFIXTURE" || p.kind == "SIGN" || p.kind == "LAMP" ||
      p.type_class == "IFCLIGHTFIXTURETYPE" || p.type_class == "IFCLAMPTYPE")
    return true;
  return by_name.contains(p.kind) &&
         (p.light || is_called_light(p.name) || is_called_light(p.type_name) ||
          is_called_light(p.object_type));
}

bool is_furniture(const IfcProduct& p) {
  return p.kind == "FURNITURE" || p.kind == "FURNISHINGELEMENT" ||
         p.kind == "SYSTEMFURNITUREELEMENT";
}

/// Whether a product has a shape but does not block light.
bool is_no_body(const IfcProduct& p) {
  static const std::set<std::string, std::less<>> kinds{
      "OPENINGELEMENT", "OPENING",     "VIRTUALELEMENT", "SPACE", "GRID",
      "ANNOTATION",     "SPATIALZONE", "VOIDINGFEATURE", "PORT",  "DISTRIBUTIONPORT"};
  return kinds.contains(p.kind);
}

/// Its name, or its kind, with its GlobalId: unique, and identifiable in the model.
std::string part_name(const IfcProduct& p, std::string_view word) {
  std::string name = as_name(p.name, "");
  if (name.size() > 60) name = as_name(name.substr(0, 60), "");
  return std::string(word) + (name.empty() ? "" : " " + name) + " " + p.guid;
}

/// Relative luminance of a display colour (IEC 61966-2-1 primaries), limited to what paints reach.
double grey_of(const ImportedPart& part) {
  const glm::dvec3 c = part.base_colour.value_or(glm::dvec3(0.5));
  return std::clamp(0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b, 0.05, 0.85);
}

class Assembly {
 public:
  Assembly(const IfcModel& model, IfcShapes shapes, const ImportProgress& told)
      : model_(model), shapes_(std::move(shapes)), told_(told) {}

  IfcBuilding build() {
    out_.title = model_.project;
    out_.file = model_.file;
    out_.schema = model_.schema;
    for (const Problem& fault : model_.faults) out_.unread.push_back(fault.text());
    if (model_.more_faults > 0)
      out_.unread.push_back(
          fmt::format("{} more faults of the model, which are not listed", model_.more_faults));
    for (const std::string& note : shapes_.notes) out_.unread.push_back(note);
    make_storeys();
    leave_out_strays();
    for (const IfcProduct& product : model_.products) by_id_.emplace(product.id, &product);
    for (const IfcProduct& product : model_.products)
      if (const IfcProduct* whole = fixture_of(product)) parts_of_[whole->id].push_back(&product);
    for (size_t i = 0; i < shapes_.parts.size(); ++i) {
      const std::string& name = shapes_.parts[i].name;
      shapes_of_[name.substr(0, name.find('#'))].push_back(i);
    }
    std::set<std::string> known;
    for (const IfcProduct& product : model_.products) {
      if (!known.insert(product.guid).second) {
        out_.unread.push_back(fmt::format("#{} has the GlobalId {} of another product", product.id,
                                          as_name(product.guid, "\"\"")));
        continue;
      }
      take(product);
    }
    for (const auto& [guid, parts] : shapes_of_)
      if (!known.contains(guid))
        out_.unread.push_back("a shape of " + as_name(guid, "nothing") +
                              ", which is no product of the model, was left out");
    finish();
    return std::move(out_);
  }

 private:
  void make_storeys() {
    for (const IfcStorey& storey : model_.storeys)
      if (storey_at_.try_emplace(storey.id, out_.storeys.size()).second)
        out_.storeys.push_back({as_name(storey.name, "storey"), storey.elevation_m, {}});
    storey_at_[0] = out_.storeys.size();
    out_.storeys.push_back({"no storey", 0, {}});
    std::set<std::string> taken;
    for (BuildingStorey& storey : out_.storeys) {
      const std::string wish = storey.name;
      for (int i = 2; !taken.insert(storey.name).second; ++i)
        storey.name = fmt::format("{} {}", wish, i);
    }
  }

  BuildingStorey& storey_of(const IfcProduct& p) {
    const auto it = storey_at_.find(p.storey_id);
    return out_.storeys[it == storey_at_.end() ? storey_at_[0] : it->second];
  }

  /// Products far from the middle of all: the median, which some strays do not move.
  void leave_out_strays() {
    std::array<std::vector<double>, 3> middles;
    std::vector<glm::dvec3> middle;
    for (const ImportedPart& part : shapes_.parts) {
      const Bounds box = bounds_of(part.mesh);
      middle.push_back((box.low + box.high) / 2.0);
      for (glm::length_t i = 0; i < 3; ++i)
        middles[static_cast<size_t>(i)].push_back(middle.back()[i]);
    }
    if (middle.empty()) return;
    glm::dvec3 centre(0);
    for (glm::length_t i = 0; i < 3; ++i) {
      auto& all = middles[static_cast<size_t>(i)];
      const auto half = all.begin() + static_cast<std::ptrdiff_t>((all.size() - 1) / 2);
      std::nth_element(all.begin(), half, all.end());
      centre[i] = *half;
    }
    for (size_t i = 0; i < shapes_.parts.size(); ++i) {
      const std::string& name = shapes_.parts[i].name;
      const double far = glm::length(middle[i] - centre);
      if (far > limits::stray_m) strays_.emplace(name.substr(0, name.find('#')), far);
    }
    std::erase_if(shapes_.parts, [&](const ImportedPart& part) {
      return strays_.contains(part.name.substr(0, part.name.find('#')));
    });
  }

  /// The luminaire that a product is a part of; null where it is of none.
  const IfcProduct* fixture_of(const IfcProduct& p) const {
    const IfcProduct* at = &p;
    for (int depth = 0; at->part_of != 0 && depth < max_parts_depth; ++depth) {
      const auto whole = by_id_.find(at->part_of);
      if (whole == by_id_.end()) return nullptr;
      at = whole->second;
      if (is_fixture(*at)) return at;
    }
    return nullptr;
  }

  /// A product, and if it is a luminaire its parts.
  std::vector<const IfcProduct*> with_parts(const IfcProduct& p) const {
    std::vector<const IfcProduct*> out{&p};
    if (const auto it = parts_of_.find(p.id); it != parts_of_.end())
      out.insert(out.end(), it->second.begin(), it->second.end());
    return out;
  }

  /// Chosen by the product's material, else its layer, else its kind. Of several materials, a clear
  /// part takes the first one called glass, others the first that is not.
  std::string material_of(const IfcProduct& p, const ImportedPart& part) {
    const bool clear = opacity_of(part) < clear_below;
    const auto fits = [&](const std::string& name) {
      return (small(name).find("glas") != std::string::npos) == clear;
    };
    const auto at = std::find_if(p.materials.begin(), p.materials.end(), fits);
    std::string name = at != p.materials.end() ? *at
                       : !p.materials.empty()  ? p.materials.front()
                       : !p.layer.empty()      ? "layer " + p.layer
                                               : small(p.kind);
    name = as_name(name, "material") + (clear ? ", clear" : "");
    out_.materials.try_emplace(name, BuildingMaterial{grey_of(part), clear});
    return name;
  }

  /// The shapes of a product, joined by material.
  std::vector<BuildingPart> bodies_of(const IfcProduct& p, std::string_view word) {
    std::vector<BuildingPart> bodies;
    for (const size_t i : shapes_with_parts(p)) {
      const ImportedPart& part = shapes_.parts[i];
      const std::string material = material_of(p, part);
      const auto at = std::find_if(bodies.begin(), bodies.end(),
                                   [&](const BuildingPart& b) { return b.material == material; });
      if (at != bodies.end()) {
        append(at->mesh, part.mesh);
        continue;
      }
      BuildingPart body;
      body.name = part_name(p, word);
      if (!bodies.empty()) body.name += fmt::format(" {}", bodies.size() + 1);
      body.material = material;
      body.mesh = part.mesh;
      body.open = shapes_.open.contains(p.guid);
      bodies.push_back(std::move(body));
    }
    return bodies;
  }

  Mesh whole_mesh(const IfcProduct& p) {
    Mesh mesh;
    for (const size_t i : shapes_with_parts(p)) append(mesh, shapes_.parts[i].mesh);
    join_identical_vertices(mesh);
    return mesh;
  }

  std::vector<size_t> shapes_with_parts(const IfcProduct& p) const {
    std::vector<size_t> out;
    for (const IfcProduct* one : with_parts(p))
      if (const auto it = shapes_of_.find(one->guid); it != shapes_of_.end())
        out.insert(out.end(), it->second.begin(), it->second.end());
    return out;
  }

  void take(const IfcProduct& p) {
    if (const auto stray = strays_.find(p.guid); stray != strays_.end()) {
      out_.unread.push_back(
          fmt::format("#{} ({}, \"{}\", {}) stands {:.0f} km from the others, and was "
                      "left out: move it in the model",
                      p.id, small(p.kind), as_name(p.name, ""), p.guid, stray->second / 1000));
      return;
    }
    const bool has_shape = shapes_of_.contains(p.guid);
    // Spaces state their own volumes; many are in other units.
    if (has_shape && !is_no_body(p)) compare_volume(p);
    if (p.kind == "SPACE") return take_room(p, has_shape);
    if (is_no_body(p)) return;
    tell_of_shape(p, has_shape);
    if (fixture_of(p) != nullptr) return;  // taken with its luminaire
    if (is_fixture(p)) return take_fixture(p);
    if (!has_shape) return;
    if (p.kind == "DOOR") return take_door(p);
    for (BuildingPart& body : bodies_of(p, small(p.kind))) {
      body.furniture = is_furniture(p);
      if (body.furniture) body.name = "furniture" + body.name.substr(p.kind.size());
      storey_of(p).parts.push_back(std::move(body));
    }
  }

  /// Lists a product whose shape is missing, open, or not the body that the schema asks for.
  void tell_of_shape(const IfcProduct& p, bool has_shape) {
    const std::string who =
        fmt::format("#{} ({}, \"{}\", {})", p.id, small(p.kind), as_name(p.name, ""), p.guid);
    if (shapes_.nothing.contains(p.guid))
      out_.unread.push_back(who + " is cut away entirely by its own half spaces");
    else if (!has_shape && p.has_shape)
      out_.unread.push_back(who + " has a shape that gave no triangles");
    if (!p.has_shape && !p.other_shapes.empty())
      out_.unread.push_back(who + " has no body, only: " + as_name(p.other_shapes, ""));
    if (has_shape && !p.taken_as.empty())
      out_.notes.push_back(who + " has no representation \"Body\"; its \"" +
                           as_name(p.taken_as, "") + "\" was taken");
    if (const auto open = shapes_.open.find(p.guid); open != shapes_.open.end())
      out_.open_solids.push_back(
          {p.guid, small(p.kind) + " " + as_name(p.name, ""), p.id, open->second});
  }

  void compare_volume(const IfcProduct& p) {
    if (!p.volume_m3 || !(*p.volume_m3 > 0)) return;
    double mesh_m3 = 0;
    for (const size_t i : shapes_of_[p.guid])
      mesh_m3 += std::abs(signed_volume_of(shapes_.parts[i].mesh));
    ++out_.volumes_compared;
    if (std::abs(mesh_m3 - *p.volume_m3) > limits::volume_difference * *p.volume_m3)
      out_.differences.push_back(
          {p.guid, small(p.kind) + " " + as_name(p.name, ""), p.id, *p.volume_m3, mesh_m3});
  }

  void take_door(const IfcProduct& p) {
    std::vector<DoorPiece> parts;
    for (const size_t i : shapes_of_[p.guid])
      parts.push_back({shapes_.parts[i].mesh, material_of(p, shapes_.parts[i])});
    DoorPieces pieces = door_pieces(parts, p.placement, p.operation);
    BuildingStorey& storey = storey_of(p);
    int number = 0;
    for (DoorLeaf& leaf : pieces.leaves)
      for (BuildingPart& part :
           joined_by_material(std::move(leaf.pieces), part_name(p, "door"), number)) {
        part.hinge = leaf.hinge;
        part.open = shapes_.open.contains(p.guid);
        storey.parts.push_back(std::move(part));
      }
    number = 0;
    for (BuildingPart& part :
         joined_by_material(std::move(pieces.frame), part_name(p, "frame"), number))
      storey.parts.push_back(std::move(part));
    take_exit(p);
  }

  /// One part for each material; from the second one on (`number`) its name ends in a number.
  static std::vector<BuildingPart> joined_by_material(std::vector<DoorPiece> pieces,
                                                      const std::string& name, int& number) {
    std::vector<BuildingPart> parts;
    for (DoorPiece& piece : pieces) {
      const auto at = std::find_if(parts.begin(), parts.end(), [&](const BuildingPart& part) {
        return part.material == piece.material;
      });
      if (at != parts.end()) {
        append(at->mesh, piece.mesh);
        continue;
      }
      BuildingPart part;
      part.name = ++number == 1 ? name : fmt::format("{} {}", name, number);
      part.material = piece.material;
      part.mesh = std::move(piece.mesh);
      parts.push_back(std::move(part));
    }
    return parts;
  }

  void take_exit(const IfcProduct& p) {
    if (p.property("Pset_DoorCommon.FireExit") != "T") return;
    const Bounds bounds = bounds_of(whole_mesh(p));
    BuildingExit exit;
    exit.name = as_name(p.name, "door");
    exit.guid = p.guid;
    exit.position = {(bounds.low.x + bounds.high.x) / 2, (bounds.low.y + bounds.high.y) / 2,
                     bounds.low.z};
    exit.final_exit = p.property("Pset_DoorCommon.IsExternal") == "T";
    out_.exits.push_back(std::move(exit));
  }

  /// Moves out of the door and the wall, to the side of a room, onto its floor.
  void step_into_room(BuildingExit& exit) {
    constexpr double step_m = 0.5, level_m = 0.5;
    for (const glm::dvec2 way : {glm::dvec2(step_m, 0), glm::dvec2(-step_m, 0),
                                 glm::dvec2(0, step_m), glm::dvec2(0, -step_m)}) {
      const glm::dvec2 at = glm::dvec2(exit.position) + way;
      for (const BuildingRoom& room : out_.rooms) {
        if (std::abs(room.z_m - exit.position.z) > level_m || !is_within(room.outline, at))
          continue;
        exit.position = glm::dvec3(at, room.z_m);
        return;
      }
    }
    out_of_rooms_.push_back(exit.guid);
  }

  void take_room(const IfcProduct& p, bool has_shape) {
    const std::string title = as_name(
        p.long_name.empty() || p.long_name == p.name ? p.name : p.name + " " + p.long_name, "room");
    const Mesh mesh = has_shape ? whole_mesh(p) : Mesh{};
    const auto floors = floor_outlines(mesh);
    if (floors.empty()) {
      out_.unread.push_back(fmt::format("#{} (space \"{}\", {}) has no floor that can be outlined",
                                        p.id, title, p.guid));
      return;
    }
    const double top = bounds_of(mesh).high.z;
    for (size_t i = 0; i < floors.size(); ++i) {
      BuildingRoom room;
      room.name = floors.size() == 1 ? title : fmt::format("{}, floor {}", title, i + 1);
      room.guid = p.guid;
      room.outline = floors[i].outline;
      room.z_m = floors[i].z_m;
      room.height_m = top - floors[i].z_m;
      out_.rooms.push_back(std::move(room));
    }
  }

  void take_fixture(const IfcProduct& p);
  void take_light(const IfcProduct& p, BuildingFixture& fixture);
  void place_sign(const IfcProduct& p, const Mesh& mesh, BuildingFixture& fixture);

  void finish() {
    set_rooms_on_floors();
    for (BuildingExit& exit : out_.exits) step_into_room(exit);
    for (const std::string& guid : out_of_rooms_)
      out_.notes.push_back("fire exit " + guid + " leads to no room; its point lies in the door");
    const PartRays rays(out_.storeys);
    for (BuildingFixture& fixture : out_.fixtures)
      if (fixture.is_sign) turn_sign(rays, fixture);
    for (size_t i = 0; i < out_.rooms.size(); ++i) {
      look_for_openings(rays, out_.rooms[i]);
      if (told_)
        told_("looking for openings of rooms",
              static_cast<double>(i + 1) / static_cast<double>(out_.rooms.size()));
    }
    std::erase_if(out_.storeys, [&](const BuildingStorey& s) {
      return s.parts.empty() &&
             std::none_of(out_.fixtures.begin(), out_.fixtures.end(),
                          [&](const BuildingFixture& f) { return f.storey == s.name; });
    });
    std::sort(out_.differences.begin(), out_.differences.end(),
              [](const VolumeDifference& a, const VolumeDifference& b) {
                return std::abs(a.mesh_m3 / a.authored_m3 - 1) >
                       std::abs(b.mesh_m3 / b.authored_m3 - 1);
              });
    std::sort(out_.open_solids.begin(), out_.open_solids.end(),
              [](const OpenSolid& a, const OpenSolid& b) { return a.area_m2 > b.area_m2; });
    unique_names();
  }

  void set_rooms_on_floors() {
    constexpr double most = 0.95;
    const PartRays floors(out_.storeys, PartRays::Hit::no_furniture);
    for (BuildingRoom& room : out_.rooms) set_on_floor(floors, room);
    std::erase_if(out_.rooms, [&](const BuildingRoom& room) {
      const std::string who = "room \"" + room.name + "\" " + room.guid;
      if (!(room.floor_share > 0)) {
        out_.notes.push_back(who + " has no floor under it: it became no open area");
        return true;
      }
      if (room.floor_share < most)
        out_.notes.push_back(
            fmt::format("{} has a floor under {:.0f} % of it only", who, 100 * room.floor_share));
      if (room.level_share < most)
        out_.notes.push_back(
            fmt::format("{}: {:.0f} % of its floor lie at another level than {:.3f} m, "
                        "at which the open area is",
                        who, 100 * (1 - room.level_share), room.z_m));
      return false;
    });
  }

  /// Rooms and fixtures with repeated names get their GlobalId appended.
  void unique_names() {
    const auto tell_apart = [](auto& things) {
      std::map<std::string, int> count;
      for (const auto& thing : things) ++count[thing.name];
      for (auto& thing : things)
        if (count[thing.name] > 1) thing.name += " " + thing.guid;
      std::set<std::string> taken;
      for (auto& thing : things) {
        const std::string wish = thing.name;
        for (int i = 2; !taken.insert(thing.name).second; ++i)
          thing.name = fmt::format("{} {}", wish, i);
      }
    };
    tell_apart(out_.rooms);
    tell_apart(out_.fixtures);
    tell_apart(out_.exits);
  }

  static void turn_sign(const PartRays& rays, BuildingFixture& fixture);

  static constexpr int max_parts_depth = 8;

  const IfcModel& model_;
  IfcShapes shapes_;
  const ImportProgress& told_;
  std::map<std::string, std::vector<size_t>> shapes_of_;
  std::map<uint64_t, size_t> storey_at_;
  std::map<std::string, double> strays_;  // distance from the others [m]
  std::unordered_map<uint64_t, const IfcProduct*> by_id_;
  std::map<uint64_t, std::vector<const IfcProduct*>> parts_of_;  // of luminaires
  std::vector<std::string> out_of_rooms_;
  IfcBuilding out_;
};

/// Properties of interest to the user, with the model's words.
std::vector<std::string> fixture_words(const IfcProduct& p) {
  std::vector<std::string> out;
  if (!p.predefined.empty() && p.predefined != "NOTDEFINED") out.push_back("kind " + p.predefined);
  for (const auto& [name, value] : p.properties) {
    const size_t dot = name.find('.');
    if (name.starts_with("Pset_LightFixtureType") && !value.empty())
      out.push_back(as_name(name.substr(dot + 1), "") + " " + as_name(value, ""));
  }
  return out;
}

/// The type of fixtures of one kind. Some exporters give only the type ("100W") and put its family
/// into the product's name ("Sconce:100W:575376"): both together distinguish types.
std::string fixture_type(const IfcProduct& p) {
  const std::string stated = p.type_name.empty() ? p.object_type : p.type_name;
  const size_t colon = p.name.find(':');
  const std::string family = colon == std::string::npos ? "" : p.name.substr(0, colon);
  if (!stated.empty() && (family.empty() || stated.starts_with(family)))
    return as_name(stated, "light");
  if (!stated.empty()) return as_name(family + ":" + stated, "light");
  // Without a type: its own name, without the number of the product.
  const size_t last = p.name.rfind(':');
  const bool numbered = last != std::string::npos && last + 1 < p.name.size() &&
                        p.name.find_first_not_of("0123456789", last + 1) == std::string::npos;
  return as_name(numbered ? p.name.substr(0, last) : p.name, "light");
}

bool is_sign(const IfcProduct& p) {
  if (p.kind == "SIGN") return true;
  const std::string set = "Pset_LightFixtureTypeSecurityLighting.";
  const std::string kind = p.property(set + "SecurityLightingType");
  const std::string pictogram = p.property(set + "PictogramEscapeDirection");
  return kind == "EMERGENCYEXITLIGHT" || (!pictogram.empty() && pictogram != "UNSET" &&
                                          pictogram != "NOTKNOWN" && pictogram != "OTHER");
}

void Assembly::take_fixture(const IfcProduct& p) {
  BuildingFixture fixture;
  fixture.name = as_name(p.name, "light");
  fixture.guid = p.guid;
  fixture.type = fixture_type(p);
  fixture.is_sign = is_sign(p);
  fixture.says = fixture_words(p);
  fixture.storey = storey_of(p).name;
  const Mesh mesh = whole_mesh(p);
  const Bounds bounds = bounds_of(mesh);
  // Without a shape and a light source it hangs at its placement.
  constexpr double below_m = 2e-3;
  fixture.position = p.placement.offset;
  if (!bounds.empty())
    fixture.position = {(bounds.low.x + bounds.high.x) / 2, (bounds.low.y + bounds.high.y) / 2,
                        bounds.low.z - below_m};
  if (p.light) take_light(p, fixture);
  const glm::dvec3 x =
      p.light && p.light->zero_plane ? *p.light->zero_plane : p.placement.linear[0];
  if (std::hypot(x.x, x.y) > 0.1)
    fixture.rotation_deg = std::atan2(x.y, x.x) * 180 / std::numbers::pi;
  if (fixture.is_sign) place_sign(p, mesh, fixture);
  if (!bounds.empty()) fixture.body = bodies_of(p, "fixture");
  out_.fixtures.push_back(std::move(fixture));
}

/// The place and direction of a light source of the model, and its intensities.
void Assembly::take_light(const IfcProduct& p, BuildingFixture& fixture) {
  const IfcLightSource& light = *p.light;
  fixture.document = as_name(light.document, "");
  if (light.kind == "directional") return;  // has no place
  fixture.position = light.position;
  fixture.direction = light.axis;
  if (light.kind != "goniometric") {
    fixture.says.push_back("light source " + light.kind + ", without intensities in candela");
    return;
  }
  if (light.planes.empty()) return;
  if (light.degrees_by_size)
    out_.notes.push_back(
        fmt::format("the angles of the intensities of #{} (\"{}\", {}) are read as degrees: in "
                    "radians, the unit of the model, they would exceed a full circle",
                    p.id, fixture.name, p.guid));
  auto text = ies_text_of(light, fixture.type);
  if (text)
    fixture.photometry = std::move(text).value();
  else
    out_.unread.push_back(fmt::format("the intensities of #{} (\"{}\", {}): {}", p.id, fixture.name,
                                      p.guid, text.problem().what));
}

/// A sign's face is perpendicular to the thinnest of its three extents, in the axes of its
/// placement.
void Assembly::place_sign(const IfcProduct& p, const Mesh& mesh, BuildingFixture& fixture) {
  Bounds local;
  const glm::dmat3 to_local = glm::transpose(p.placement.linear);
  for (const glm::dvec3& q : mesh.positions) local.extend(to_local * (q - p.placement.offset));
  if (local.empty()) return;
  const glm::dvec3 size = local.high - local.low;
  const glm::length_t across = size.x <= size.y ? 0 : 1;
  fixture.position = p.placement.point((local.low + local.high) / 2.0);
  fixture.direction = p.placement.linear[across];
  fixture.width_m = size[1 - across];
  fixture.height_m = size.z;
  // The face lies on the body's front, and distances behind it count from there.
  fixture.double_sided = false;
}

/// Faces the side with more room; both sides if both have room.
void Assembly::turn_sign(const PartRays& rays, BuildingFixture& fixture) {
  constexpr double room_m = 0.5;
  const auto free = [&](const glm::dvec3& way) {
    return rays.first(fixture.position, way).value_or(1e9);
  };
  const double ahead = free(fixture.direction), behind = free(-fixture.direction);
  if (behind > ahead) fixture.direction = -fixture.direction;
  fixture.double_sided = std::min(ahead, behind) > room_m;
}

}  // namespace

IfcBuilding building_of(const IfcModel& model, IfcShapes shapes, const ImportProgress& told) {
  return Assembly(model, std::move(shapes), told).build();
}

}  // namespace luxodus
