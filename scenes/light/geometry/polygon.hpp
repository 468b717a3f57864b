// Simple polygons in the plane, checked and triangulated: floor outlines and profiles of extruded
// bodies. Pure functions; any thread.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Checking takes time quadratic in this, triangulating up to cubic: 2048 stays within seconds.
inline constexpr size_t polygon_points = 2048;
}  // namespace limits

/// Whether the closed segments a b and c d have a point in common. Disjoint pieces of one line have
/// none, at any slope of the line.
bool segments_meet(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c,
                   const glm::dvec2& d);

/// Twice the signed area of a, b, c: positive where c is to the left of a -> b.
inline double twice_signed_area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Whether a point lies within an outline, by the even-odd rule: a ray to +x crosses its edges an
/// odd number of times. Points on edges may count as either.
bool is_within(std::span<const glm::dvec2> outline, const glm::dvec2& p);

/// Shoelace area [m2]: positive for counter-clockwise outlines.
double signed_area(std::span<const glm::dvec2> outline);

/// The outline, counter-clockwise (reversed where it was not); the last point joins the first.
/// Errors: fewer than 3 points, too many, a point that is not finite or repeats its neighbour, an
/// outline that touches or crosses itself; points and edges are counted from 1.
Result<std::vector<glm::dvec2>> checked_outline(std::span<const glm::dvec2> outline);

/// n - 2 counter-clockwise triangles that use every point, also those on straight edges, so that
/// bodies built on one outline meet without a crack. Ear clipping (Meisters 1975).
/// Requires: an outline from checked_outline. Errors: angles too flat for double precision.
Result<std::vector<glm::uvec3>> triangulate(std::span<const glm::dvec2> outline);

}  // namespace luxodus
