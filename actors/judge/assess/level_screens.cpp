// A level is divided into square cells. Each triangle of the level is subtracted from the cells
// that it meets; a cell of which nothing is left is closed. A line from a place into a box crosses
// the level within the projection of the box from that place. If all cells around that projection
// are closed, every such line is blocked.
#include "actors/judge/assess/level_screens.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>

namespace luxodus {

namespace {

/// Heights within a triangle, and of triangles of one level, differ by less than this [m].
constexpr double one_level_m = 1e-5;
/// Levels with less closed area hide too little to be worth a test [m2].
constexpr double least_area_m2 = 2;
/// Edge of a cell; larger if the level would have too many cells [m].
constexpr double usual_cell_m = 0.25;
/// Rests of a cell below this area are rounding errors [m2].
constexpr double no_area_m2 = 1e-8;
/// Largest number of pieces that are left of a cell; beyond it the cell counts as open.
constexpr size_t max_pieces = 64;
/// Smallest distance of a screen from the place and the box that it separates [m]: luminaires lie
/// in ceilings, places on floors.
constexpr double apart_m = 5e-3;
/// Margin around a projection [m].
constexpr double around_line_m = 1e-3;
/// Screens that are tested from a place; one farther away rarely hides what these do not.
constexpr int max_screens = 6;

using Polygon = std::vector<glm::dvec2>;
using LevelTriangle = std::array<glm::dvec2, 3>;

double cross_of(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

double area_of(const Polygon& polygon) {
  double twice = 0;
  for (size_t i = 0; i < polygon.size(); ++i)
    twice += cross_of(polygon[i], polygon[(i + 1) % polygon.size()]);
  return 0.5 * std::abs(twice);
}

/// Part of a polygon to the left of the line from `a` to `b`, or to the right of it.
Polygon side_of(const Polygon& polygon, const glm::dvec2& a, const glm::dvec2& b, bool left) {
  Polygon out;
  const auto height = [&](const glm::dvec2& p) { return (left ? 1 : -1) * cross_of(b - a, p - a); };
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double hp = height(p), hq = height(q);
    if (hp >= 0) out.push_back(p);
    if ((hp > 0 && hq < 0) || (hp < 0 && hq > 0)) out.push_back(p + (q - p) * (hp / (hp - hq)));
  }
  return out;
}

/// Parts of a piece outside a triangle; none if the triangle does not meet the piece.
std::optional<std::vector<Polygon>> without(const Polygon& piece, const LevelTriangle& t) {
  std::vector<Polygon> out;
  Polygon rest = piece;
  for (size_t i = 0; i < 3; ++i) {
    Polygon beside = side_of(rest, t[i], t[(i + 1) % 3], false);
    if (beside.size() > 2 && area_of(beside) > no_area_m2) out.push_back(std::move(beside));
    rest = side_of(rest, t[i], t[(i + 1) % 3], true);
    if (rest.size() < 3 || !(area_of(rest) > no_area_m2)) return std::nullopt;
  }
  return out;
}

/// Horizontal triangles by level, counter-clockwise.
std::map<int64_t, std::vector<LevelTriangle>> level_triangles(const CompiledScene& scene) {
  std::map<int64_t, std::vector<LevelTriangle>> out;
  const auto& objects = scene.description->objects;
  const auto opaque = [&](uint32_t material) {
    const MaterialKind kind = scene.materials[material].kind;
    return kind != MaterialKind::open && kind != MaterialKind::glass_pane;
  };
  for (size_t o = 0; o < objects.size() && o < scene.surfaces.size(); ++o) {
    const CompiledSurface& surface = scene.surfaces[o];
    // The body of a luminaire does not stop the luminaire's own light.
    if (objects[o].door || surface.body != 0 || !opaque(surface.material[0]) ||
        !opaque(surface.material[1]))
      continue;
    const Mesh& mesh = objects[o].mesh;
    for (const glm::uvec3& corners : mesh.triangles) {
      const glm::dvec3 &a = mesh.positions[corners[0]], &b = mesh.positions[corners[1]],
                       &c = mesh.positions[corners[2]];
      if (std::max({a.z, b.z, c.z}) - std::min({a.z, b.z, c.z}) > one_level_m) continue;
      LevelTriangle flat{glm::dvec2(a), glm::dvec2(b), glm::dvec2(c)};
      const double turn = cross_of(flat[1] - flat[0], flat[2] - flat[0]);
      if (turn < 0) std::swap(flat[1], flat[2]);
      if (turn != 0) out[std::llround(a.z / one_level_m)].push_back(flat);
    }
  }
  return out;
}

double area_of(const std::vector<LevelTriangle>& triangles) {
  double sum = 0;
  for (const LevelTriangle& t : triangles) sum += 0.5 * cross_of(t[1] - t[0], t[2] - t[0]);
  return sum;
}

}  // namespace

class LevelScreens::Drawing {
 public:
  Drawing(double z, const std::vector<LevelTriangle>& triangles) {
    glm::dvec2 low = triangles.front()[0], high = low;
    for (const LevelTriangle& t : triangles)
      for (const glm::dvec2& p : t) low = glm::min(low, p), high = glm::max(high, p);
    const glm::dvec2 size = high - low;
    level_.z = z;
    level_.low = low;
    const double cell_m = std::max({usual_cell_m, size.x / max_columns, size.y / max_columns,
                                    std::sqrt(size.x * size.y / double(limits::screen_cells))});
    level_.columns = static_cast<int>(std::ceil(size.x / cell_m));
    level_.rows = static_cast<int>(std::ceil(size.y / cell_m));
    level_.cell_m = size / glm::dvec2(level_.columns, level_.rows);
    for (const LevelTriangle& t : triangles) visits_ += size_of(cells_around(t));
  }

  /// Visits of cells needed to subtract all triangles.
  size_t visits() const { return visits_; }

  size_t count() const {
    return static_cast<size_t>(level_.columns) * static_cast<size_t>(level_.rows);
  }

  /// The level of the triangles that this was made for.
  Level level(const std::vector<LevelTriangle>& triangles) {
    closed_.assign(count(), 0);
    for (const LevelTriangle& t : triangles) take(t);
    const size_t wide = static_cast<size_t>(level_.columns) + 1;
    level_.closed.assign(wide * (static_cast<size_t>(level_.rows) + 1), 0);
    for (size_t y = 1; y <= static_cast<size_t>(level_.rows); ++y)
      for (size_t x = 1; x < wide; ++x)
        level_.closed[y * wide + x] = (closed_[(y - 1) * (wide - 1) + x - 1] != 0 ? 1U : 0U) +
                                      level_.closed[y * wide + x - 1] +
                                      level_.closed[(y - 1) * wide + x] -
                                      level_.closed[(y - 1) * wide + x - 1];
    return std::move(level_);
  }

 private:
  static constexpr double max_columns = 10'000;

  glm::ivec2 cell_of(const glm::dvec2& p) const {
    const glm::ivec2 last(level_.columns - 1, level_.rows - 1);
    return glm::clamp(glm::ivec2(glm::floor((p - level_.low) / level_.cell_m)), glm::ivec2(0),
                      last);
  }

  struct CellRange {
    glm::ivec2 first, last;
  };

  CellRange cells_around(const LevelTriangle& t) const {
    return {cell_of(glm::min(t[0], glm::min(t[1], t[2]))),
            cell_of(glm::max(t[0], glm::max(t[1], t[2])))};
  }

  static size_t size_of(const CellRange& cells) {
    const glm::ivec2 size = cells.last - cells.first + 1;
    return static_cast<size_t>(size.x) * static_cast<size_t>(size.y);
  }

  /// Subtracts a triangle from what is left of the cells that it meets.
  void take(const LevelTriangle& t) {
    const auto [first, last] = cells_around(t);
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x)
        take_from(
            static_cast<size_t>(y) * static_cast<size_t>(level_.columns) + static_cast<size_t>(x),
            level_.low + glm::dvec2(x, y) * level_.cell_m, t);
  }

  void take_from(size_t cell, const glm::dvec2& at, const LevelTriangle& t) {
    if (closed_[cell] != 0) return;
    const glm::dvec2 size = level_.cell_m;
    const auto [found, fresh] = left_.try_emplace(cell);
    if (fresh)
      found->second = {{at, at + glm::dvec2(size.x, 0), at + size, at + glm::dvec2(0, size.y)}};
    std::vector<Polygon> left;
    bool any_changed = false;
    for (const Polygon& piece : found->second)
      if (auto rest = without(piece, t)) {
        any_changed = true;
        std::move(rest->begin(), rest->end(), std::back_inserter(left));
      } else {
        left.push_back(piece);
      }
    if (!any_changed) {
      if (fresh) left_.erase(found);
    } else if (left.empty()) {
      closed_[cell] = 1;
      left_.erase(found);
    } else if (left.size() <= max_pieces) {
      found->second = std::move(left);
    }
  }

  Level level_;
  size_t visits_ = 0;
  std::vector<char> closed_;
  std::map<size_t, std::vector<Polygon>> left_;  // of cells that a triangle has met
};

bool LevelScreens::Level::covers(const glm::dvec2& from, const glm::dvec2& to) const {
  const glm::dvec2 a = (from - around_line_m - low) / cell_m,
                   b = (to + around_line_m - low) / cell_m;
  if (!(a.x >= 0 && a.y >= 0 && b.x <= columns && b.y <= rows)) return false;
  const auto x0 = static_cast<size_t>(a.x), y0 = static_cast<size_t>(a.y),
             x1 = static_cast<size_t>(std::ceil(b.x)), y1 = static_cast<size_t>(std::ceil(b.y)),
             wide = static_cast<size_t>(columns) + 1;
  const uint32_t inside = closed[y1 * wide + x1] + closed[y0 * wide + x0] - closed[y0 * wide + x1] -
                          closed[y1 * wide + x0];
  return inside == (x1 - x0) * (y1 - y0);
}

LevelScreens::LevelScreens(const CompiledScene& scene) {
  size_t cells = 0, visits = 0;
  for (const auto& [z, triangles] : level_triangles(scene)) {
    if (area_of(triangles) < least_area_m2) continue;
    Drawing drawing(static_cast<double>(z) * one_level_m, triangles);
    if (drawing.visits() > limits::screen_visits - visits) continue;
    cells += drawing.count();
    visits += drawing.visits();
    if (cells > limits::all_screen_cells) break;
    levels_.push_back(drawing.level(triangles));
  }
}

bool LevelScreens::hide(const glm::dvec3& place, const Bounds& box) const {
  const bool above = box.low.z > place.z;
  if (!above && box.high.z > place.z) return false;
  const double nearest = above ? box.low.z : box.high.z;
  const auto hides = [&](const Level& level) {
    glm::dvec2 low(0), high(0);
    for (int i = 0; i < 8; ++i) {
      const glm::dvec3 corner((i & 1) != 0 ? box.high.x : box.low.x,
                              (i & 2) != 0 ? box.high.y : box.low.y,
                              (i & 4) != 0 ? box.high.z : box.low.z);
      const glm::dvec2 at = glm::dvec2(place) + glm::dvec2(corner - place) *
                                                    ((level.z - place.z) / (corner.z - place.z));
      low = i == 0 ? at : glm::min(low, at);
      high = i == 0 ? at : glm::max(high, at);
    }
    return level.covers(low, high);
  };
  const auto at_or_above = [](const Level& level, double z) { return level.z < z; };
  int looked_at = 0;
  if (above) {
    for (auto it = std::lower_bound(levels_.begin(), levels_.end(), place.z + apart_m, at_or_above);
         it != levels_.end() && it->z < nearest - apart_m && looked_at < max_screens; ++it)
      if (++looked_at; hides(*it)) return true;
    return false;
  }
  for (auto it = std::lower_bound(levels_.begin(), levels_.end(), place.z - apart_m, at_or_above);
       it != levels_.begin() && looked_at < max_screens;) {
    if (!((--it)->z > nearest + apart_m)) return false;
    if (++looked_at; hides(*it)) return true;
  }
  return false;
}

}  // namespace luxodus
