// Solids of an IFC model as closed meshes, in the model's unit and double precision: extrusions,
// blocks, cylinders, cones, pyramids, faceted breps, face sets, and all of these cut by half spaces
// or convex bodies. Internal to the reading of IFC; one thread, since it reads through a StepGraph.
#pragma once

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
}  // namespace limits

/// Nothing for an item that is not known here, or whose mesh is not closed.
/// `one_place`: distance below which a point is on a plane, in the model's unit.
std::optional<Mesh> step_solid(StepGraph& graph, const StepNode& item, double one_place = 1e-6);

/// The parameters of an IfcFacetedBrep; its instances are added.
std::string brep_body(StepDraft& draft, const Mesh& mesh);

/// The coordinates of a point, as the parameters of an IfcCartesianPoint or IfcDirection.
std::string step_point(const glm::dvec3& p, int dimensions);

/// A number as exchange files write it, with all digits.
std::string step_number(double x);

}  // namespace luxodus
