#include "scenes/light/transport/media_bounds.hpp"

#include <algorithm>

namespace luxodus {

namespace {

/// Bounds of a box given in the coordinates of a frame.
Bounds placed(const Bounds& local, const Frame& frame) {
  Bounds out;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p((corner & 1) != 0 ? local.high.x : local.low.x,
                       (corner & 2) != 0 ? local.high.y : local.low.y,
                       (corner & 4) != 0 ? local.high.z : local.low.z);
    out.extend(frame.origin + frame.axes * p);
  }
  return out;
}

Bounds within(const Footprint& footprint, Bounds scene) {
  scene.low.z = std::max(scene.low.z, footprint.z_low);
  scene.high.z = std::min(scene.high.z, footprint.z_high);
  if (footprint.polygon.empty()) return scene;
  glm::dvec2 low = footprint.polygon.front(), high = low;
  for (const glm::dvec2& p : footprint.polygon) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  scene.low = glm::max(scene.low, glm::dvec3(low, scene.low.z));
  scene.high = glm::min(scene.high, glm::dvec3(high, scene.high.z));
  return scene;
}

/// The box restricted to the heights of layers with any extinction.
Bounds of_layers(const Medium& medium, Bounds box) {
  double low = 1e300, high = -1e300;
  for (const Layer& layer : medium.layers) {
    if (!layer.optics.extinction.table && !(layer.optics.extinction.sigma_t > 0)) continue;
    low = std::min(low, layer.z_low);
    high = std::max(high, layer.z_high);
  }
  box.low.z = std::max(box.low.z, low);
  box.high.z = std::min(box.high.z, high);
  return box;
}

Bounds bounds_of(const Medium& medium, const Bounds& scene) {
  switch (medium.kind) {
    case MediumKind::homogeneous:
      return within(medium.footprint, scene);
    case MediumKind::layered:
      return of_layers(medium, within(medium.footprint, scene));
    case MediumKind::bounded:
      return placed(medium.local_bounds, medium.frame);
    case MediumKind::data_set:
      break;
  }
  return placed({glm::dvec3(0), medium.data.extent}, medium.frame);
}

}  // namespace

Bounds media_bounds(std::span<const Medium* const> media, const Bounds& scene) {
  Bounds out;
  for (const Medium* medium : media) {
    Bounds box = bounds_of(*medium, scene);
    box.low = glm::max(box.low, scene.low);
    box.high = glm::min(box.high, scene.high);
    if (glm::all(glm::lessThanEqual(box.low, box.high))) out.extend(box);
  }
  return out;
}

}  // namespace luxodus
