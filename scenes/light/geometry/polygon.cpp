#include "scenes/light/geometry/polygon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace luxodus {
namespace {

/// Beyond this coordinate [m] float would no longer resolve millimetres.
constexpr double farthest_m = 1e7;

int sign(double v) {
  return (v > 0) - (v < 0);
}

bool within_box(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

Result<void> check_points(std::span<const glm::dvec2> outline) {
  const size_t n = outline.size();
  if (n < 3) return problem(fmt::format("an outline needs 3 points or more, this has {}", n));
  if (n > limits::polygon_points) {
    return problem(fmt::format("an outline may have {} points, this has {}: cut it into parts",
                               limits::polygon_points, n));
  }
  for (size_t i = 0; i < n; ++i) {
    const glm::dvec2 p = outline[i];
    if (!(std::abs(p.x) <= farthest_m && std::abs(p.y) <= farthest_m)) {
      return problem(
          fmt::format("point {} of the outline is not finite or beyond {:g} m", i + 1, farthest_m));
    }
    if (p == outline[(i + 1) % n]) {
      return problem(fmt::format("points {} and {} of the outline are the same: leave one out",
                                 i + 1, (i + 1) % n + 1));
    }
  }
  return {};
}

/// Share of a triangle's squared size: corners whose doubled area is below it count as collinear.
/// Rounding of exact corners stays below 1e-15; a limit of 1e-9 would drop real corners.
constexpr double flat_share = 1e-12;

double flat_area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return flat_share * (glm::dot(b - a, b - a) + glm::dot(c - b, c - b));
}

/// Whether p lies in the triangle, its edges included, or on them but for rounding: a diagonal
/// along collinear points is no valid cut.
bool in_closed_triangle(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c,
                        const glm::dvec2& p) {
  const double flat = -flat_area(a, b, c);
  return twice_signed_area(a, b, p) >= flat && twice_signed_area(b, c, p) >= flat &&
         twice_signed_area(c, a, p) >= flat;
}

/// Whether the boxes of a b and c d have a point in common.
bool boxes_meet(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c,
                const glm::dvec2& d) {
  const glm::dvec2 low = glm::max(glm::min(a, b), glm::min(c, d));
  const glm::dvec2 high = glm::min(glm::max(a, b), glm::max(c, d));
  return low.x <= high.x && low.y <= high.y;
}

}  // namespace

bool is_within(std::span<const glm::dvec2> outline, const glm::dvec2& p) {
  bool inside = false;
  for (size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const glm::dvec2 &a = outline[i], &b = outline[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x)
      inside = !inside;
  }
  return inside;
}

bool segments_meet(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c,
                   const glm::dvec2& d) {
  // Two disjoint pieces of one slanting wall may seem to cross, because the signs of their sides
  // are only rounding.
  if (!boxes_meet(a, b, c, d)) return false;
  const int s1 = sign(twice_signed_area(a, b, c)), s2 = sign(twice_signed_area(a, b, d));
  const int s3 = sign(twice_signed_area(c, d, a)), s4 = sign(twice_signed_area(c, d, b));
  if (s1 != s2 && s3 != s4) return true;
  return (s1 == 0 && within_box(a, b, c)) || (s2 == 0 && within_box(a, b, d)) ||
         (s3 == 0 && within_box(c, d, a)) || (s4 == 0 && within_box(c, d, b));
}

double signed_area(std::span<const glm::dvec2> outline) {
  if (outline.empty()) return 0;
  double twice = 0;
  for (size_t i = 0; i < outline.size(); ++i) {
    // Measured from the first point, so that an outline far from the origin keeps its precision.
    const glm::dvec2 a = outline[i] - outline[0];
    const glm::dvec2 b = outline[(i + 1) % outline.size()] - outline[0];
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * twice;
}

Result<std::vector<glm::dvec2>> checked_outline(std::span<const glm::dvec2> outline) {
  if (auto ok = check_points(outline); !ok) return ok.problem();
  const size_t n = outline.size();
  for (size_t i = 0; i < n; ++i) {
    const glm::dvec2 a = outline[i], b = outline[(i + 1) % n], c = outline[(i + 2) % n];
    if (twice_signed_area(a, b, c) == 0 && glm::dot(b - a, c - b) < 0) {
      return problem(fmt::format("the outline turns back on itself at point {}", (i + 1) % n + 1));
    }
    for (size_t k = i + 2; k < n; ++k) {
      if (i == 0 && k == n - 1) continue;  // adjacent edges, across the start of the list
      if (!segments_meet(a, b, outline[k], outline[(k + 1) % n])) continue;
      return problem(fmt::format(
          "edges {} and {} of the outline touch or cross: outlines must be simple", i + 1, k + 1));
    }
  }
  std::vector<glm::dvec2> out(outline.begin(), outline.end());
  const double area = signed_area(outline);
  if (area == 0) return problem("the outline encloses no area");
  if (area < 0) std::reverse(out.begin(), out.end());
  return out;
}

Result<std::vector<glm::uvec3>> triangulate(std::span<const glm::dvec2> outline) {
  std::vector<uint32_t> ring(outline.size());
  std::iota(ring.begin(), ring.end(), 0u);
  std::vector<glm::uvec3> triangles;
  size_t at = 0;     // continue from the last ear: a full round per ear is rare
  size_t tried = 0;  // candidates since the last ear
  while (ring.size() > 3) {
    const size_t n = ring.size();
    if (tried == n) {
      return problem("the outline has corners too flat to be cut into triangles: simplify it");
    }
    at %= n;
    const uint32_t before = ring[(at + n - 1) % n], tip = ring[at], after = ring[(at + 1) % n];
    const glm::dvec2 a = outline[before], b = outline[tip], c = outline[after];
    const bool convex = twice_signed_area(a, b, c) > flat_area(a, b, c);
    const bool ear =
        convex && std::none_of(ring.begin(), ring.end(), [&](uint32_t k) {
          return k != before && k != tip && k != after && in_closed_triangle(a, b, c, outline[k]);
        });
    if (!ear) {
      ++at;
      ++tried;
      continue;
    }
    triangles.push_back({before, tip, after});
    ring.erase(ring.begin() + static_cast<ptrdiff_t>(at));
    tried = 0;
  }
  if (!(twice_signed_area(outline[ring[0]], outline[ring[1]], outline[ring[2]]) > 0)) {
    return problem("the outline has corners too flat to be cut into triangles: simplify it");
  }
  triangles.push_back({ring[0], ring[1], ring[2]});
  return triangles;
}

}  // namespace luxodus
