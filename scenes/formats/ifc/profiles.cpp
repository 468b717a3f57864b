#include "scenes/formats/ifc/profiles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/formats/ifc/placements.hpp"
#include "scenes/light/geometry/polygon.hpp"

namespace luxodus {

namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

/// Adds the arc from the last point over `middle` to `end`; a straight line where they are on one.
void add_arc(Outline& to, const glm::dvec2& middle, const glm::dvec2& end) {
  const glm::dvec2 start = to.back(), u = middle - start, v = end - start;
  const double twice = 2 * cross(u, v);
  if (std::abs(twice) > 1e-12 * (glm::dot(u, u) + glm::dot(v, v))) {
    const glm::dvec2 centre = start + glm::dvec2(v.y * glm::dot(u, u) - u.y * glm::dot(v, v),
                                                 u.x * glm::dot(v, v) - v.x * glm::dot(u, u)) /
                                          twice;
    const glm::dvec2 from = start - centre, to_end = end - centre;
    const double radius = glm::length(from), turn = twice > 0 ? 1 : -1;
    double angle = std::atan2(cross(from, to_end), glm::dot(from, to_end)) * turn;
    if (angle <= 0) angle += 2 * std::numbers::pi;
    const int steps = std::max(2, static_cast<int>(std::ceil(angle / (2 * std::numbers::pi) *
                                                             limits::ifc_circle_corners)));
    const double first = std::atan2(from.y, from.x);
    for (int i = 1; i < steps; ++i) {
      const double a = first + turn * angle * i / steps;
      to.push_back(centre + radius * glm::dvec2(std::cos(a), std::sin(a)));
    }
  } else {
    to.push_back(middle);
  }
  to.push_back(end);
}

/// IfcIndexedPolyCurve: points, segments.
std::optional<Outline> indexed_points(StepGraph& graph, const StepNode& curve) {
  Outline all;
  for (const StepValue& row : graph.follow(curve, 0).at(0).items) {
    if (row.items.size() < 2) return std::nullopt;
    all.emplace_back(row.items[0].number, row.items[1].number);
  }
  const auto& segments = curve.at(1).items;
  if (segments.empty()) return all;
  Outline out;
  for (const StepValue& segment : segments) {
    std::vector<glm::dvec2> at;
    for (const StepValue& list : segment.items)
      for (const StepValue& index : list.items) {
        if (!(index.number >= 1 && index.number <= static_cast<double>(all.size())))
          return std::nullopt;
        at.push_back(all[static_cast<size_t>(index.number) - 1]);
      }
    if (at.size() < 2 || out.size() > limits::ifc_outline_points) return std::nullopt;
    if (out.empty()) out.push_back(at.front());
    if (segment.text == "IFCARCINDEX" && at.size() == 3)
      add_arc(out, at[1], at[2]);
    else
      out.insert(out.end(), at.begin() + 1, at.end());
  }
  return out;
}

std::optional<Outline> open_points(StepGraph& graph, const StepNode& curve, int depth) {
  if (curve.is("IFCPOLYLINE")) {
    Outline out;
    for (const uint64_t id : curve.references(0))
      out.emplace_back(vector_of(graph.node(id), glm::dvec3(0)));
    return out;
  }
  if (curve.is("IFCINDEXEDPOLYCURVE")) return indexed_points(graph, curve);
  if (curve.is("IFCCIRCLE") || curve.is("IFCELLIPSE")) {
    const double x = curve.number(1).value_or(0);
    Outline out = ellipse_points(x, curve.is("IFCCIRCLE") ? x : curve.number(2).value_or(0));
    const Transform place = axis_placement(graph, graph.follow(curve, 0));
    for (glm::dvec2& p : out) p = glm::dvec2(place.point({p, 0}));
    return out;
  }
  if (!curve.is("IFCCOMPOSITECURVE") || depth > 2) return std::nullopt;
  Outline out;
  for (const uint64_t id : curve.references(0)) {
    const StepNode segment = graph.node(id);  // transition, same sense, parent curve
    auto points = open_points(graph, graph.follow(segment, 2), depth + 1);
    if (!points || points->empty() || out.size() > limits::ifc_outline_points) return std::nullopt;
    if (segment.word(1) == "F") std::reverse(points->begin(), points->end());
    out.insert(out.end(), points->begin(), points->end());
  }
  return out;
}

/// Without points that repeat their neighbours, and turned to `sense`. Nothing without an area.
std::optional<Outline> closed_outline(Outline points, double sense) {
  Outline out;
  double size = 0;
  for (const glm::dvec2& p : points) size = std::max({size, std::abs(p.x), std::abs(p.y)});
  const double one_place = 1e-9 * size;
  for (const glm::dvec2& p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return std::nullopt;
    if (out.empty() || glm::length(p - out.back()) > one_place) out.push_back(p);
  }
  while (out.size() > 1 && glm::length(out.front() - out.back()) <= one_place) out.pop_back();
  if (out.size() < 3 || out.size() > limits::ifc_outline_points) return std::nullopt;
  const double area = signed_area(out);
  if (!(std::abs(area) > 0)) return std::nullopt;
  if (area * sense < 0) std::reverse(out.begin(), out.end());
  return out;
}

Outline rectangle(double x, double y) {
  return {{-x / 2, -y / 2}, {x / 2, -y / 2}, {x / 2, y / 2}, {-x / 2, y / 2}};
}

/// The band of half the thickness on both sides of a line, with mitred corners.
std::optional<Outline> band(const Outline& line, double thickness) {
  if (line.size() < 2 || !(thickness > 0)) return std::nullopt;
  Outline left, right;
  for (size_t i = 0; i < line.size(); ++i) {
    const auto along = [&](size_t from, size_t to) {
      return glm::normalize(line[to] - line[from]);
    };
    const glm::dvec2 before = i > 0 ? along(i - 1, i) : along(i, i + 1);
    const glm::dvec2 after = i + 1 < line.size() ? along(i, i + 1) : before;
    const glm::dvec2 a(-before.y, before.x), b(-after.y, after.x);
    const double cosine = glm::dot(a, b);
    // A mitre of a sharp corner would reach far beyond the line.
    if (!(cosine > -0.5)) return std::nullopt;
    const glm::dvec2 mitre = (a + b) / (1 + cosine) * (thickness / 2);
    left.push_back(line[i] + mitre);
    right.push_back(line[i] - mitre);
  }
  left.insert(left.end(), right.rbegin(), right.rend());
  return left;
}

/// The outline of a profile with a position, about its own origin.
std::optional<Outline> parameterized(const StepNode& p) {
  const auto n = [&](size_t place) { return p.number(place).value_or(0); };
  if (p.is("IFCRECTANGLEPROFILEDEF") || p.is("IFCRECTANGLEHOLLOWPROFILEDEF"))
    return rectangle(n(3), n(4));
  if (p.is("IFCCIRCLEPROFILEDEF") || p.is("IFCCIRCLEHOLLOWPROFILEDEF"))
    return ellipse_points(n(3), n(3));
  if (p.is("IFCELLIPSEPROFILEDEF")) return ellipse_points(n(3), n(4));
  if (p.is("IFCTRAPEZIUMPROFILEDEF")) {
    const double bottom = n(3), top = n(4), y = n(5), from = n(6) - bottom / 2;
    return Outline{{-bottom / 2, -y / 2}, {bottom / 2, -y / 2}, {from + top, y / 2}, {from, y / 2}};
  }
  return std::nullopt;
}

std::optional<Outline> hole_of(const StepNode& p) {
  const auto n = [&](size_t place) { return p.number(place).value_or(0); };
  if (p.is("IFCRECTANGLEHOLLOWPROFILEDEF")) return rectangle(n(3) - 2 * n(5), n(4) - 2 * n(5));
  if (p.is("IFCCIRCLEHOLLOWPROFILEDEF")) return ellipse_points(n(3) - n(4), n(3) - n(4));
  return std::nullopt;
}

}  // namespace

Outline ellipse_points(double radius_x, double radius_y) {
  Outline out;
  for (int i = 0; i < limits::ifc_circle_corners; ++i) {
    const double a = 2 * std::numbers::pi * i / limits::ifc_circle_corners;
    out.emplace_back(radius_x * std::cos(a), radius_y * std::sin(a));
  }
  return out;
}

std::optional<Outline> curve_points(StepGraph& graph, const StepNode& curve) {
  auto points = open_points(graph, curve, 0);
  if (!points || points->empty() || points->size() > limits::ifc_outline_points)
    return std::nullopt;
  if (points->size() > 1 && points->front() == points->back()) points->pop_back();
  return points;
}

std::optional<IfcProfile> ifc_profile(StepGraph& graph, const StepNode& p) {
  IfcProfile out;
  std::optional<Outline> outer;
  std::vector<Outline> inner;
  if (p.is("IFCARBITRARYCLOSEDPROFILEDEF") || p.is("IFCARBITRARYPROFILEDEFWITHVOIDS")) {
    outer = curve_points(graph, graph.follow(p, 2));
    for (const uint64_t id : p.references(3)) {
      const auto hole = curve_points(graph, graph.node(id));
      if (!hole) return std::nullopt;
      inner.push_back(*hole);
    }
  } else if (p.is("IFCCENTERLINEPROFILEDEF")) {
    auto line = open_points(graph, graph.follow(p, 2), 0);
    if (line) {
      line->erase(std::unique(line->begin(), line->end()), line->end());
      outer = band(*line, p.number(3).value_or(0));
    }
  } else if ((outer = parameterized(p))) {
    const Transform place = axis_placement(graph, graph.follow(p, 2));
    const auto set = [&](Outline& outline) {
      for (glm::dvec2& q : outline) q = glm::dvec2(place.point({q, 0}));
    };
    set(*outer);
    if (auto hole = hole_of(p)) inner.push_back(std::move(*hole)), set(inner.back());
  }
  if (!outer) return std::nullopt;
  auto outline = closed_outline(std::move(*outer), 1);
  if (!outline) return std::nullopt;
  out.outline = std::move(*outline);
  for (Outline& hole : inner) {
    auto closed = closed_outline(std::move(hole), -1);
    if (!closed) return std::nullopt;
    out.holes.push_back(std::move(*closed));
  }
  return out;
}

}  // namespace luxodus
