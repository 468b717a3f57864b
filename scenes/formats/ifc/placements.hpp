// Placements of products in an IFC model: local ones, one relative to another, and those at the
// intersection of two axes of a grid. In the model's unit. Internal to the reading of IFC; one
// thread, since it reads through a StepGraph.
#pragma once

#include <map>
#include <optional>

#include "scenes/formats/ifc/step_graph.hpp"
#include "scenes/light/geometry/transform.hpp"

namespace luxodus {

namespace limits {
/// Depth of chains of relative placements, and of spatial structure.
inline constexpr int ifc_chain = 64;
}  // namespace limits

/// Coordinates of a point or direction; `otherwise` where it has fewer than two.
glm::dvec3 vector_of(const StepNode& node, const glm::dvec3& otherwise);

/// Avoids overflow for numbers near 1e308; nothing where the vector has no direction.
std::optional<glm::dvec3> unit_vector(glm::dvec3 v);

/// IfcAxis2Placement3D and 2D, in the model's unit; of nothing the identity.
Transform axis_placement(StepGraph& graph, const StepNode& node);

/// An IfcGridPlacement as a placement relative to that of its grid.
struct GridPlacement {
  uint64_t grid = 0;  // the placement of the grid, 0 for none
  Transform local;
};

/// The grids of a model, by their axes.
class IfcGrids {
 public:
  /// Takes an instance if it is a grid.
  void add(const StepNode& node);

  /// Nothing where the axes are of no grid, are no straight lines, or do not intersect.
  std::optional<GridPlacement> placement(StepGraph& graph, const StepNode& node) const;

 private:
  std::optional<glm::dvec3> intersection(StepGraph& graph, const StepNode& node) const;

  std::map<uint64_t, uint64_t> placement_of_axis_;
};

/// A product's placement in metres; nothing where the chain is broken, circular or not finite.
std::optional<Transform> placement_of(StepGraph& graph, const IfcGrids& grids, StepNode node,
                                      double metres_per_unit);

}  // namespace luxodus
