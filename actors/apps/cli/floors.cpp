#include "actors/apps/cli/floors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "actors/apps/cli/command.hpp"
#include "scenes/light/transport/packed_scene.hpp"

namespace luxodus::cli {

namespace {

/// Narrower surfaces [m] are tops of walls or beams, shelves or sills.
constexpr double min_width_m = 0.5;
constexpr double min_area_m2 = 1;
/// Share of the largest area: less is furniture.
constexpr double min_share = 0.05;

/// Horizontal surfaces at one height. Edges shared by two triangles are inner ones.
struct Level {
  double area_m2 = 0, rim_m = 0;
  std::set<std::array<int64_t, 4>> rim;  // edges with only one triangle so far, in millimetres

  void add(const TriangleRecord& t) {
    area_m2 += 0.5 * static_cast<double>(glm::length(
                         glm::cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0])));
    for (size_t i = 0; i < 3; ++i) add_edge(t.corner[i], t.corner[(i + 1) % 3]);
  }
  /// The width of a long strip; less than the width for any other shape, half of it for a square.
  double width_m() const { return rim_m > 0 ? 2 * area_m2 / rim_m : 0; }

 private:
  void add_edge(const glm::vec3& from, const glm::vec3& to) {
    const auto millimetres = [](float v) { return std::llround(static_cast<double>(v) * 1000); };
    std::array<int64_t, 2> a{millimetres(from.x), millimetres(from.y)};
    std::array<int64_t, 2> b{millimetres(to.x), millimetres(to.y)};
    if (b < a) std::swap(a, b);
    const double length_m = static_cast<double>(glm::length(to - from));
    const std::array<int64_t, 4> edge{a[0], a[1], b[0], b[1]};
    if (rim.erase(edge) > 0) {
      rim_m -= length_m;
    } else {
      rim.insert(edge);
      rim_m += length_m;
    }
  }
};

}  // namespace

std::vector<double> floor_heights(const CompiledScene& scene) {
  std::map<int64_t, Level> levels;  // by millimetre
  const auto read = for_each_cell(scene, [&](const GeometryCell& cell) {
    for (const TriangleRecord& t : cell.triangles) {
      if (t.normal.z < 0.999f) continue;
      const double z = static_cast<double>(t.corner[0].z) + scene.local_origin.z;
      levels[std::llround(z * 1000)].add(t);
    }
  });
  if (!read) tell(read.problem());
  double most = 0;
  for (const auto& [z, level] : levels) most = std::max(most, level.area_m2);
  std::vector<double> out;
  for (const auto& [z, level] : levels) {
    if (level.area_m2 >= min_area_m2 && level.area_m2 > min_share * most &&
        level.width_m() >= min_width_m)
      out.push_back(static_cast<double>(z) / 1000);
  }
  return out;
}

}  // namespace luxodus::cli
