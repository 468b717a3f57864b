#include "scenes/light/geometry/closed_mesh.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>

namespace luxodus {

namespace {

using Edge = std::pair<uint32_t, uint32_t>;

/// Numbers vertices, the same where they are at one place. They are found in cells of a grid that
/// are large against that distance, so that few vertices have to look into a neighbour.
class Places {
 public:
  uint32_t number(const glm::dvec3& p) {
    const Cell low = cell(p - one_vertex_m), high = cell(p + one_vertex_m);
    for (int64_t x = low[0]; x <= high[0]; ++x)
      for (int64_t y = low[1]; y <= high[1]; ++y)
        for (int64_t z = low[2]; z <= high[2]; ++z) {
          const auto found = cells_.find(key({x, y, z}));
          if (found == cells_.end()) continue;
          for (const uint32_t i : found->second)
            if (glm::length(points_[i] - p) < one_vertex_m) return i;
        }
    const auto i = static_cast<uint32_t>(points_.size());
    points_.push_back(p);
    cells_[key(cell(p))].push_back(i);
    return i;
  }

  const glm::dvec3& point(uint32_t i) const { return points_[i]; }

 private:
  using Cell = std::array<int64_t, 3>;
  static constexpr double cell_m = 8 * one_vertex_m;

  static Cell cell(const glm::dvec3& p) {
    const glm::dvec3 q = glm::floor(p / cell_m);
    return {static_cast<int64_t>(q.x), static_cast<int64_t>(q.y), static_cast<int64_t>(q.z)};
  }
  /// Cells that share a key are told apart by the distance of their points.
  static uint64_t key(const Cell& c) {
    uint64_t h = 0;
    for (const int64_t i : c) h = (h ^ static_cast<uint64_t>(i)) * 0x9e3779b97f4a7c15u;
    return h;
  }

  std::vector<glm::dvec3> points_;
  std::unordered_map<uint64_t, std::vector<uint32_t>> cells_;
};

void toggle(std::map<Edge, bool>& odd, uint32_t a, uint32_t b) {
  if (a == b) return;
  const auto [at, fresh] = odd.try_emplace({std::min(a, b), std::max(a, b)}, true);
  if (!fresh) odd.erase(at);
}

/// Open edges cut at the ends of others that lie on them, and matched again.
std::map<Edge, bool> split(const std::map<Edge, bool>& open, const Places& places) {
  std::map<Edge, bool> out;
  std::vector<uint32_t> ends;
  for (const auto& [edge, odd] : open) {
    ends.push_back(edge.first);
    ends.push_back(edge.second);
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  for (const auto& [edge, odd] : open) {
    const glm::dvec3 a = places.point(edge.first), way = places.point(edge.second) - a;
    const double length = glm::length(way);
    std::vector<std::pair<double, uint32_t>> on{{0, edge.first}, {length, edge.second}};
    for (const uint32_t i : ends) {
      const glm::dvec3 from = places.point(i) - a;
      const double along = glm::dot(from, way) / length;
      if (along > one_vertex_m && along < length - one_vertex_m &&
          glm::length(from - along / length * way) < one_vertex_m)
        on.emplace_back(along, i);
    }
    std::sort(on.begin(), on.end());
    for (size_t i = 1; i < on.size(); ++i) toggle(out, on[i - 1].second, on[i].second);
  }
  return out;
}

/// Area of the loops that open edges form, each as if it were flat.
double area_of_loops(const std::map<Edge, bool>& open, const Places& places) {
  std::multimap<uint32_t, uint32_t> ways;
  for (const auto& [edge, odd] : open) {
    ways.emplace(edge.first, edge.second);
    ways.emplace(edge.second, edge.first);
  }
  const auto take = [&](uint32_t from, uint32_t to) {
    const auto [first, last] = ways.equal_range(from);
    for (auto at = first; at != last; ++at)
      if (at->second == to) return ways.erase(at), void();
  };
  double area = 0;
  while (!ways.empty()) {
    const uint32_t start = ways.begin()->first;
    glm::dvec3 sum(0);
    uint32_t at = start;
    for (auto next = ways.find(at); next != ways.end(); next = ways.find(at)) {
      const uint32_t to = next->second;
      sum += glm::cross(places.point(at) - places.point(start),
                        places.point(to) - places.point(start));
      ways.erase(next);
      take(to, at);
      at = to;
      if (at == start) break;
    }
    area += glm::length(sum) / 2;
  }
  return area;
}

}  // namespace

OpenEdges open_edges(const Mesh& mesh) {
  Places places;
  std::vector<uint32_t> place;
  place.reserve(mesh.positions.size());
  for (const glm::dvec3& p : mesh.positions) place.push_back(places.number(p));
  std::map<Edge, bool> odd;
  for (const glm::uvec3& t : mesh.triangles) {
    const uint32_t a = place[t.x], b = place[t.y], c = place[t.z];
    if (a == b || b == c || c == a) continue;  // without area: its two long edges are one
    toggle(odd, a, b);
    toggle(odd, b, c);
    toggle(odd, c, a);
  }
  if (!odd.empty() && odd.size() <= limits::split_edges) odd = split(odd, places);
  OpenEdges out;
  out.edges = odd.size();
  out.area_m2 = area_of_loops(odd, places);
  return out;
}

}  // namespace luxodus
