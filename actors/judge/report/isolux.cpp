// Squares that a wall crosses are cut out of the grid. Lines are drawn for each run of whole
// squares in a row separately, and then joined where the rows meet.
#include "actors/judge/report/isolux.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace luxodus {

namespace {

/// A wall is at most this far from the end of a line, in squares: the diagonal of one that the wall
/// crosses.
constexpr double squares_to_wall = 1.5;

struct ValueGrid {
  glm::dvec2 corner{0};
  double spacing = 1;
  size_t columns = 0, rows = 0;
  std::vector<double> lux;
};

ValueGrid grid_of(const LightMap& map) {
  ValueGrid out;
  out.corner = map.corner;
  out.spacing = map.spacing_m;
  out.columns = static_cast<size_t>(map.columns);
  out.rows = static_cast<size_t>(map.rows);
  for (const DrawnLux& value : map.lux) out.lux.push_back(value.lux);
  return out;
}

/// Whether a line from a to b, in units of squares, touches the square (i, j); clipping by Liang
/// and Barsky.
bool touches(glm::dvec2 a, glm::dvec2 b, double i, double j) {
  double from = 0, to = 1;
  const glm::dvec2 way = b - a;
  const double low[2] = {i, j};
  for (int axis = 0; axis < 2; ++axis) {
    if (way[axis] == 0) {
      if (a[axis] < low[axis] || a[axis] > low[axis] + 1) return false;
      continue;
    }
    double t0 = (low[axis] - a[axis]) / way[axis], t1 = (low[axis] + 1 - a[axis]) / way[axis];
    if (t0 > t1) std::swap(t0, t1);
    from = std::max(from, t0);
    to = std::min(to, t1);
  }
  return from <= to;
}

/// Marks the squares that walls cross, row by row.
std::vector<char> crossed(const ValueGrid& grid, const std::vector<DrawnLine>& walls) {
  const size_t across = grid.columns - 1, up = grid.rows - 1;
  std::vector<char> out(across * up, 0);
  const auto first = [](double v, size_t count) {
    return static_cast<size_t>(std::clamp(std::floor(v), 0.0, static_cast<double>(count)));
  };
  for (const auto& [from, to] : walls) {
    const glm::dvec2 a = (from - grid.corner) / grid.spacing, b = (to - grid.corner) / grid.spacing,
                     low = glm::min(a, b), high = glm::max(a, b);
    for (size_t j = first(low.y, up); j < std::min(up, first(high.y, up) + 1); ++j)
      for (size_t i = first(low.x, across); i < std::min(across, first(high.x, across) + 1); ++i)
        if (touches(a, b, static_cast<double>(i), static_cast<double>(j))) out[j * across + i] = 1;
  }
  return out;
}

/// Dark corners of crossed squares lie in walls, or in walls below windows, where a plan shows only
/// the pane. No line of equal illuminance is drawn between such a corner and lit places.
void leave_out_walls(const std::vector<char>& cut, ValueGrid& grid) {
  const size_t across = grid.columns - 1;
  for (size_t square = 0; square < cut.size(); ++square) {
    if (cut[square] == 0) continue;
    const size_t first = square / across * grid.columns + square % across;
    for (const size_t corner : {first, first + 1, first + grid.columns, first + grid.columns + 1})
      if (grid.lux[corner] == 0) grid.lux[corner] = std::nan("");
  }
}

using Key = std::pair<int64_t, int64_t>;

/// Joins pieces whose ends meet.
std::vector<ContourLine> joined(std::vector<ContourLine> pieces, double spacing) {
  // Ends on a common edge are computed from the same two values, so they agree to rounding.
  const auto key = [&](const glm::dvec2& p) {
    return Key(std::llround(p.x / spacing * 1e6), std::llround(p.y / spacing * 1e6));
  };
  std::multimap<Key, size_t> ends;
  for (size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].closed) continue;
    ends.emplace(key(pieces[i].points.front()), i);
    ends.emplace(key(pieces[i].points.back()), i);
  }
  std::vector<char> used(pieces.size(), 0);
  const auto next = [&](const glm::dvec2& from) {
    const auto [low, high] = ends.equal_range(key(from));
    for (auto at = low; at != high; ++at)
      if (used[at->second] == 0) return at->second;
    return pieces.size();
  };
  std::vector<ContourLine> out;
  for (size_t i = 0; i < pieces.size(); ++i) {
    if (used[i] != 0) continue;
    used[i] = 1;
    ContourLine line = pieces[i];
    for (const bool forward : {true, false}) {
      if (line.closed) break;
      for (size_t k = next(line.points.back()); k < pieces.size(); k = next(line.points.back())) {
        used[k] = 1;
        auto more = pieces[k].points;
        if (key(more.front()) != key(line.points.back())) std::reverse(more.begin(), more.end());
        line.points.insert(line.points.end(), more.begin() + 1, more.end());
      }
      if (forward) std::reverse(line.points.begin(), line.points.end());
    }
    line.closed = line.points.size() > 2 && key(line.points.front()) == key(line.points.back());
    out.push_back(std::move(line));
  }
  return out;
}

/// Where a way of at most `reach` from a point, in a unit direction, first meets a wall.
std::optional<glm::dvec2> wall_ahead(const glm::dvec2& from, const glm::dvec2& direction,
                                     double reach, const std::vector<DrawnLine>& walls) {
  double nearest = reach;
  bool met = false;
  for (const auto& [a, b] : walls) {
    const glm::dvec2 wall = b - a, to = a - from;
    const double across = direction.x * wall.y - direction.y * wall.x;
    if (std::abs(across) < 1e-12) continue;
    const double t = (to.x * wall.y - to.y * wall.x) / across;
    const double on_wall = (to.x * direction.y - to.y * direction.x) / across;
    if (t < 0 || t > nearest || on_wall < 0 || on_wall > 1) continue;
    nearest = t;
    met = true;
  }
  if (!met) return std::nullopt;
  return from + direction * nearest;
}

/// Lines end where the squares that a wall crosses begin: goes on straight to the wall.
void meet_walls(ContourLine& line, double spacing, const std::vector<DrawnLine>& walls) {
  const double reach = squares_to_wall * spacing;
  for (int end = 0; end < 2 && !line.closed && line.points.size() > 1; ++end) {
    const glm::dvec2 last = line.points.back(), way = last - line.points[line.points.size() - 2];
    if (glm::length(way) > 0)
      if (const auto wall = wall_ahead(last, glm::normalize(way), reach, walls))
        line.points.push_back(*wall);
    std::reverse(line.points.begin(), line.points.end());
  }
}

/// Adds the lines of one row, for each run of squares that no wall crosses.
void add_row(const ValueGrid& grid, const std::vector<char>& cut, size_t j, double lux,
             std::vector<ContourLine>& out) {
  const size_t across = grid.columns - 1;
  const auto at = [&](size_t i) { return grid.corner.x + static_cast<double>(i) * grid.spacing; };
  const double y = grid.corner.y + static_cast<double>(j) * grid.spacing;
  const std::vector<double> ys{y, grid.corner.y + static_cast<double>(j + 1) * grid.spacing};
  for (size_t from = 0; from < across; ++from) {
    if (cut[j * across + from] != 0) continue;
    size_t to = from;
    while (to < across && cut[j * across + to] == 0) ++to;
    std::vector<double> xs, values;
    for (size_t i = from; i <= to; ++i) xs.push_back(at(i));
    for (size_t k = j; k <= j + 1; ++k)
      for (size_t i = from; i <= to; ++i) values.push_back(grid.lux[k * grid.columns + i]);
    auto lines = contour_lines(xs, ys, values, lux);
    out.insert(out.end(), lines.begin(), lines.end());
    from = to;
  }
}

}  // namespace

std::vector<IsoluxLine> isolux_lines(const PlanLevel& level) {
  ValueGrid grid = grid_of(level.map);
  std::vector<IsoluxLine> out;
  if (grid.columns < 2 || grid.rows < 2) return out;
  const auto cut = crossed(grid, level.walls);
  leave_out_walls(cut, grid);
  for (const double lux : isolux_levels) {
    std::vector<ContourLine> pieces;
    for (size_t j = 0; j + 1 < grid.rows; ++j) add_row(grid, cut, j, lux, pieces);
    for (ContourLine& line : joined(std::move(pieces), grid.spacing)) {
      meet_walls(line, grid.spacing, level.walls);
      out.push_back({lux, std::move(line)});
    }
  }
  return out;
}

}  // namespace luxodus
