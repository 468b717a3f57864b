#include "actors/results/pictures/flames_in_view.hpp"

#include <algorithm>
#include <vector>

#include "actors/results/pictures/pixel_tracer.hpp"
#include "scenes/light/transport/flame_boxes.hpp"
#include "scenes/light/transport/flame_moment.hpp"

namespace luxodus {

namespace {

/// Share of the pixels with a flame that are brighter.
constexpr double left_out_above = 0.05;

/// The bodies of flames that the scenario leaves.
std::vector<const QuadricBody*> bodies_of_flames(const CompiledScene& scene) {
  const MediaTables& tables = scene.media.tables();
  std::vector<const QuadricBody*> out;
  for (const FlameBox& box : flame_boxes(scene))
    for (const PlacedBody& body : tables.bodies)
      if (body.quadric >= 0 && tables.component(body.component).medium ==
                                   static_cast<int>(scene.emitters[box.emitter].medium))
        out.push_back(&tables.quadrics[static_cast<size_t>(body.quadric)]);
  return out;
}

}  // namespace

double brightest_flame(const CompiledScene& scene, const Camera& camera,
                       const NoisyPicture& features, const XyzPicture& light) {
  const std::vector<const QuadricBody*> bodies = bodies_of_flames(scene);
  if (bodies.empty()) return 0;
  Camera seen = camera;
  seen.width = features.width;
  seen.height = features.height;
  const Pinhole pinhole(seen, scene.local_origin);
  constexpr double everywhere_m = 1e6;
  std::vector<float> found;
  for (int row = 0; row < seen.height; ++row)
    for (int column = 0; column < seen.width; ++column) {
      const auto pixel = static_cast<size_t>(int64_t{row} * seen.width + column);
      const auto nearness =
          static_cast<double>(features.features[features.feature_count * pixel + 3]);
      const double end_m = nearness > 0 ? 1 / nearness : everywhere_m;
      const Ray ray = pinhole.ray(column + 0.5, row + 0.5);
      RayInterval parts[2];
      const bool shows = std::any_of(bodies.begin(), bodies.end(), [&](const QuadricBody* body) {
        return body->intervals(glm::dvec3(ray.origin), glm::dvec3(ray.direction), {0, end_m},
                               parts) > 0;
      });
      if (shows && is_light(light, pixel)) found.push_back(light.xyz[3 * pixel + 1]);
    }
  if (found.empty()) return 0;
  const auto rank =
      static_cast<std::ptrdiff_t>((1 - left_out_above) * static_cast<double>(found.size() - 1));
  std::nth_element(found.begin(), found.begin() + rank, found.end());
  return static_cast<double>(found[static_cast<size_t>(rank)]);
}

}  // namespace luxodus
