#include "scenes/emergency/calculation_grid.hpp"

#include <algorithm>
#include <optional>

#include "scenes/emergency/way.hpp"

namespace luxodus {

namespace {

/// Indices of the points of a leg in a grid.
using LegPoints = std::vector<uint32_t>;

/// Adds the points of a line. A leg that begins where the one before ends shares that point.
std::vector<LegPoints> add_line(const GridLine& line, std::vector<glm::dvec3>& places) {
  std::vector<LegPoints> out;
  for (const GridLeg& leg : line) {
    LegPoints points;
    for (size_t k = 0; k < leg.places.size(); ++k) {
      const bool shared =
          k == 0 && !out.empty() && !places.empty() && places.back() == leg.places.front();
      if (!shared) places.push_back(leg.places[k]);
      points.push_back(static_cast<uint32_t>(places.size() - 1));
    }
    out.push_back(std::move(points));
  }
  return out;
}

void add_gaps_along(const GridLeg& leg, const LegPoints& points, std::vector<GridGap>& gaps) {
  for (size_t k = 0; k + 1 < leg.places.size(); ++k) {
    if (leg.is_stairs() && leg.riser_follows[k] != 0) continue;
    gaps.push_back({leg.places[k],
                    leg.places[k + 1] - leg.places[k],
                    glm::dvec3(0),
                    {points[k], points[k + 1], points[k + 1], points[k + 1]}});
  }
}

void add_gaps_between(const GridLeg& left, const LegPoints& points, const GridLeg& right,
                      const LegPoints& beside, std::vector<GridGap>& gaps) {
  for (size_t k = 0; k + 1 < left.places.size(); ++k)
    gaps.push_back({left.places[k],
                    left.places[k + 1] - left.places[k],
                    right.places[k] - left.places[k],
                    {points[k], points[k + 1], beside[k], beside[k + 1]}});
}

}  // namespace

void CalculationGrid::append(const CalculationGrid& other) {
  const auto before = static_cast<uint32_t>(places.size());
  places.insert(places.end(), other.places.begin(), other.places.end());
  for (GridGap gap : other.gaps) {
    for (uint32_t& corner : gap.corners) corner += before;
    gaps.push_back(gap);
  }
  in_bodies += other.in_bodies;
}

GridLine line_along(const EscapeRoute& route, double aside_m, double spacing_m) {
  GridLine out;
  for (size_t i = 1; i < route.path.size(); ++i)
    out.push_back({along_leg(route.path[i - 1], route.path[i], aside_m, spacing_m), {}});
  return out;
}

CalculationGrid grid_of(const std::vector<GridLine>& lines, bool joined) {
  CalculationGrid out;
  std::vector<std::vector<LegPoints>> points;
  for (const GridLine& line : lines) points.push_back(add_line(line, out.places));
  const auto is_joined = [&](size_t line, size_t leg) {
    if (!joined || line + 1 >= lines.size()) return false;
    const GridLeg &here = lines[line][leg], &beside = lines[line + 1][leg];
    return !here.is_stairs() && !beside.is_stairs() && here.places.size() == beside.places.size();
  };
  for (size_t j = 0; j < lines.size(); ++j)
    for (size_t i = 0; i < lines[j].size(); ++i) {
      if (is_joined(j, i))
        add_gaps_between(lines[j][i], points[j][i], lines[j + 1][i], points[j + 1][i], out.gaps);
      else if (j == 0 || !is_joined(j - 1, i))
        add_gaps_along(lines[j][i], points[j][i], out.gaps);
    }
  return out;
}

CalculationGrid grid_within(double half_width_m, double spacing_m, const LineOfRoute& line) {
  std::vector<GridLine> lines;
  const int n = pieces_of(half_width_m, spacing_m);
  for (int k = -n; k <= n; ++k) lines.push_back(line(half_width_m * k / n));
  return grid_of(lines, true);
}

CalculationGrid grid_of(const AssessedArea& area, double border_m, double spacing_m) {
  CalculationGrid out;
  const AreaLattice lattice = lattice_of(area, border_m, spacing_m);
  if (lattice.columns == 0) return out;
  std::vector<std::optional<uint32_t>> index;
  for (int j = 0; j <= lattice.rows; ++j)
    for (int i = 0; i <= lattice.columns; ++i) {
      const glm::dvec2 p = lattice.place(i, j);
      index.emplace_back();
      if (!is_within(area, p, border_m)) continue;
      index.back() = static_cast<uint32_t>(out.places.size());
      out.places.emplace_back(p, area.z_m);
    }
  const auto at = [&](int i, int j) {
    return index[static_cast<size_t>(j * (lattice.columns + 1) + i)];
  };
  for (int j = 0; j < lattice.rows; ++j)
    for (int i = 0; i < lattice.columns; ++i) {
      const auto a = at(i, j), b = at(i + 1, j), c = at(i, j + 1), d = at(i + 1, j + 1);
      if (!a || !b || !c || !d) continue;
      out.gaps.push_back({out.places[*a],
                          out.places[*b] - out.places[*a],
                          out.places[*c] - out.places[*a],
                          {*a, *b, *c, *d}});
    }
  return out;
}

}  // namespace luxodus
