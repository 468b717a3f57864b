// A medium bounded by a horizontal polygon: an upright prism of one or more slabs. Any simple
// polygon, in either orientation; a ray may cross it many times. Each vertex gets one sign per ray,
// and crossings follow from the signs, so a ray through a vertex or along a wall enters and leaves
// equally often and nothing leaks. Immutable once made; any thread.
#pragma once

#include <array>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/optics/layer_stack.hpp"
#include "scenes/light/optics/medium.hpp"
#include "scenes/light/optics/ray_interval.hpp"

namespace luxodus {

namespace limits {
/// Vertices of a footprint. A floor plan has tens; crossings are kept on the stack of the tracing
/// loop (8 bytes each), and every flight tests every edge.
inline constexpr int max_footprint_vertices = 256;
}  // namespace limits

/// Whether a polygon is simple and has an area; what is wrong goes on from its name ("has ...").
Result<void> check_polygon(const std::vector<glm::dvec2>& polygon);

class FootprintPrism {
 public:
  /// Polygon and parts in coordinates of the tracer (relative to the local origin); parts do not
  /// overlap. Requires: check_polygon(polygon).
  FootprintPrism(std::vector<glm::dvec2> polygon, std::vector<LayerStack::Part> parts);

  const std::vector<LayerStack::Part>& parts() const { return parts_; }
  const glm::dvec3& low() const { return low_; }
  const glm::dvec3& high() const { return high_; }
  /// Largest number of segments of one ray inside the prism.
  int max_segments() const {
    return static_cast<int>(polygon_.size()) / 2 + static_cast<int>(parts_.size());
  }

  bool covers(const glm::dvec2& p) const;

  /// Calls add(t0, t1, component) for each segment of the ray inside the prism, clipped to
  /// `within`.
  template <class Add>
  void for_each_segment(const glm::dvec3& o, const glm::dvec3& d, RayInterval within,
                        Add&& add) const;

 private:
  using Crossings = std::array<double, limits::max_footprint_vertices>;
  int crossings(const glm::dvec2& o, const glm::dvec2& d, Crossings& t) const;

  std::vector<glm::dvec2> polygon_;
  std::vector<LayerStack::Part> parts_;
  glm::dvec3 low_{0};
  glm::dvec3 high_{0};
};

template <class Add>
void FootprintPrism::for_each_segment(const glm::dvec3& o, const glm::dvec3& d, RayInterval within,
                                      Add&& add) const {
  const auto add_parts = [&](RayInterval covered) {
    for (const LayerStack::Part& p : parts_) {
      const RayInterval piece = between_planes(p.z_low, p.z_high, o.z, d.z, covered);
      if (!piece.empty()) add(piece.t0, piece.t1, p.component);
    }
  };
  const glm::dvec2 across(d);
  if (across == glm::dvec2(0)) {
    if (covers(glm::dvec2(o))) add_parts(within);
    return;
  }
  Crossings t;
  const int n = crossings(glm::dvec2(o), across, t);
  for (int i = 0; i + 1 < n; i += 2) {
    const RayInterval covered =
        common(within, {t[static_cast<size_t>(i)], t[static_cast<size_t>(i) + 1]});
    if (!covered.empty()) add_parts(covered);
  }
}

}  // namespace luxodus
