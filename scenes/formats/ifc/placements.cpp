#include "scenes/formats/ifc/placements.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace luxodus {

namespace {

/// A straight line in the plane of a grid.
struct AxisLine {
  glm::dvec2 from{0}, along{1, 0};
};

/// IfcGridAxis: tag, curve, same sense. Nothing where the curve is no straight line.
std::optional<AxisLine> axis_line(StepGraph& graph, const StepNode& axis) {
  StepNode curve = graph.follow(axis, 1);
  if (curve.is("IFCTRIMMEDCURVE")) curve = graph.follow(curve, 0);
  glm::dvec3 from(0), along(0);
  if (curve.is("IFCPOLYLINE")) {
    const auto points = curve.references(0);
    if (points.size() != 2) return std::nullopt;
    from = vector_of(graph.node(points[0]), glm::dvec3(0));
    along = vector_of(graph.node(points[1]), glm::dvec3(0)) - from;
  } else if (curve.is("IFCLINE")) {
    from = vector_of(graph.follow(curve, 0), glm::dvec3(0));
    along = vector_of(graph.follow(graph.follow(curve, 1), 0), glm::dvec3(0));
  } else {
    return std::nullopt;
  }
  if (axis.word(2) == "F") along = -along;
  const auto unit = unit_vector({along.x, along.y, 0});
  if (!unit) return std::nullopt;
  return AxisLine{from, *unit};
}

/// The line at an offset to its left.
AxisLine offset_line(const AxisLine& line, double offset) {
  return {line.from + offset * glm::dvec2(-line.along.y, line.along.x), line.along};
}

}  // namespace

glm::dvec3 vector_of(const StepNode& node, const glm::dvec3& otherwise) {
  const std::vector<double> n = node.numbers(0);
  return n.size() < 2 ? otherwise : glm::dvec3(n[0], n[1], n.size() > 2 ? n[2] : 0);
}

std::optional<glm::dvec3> unit_vector(glm::dvec3 v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0) || !std::isfinite(largest)) return std::nullopt;
  v /= largest;
  return v / glm::length(v);
}

Transform axis_placement(StepGraph& graph, const StepNode& node) {
  Transform out;
  out.offset = vector_of(graph.follow(node, 0), glm::dvec3(0));
  const bool flat = node.is("IFCAXIS2PLACEMENT2D");
  const glm::dvec3 z =
      flat ? glm::dvec3(0, 0, 1)
           : unit_vector(vector_of(graph.follow(node, 1), {0, 0, 1})).value_or(glm::dvec3(0, 0, 1));
  glm::dvec3 x = vector_of(graph.follow(node, flat ? 1 : 2), {1, 0, 0});
  x = unit_vector(x).value_or(glm::dvec3(1, 0, 0));
  x -= glm::dot(x, z) * z;
  // Parallel to the axis: any perpendicular direction, since the schema's default would not do
  // either.
  if (glm::length(x) < 1e-9)
    x = glm::cross(std::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), z);
  x = glm::normalize(x);
  out.linear = glm::dmat3(x, glm::cross(z, x), z);
  return out;
}

void IfcGrids::add(const StepNode& node) {
  if (!node.is("IFCGRID")) return;
  for (const size_t axes : {size_t{7}, size_t{8}, size_t{9}})
    for (const uint64_t axis : node.references(axes))
      placement_of_axis_.emplace(axis, node.reference(5));
}

/// IfcVirtualGridIntersection: two axes, and offsets from them and along z.
std::optional<glm::dvec3> IfcGrids::intersection(StepGraph& graph, const StepNode& node) const {
  const auto axes = node.references(0);
  if (axes.size() != 2) return std::nullopt;
  std::vector<double> offsets = node.numbers(1);
  offsets.resize(3);
  std::array<AxisLine, 2> lines;
  for (size_t i = 0; i < 2; ++i) {
    const auto line = axis_line(graph, graph.node(axes[i]));
    if (!line) return std::nullopt;
    lines[i] = offset_line(*line, offsets[i]);
  }
  const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
  const double turn = cross(lines[0].along, lines[1].along);
  if (std::abs(turn) < 1e-6) return std::nullopt;  // parallel
  const double way = cross(lines[1].from - lines[0].from, lines[1].along) / turn;
  return glm::dvec3(lines[0].from + way * lines[0].along, offsets[2]);
}

std::optional<GridPlacement> IfcGrids::placement(StepGraph& graph, const StepNode& node) const {
  // IFC4x3 has put PlacementRelTo before the location.
  const size_t first = graph.follow(node, 0).is("IFCVIRTUALGRIDINTERSECTION") ? 0 : 1;
  const StepNode location = graph.follow(node, first);
  const auto axes = location.references(0);
  const auto at = intersection(graph, location);
  if (!at) return std::nullopt;
  const auto grid = placement_of_axis_.find(axes.front());
  if (grid == placement_of_axis_.end()) return std::nullopt;
  // Along the first axis, unless a direction or a second intersection is given.
  glm::dvec3 x(axis_line(graph, graph.node(axes.front())).value_or(AxisLine{}).along, 0);
  const StepNode towards = graph.follow(node, first + 1);
  if (towards.is("IFCDIRECTION")) x = vector_of(towards, x);
  if (towards.is("IFCVIRTUALGRIDINTERSECTION")) {
    const auto other = intersection(graph, towards);
    if (!other) return std::nullopt;
    x = *other - *at;
  }
  x.z = 0;
  x = unit_vector(x).value_or(glm::dvec3(1, 0, 0));
  GridPlacement out;
  out.grid = grid->second;
  out.local.linear = glm::dmat3(x, glm::cross(glm::dvec3(0, 0, 1), x), glm::dvec3(0, 0, 1));
  out.local.offset = *at;
  return out;
}

std::optional<Transform> placement_of(StepGraph& graph, const IfcGrids& grids, StepNode node,
                                      double metres_per_unit) {
  Transform out;
  for (int depth = 0; node; ++depth) {
    if (depth >= limits::ifc_chain) return std::nullopt;
    uint64_t above = 0;
    if (node.is("IFCLOCALPLACEMENT")) {
      out = axis_placement(graph, graph.follow(node, 1)) * out;
      above = node.reference(0);
    } else if (node.is("IFCGRIDPLACEMENT")) {
      const auto place = grids.placement(graph, node);
      if (!place) return std::nullopt;
      out = place->local * out;
      above = place->grid;
    } else {
      return std::nullopt;
    }
    if (above != 0 && !graph.node(above)) return std::nullopt;
    node = graph.node(above);
  }
  out.offset *= metres_per_unit;
  return is_finite(out.offset) ? std::optional(out) : std::nullopt;
}

}  // namespace luxodus
