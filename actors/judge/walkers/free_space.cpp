// Each triangle is cut to the heights that a body fills and seen from above: a convex polygon, or a
// line where a wall is upright. Cells nearer to it than a body's radius and half their own diagonal
// are not free. So a place anywhere in a free cell is a radius away from everything.
#include "actors/judge/walkers/free_space.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scenes/light/transport/surroundings.hpp"

namespace luxodus {

namespace {

using Polygon = std::vector<glm::dvec2>;

/// The part of a convex polygon on one side of a height: above it (1) or below it (-1).
std::vector<glm::dvec3> cut_at(const std::vector<glm::dvec3>& polygon, double z, int side) {
  std::vector<glm::dvec3> out;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const bool a_in = side * (a.z - z) >= 0, b_in = side * (b.z - z) >= 0;
    if (a_in) out.push_back(a);
    if (a_in != b_in) out.push_back(glm::mix(a, b, (z - a.z) / (b.z - a.z)));
  }
  return out;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

double distance_to_line(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 way = b - a;
  const double length2 = glm::dot(way, way);
  const double t = length2 > 0 ? std::clamp(glm::dot(p - a, way) / length2, 0.0, 1.0) : 0;
  return glm::length(p - a - way * t);
}

/// 0 within the polygon. Its corners may go round either way, and it may be flat.
double distance_to(const Polygon& polygon, const glm::dvec2& p) {
  double least = std::numeric_limits<double>::infinity();
  bool left = false, right = false;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    least = std::min(least, distance_to_line(p, a, b));
    const double side = cross(b - a, p - a);
    left = left || side > 0;
    right = right || side < 0;
  }
  return left != right ? 0 : least;
}

bool is_there(const CompiledScene& scene, const FacedSurface& facing) {
  return facing.surface < scene.description->objects.size() && facing.kind != MaterialKind::open;
}

}  // namespace

Result<FreeSpace> FreeSpace::make(const Building& walls, const BodyOnFloor& body) {
  const SceneDescription& scene = *walls.scene().description;
  Bounds box;
  for (const Object& object : scene.objects)
    for (const glm::dvec3& place : object.mesh.positions) box.extend(place);
  if (box.empty())
    return problem_in(scene.file, "this scene has no surfaces, so that nobody can walk in it");
  const glm::dvec2 count = glm::ceil(glm::dvec2(box.high - box.low) / body.cell_m - 1e-9);
  const glm::dvec2 cells = glm::max(count, glm::dvec2(1));
  if (cells.x * cells.y > static_cast<double>(limits::floor_cells))
    return problem_in(
        scene.file,
        fmt::format("a floor of {:.5g} m by {:.5g} m has {:.3g} cells of {:g} m; at most {} are "
                    "walked on: give a larger --cell",
                    box.high.x - box.low.x, box.high.y - box.low.y, cells.x * cells.y, body.cell_m,
                    limits::floor_cells));
  FreeSpace out;
  out.low_ = glm::dvec2(box.low);
  out.cell_m_ = body.cell_m;
  out.columns_ = static_cast<size_t>(cells.x);
  out.rows_ = static_cast<size_t>(cells.y);
  out.free_.assign(out.cells(), 1);
  for (const Object& object : scene.objects)
    for (const auto& triangle : object.mesh.triangles)
      out.block({object.mesh.positions[triangle[0]], object.mesh.positions[triangle[1]],
                 object.mesh.positions[triangle[2]]},
                body);
  out.need_floor(walls, body);
  out.leave_solids(walls, body);
  return out;
}

/// Cells too near to a triangle are not free.
void FreeSpace::block(const glm::dvec3 (&corners)[3], const BodyOnFloor& body) {
  auto part = cut_at({corners[0], corners[1], corners[2]}, body.floor_m + body.from_m, 1);
  part = cut_at(part, body.floor_m + body.to_m, -1);
  if (part.empty()) return;
  Polygon polygon;
  Bounds box;
  for (const glm::dvec3& p : part) {
    polygon.emplace_back(p);
    box.extend(p);
  }
  const double clear_m = body.radius_m + cell_m_ / std::numbers::sqrt2;
  const glm::dvec2 first = (glm::dvec2(box.low) - clear_m - low_) / cell_m_ - 0.5,
                   last = (glm::dvec2(box.high) + clear_m - low_) / cell_m_ - 0.5;
  const auto from = [](double at) { return static_cast<size_t>(std::max(0.0, std::ceil(at))); };
  const auto end = [](double at, size_t count) {
    return at < 0 ? size_t{0} : std::min(count, static_cast<size_t>(at) + 1);
  };
  for (size_t row = from(first.y); row < end(last.y, rows_); ++row)
    for (size_t column = from(first.x); column < end(last.x, columns_); ++column) {
      const CellNumber cell = cell_at(column, row);
      if (is_free(cell) && distance_to(polygon, centre(cell)) < clear_m) free_[cell] = 0;
    }
}

/// Cells without a floor under their middle are not free.
void FreeSpace::need_floor(const Building& walls, const BodyOnFloor& body) {
  walls.each(cells(), [&](const GeometryAccess& access, size_t cell) {
    if (free_[cell] == 0) return;
    const glm::dvec3 above(centre(static_cast<CellNumber>(cell)), body.floor_m + body.from_m);
    const auto floor =
        first_stop(walls.scene(), access, walls.local(above), Vec3(0, 0, -1),
                   static_cast<Real>(2 * body.from_m),
                   [&](const FacedSurface& facing) { return !is_there(walls.scene(), facing); });
    if (!floor) free_[cell] = 0;
  });
}

/// Free cells that are connected by their sides, part by part.
std::vector<std::vector<CellNumber>> FreeSpace::parts() const {
  std::vector<std::vector<CellNumber>> out;
  std::vector<char> taken(cells());
  for (CellNumber first = 0; first < cells(); ++first) {
    if (!is_free(first) || taken[first] != 0) continue;
    std::vector<CellNumber> part;
    const auto take = [&](CellNumber cell) {
      if (!is_free(cell) || taken[cell] != 0) return;
      taken[cell] = 1;
      part.push_back(cell);
    };
    take(first);
    for (size_t i = 0; i < part.size(); ++i) {
      const size_t column = column_of(part[i]), row = row_of(part[i]);
      if (column > 0) take(cell_at(column - 1, row));
      if (column + 1 < columns_) take(cell_at(column + 1, row));
      if (row > 0) take(cell_at(column, row - 1));
      if (row + 1 < rows_) take(cell_at(column, row + 1));
    }
    out.push_back(std::move(part));
  }
  return out;
}

/// Cells within thick walls and other bodies are not free. What surrounds one of them surrounds all
/// that are connected with it.
void FreeSpace::leave_solids(const Building& walls, const BodyOnFloor& body) {
  const auto all = parts();
  const double middle_m = body.floor_m + (body.from_m + body.to_m) / 2;
  walls.each(all.size(), [&](const GeometryAccess& access, size_t i) {
    if (!walls.in_solid(access, glm::dvec3(centre(all[i].front()), middle_m))) return;
    for (const CellNumber cell : all[i]) free_[cell] = 0;
  });
}

glm::dvec2 FreeSpace::high() const {
  return low_ + glm::dvec2(columns_, rows_) * cell_m_;
}

glm::dvec2 FreeSpace::centre(CellNumber cell) const {
  return low_ + (glm::dvec2(column_of(cell), row_of(cell)) + 0.5) * cell_m_;
}

std::optional<CellNumber> FreeSpace::cell_of(const glm::dvec2& place) const {
  const glm::dvec2 at = glm::floor((place - low_) / cell_m_);
  if (!(at.x >= 0 && at.y >= 0 && at.x < static_cast<double>(columns_) &&
        at.y < static_cast<double>(rows_)))
    return std::nullopt;
  return cell_at(static_cast<size_t>(at.x), static_cast<size_t>(at.y));
}

std::optional<CellNumber> FreeSpace::nearest_free(const glm::dvec2& place, double within_m) const {
  std::optional<CellNumber> out;
  double least = within_m;
  const glm::dvec2 first = glm::floor((place - within_m - low_) / cell_m_),
                   last = glm::floor((place + within_m - low_) / cell_m_);
  for (double y = std::max(0.0, first.y); y <= last.y && y < static_cast<double>(rows_); ++y)
    for (double x = std::max(0.0, first.x); x <= last.x && x < static_cast<double>(columns_); ++x) {
      const CellNumber cell = cell_at(static_cast<size_t>(x), static_cast<size_t>(y));
      const double distance = glm::distance(centre(cell), place);
      if (!is_free(cell) || distance > least || (out && distance == least)) continue;
      least = distance;
      out = cell;
    }
  return out;
}

/// Goes from cell to cell as the line does; where it passes through a corner, both cells beside it
/// must be free as well.
bool FreeSpace::sees(CellNumber from, CellNumber to) const {
  const auto signed_of = [](size_t v) { return static_cast<int64_t>(v); };
  int64_t x = signed_of(column_of(from)), y = signed_of(row_of(from));
  const int64_t dx = signed_of(column_of(to)) - x, dy = signed_of(row_of(to)) - y;
  const int64_t nx = std::abs(dx), ny = std::abs(dy), sx = dx > 0 ? 1 : -1, sy = dy > 0 ? 1 : -1;
  const auto free_at = [&](int64_t column, int64_t row) {
    return is_free(cell_at(static_cast<size_t>(column), static_cast<size_t>(row)));
  };
  if (!is_free(from)) return false;
  for (int64_t ix = 0, iy = 0; ix < nx || iy < ny;) {
    const int64_t side = (1 + 2 * ix) * ny - (1 + 2 * iy) * nx;
    if (side == 0 && !(free_at(x + sx, y) && free_at(x, y + sy))) return false;
    if (side <= 0) {
      x += sx;
      ++ix;
    }
    if (side >= 0) {
      y += sy;
      ++iy;
    }
    if (!free_at(x, y)) return false;
  }
  return true;
}

}  // namespace luxodus
