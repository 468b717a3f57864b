#include "actors/judge/inspect/building.hpp"

#include <algorithm>

#include "scenes/light/transport/surroundings.hpp"
#include "scenes/light/world/measurements.hpp"

namespace luxodus {

namespace {

/// Sample points along each edge of a face.
constexpr int face_points = 3;

}  // namespace

SceneDescription without_measurements(const SceneDescription& scene) {
  SceneDescription bare = scene;
  count_by_object(bare);
  return bare;
}

Building::Building(std::shared_ptr<const CompiledScene> scene, int threads)
    : scene_(std::move(scene)),
      index_(device_, *scene_),
      rows_(index_, threads),
      turned_(turned_surfaces(*scene_, GeometryAccess::resident(index_))) {}

Result<std::unique_ptr<Building>> Building::make(SceneDescription scene, const Scenario& scenario,
                                                 int threads) {
  auto compiled = compile_scene(std::make_shared<SceneDescription>(std::move(scene)), scenario, {});
  if (!compiled) return compiled.problem();
  return std::unique_ptr<Building>(new Building(std::move(compiled).value(), threads));
}

void Building::each(size_t count,
                    const std::function<void(const GeometryAccess& access, size_t i)>& work) const {
  rows_.run(static_cast<int64_t>(count),
            [&](const GeometryAccess& access) {
              return [&work, access](int64_t i) { work(access, static_cast<size_t>(i)); };
            },
            {});
}

bool Building::in_solid(const GeometryAccess& access, const glm::dvec3& place,
                        std::span<const char> ignored) const {
  return in_body(*scene_, access, local(place), turned_, ignored);
}

double Building::seen_share(const GeometryAccess& access, const Sign& sign, const SignView& view,
                            const glm::dvec3& eye) const {
  int seen = 0;
  for (int j = 0; j < face_points; ++j)
    for (int i = 0; i < face_points; ++i) {
      const glm::dvec2 uv = (glm::dvec2(i, j) + 0.5) / static_cast<double>(face_points) - 0.5;
      const glm::dvec3 place = view.centre + sign.frame.axes[0] * (uv.x * sign.width_m) +
                               sign.frame.axes[1] * (uv.y * sign.height_m) + view.normal * 1e-3;
      if (clear_share(*scene_, access, local(eye), local(place)) > 0) ++seen;
    }
  return static_cast<double>(seen) / (face_points * face_points);
}

}  // namespace luxodus
