#include "scenes/formats/ifc/representations.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <set>

namespace luxodus {

namespace {

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// How far a representation is from being the body: 0 is the body, none is no body at all.
std::optional<int> distance_from_body(StepGraph& graph, const StepNode& node) {
  constexpr int unnamed = 2, simplified = 3, unknown = 4;
  constexpr std::array<std::string_view, 4> other_views{"SKETCH_VIEW", "PLAN_VIEW", "GRAPH_VIEW",
                                                        "SECTION_VIEW"};
  constexpr std::array<std::string_view, 13> no_bodies{
      "axis",     "annotation",  "box",     "clearance", "cog",          "directrix", "footprint",
      "lighting", "lightsource", "profile", "reference", "surveypoints", "plan"};
  if (node.is("IFCTOPOLOGYREPRESENTATION")) return std::nullopt;
  const StepNode context = graph.follow(node, 0);
  const bool is_part = context.is("IFCGEOMETRICREPRESENTATIONSUBCONTEXT");
  const std::string view = is_part ? context.word(8) : "";
  if (std::find(other_views.begin(), other_views.end(), view) != other_views.end() ||
      view.ends_with("PLAN_VIEW") || view.starts_with("ELEVATION"))
    return std::nullopt;
  std::string name = lower_case(node.text(1));
  if (name.empty() && is_part) name = lower_case(context.text(0));
  if (name == "body") return 0;
  if (name == "facetation") return 1;
  if (name.empty())
    return lower_case(context.text(1)) == "plan" ? std::nullopt : std::optional(unnamed);
  if (name.starts_with("body")) return simplified;  // Body-FallBack
  if (std::find(no_bodies.begin(), no_bodies.end(), name) != no_bodies.end()) return std::nullopt;
  return unknown;
}

/// Whether an item is a solid by its kind; of a mapped item, whether its source is.
bool is_solid_item(StepGraph& graph, const StepNode& item, std::set<uint64_t>& seen) {
  constexpr std::array<std::string_view, 22> solids{"IFCEXTRUDEDAREASOLID",
                                                    "IFCEXTRUDEDAREASOLIDTAPERED",
                                                    "IFCREVOLVEDAREASOLID",
                                                    "IFCREVOLVEDAREASOLIDTAPERED",
                                                    "IFCSURFACECURVESWEPTAREASOLID",
                                                    "IFCFIXEDREFERENCESWEPTAREASOLID",
                                                    "IFCDIRECTRIXCURVESWEPTAREASOLID",
                                                    "IFCSWEPTDISKSOLID",
                                                    "IFCSWEPTDISKSOLIDPOLYGONAL",
                                                    "IFCSECTIONEDSOLIDHORIZONTAL",
                                                    "IFCBOOLEANRESULT",
                                                    "IFCBOOLEANCLIPPINGRESULT",
                                                    "IFCCSGSOLID",
                                                    "IFCBLOCK",
                                                    "IFCSPHERE",
                                                    "IFCRIGHTCIRCULARCYLINDER",
                                                    "IFCRIGHTCIRCULARCONE",
                                                    "IFCRECTANGULARPYRAMID",
                                                    "IFCFACETEDBREP",
                                                    "IFCFACETEDBREPWITHVOIDS",
                                                    "IFCADVANCEDBREP",
                                                    "IFCADVANCEDBREPWITHVOIDS"};
  if (std::find(solids.begin(), solids.end(), item.type()) != solids.end()) return true;
  if (item.is("IFCPOLYGONALFACESET")) return item.word(1) == "T";
  if (item.is("IFCTRIANGULATEDFACESET")) return item.word(2) == "T";
  if (!item.is("IFCMAPPEDITEM")) return false;
  if (!seen.insert(item.id()).second) return true;  // decided by its first use
  const StepNode source = graph.follow(graph.follow(item, 0), 1);
  const auto items = source.references(3);
  return !items.empty() && std::all_of(items.begin(), items.end(), [&](uint64_t id) {
    return is_solid_item(graph, graph.node(id), seen);
  });
}

}  // namespace

IfcBody ifc_body(StepGraph& graph, const StepNode& shape) {
  IfcBody out;
  std::optional<int> nearest;
  for (const uint64_t id : shape.references(2)) {
    const auto distance = distance_from_body(graph, graph.node(id));
    if (distance && (!nearest || *distance < *nearest)) nearest = distance;
  }
  std::set<std::string> left_out;
  for (const uint64_t id : shape.references(2)) {
    const StepNode node = graph.node(id);
    const auto distance = distance_from_body(graph, node);
    const bool is_body = distance && distance == nearest;
    (is_body ? out.representations : out.others).push_back(id);
    if (is_body && *distance > 2) out.taken_as = node.text(1);
    const std::string name = lower_case(node.text(1));
    for (const std::string_view volume : {"clearance", "lighting", "reference", "cog", "box"})
      if (!is_body && name == volume) left_out.insert(node.text(1));
  }
  for (const std::string& name : left_out)
    out.left_out += (out.left_out.empty() ? "" : ", ") + name;
  return out;
}

bool is_solid_body(StepGraph& graph, const IfcBody& body) {
  std::set<uint64_t> seen;
  bool any = false;
  for (const uint64_t id : body.representations)
    for (const uint64_t item : graph.node(id).references(3)) {
      if (!is_solid_item(graph, graph.node(item), seen)) return false;
      any = true;
    }
  return any;
}

}  // namespace luxodus
