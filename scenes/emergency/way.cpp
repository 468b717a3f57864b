#include "scenes/emergency/way.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace luxodus {

namespace {

/// Heights that differ by less count as equal [m].
constexpr double level_within_m = 0.01;
/// A point this close to an edge lies on it [m].
constexpr double on_edge_m = 1e-6;

/// Horizontal unit vector to the left of a leg.
glm::dvec3 left_of(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec2 way = glm::normalize(glm::dvec2(to - from));
  return {-way.y, way.x, 0};
}

double distance_to_edge(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 edge = b - a;
  const double t = std::clamp(glm::dot(p - a, edge) / glm::dot(edge, edge), 0.0, 1.0);
  return glm::length(p - a - edge * t);
}

double distance_to_outline(const glm::dvec2& p, const std::vector<glm::dvec2>& outline) {
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < outline.size(); ++i)
    least = std::min(least, distance_to_edge(p, outline[i], outline[(i + 1) % outline.size()]));
  return least;
}

/// Even-odd rule: counts the edges that a ray to the right crosses.
bool lies_in(const glm::dvec2& p, const std::vector<glm::dvec2>& outline) {
  bool in = false;
  for (size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 a = outline[i], b = outline[(i + 1) % outline.size()];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if (p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) in = !in;
  }
  return in;
}

/// Distance in plan to a route, and the height of its nearest point.
std::pair<double, double> nearest_of(const EscapeRoute& route, const glm::dvec2& p) {
  std::pair<double, double> best{std::numeric_limits<double>::infinity(), 0};
  for (size_t i = 1; i < route.path.size(); ++i) {
    const glm::dvec3 a = route.path[i - 1], b = route.path[i];
    const glm::dvec2 leg(b - a);
    const double t = std::clamp(glm::dot(p - glm::dvec2(a), leg) / glm::dot(leg, leg), 0.0, 1.0);
    const glm::dvec3 at = a + (b - a) * t;
    const double distance = glm::length(p - glm::dvec2(at));
    if (distance < best.first) best = {distance, at.z};
  }
  return best;
}

}  // namespace

double length_of(const EscapeRoute& route) {
  double length = 0;
  for (size_t i = 1; i < route.path.size(); ++i)
    length += glm::length(route.path[i] - route.path[i - 1]);
  return length;
}

bool is_level(const EscapeRoute& route) {
  return std::all_of(route.path.begin(), route.path.end(), [&](const glm::dvec3& p) {
    return std::abs(p.z - route.path.front().z) < level_within_m;
  });
}

int pieces_of(double length_m, double spacing_m) {
  return std::max(1, static_cast<int>(std::ceil(length_m / spacing_m * (1 - 1e-9))));
}

std::vector<glm::dvec3> along_leg(const glm::dvec3& from, const glm::dvec3& to, double aside_m,
                                  double spacing_m) {
  const glm::dvec3 aside = left_of(from, to) * aside_m;
  const int n = pieces_of(glm::length(to - from), spacing_m);
  std::vector<glm::dvec3> out;
  for (int k = 0; k <= n; ++k)
    out.push_back(glm::mix(from, to, static_cast<double>(k) / n) + aside);
  return out;
}

std::vector<glm::dvec3> along(const EscapeRoute& route, double aside_m, double spacing_m) {
  std::vector<glm::dvec3> out;
  for (size_t i = 1; i < route.path.size(); ++i) {
    const auto leg = along_leg(route.path[i - 1], route.path[i], aside_m, spacing_m);
    // A leg on the centre line shares its first point with the end of the leg before.
    out.insert(out.end(), leg.begin() + (i > 1 && aside_m == 0 ? 1 : 0), leg.end());
  }
  return out;
}

std::vector<glm::dvec3> within(const EscapeRoute& route, double half_width_m, double spacing_m) {
  std::vector<glm::dvec3> out;
  const int n = pieces_of(half_width_m, spacing_m);
  for (int k = -n; k <= n; ++k) {
    const auto line = along(route, half_width_m * k / n, spacing_m);
    out.insert(out.end(), line.begin(), line.end());
  }
  return out;
}

PlanBox plan_box_of(const AssessedArea& area) {
  PlanBox out{area.outline.front(), area.outline.front()};
  for (const glm::dvec2& p : area.outline) {
    out.low = glm::min(out.low, p);
    out.high = glm::max(out.high, p);
  }
  return out;
}

AreaLattice lattice_of(const AssessedArea& area, double border_m, double spacing_m) {
  const auto [low, high] = plan_box_of(area);
  AreaLattice out{low + border_m, high - border_m, 0, 0};
  const glm::dvec2 size = out.high - out.low;
  if (size.x < 0 || size.y < 0) return out;
  out.columns = pieces_of(size.x, spacing_m);
  out.rows = pieces_of(size.y, spacing_m);
  return out;
}

std::vector<glm::dvec3> within(const AssessedArea& area, double border_m, double spacing_m) {
  std::vector<glm::dvec3> out;
  const AreaLattice lattice = lattice_of(area, border_m, spacing_m);
  if (lattice.columns == 0) return out;
  for (int j = 0; j <= lattice.rows; ++j)
    for (int i = 0; i <= lattice.columns; ++i) {
      const glm::dvec2 p = lattice.place(i, j);
      if (is_within(area, p, border_m)) out.emplace_back(p, area.z_m);
    }
  return out;
}

bool is_within(const AssessedArea& area, const glm::dvec2& place, double border_m) {
  const bool inside = lies_in(place, area.outline);
  const double edge_m = distance_to_outline(place, area.outline);
  return border_m > 0 ? inside && edge_m >= border_m * (1 - 1e-9) : inside || edge_m < 1e-9;
}

std::vector<Walker> walkers(const EscapeRoute& route, double spacing_m) {
  std::vector<Walker> out;
  double before = 0;
  for (size_t i = 1; i < route.path.size(); ++i) {
    const glm::dvec3 from = route.path[i - 1], way = route.path[i] - from;
    const double length = glm::length(way);
    const int n = pieces_of(length, spacing_m);
    for (int k = 0; k < n; ++k) {
      const double share = static_cast<double>(k) / n;
      out.push_back({from + way * share, way / length, before + length * share});
    }
    before += length;
  }
  return out;
}

glm::dvec3 place_along(const EscapeRoute& route, double along_m) {
  double before = 0;
  for (size_t i = 1;; ++i) {
    const glm::dvec3 from = route.path[i - 1], way = route.path[i] - from;
    const double length = glm::length(way);
    if (along_m <= before + length || i + 1 == route.path.size())
      return from + way * ((along_m - before) / length);
    before += length;
  }
}

bool in_plan_of(const EscapeRoute& route, const glm::dvec2& place) {
  return nearest_of(route, place).first <= route.width_m / 2 + on_edge_m;
}

bool in_plan_of(const AssessedArea& area, const glm::dvec2& place) {
  return lies_in(place, area.outline) || distance_to_outline(place, area.outline) <= on_edge_m;
}

std::optional<double> floor_below(const SceneDescription& scene, const glm::dvec3& place) {
  std::pair<double, double> best{std::numeric_limits<double>::infinity(), 0};
  const auto offer = [&](const std::pair<double, double>& floor) {
    if (floor.second > place.z || floor.first > best.first) return;
    // If several storeys are equally near in plan, the one just below counts.
    if (floor.first < best.first || floor.second > best.second) best = floor;
  };
  for (const EscapeRoute& route : scene.routes) offer(nearest_of(route, glm::dvec2(place)));
  for (const AssessedArea& area : scene.open_areas) {
    const glm::dvec2 p(place);
    offer({lies_in(p, area.outline) ? 0 : distance_to_outline(p, area.outline), area.z_m});
  }
  if (!std::isfinite(best.first)) return std::nullopt;
  return best.second;
}

}  // namespace luxodus
