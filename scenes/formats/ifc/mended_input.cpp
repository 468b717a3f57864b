#include <cmath>

#include "scenes/formats/ifc/shape_input.hpp"
#include "scenes/formats/ifc/step_draft.hpp"
#include "scenes/formats/ifc/step_graph.hpp"
#include "scenes/formats/ifc/step_solids.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"

namespace luxodus {

namespace {

/// Points nearer to a plane than this are on it [m].
constexpr double on_plane_m = 1e-6;

/// Cuts the items of products.
class Mender {
 public:
  Mender(const StepFile& prepared, double metres_per_unit)
      : graph_(prepared), draft_(prepared), one_place_(on_plane_m / metres_per_unit) {}

  /// Whether an item of a body, or of what it maps, could be cut.
  bool mend(const StepNode& shape) {
    bool any = false;
    for (const uint64_t representation : shape.references(2))
      for (const uint64_t item : graph_.node(representation).references(3))
        any = mend_item(graph_.node(item), 0) || any;
    return any;
  }

  const StepDraft& draft() const { return draft_; }

 private:
  bool mend_item(const StepNode& item, int depth) {
    if (item.is("IFCMAPPEDITEM") && depth < 4) {
      bool any = false;
      for (const uint64_t id : graph_.follow(graph_.follow(item, 0), 1).references(3))
        any = mend_item(graph_.node(id), depth + 1) || any;
      return any;
    }
    if (item.is("IFCFACETEDBREP")) return false;  // as it is
    if (draft_.type(item.id()) == "IFCFACETEDBREP") return true;
    const auto mesh = step_solid(graph_, item, one_place_);
    if (!mesh || mesh->triangles.empty()) return false;
    draft_.replace(item.id(), "IFCFACETEDBREP", brep_body(draft_, *mesh));
    return true;
  }

  StepGraph graph_;
  StepDraft draft_;
  double one_place_;
};

/// The linear scale of a mapped item's target; nothing if it has several.
std::optional<double> scale_of(const StepNode& target) {
  if (!target.is("IFCCARTESIANTRANSFORMATIONOPERATOR3D")) return std::nullopt;
  return target.number(3).value_or(1);
}

/// Volume of an item in cubic units of the model; nothing where it is not known here. Of faces that
/// a model lists the library decides which side is outward, so that volumes may differ.
std::optional<double> item_volume(StepGraph& graph, const StepNode& item, double one_place,
                                  int depth) {
  if (item.is("IFCFACETEDBREP") || item.type().ends_with("FACESET")) return std::nullopt;
  if (!item.is("IFCMAPPEDITEM")) {
    const auto mesh = step_solid(graph, item, one_place);
    return mesh ? std::optional(signed_volume_of(*mesh)) : std::nullopt;
  }
  const auto scale = scale_of(graph.follow(item, 1));
  if (!scale || depth > 3) return std::nullopt;
  double sum = 0;
  for (const uint64_t id : graph.follow(graph.follow(item, 0), 1).references(3)) {
    const auto volume = item_volume(graph, graph.node(id), one_place, depth + 1);
    if (!volume) return std::nullopt;
    sum += *volume;
  }
  return std::abs(*scale * *scale * *scale) * sum;
}

}  // namespace

std::map<uint64_t, double> ifc_solid_volumes(const StepFile& prepared, const IfcModel& model) {
  StepGraph graph(prepared);
  const double unit = model.metres_per_unit;
  std::set<uint64_t> with_openings;
  for (const IfcProduct& product : model.products) with_openings.insert(product.voids);
  std::map<uint64_t, double> out;
  for (const IfcProduct& product : model.products) {
    if (!product.is_solid || with_openings.contains(product.id)) continue;
    double sum = 0;
    bool known = true;
    for (const uint64_t representation : graph.follow(graph.node(product.id), 6).references(2))
      for (const uint64_t item : graph.node(representation).references(3)) {
        const auto volume = item_volume(graph, graph.node(item), on_plane_m / unit, 0);
        known = known && volume;
        sum += volume.value_or(0);
      }
    if (known && sum > 0) out.emplace(product.id, sum * unit * unit * unit);
  }
  return out;
}

std::optional<IfcMendedInput> ifc_mended_input(const StepFile& prepared, const IfcModel& model,
                                               const std::set<uint64_t>& products) {
  if (products.empty()) return std::nullopt;
  Mender mender(prepared, model.metres_per_unit);
  StepGraph graph(prepared);
  IfcMendedInput out;
  for (const uint64_t id : products)
    if (mender.mend(graph.follow(graph.node(id), 6))) out.products.insert(id);
  if (out.products.empty() || mender.draft().is_full()) return std::nullopt;
  auto file = StepFile::of(mender.draft().text(), model.file);
  if (!file) return std::nullopt;
  out.file = std::move(file).value();
  return out;
}

}  // namespace luxodus
