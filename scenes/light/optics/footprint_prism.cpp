// Crossings of a line with a polygon (parity rule), and the checks that make the rule valid.
#include "scenes/light/optics/footprint_prism.hpp"

#include <cmath>
#include <string>

#include "scenes/light/geometry/polygon.hpp"

namespace luxodus {

namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace

Result<void> check_polygon(const std::vector<glm::dvec2>& polygon) {
  const size_t n = polygon.size();
  if (n < 3) return problem("has fewer than 3 corners");
  if (n > static_cast<size_t>(limits::max_footprint_vertices)) {
    return problem("has " + std::to_string(n) + " corners; at most " +
                   std::to_string(limits::max_footprint_vertices) + " are allowed");
  }
  double area = 0;
  for (size_t i = 0; i < n; ++i) {
    const glm::dvec2& p = polygon[i];
    const glm::dvec2& q = polygon[(i + 1) % n];
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
      return problem("has a corner " + std::to_string(i + 1) + " that is not finite");
    }
    if (p == q) return problem("names corner " + std::to_string(i + 1) + " twice in a row");
    area += cross(p - polygon[0], q - polygon[0]) / 2;
  }
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;  // adjacent edges, across the start of the list
      if (segments_meet(polygon[i], polygon[i + 1], polygon[j], polygon[(j + 1) % n])) {
        return problem("crosses itself: edges " + std::to_string(i + 1) + " and " +
                       std::to_string(j + 1));
      }
    }
  }
  if (area == 0) return problem("has no area");
  return {};
}

FootprintPrism::FootprintPrism(std::vector<glm::dvec2> polygon, std::vector<LayerStack::Part> parts)
    : polygon_(std::move(polygon)), parts_(std::move(parts)) {
  low_ = glm::dvec3(LayerStack::infinity);
  high_ = -low_;
  for (const glm::dvec2& p : polygon_) {
    low_ = glm::min(low_, glm::dvec3(p, LayerStack::infinity));
    high_ = glm::max(high_, glm::dvec3(p, -LayerStack::infinity));
  }
  for (const LayerStack::Part& p : parts_) {
    low_.z = std::min(low_.z, p.z_low);
    high_.z = std::max(high_.z, p.z_high);
  }
}

// The half-open rule on y assigns each point of a tiling by polygons to exactly one of them, up to
// rounding.
bool FootprintPrism::covers(const glm::dvec2& p) const {
  bool inside = false;
  for (size_t i = 0, j = polygon_.size() - 1; i < polygon_.size(); j = i++) {
    const glm::dvec2 a = polygon_[i] - p;
    const glm::dvec2 b = polygon_[j] - p;
    if ((a.y > 0) == (b.y > 0)) continue;
    // Sign of the crossing's x, without a division.
    if ((cross(a, b) > 0) == (b.y > a.y)) inside = !inside;
  }
  return inside;
}

// Each vertex has one offset from the line, counted as non-negative or negative; an edge is crossed
// if the sign changes. Around a closed polygon that happens an even number of times.
int FootprintPrism::crossings(const glm::dvec2& o, const glm::dvec2& d, Crossings& t) const {
  const double scale = 1 / glm::dot(d, d);
  int n = 0;
  glm::dvec2 before = polygon_.back() - o;
  double offset_before = cross(d, before);
  for (const glm::dvec2& vertex : polygon_) {
    const glm::dvec2 here = vertex - o;
    const double offset = cross(d, here);
    if ((offset >= 0) != (offset_before >= 0)) {
      const double share = offset / (offset - offset_before);
      const double along = glm::dot(d, here) * scale;
      const double along_before = glm::dot(d, before) * scale;
      t[static_cast<size_t>(n++)] = along + (along_before - along) * share;
    }
    before = here;
    offset_before = offset;
  }
  // Few numbers, nearly always two: insertion sort.
  for (int i = 1; i < n; ++i) {
    const double value = t[static_cast<size_t>(i)];
    int j = i;
    for (; j > 0 && t[static_cast<size_t>(j - 1)] > value; --j) {
      t[static_cast<size_t>(j)] = t[static_cast<size_t>(j - 1)];
    }
    t[static_cast<size_t>(j)] = value;
  }
  return n;
}

}  // namespace luxodus
