// Parts are connected by joints. A list of parts still to be placed replaces recursion, so that no
// nesting overflows the stack.
#include "scenes/formats/photometry/l3d.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <pugixml.hpp>

#include "runtime/core/printable.hpp"
#include "scenes/formats/photometry/gldf_archive.hpp"
#include "scenes/formats/photometry/photometric_text.hpp"
#include "scenes/formats/photometry/plain_xml.hpp"

namespace luxodus {
namespace {

/// Metres per unit of L3D; nothing for any other word.
std::optional<double> metres_of(std::string_view unit) {
  constexpr std::array<std::pair<std::string_view, double>, 7> units{{{"m", 1},
                                                                      {"dm", 0.1},
                                                                      {"cm", 0.01},
                                                                      {"mm", 0.001},
                                                                      {"yard", 0.9144},
                                                                      {"foot", 0.3048},
                                                                      {"inch", 0.0254}}};
  const auto it = std::find_if(units.begin(), units.end(),
                               [&](const auto& known) { return known.first == unit; });
  return it == units.end() ? std::nullopt : std::optional(it->second);
}

/// The attributes x, y, z of an element; nothing where one is not a number or exceeds `largest`.
std::optional<glm::dvec3> triple(pugi::xml_node node, double largest) {
  glm::dvec3 out(0);
  constexpr std::array<const char*, 3> names{"x", "y", "z"};
  for (glm::length_t i = 0; i < 3; ++i) {
    const auto number = decimal(node.attribute(names[static_cast<size_t>(i)]).value(), false);
    if (!number || !(std::abs(*number) <= largest)) return std::nullopt;
    out[i] = *number;
  }
  return out;
}

/// Rotates about the part's own axes in the order z, x, y.
Transform turned(const glm::dvec3& degrees) {
  const auto about = [](const glm::dvec3& axis, double angle) {
    return rotation(axis, angle).value();  // an axis of length 1, a finite angle
  };
  return about({0, 0, 1}, degrees.z) * about({1, 0, 0}, degrees.x) * about({0, 1, 0}, degrees.y);
}

/// Calls `each` with the first word of every line and what follows it.
template <class Each>
void for_lines(std::string_view text, Each&& each) {
  constexpr std::string_view blanks = " \t";
  constexpr std::string_view ends("\n\r\f\0", 4);  // line ends for any reader
  while (!text.empty()) {
    const size_t end = std::min(text.find_first_of(ends), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
    line = line.substr(0, line.find_last_not_of(blanks) + 1);
    const size_t word = std::min(line.find_first_of(blanks), line.size());
    std::string_view rest = line.substr(word);
    rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
    each(line.substr(0, word), rest);
  }
}

/// The material library that an OBJ names first, as a view into its text; "" for none.
std::string_view library_of(std::string_view obj) {
  std::string_view out;
  for_lines(obj, [&](std::string_view word, std::string_view rest) {
    if (out.empty() && word == "mtllib") out = rest;
  });
  return out;
}

/// Three numbers from 0 to 1, with blanks between them.
bool is_colour(std::string_view text) {
  int count = 0;
  while (!text.empty()) {
    const size_t end = std::min(text.find_first_of(" \t"), text.size());
    const auto number = decimal(text.substr(0, end), false);
    if (!number || !(*number >= 0 && *number <= 1)) return false;
    ++count;
    text.remove_prefix(end);
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  }
  return count == 3;
}

/// Names and diffuse colours of a material library, without textures and all else. A material
/// without a colour is grey. "" where none has one. `odd`: describes the first colour that cannot
/// be read.
std::string colours_in(std::string_view library, std::string& odd) {
  constexpr std::string_view grey = "0.7 0.7 0.7";
  struct Paint {
    std::string_view name, colour;
  };
  std::vector<Paint> paints;
  for_lines(library, [&](std::string_view word, std::string_view rest) {
    if (word == "newmtl" && !rest.empty()) paints.push_back({rest, {}});
    if (word != "Kd" || paints.empty()) return;
    if (is_colour(rest))
      paints.back().colour = rest;
    else if (odd.empty())
      odd = fmt::format(
          "the colour of its material \"{}\" is \"{}\", and not three numbers from 0 "
          "to 1: it is not used",
          excerpt(paints.back().name), excerpt(rest));
  });
  std::string out;
  bool coloured = false;
  for (const auto& [name, colour] : paints) {
    coloured = coloured || !colour.empty();
    out += fmt::format("newmtl {}\nKd {}\n", name, colour.empty() ? grey : colour);
  }
  return coloured ? out : "";
}

class L3dReader {
 public:
  L3dReader(const GldfArchive& archive, const std::string& file, uint64_t max_bytes)
      : archive_(archive), file_(file), left_bytes_(max_bytes) {}

  Result<L3dModel> read(pugi::xml_node root) {
    for (const auto node : root.child("GeometryDefinitions").children("GeometryFileDefinition"))
      definitions_.emplace(node.attribute("id").value(), node);
    add_geometries(root.child("Structure"), {}, 1);
    // Copies each element, because the list grows meanwhile.
    for (size_t i = 0; i < open_.size() && !problem_; ++i) place(Open(open_[i]));
    if (problem_) return *problem_;
    if (model_.parts.empty()) return problem_in(file_, "'structure.xml' in it places no part");
    return std::move(model_);
  }

 private:
  struct Open {
    pugi::xml_node geometry;
    Transform above;  // of the part above
    int depth = 1;
  };

  void fail(std::string what) {
    if (!problem_) problem_ = problem_in(file_, std::move(what));
  }

  void add_geometries(pugi::xml_node parent, const Transform& above, int depth) {
    if (depth > limits::l3d_depth)
      return fail(fmt::format("more than {} parts hang on each other", limits::l3d_depth));
    for (const auto geometry : parent.children("Geometry")) {
      if (open_.size() >= limits::l3d_parts)
        return fail(fmt::format("more than {} parts", limits::l3d_parts));
      open_.push_back({geometry, above, depth});
    }
  }

  void place(const Open& open) {
    L3dPart part;
    part.name = open.geometry.attribute("partName").value();
    part.place = open.above * placed(open.geometry);
    part.measured = is_measured(open.geometry);
    part.shape = shape(open.geometry.child("GeometryReference").attribute("geometryId").value());
    for (const auto node :
         open.geometry.child("LightEmittingObjects").children("LightEmittingObject"))
      opening(node, part.place);
    for (const auto joint : open.geometry.child("Joints").children("Joint")) {
      const auto stands = joint.child("DefaultRotation");
      Transform below = part.place * placed(joint);
      if (stands) below = below * turned(degrees(stands, joint));
      add_geometries(joint.child("Geometries"), below, open.depth + 1);
    }
    model_.parts.push_back(std::move(part));
  }

  /// Since version 0.9.2; where it is not stated, the part was measured with the light, as readers
  /// of the format take it.
  bool is_measured(pugi::xml_node geometry) {
    const auto stated = geometry.attribute("includedInMeasurement");
    const std::string_view word = bare(stated.value());
    if (!stated || word == "true" || word == "1") return true;
    if (word != "false" && word != "0")
      fail(named(geometry) + " in 'structure.xml' has includedInMeasurement = \"" + excerpt(word) +
           "\"; it is true or false");
    return false;
  }

  std::string named(pugi::xml_node node) const {
    return fmt::format("{} \"{}\"", node.name(), excerpt(node.attribute("partName").value()));
  }

  Transform placed(pugi::xml_node node) {
    const auto position = triple(node.child("Position"), limits::l3d_farthest_m);
    if (!position) {
      fail(fmt::format("{} in 'structure.xml' has no 'Position' of three numbers up to {} m",
                       named(node), limits::l3d_farthest_m));
      return {};
    }
    return translation(*position) * turned(degrees(node.child("Rotation"), node));
  }

  glm::dvec3 degrees(pugi::xml_node turn, pugi::xml_node of) {
    constexpr double largest_deg = 3600;
    const auto angles = triple(turn, largest_deg);
    if (!angles)
      fail(named(of) + " in 'structure.xml' has no rotation of three numbers up to 3600 degrees");
    return angles.value_or(glm::dvec3(0));
  }

  void opening(pugi::xml_node node, const Transform& part) {
    if (model_.openings.size() >= limits::l3d_openings)
      return fail(fmt::format("more than {} luminous openings", limits::l3d_openings));
    const Transform place = part * placed(node);
    model_.openings.push_back(
        {node.attribute("partName").value(), place.offset, place.vector({0, 0, -1})});
  }

  /// Index of a shape, which is unpacked at its first use.
  size_t shape(const std::string& id) {
    const auto [it, fresh] = shape_of_.try_emplace(id, model_.shapes.size());
    if (!fresh || problem_) return it->second;
    const auto definition = definitions_.find(id);
    if (definition == definitions_.end()) {
      fail("a part in 'structure.xml' has the shape \"" + excerpt(id) + "\", which is not defined");
      return 0;
    }
    L3dShape out;
    out.name = id + "/" + definition->second.attribute("filename").value();
    const std::string unit = definition->second.attribute("units").value();
    const auto metres = metres_of(unit);
    if (!metres)
      fail("the shape \"" + excerpt(id) + "\" has the unit \"" + excerpt(unit) +
           "\"; m, dm, cm, mm, yard, foot and inch are read");
    out.metres_per_unit = metres.value_or(1);
    const auto entry = entry_of(out.name);
    if (!entry) {
      fail("the shape \"" + excerpt(out.name) + "\" is not in it");
      return 0;
    }
    auto bytes = archive_.read(*entry, left_bytes_);
    if (!bytes) {
      fail(bytes.problem().what);
      return 0;
    }
    left_bytes_ -= bytes->size();
    out.obj = std::move(bytes).value();
    add_colours(id, out);
    model_.shapes.push_back(std::move(out));
    return it->second;
  }

  std::optional<size_t> entry_of(const std::string& name) const {
    const auto& names = archive_.names();
    const auto entry = std::find(names.begin(), names.end(), name);
    if (entry == names.end()) return std::nullopt;
    return static_cast<size_t>(entry - names.begin());
  }

  /// A body is useful without colours: an error in a library only drops them.
  void add_colours(const std::string& id, L3dShape& shape) {
    const std::string_view name = library_of(shape.obj);
    const auto entry = name.empty() ? std::nullopt : entry_of(id + "/" + std::string(name));
    if (!entry) return;
    const auto library = archive_.read(*entry, std::min(limits::l3d_library_bytes, left_bytes_));
    if (!library) return;
    shape.colours = colours_in(library.value(), shape.odd_colour);
    if (shape.colours.empty()) return;
    left_bytes_ -= std::min<uint64_t>(left_bytes_, shape.colours.size());
    shape.obj.replace(static_cast<size_t>(name.data() - shape.obj.data()), name.size(),
                      l3d_library);
  }

  const GldfArchive& archive_;
  std::string file_;
  uint64_t left_bytes_;
  std::map<std::string, pugi::xml_node> definitions_;
  std::map<std::string, size_t> shape_of_;
  std::vector<Open> open_;
  std::optional<Problem> problem_;
  L3dModel model_;
};

}  // namespace

Result<L3dModel> l3d_of(std::string_view bytes, const std::string& file, uint64_t max_bytes) {
  const auto archive = GldfArchive::open(bytes, file, "L3D model");
  if (!archive) return archive.problem();
  const auto& names = archive->names();
  const auto entry = std::find(names.begin(), names.end(), "structure.xml");
  if (entry == names.end())
    return problem_in(file, "there is no 'structure.xml' in it, so it is no L3D model");
  const auto xml = archive->read(static_cast<size_t>(entry - names.begin()), limits::l3d_xml_bytes);
  if (!xml) return xml.problem();
  pugi::xml_document document;
  if (auto ok = load_plain_xml(document, xml.value(), "structure.xml"); !ok)
    return problem_in(file, ok.problem());
  const auto root = document.child("Luminaire");
  if (!root) return problem_in(file, "'structure.xml' in it has no element 'Luminaire'");
  return L3dReader(archive.value(), file, max_bytes).read(root);
}

}  // namespace luxodus
