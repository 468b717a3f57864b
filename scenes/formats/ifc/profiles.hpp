// Profiles of swept solids as polygons, in the model's unit: those that a few lines can say.
// Internal to the reading of IFC; one thread, since it reads through a StepGraph.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "scenes/formats/ifc/step_graph.hpp"

namespace luxodus {

namespace limits {
/// Corners of a polygon that stands for a circle or an ellipse: the chord of a column of 1 m
/// diameter is 1.1 mm off.
inline constexpr int ifc_circle_corners = 72;
/// Points of one outline.
inline constexpr size_t ifc_outline_points = 20'000;
}  // namespace limits

using Outline = std::vector<glm::dvec2>;

struct IfcProfile {
  Outline outline;             // counter-clockwise, the last point joins the first
  std::vector<Outline> holes;  // clockwise
};

/// Points of a curve of straight pieces and of arcs through three points; a closed one without its
/// last point. Nothing for others.
std::optional<Outline> curve_points(StepGraph& graph, const StepNode& curve);

/// Nothing for a profile that is not known here, or has no area.
std::optional<IfcProfile> ifc_profile(StepGraph& graph, const StepNode& profile);

/// Corners of an ellipse about the origin.
Outline ellipse_points(double radius_x, double radius_y);

}  // namespace luxodus
