// Solids of an IFC model as closed meshes, in the model's unit and double precision: extrusions,
// blocks, cylinders, cones, pyramids, faceted breps, face sets, and all of these cut by half spaces
// or convex bodies. Internal to the reading of IFC; one thread, since it reads through a StepGraph.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "scenes/formats/ifc/step_draft.hpp"
#include "scenes/formats/ifc/step_graph.hpp"
#include "scenes/light/geometry/mesh.hpp"

namespace luxodus {

namespace limits {
/// Operations of one solid, one within another.
inline constexpr int solid_depth = 40;
/// Triangles of one solid.
inline constexpr size_t solid_triangles = 200'000;
/// Sides of an outline that bounds a half space.
inline constexpr size_t bounding_sides = 60;
/// Triangles that are made or cut for all solids of a model: about a minute. A model of 100 000
/// walls, each clipped twice, needs 5 million.
inline constexpr uint64_t solid_work = 100'000'000;
/// Triangles of operands that are remembered while one solid is computed: 200 MB.
inline constexpr size_t remembered_triangles = 4'000'000;
}  // namespace limits

/// The work that the solids of one model may still take.
class SolidBudget {
 public:
  explicit SolidBudget(uint64_t triangles = limits::solid_work) : left_(triangles) {}

  /// Whether this many triangles were left; they are taken off.
  bool spend(uint64_t triangles) {
    is_spent_ = is_spent_ || triangles > left_;
    left_ -= is_spent_ ? 0 : triangles;
    return !is_spent_;
  }
  /// Whether something was refused: then everything is.
  bool is_spent() const { return is_spent_; }

 private:
  uint64_t left_;
  bool is_spent_ = false;
};

/// Nothing for an item that is not known here, whose mesh is not closed, or that takes more work
/// than the budget has. An operand that occurs several times in a solid is computed once.
/// `one_place`: distance below which a point is on a plane, in the model's unit.
std::optional<Mesh> step_solid(StepGraph& graph, const StepNode& item, double one_place,
                               SolidBudget& budget);
/// The same, with a budget of its own.
std::optional<Mesh> step_solid(StepGraph& graph, const StepNode& item, double one_place = 1e-6);

/// The parameters of an IfcFacetedBrep; its instances are added.
std::string brep_body(StepDraft& draft, const Mesh& mesh);

/// The coordinates of a point, as the parameters of an IfcCartesianPoint or IfcDirection.
std::string step_point(const glm::dvec3& p, int dimensions);

/// A number as exchange files write it, with all digits.
std::string step_number(double x);

}  // namespace luxodus
