#include "actors/judge/walkers/ways_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/emergency/way.hpp"

namespace luxodus {

namespace {

/// A point of a route belongs to a floor that is this near in height [m].
constexpr double on_floor_m = 0.5;
/// A route may end in a door or wall: people walk to the nearest free place within this [m].
constexpr double beside_end_m = 1;
/// Its line may run along furniture: other points of it move this far [m].
constexpr double beside_line_m = 0.5;

/// Distances along a route of the points of its last part that lies on a floor; empty if none
/// does.
std::vector<double> bends_on(const EscapeRoute& route, double floor_m) {
  std::vector<double> part, last;
  double along_m = 0;
  for (size_t i = 0; i < route.path.size(); ++i) {
    if (i > 0) along_m += glm::length(route.path[i] - route.path[i - 1]);
    if (std::abs(route.path[i].z - floor_m) > on_floor_m) {
      part.clear();
      continue;
    }
    part.push_back(along_m);
    last = part;
  }
  return last;
}

}  // namespace

Result<WaysOut> WaysOut::make(const SceneDescription& scene, const FreeSpace& space, double floor_m,
                              size_t followed) {
  WaysOut out(scene, space);
  for (const EscapeRoute& route : scene.routes) {
    const std::vector<double> bends_m = bends_on(route, floor_m);
    if (bends_m.empty()) continue;
    WayOut way{&route, bends_m.front(), bends_m.back(), {}};
    for (const double along_m : bends_m) {
      const bool is_end = along_m == way.to_m;
      const glm::dvec3 at = place_along(route, along_m);
      const auto cell = space.nearest_free(glm::dvec2(at), is_end ? beside_end_m : beside_line_m);
      if (cell) way.bends.emplace_back(along_m, *cell);
      if (is_end && !cell)
        return problem_in(route.place,
                          fmt::format("nobody can stand within {:g} m of the end of the route "
                                      "\"{}\" on this floor, at ({:.4g}, {:.4g}, {:.4g}) m: is "
                                      "there a floor, and room between walls and furniture?",
                                      beside_end_m, route.name, at.x, at.y, at.z));
    }
    auto& line = out.lines_.emplace_back();
    const int steps = pieces_of(std::max(way.to_m - way.from_m, space.cell_m()), space.cell_m());
    for (int i = 0; i <= steps; ++i) {
      const double along_m = way.from_m + (way.to_m - way.from_m) * i / steps;
      const glm::dvec2 at(place_along(route, along_m));
      if (const auto cell = space.nearest_free(at, 2 * space.cell_m())) line[*cell] = along_m;
    }
    line[way.end()] = way.to_m;
    out.ways_.push_back(std::move(way));
  }
  if (out.ways_.empty())
    return problem_in(scene.file,
                      fmt::format("no [[route]] lies on the floor at {:g} m: people leave by the "
                                  "ends of routes",
                                  floor_m));
  out.to_end_.assign(out.ways_.size(), nullptr);
  const size_t fields = 2 * out.ways_.size() + followed;
  if (fields * space.cells() > limits::field_cells)
    return problem_in(
        scene.file,
        fmt::format(
            "{} routes and signs that lead {} times along routes need {} fields of distances over "
            "{} cells; at most {} cells are kept: give a larger --cell",
            out.ways_.size(), followed, fields, space.cells(), limits::field_cells));
  return out;
}

std::optional<size_t> WaysOut::way_of(const EscapeRoute& route) const {
  for (size_t i = 0; i < ways_.size(); ++i)
    if (ways_[i].route == &route) return i;
  return std::nullopt;
}

Result<size_t> WaysOut::way_named(const std::string& name) const {
  std::string names;
  for (size_t i = 0; i < ways_.size(); ++i) {
    if (ways_[i].route->name == name) return i;
    names += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", ways_[i].route->name);
  }
  return problem_in(scene_.file, fmt::format("there is no route \"{}\" on this floor; there are {}",
                                             name, names));
}

double WaysOut::distance_to_end_m(size_t way, CellNumber from) {
  if (to_end_[way] == nullptr) to_end_[way] = &field_to({ways_[way].end()});
  return to_end_[way]->distance_m(from);
}

std::optional<WalkingLine> WaysOut::along(size_t way, CellNumber from) {
  std::vector<CellNumber> goals;
  for (const auto& [cell, along_m] : lines_[way]) goals.push_back(cell);
  const WalkingField& field = field_to(goals);
  if (!field.reaches(from)) return std::nullopt;
  auto cells = field.way_from(from);
  if (!go_on(way, lines_[way].at(cells.back()), cells)) return std::nullopt;
  return places_of(cells);
}

std::optional<WalkingLine> WaysOut::past(size_t way, double along_m, CellNumber from) {
  const WayOut& out = ways_[way];
  const double at_m = std::clamp(along_m, out.from_m, out.to_m);
  // The cell of the line that is nearest along the route: its own points are on free cells.
  const auto nearest =
      std::min_element(lines_[way].begin(), lines_[way].end(), [&](const auto& a, const auto& b) {
        return std::abs(a.second - at_m) < std::abs(b.second - at_m);
      });
  const WalkingField& field = field_to({nearest->first});
  if (!field.reaches(from)) return std::nullopt;
  auto cells = field.way_from(from);
  if (!go_on(way, nearest->second, cells)) return std::nullopt;
  return places_of(cells);
}

const WalkingField& WaysOut::field_to(const std::vector<CellNumber>& goals) {
  auto& field = fields_[goals];
  if (!field) field = std::make_unique<WalkingField>(space_, goals);
  return *field;
}

bool WaysOut::go_on(size_t way, double along_m, std::vector<CellNumber>& line) {
  for (const auto& [bend_m, cell] : ways_[way].bends) {
    if (bend_m <= along_m || cell == line.back()) continue;
    auto& leg = legs_[{line.back(), cell}];
    if (leg.empty() && space_.sees(line.back(), cell)) {
      leg = {line.back(), cell};
    } else if (leg.empty()) {
      const WalkingField field(space_, {cell}, line.back());
      if (field.reaches(line.back())) leg = field.way_from(line.back());
    }
    if (leg.empty()) return false;
    line.insert(line.end(), leg.begin() + 1, leg.end());
  }
  return true;
}

WalkingLine WaysOut::places_of(const std::vector<CellNumber>& cells) const {
  WalkingLine out;
  for (const CellNumber cell : cells) out.push_back(space_.centre(cell));
  return out;
}

}  // namespace luxodus
