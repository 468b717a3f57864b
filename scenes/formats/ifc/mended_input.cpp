#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include "scenes/formats/ifc/shape_input.hpp"
#include "scenes/formats/ifc/step_draft.hpp"
#include "scenes/formats/ifc/step_graph.hpp"
#include "scenes/formats/ifc/step_solids.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"

namespace luxodus {

namespace {

/// Points nearer to a plane than this are on it [m].
constexpr double on_plane_m = 1e-6;

/// The parts of a mesh that share no vertices.
std::vector<Mesh> separate_parts(const Mesh& mesh) {
  std::vector<uint32_t> parent(mesh.positions.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const glm::uvec3& t : mesh.triangles)
    for (const uint32_t corner : {t.y, t.z}) parent[root(corner)] = root(t.x);
  std::map<uint32_t, Mesh> parts;
  std::vector<uint32_t> number(mesh.positions.size(), UINT32_MAX);
  for (const glm::uvec3& t : mesh.triangles) {
    Mesh& part = parts[root(t.x)];
    glm::uvec3 corners;
    for (glm::length_t i = 0; i < 3; ++i) {
      if (number[t[i]] == UINT32_MAX) {
        number[t[i]] = static_cast<uint32_t>(part.positions.size());
        part.positions.push_back(mesh.positions[t[i]]);
      }
      corners[i] = number[t[i]];
    }
    part.triangles.push_back(corners);
  }
  std::vector<Mesh> out;
  for (auto& [first, part] : parts) out.push_back(std::move(part));
  return out;
}

/// Makes breps of the items of products. Parts that touch are items of their own, since the library
/// would join them.
class Mender {
 public:
  Mender(const StepFile& prepared, double metres_per_unit)
      : graph_(prepared), draft_(prepared), one_place_(on_plane_m / metres_per_unit) {
    for (const StepFile::Instance& instance : prepared.instances())
      if (instance.type == "IFCSTYLEDITEM")
        styles_.emplace(graph_.node(instance).reference(0), instance.id);
  }

  /// Whether an item of a body, or of what it maps, is a brep now.
  bool mend(const StepNode& shape) {
    bool any = false;
    for (const uint64_t representation : shape.references(2))
      any = mend_representation(representation, 0) || any;
    return any;
  }

  const StepDraft& draft() const { return draft_; }

 private:
  bool mend_representation(uint64_t id, int depth) {
    if (const auto known = done_.find(id); known != done_.end()) return known->second;
    bool& any = done_[id];
    std::string more;
    for (const uint64_t item : graph_.node(id).references(3))
      any = mend_item(graph_.node(item), depth, more) || any;
    auto words = draft_.copied_parameters(id);
    if (more.empty() || words.size() < 4 || words[3].size() < 2) return any;
    words[3].insert(words[3].size() - 1, more);
    draft_.replace(id, std::string(draft_.type(id)), joined_parameters(words));
    return any;
  }

  bool mend_item(const StepNode& item, int depth, std::string& more) {
    if (item.is("IFCMAPPEDITEM"))
      return depth < 4 && mend_representation(graph_.follow(item, 0).reference(1), depth + 1);
    if (item.is("IFCFACETEDBREP")) return false;  // as it is
    const auto mesh = step_solid(graph_, item, one_place_, budget_);
    if (!mesh || mesh->triangles.empty()) return false;
    const std::vector<Mesh> parts = separate_parts(*mesh);
    draft_.replace(item.id(), "IFCFACETEDBREP", brep_body(draft_, parts.front()));
    for (size_t i = 1; i < parts.size(); ++i) {
      const uint64_t brep = draft_.add("IFCFACETEDBREP", brep_body(draft_, parts[i]));
      more += ",#" + std::to_string(brep);
      if (const auto style = styles_.find(item.id()); style != styles_.end()) {
        auto words = draft_.copied_parameters(style->second);
        words[0] = "#" + std::to_string(brep);
        draft_.add("IFCSTYLEDITEM", joined_parameters(words));
      }
    }
    return true;
  }

  StepGraph graph_;
  StepDraft draft_;
  double one_place_;
  SolidBudget budget_;
  std::map<uint64_t, uint64_t> styles_;  // of items
  std::map<uint64_t, bool> done_;        // representations
};

/// The linear scale of a mapped item's target; nothing if it has several.
std::optional<double> scale_of(const StepNode& target) {
  if (!target.is("IFCCARTESIANTRANSFORMATIONOPERATOR3D")) return std::nullopt;
  return target.number(3).value_or(1);
}

/// Volumes of items in cubic units of the model; nothing where one is not known here. Of faces that
/// a model lists the library decides which side is outward, so that volumes may differ.
class ItemVolumes {
 public:
  ItemVolumes(const StepFile& prepared, double one_place, uint64_t max_work)
      : graph_(prepared), one_place_(one_place), budget_(max_work) {}

  StepGraph& graph() { return graph_; }
  bool is_spent() const { return budget_.is_spent(); }

  /// Of all items of a representation. Known ones are remembered: a representation may list items
  /// that map another one, and each many times.
  std::optional<double> of_representation(uint64_t id, int depth = 0) {
    if (const auto known = known_.find(id); known != known_.end()) return known->second;
    double sum = 0;
    for (const uint64_t item : graph_.node(id).references(3)) {
      const auto volume = of_item(graph_.node(item), depth);
      if (!volume) return std::nullopt;
      sum += *volume;
    }
    known_.emplace(id, sum);
    return sum;
  }

 private:
  std::optional<double> of_item(const StepNode& item, int depth) {
    if (item.is("IFCFACETEDBREP") || item.type().ends_with("FACESET")) return std::nullopt;
    if (!item.is("IFCMAPPEDITEM")) {
      const auto mesh = step_solid(graph_, item, one_place_, budget_);
      return mesh ? std::optional(signed_volume_of(*mesh)) : std::nullopt;
    }
    const auto scale = scale_of(graph_.follow(item, 1));
    if (!scale || depth > 3) return std::nullopt;
    const auto source = of_representation(graph_.follow(item, 0).reference(1), depth + 1);
    const double volume = std::abs(*scale * *scale * *scale) * source.value_or(0);
    return source && std::isfinite(volume) ? std::optional(volume) : std::nullopt;
  }

  StepGraph graph_;
  double one_place_;
  SolidBudget budget_;
  std::map<uint64_t, double> known_;  // representations
};

}  // namespace

IfcSolidVolumes ifc_solid_volumes(const StepFile& prepared, const IfcModel& model,
                                  uint64_t max_work) {
  const double unit = model.metres_per_unit;
  ItemVolumes items(prepared, on_plane_m / unit, max_work);
  StepGraph& graph = items.graph();
  std::set<uint64_t> with_openings;
  for (const IfcProduct& product : model.products) with_openings.insert(product.voids);
  IfcSolidVolumes out;
  for (const IfcProduct& product : model.products) {
    if (!product.is_solid) continue;
    std::optional<double> sum = 0;
    for (const uint64_t id : graph.follow(graph.node(product.id), 6).references(2)) {
      const auto volume = items.of_representation(id);
      sum = volume ? std::optional(*sum + *volume) : std::nullopt;
      if (!sum) break;
    }
    if (sum)
      out.known.emplace(product.id, IfcSolidVolume{*sum * unit * unit * unit,
                                                   with_openings.contains(product.id)});
    else if (items.is_spent())
      ++out.beyond_budget;
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
