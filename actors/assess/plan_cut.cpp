#include "actors/assess/plan_cut.hpp"

#include <algorithm>

namespace luxodus {

namespace {

constexpr double breast_m = 1.2;

double floor_of(const SceneDescription& scene) {
  if (!scene.routes.empty()) return scene.routes.front().path.front().z;
  return scene.open_areas.empty() ? 0 : scene.open_areas.front().z_m;
}

using Line = std::pair<glm::dvec2, glm::dvec2>;

/// Where a level plane cuts a triangle.
void cut(const glm::dvec3 (&corners)[3], double z, std::vector<Line>& out) {
  glm::dvec2 ends[3];
  int count = 0;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 &a = corners[i], &b = corners[(i + 1) % 3];
    if ((a.z < z) == (b.z < z)) continue;
    ends[count++] = glm::dvec2(glm::mix(a, b, (z - a.z) / (b.z - a.z)));
  }
  if (count == 2) out.emplace_back(ends[0], ends[1]);
}

}  // namespace

std::vector<Line> walls_of(const SceneDescription& scene) {
  const double z = floor_of(scene) + breast_m;
  std::vector<Line> out;
  for (const Object& object : scene.objects)
    for (const auto& triangle : object.mesh.triangles) {
      const glm::dvec3 corners[3] = {object.mesh.positions[triangle[0]],
                                     object.mesh.positions[triangle[1]],
                                     object.mesh.positions[triangle[2]]};
      cut(corners, z, out);
    }
  if (out.size() > limits::plan_lines) {
    std::stable_sort(out.begin(), out.end(), [](const Line& a, const Line& b) {
      return glm::length(a.second - a.first) > glm::length(b.second - b.first);
    });
    out.resize(limits::plan_lines);
  }
  return out;
}

}  // namespace luxodus
