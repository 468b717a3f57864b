// One pass over all instances gathers products, relations and related instances; a second one adds
// to each product what relations say about it. Attributes are counted as in the schemas: those of
// IfcRoot (GlobalId 0, Name 2), IfcObject (ObjectType 4), IfcProduct (ObjectPlacement 5,
// Representation 6) and IfcElement (Tag 7) are the same in IFC2x3, IFC4 and IFC4x3.
#include "scenes/formats/ifc/ifc_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "runtime/core/printable.hpp"
#include "scenes/formats/ifc/placements.hpp"
#include "scenes/formats/ifc/representations.hpp"
#include "scenes/formats/ifc/step_graph.hpp"

namespace luxodus {
namespace {

using Ids = std::vector<uint64_t>;

constexpr size_t guid_length = 22;

/// Whether an instance begins with a GlobalId, as every IfcRoot does. Decided without parsing it:
/// most instances are points and faces.
bool is_rooted(const StepFile::Instance& instance) {
  const std::string_view b = instance.body;
  return b.size() > guid_length + 1 && b[0] == '\'' && b[guid_length + 1] == '\'';
}

/// "WALL" of "IFCWALLSTANDARDCASE".
std::string kind_of(std::string_view type) {
  if (type.starts_with("IFC")) type.remove_prefix(3);
  for (const std::string_view narrowed : {"STANDARDCASE", "ELEMENTEDCASE"})
    if (type.ends_with(narrowed)) type.remove_suffix(narrowed.size());
  return std::string(type);
}

// ---- units -------------------------------------------------------------------------------------

double prefix_factor(std::string_view prefix) {
  constexpr std::array<std::pair<std::string_view, double>, 16> factors{{{"EXA", 1e18},
                                                                         {"PETA", 1e15},
                                                                         {"TERA", 1e12},
                                                                         {"GIGA", 1e9},
                                                                         {"MEGA", 1e6},
                                                                         {"KILO", 1e3},
                                                                         {"HECTO", 1e2},
                                                                         {"DECA", 1e1},
                                                                         {"DECI", 1e-1},
                                                                         {"CENTI", 1e-2},
                                                                         {"MILLI", 1e-3},
                                                                         {"MICRO", 1e-6},
                                                                         {"NANO", 1e-9},
                                                                         {"PICO", 1e-12},
                                                                         {"FEMTO", 1e-15},
                                                                         {"ATTO", 1e-18}}};
  for (const auto& [word, factor] : factors)
    if (word == prefix) return factor;
  return 1;
}

/// A unit in SI units; `power`: 1 for a length or an angle, 3 for a volume. Nothing where it is
/// none.
std::optional<double> si_factor(StepGraph& graph, const StepNode& unit, int power, int depth = 0) {
  if (depth > 4) return std::nullopt;
  if (unit.is("IFCSIUNIT")) return std::pow(prefix_factor(unit.word(2)), power);
  if (!unit.is("IFCCONVERSIONBASEDUNIT") && !unit.is("IFCCONVERSIONBASEDUNITWITHOFFSET"))
    return std::nullopt;
  const StepNode measure = graph.follow(unit, 3);
  const auto value = measure.number(0);
  const auto of = si_factor(graph, graph.follow(measure, 1), power, depth + 1);
  if (!value || !of || !(*value * *of > 0)) return std::nullopt;
  return *value * *of;
}

struct Units {
  std::optional<double> length, volume, angle;
};

Units units_of(StepGraph& graph, const StepNode& project) {
  Units out;
  for (const uint64_t id : graph.follow(project, 8).references(0)) {
    const StepNode unit = graph.node(id);
    if (unit.word(1) == "LENGTHUNIT") out.length = si_factor(graph, unit, 1);
    if (unit.word(1) == "VOLUMEUNIT") out.volume = si_factor(graph, unit, 3);
    if (unit.word(1) == "PLANEANGLEUNIT") out.angle = si_factor(graph, unit, 1);
  }
  if (!out.volume && out.length) out.volume = std::pow(*out.length, 3);
  return out;
}

// ---- materials, properties, quantities ---------------------------------------------------------

/// Names of the materials that IfcRelAssociatesMaterial relates to.
/// `seen`: visited sets. In a malformed file sets may contain each other, and each many times.
std::vector<std::string> material_names(StepGraph& graph, uint64_t of, std::set<uint64_t>& seen) {
  const StepNode node = graph.node(of);
  if (!node) return {};
  if (node.is("IFCMATERIAL")) return {node.text(0)};
  if (!seen.insert(of).second) return {};
  const auto through = [&](size_t place) {
    std::vector<std::string> all;
    for (const uint64_t id : node.references(place))
      for (std::string& name : material_names(graph, id, seen)) all.push_back(std::move(name));
    return all;
  };
  if (node.is("IFCMATERIALLAYERSETUSAGE") || node.is("IFCMATERIALPROFILESETUSAGE") ||
      node.is("IFCMATERIALLAYERSET") || node.is("IFCMATERIALLAYER") || node.is("IFCMATERIALLIST"))
    return through(0);
  if (node.is("IFCMATERIALCONSTITUENTSET") || node.is("IFCMATERIALPROFILESET") ||
      node.is("IFCMATERIALCONSTITUENT") || node.is("IFCMATERIALPROFILE"))
    return through(2);
  return {};
}

void add_properties(StepGraph& graph, const StepNode& set, double volume_factor, IfcProduct& to) {
  const std::string name = set.text(2);
  if (set.is("IFCPROPERTYSET"))
    for (const uint64_t id : set.references(4)) {
      const StepNode property = graph.node(id);
      std::string value = words_of(property.at(2));
      if (property.is("IFCPROPERTYENUMERATEDVALUE") && property.at(2).items.size() > 1) {
        value.clear();
        for (const StepValue& item : property.at(2).items)
          value += (value.empty() ? "" : ", ") + words_of(item);
      }
      to.properties.emplace(name + "." + property.text(0), std::move(value));
    }
  if (set.is("IFCELEMENTQUANTITY"))
    for (const uint64_t id : set.references(5)) {
      const StepNode quantity = graph.node(id);
      const auto value = quantity.number(3);
      const std::string what = quantity.text(0);
      if (!quantity.is("IFCQUANTITYVOLUME") || !value) continue;
      if (what == "NetVolume" || ((what == "GrossVolume" || what == "Volume") && !to.volume_m3))
        to.volume_m3 = *value * volume_factor;
    }
}

// ---- the model ---------------------------------------------------------------------------------

/// References anywhere within a value: a definition set may be a typed list of them.
void add_references(const StepValue& value, Ids& to) {
  if (value.kind == StepValue::Kind::reference) to.push_back(value.id);
  for (const StepValue& item : value.items) add_references(item, to);
}

/// Relations, from the relating to the related instance.
struct Relations {
  std::map<uint64_t, uint64_t> inside_of, part_of, type_of, fills, voids;
  std::map<uint64_t, Ids> sets, materials;
  std::map<uint64_t, std::string> layers;  // by representation
};

class ModelReader {
 public:
  ModelReader(const StepFile& step, const std::string& file) : step_(step), graph_(step) {
    model_.file = file;
    model_.schema = step.schema();
    model_.faults = step.faults();
    model_.more_faults = step.fault_count() - step.faults().size();
  }

  Result<IfcModel> read() {
    Ids products;
    uint64_t project = 0;
    for (const StepFile::Instance& instance : step_.instances()) {
      if (instance.type == "IFCPRESENTATIONLAYERASSIGNMENT" ||
          instance.type == "IFCPRESENTATIONLAYERWITHSTYLE")
        read_layer(graph_.node(instance));
      if (!is_rooted(instance)) continue;
      if (instance.type == "IFCPROJECT")
        project = instance.id;
      else if (instance.type.starts_with("IFCREL"))
        read_relation(graph_.node(instance));
      else if (is_product(graph_.node(instance)))
        products.push_back(instance.id);
      grids_.add(graph_.node(instance));
    }
    const StepNode root = graph_.node(project);
    model_.project = root.text(2);
    units_ = units_of(graph_, root);
    if (!units_.length)
      return problem_in(model_.file,
                        "the model states no unit of length that is known; it says "
                        "neither metres nor feet, and none is guessed");
    model_.metres_per_unit = *units_.length;
    for (const uint64_t id : products) read_product(graph_.node(id));
    std::sort(model_.storeys.begin(), model_.storeys.end(),
              [](const IfcStorey& a, const IfcStorey& b) { return a.elevation_m < b.elevation_m; });
    return std::move(model_);
  }

 private:
  void fault(uint64_t id, const std::string& what) {
    if (model_.faults.size() < limits::ifc_faults)
      model_.faults.push_back(problem_in(model_.file, fmt::format("#{} {}", id, what)));
    else
      ++model_.more_faults;
  }

  /// Whether an instance has a placement or a shape at the attributes of IfcProduct. A luminaire is
  /// one in any case, so that it is not lost.
  bool is_product(const StepNode& node) {
    const StepNode place = graph_.follow(node, 5), shape = graph_.follow(node, 6);
    return place.type().ends_with("PLACEMENT") || shape.is("IFCPRODUCTDEFINITIONSHAPE") ||
           shape.is("IFCPRODUCTREPRESENTATION") || node.is("IFCLIGHTFIXTURE") || node.is("IFCLAMP");
  }

  void read_layer(const StepNode& node) {
    for (const uint64_t item : node.references(2)) relations_.layers.emplace(item, node.text(0));
  }

  void read_relation(const StepNode& node) {
    const auto all_to_one = [&](std::map<uint64_t, uint64_t>& to, size_t many, size_t one) {
      for (const uint64_t id : node.references(many)) to.emplace(id, node.reference(one));
    };
    if (node.is("IFCRELAGGREGATES") || node.is("IFCRELNESTS")) all_to_one(relations_.part_of, 5, 4);
    if (node.is("IFCRELCONTAINEDINSPATIALSTRUCTURE")) all_to_one(relations_.inside_of, 4, 5);
    if (node.is("IFCRELDEFINESBYTYPE")) all_to_one(relations_.type_of, 4, 5);
    if (node.is("IFCRELFILLSELEMENT")) all_to_one(relations_.fills, 5, 4);
    if (node.is("IFCRELVOIDSELEMENT")) {
      if (node.reference(5) == 0 || node.reference(4) == 0)
        fault(node.id(), "(" + std::string(node.type()) + ") names no opening or no element");
      all_to_one(relations_.voids, 5, 4);
    }
    if (node.is("IFCRELDEFINESBYPROPERTIES"))
      for (const uint64_t id : node.references(4)) add_references(node.at(5), relations_.sets[id]);
    if (node.is("IFCRELASSOCIATESMATERIAL"))
      for (const uint64_t id : node.references(4))
        relations_.materials[id].push_back(node.reference(5));
  }

  static uint64_t related(const std::map<uint64_t, uint64_t>& relation, uint64_t id) {
    const auto it = relation.find(id);
    return it == relation.end() ? 0 : it->second;
  }

  uint64_t storey_of(uint64_t id) {
    for (int depth = 0; id != 0 && depth < limits::ifc_chain; ++depth) {
      const StepNode node = graph_.node(id);
      if (node.is("IFCBUILDINGSTOREY")) return id;
      const uint64_t inside = related(relations_.inside_of, id);
      const uint64_t filled = related(relations_.voids, related(relations_.fills, id));
      id = inside != 0                            ? inside
           : related(relations_.part_of, id) != 0 ? related(relations_.part_of, id)
                                                  : filled;
    }
    return 0;
  }

  static std::string storey_name(const StepNode& node) {
    const std::string name = node.text(2).empty() ? node.text(7) : node.text(2);
    return name.empty() ? fmt::format("storey {}", node.id()) : name;
  }

  void read_product(const StepNode& node) {
    IfcProduct p;
    p.id = node.id();
    p.guid = node.text(0);
    p.kind = kind_of(node.type());
    p.name = node.text(2);
    p.object_type = node.text(4);
    const auto placement = placement_of(graph_, grids_, graph_.follow(node, 5), *units_.length);
    if (!placement) {
      fault(p.id, "(" + std::string(node.type()) + ", \"" + excerpt(p.name) +
                      "\") has a placement that leads nowhere");
      return;
    }
    p.placement = *placement;
    if (node.is("IFCBUILDINGSTOREY"))
      model_.storeys.push_back({p.id, storey_name(node), p.placement.offset.z});
    if (node.is("IFCSPACE"))
      p.long_name = node.text(7);
    else
      p.tag = node.text(7);
    p.storey_id = storey_of(p.id);
    if (p.storey_id != 0) p.storey = storey_name(graph_.node(p.storey_id));
    p.part_of = related(relations_.part_of, p.id);
    p.fills = related(relations_.fills, p.id);
    p.voids = related(relations_.voids, p.id);
    if (p.kind == "DOOR") p.operation = node.word(11);
    for (size_t place = 8; place <= 9 && p.predefined.empty(); ++place)
      p.predefined = node.word(place);
    read_type(graph_.node(related(relations_.type_of, p.id)), p);
    read_related(p.id, p);
    read_representations(graph_.follow(node, 6), p);
    model_.products.push_back(std::move(p));
  }

  /// Takes from the type what the product does not state.
  void read_type(const StepNode& type, IfcProduct& p) {
    if (!type) return;
    p.type_name = type.text(2);
    p.type_class = type.type();
    // IfcDoorStyle has its operation where IfcElementType has the name of its kind.
    if (p.kind == "DOOR" && (p.operation.empty() || p.operation == "NOTDEFINED"))
      p.operation = type.is("IFCDOORSTYLE") ? type.word(8) : type.word(10);
    if (p.predefined.empty() || p.predefined == "NOTDEFINED") p.predefined = type.word(9);
    for (const uint64_t id : type.references(5))
      add_properties(graph_, graph_.node(id), *units_.volume, p);
    add_materials(type.id(), p);
  }

  void add_materials(uint64_t of, IfcProduct& p) {
    const auto it = relations_.materials.find(of);
    if (it == relations_.materials.end()) return;
    p.materials.clear();
    std::set<uint64_t> seen;
    for (const uint64_t id : it->second)
      for (std::string& name : material_names(graph_, id, seen))
        if (!name.empty()) p.materials.push_back(std::move(name));
  }

  void read_related(uint64_t id, IfcProduct& p) {
    std::map<std::string, std::string> of_type;
    of_type.swap(p.properties);
    if (const auto it = relations_.sets.find(id); it != relations_.sets.end())
      for (const uint64_t set : it->second)
        add_properties(graph_, graph_.node(set), *units_.volume, p);
    p.properties.merge(of_type);  // those of the product win
    add_materials(id, p);
  }

  void read_representations(const StepNode& shape, IfcProduct& p) {
    const IfcBody body = ifc_body(graph_, shape);
    p.has_shape = !body.representations.empty();
    p.is_solid = is_solid_body(graph_, body);
    p.other_shapes = body.left_out;
    p.taken_as = body.taken_as;
    for (const uint64_t id : shape.references(2))
      if (const auto it = relations_.layers.find(id); it != relations_.layers.end())
        p.layer = it->second;
    p.light = ifc_light_of(graph_, shape, p.placement, {*units_.length, units_.angle});
  }

  const StepFile& step_;
  StepGraph graph_;
  Units units_;
  Relations relations_;
  IfcGrids grids_;
  IfcModel model_;
};

}  // namespace

std::string IfcProduct::property(const std::string& path) const {
  const auto it = properties.find(path);
  return it == properties.end() ? std::string() : it->second;
}

Result<IfcModel> ifc_model_of(std::string bytes, const std::string& file, ReadingShare* reading) {
  const auto step = StepFile::of(std::move(bytes), file, reading);
  if (!step) return step.problem();
  return ifc_model_of(step.value(), file);
}

Result<IfcModel> ifc_model_of(const StepFile& step, const std::string& file) {
  return ModelReader(step, file).read();
}

}  // namespace luxodus
