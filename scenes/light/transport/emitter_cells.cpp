// Cells are halved across their longer side until the two-point Gauss-Legendre rule per side
// suffices. Its error grows with the fourth power of width over distance: a width of an eighth
// gives 1e-4. The error of one point grows with the square: a 26th gives 1e-3. Polar coordinates
// start as four quarters, since two points around a whole circle would lie on one side of it.
#include "scenes/light/transport/emitter_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace luxodus {

namespace {

constexpr double plastic = 1.2207440846057596;  // root of x^4 = x + 1
/// Points of the two-point Gauss-Legendre rule, from 0 to 1.
constexpr Real gauss[2] = {0.2113248654051871_r, 0.7886751345948129_r};
/// Largest width that one point may represent, relative to the spacing of points.
constexpr double whole_share = 0.6;
/// Factor by which cells that the receiver's horizon cuts are narrower.
constexpr double at_horizon = 8;
/// Distance from a cell's corners at which they are tested, as a share of its width: on a corner it
/// may touch a wall.
constexpr Real inset = 1e-3_r;

double fractional(double x) {
  return x - std::floor(x);
}

double length_of(const Vec3& v) {
  return static_cast<double>(glm::length(v));
}

/// Largest extent of a mesh [m], and the approximate distance to it.
struct MeshSight {
  double size = 0, distance = 0;
};
MeshSight look_at_mesh(const CompiledEmitter& e, const Vec3& from) {
  Vec3 low = e.corners.front(), high = low;
  for (const Vec3& c : e.corners) {
    low = glm::min(low, c);
    high = glm::max(high, c);
  }
  const double size = length_of(high - low);
  const double away = length_of(from - 0.5_r * (low + high));
  return {size, std::max(away - size / 2, size / 32)};
}

int points_of_mesh(const CompiledEmitter& e, const Viewpoint& from) {
  const MeshSight sight = look_at_mesh(e, from.place);
  const double per_side = std::ceil(sight.size / (from.part_share * sight.distance));
  return static_cast<int>(
      std::clamp(per_side * per_side * 2, 64.0, static_cast<double>(limits::direct_points)));
}

/// Two directions perpendicular to a third.
void across(const Vec3& w, Vec3& a, Vec3& b) {
  const Vec3 least = std::abs(w.x) < 0.5_r ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  a = glm::normalize(glm::cross(w, least));
  b = glm::cross(w, a);
}

}  // namespace

bool has_flat_cells(const CompiledEmitter& e) {
  return e.kind == EmitterKind::rectangle ||
         (e.kind == EmitterKind::mesh && e.corners.size() <= 3 * limits::direct_triangles);
}

bool EmitterCells::is_mesh_of_points() const {
  return emitter_->kind == EmitterKind::mesh && !has_flat_cells(*emitter_);
}

bool EmitterCells::emits_outwards() const {
  return emitter_->distribution == Distribution::lambertian ||
         emitter_->distribution == Distribution::cosine_power;
}

/// The map of a patch's unit square; `share` is per unit of that square.
EmitterPart EmitterCells::at(uint32_t patch, Real u, Real v) const {
  const CompiledEmitter& e = *emitter_;
  const Vec3 down = -e.axes[2];
  switch (e.kind) {
    case EmitterKind::point:
    case EmitterKind::rectangle:
      return {emission_point(e, u, v, 0), 1};
    case EmitterKind::sign_face:
      return {
          {e.origin + e.axes[0] * ((u - 0.5_r) * e.size.x) + e.axes[1] * ((0.5_r - v) * e.size.y),
           e.axes[2]},
          1};
    case EmitterKind::volume: {
      const std::vector<glm::vec3>& points = scene_->volume_points.at(e.medium);
      return {{Vec3(points[patch]), down}, 1 / static_cast<double>(points.size())};
    }
    case EmitterKind::disc: {
      const Real r = 0.5_r * e.size.x * u;
      const SinCos phi = sin_cos_two_pi(v);
      return {{e.origin + e.axes[0] * (r * phi.cos) + e.axes[1] * (r * phi.sin), down},
              2 * static_cast<double>(u)};
    }
    case EmitterKind::sphere: {
      const Vec3 to_place = from_.place - e.origin;
      const Real away = glm::length(to_place);
      const Vec3 w = away > 0 ? to_place / away : Vec3(0, 0, 1);
      Vec3 a, b;
      across(w, a, b);
      const Real radius = 0.5_r * e.size.x;
      const double reach = emits_outwards()
                               ? std::acos(std::min(1.0, static_cast<double>(radius / away)))
                               : std::numbers::pi;
      const double theta = static_cast<double>(u) * reach;
      const SinCos phi = sin_cos_two_pi(v);
      const auto sine = static_cast<Real>(std::sin(theta));
      const Vec3 n =
          w * static_cast<Real>(std::cos(theta)) + a * (sine * phi.cos) + b * (sine * phi.sin);
      return {{e.origin + n * radius, e.distribution == Distribution::web ? down : n},
              0.5 * reach * std::sin(theta)};
    }
    case EmitterKind::tube: {
      const Vec3 to_place = from_.place - e.origin;
      const auto y = static_cast<double>(glm::dot(to_place, e.axes[1]));
      const auto z = static_cast<double>(glm::dot(to_place, e.axes[2]));
      const auto radius = static_cast<double>(0.5_r * e.size.y);
      const double reach =
          emits_outwards() ? std::acos(std::min(1.0, radius / std::hypot(y, z))) : std::numbers::pi;
      const double psi = std::atan2(z, y) + (2 * static_cast<double>(v) - 1) * reach;
      const Vec3 n = e.axes[1] * static_cast<Real>(std::cos(psi)) +
                     e.axes[2] * static_cast<Real>(std::sin(psi));
      return {{e.origin + e.axes[0] * ((u - 0.5_r) * e.size.x) + n * (0.5_r * e.size.y),
               e.distribution == Distribution::web ? down : n},
              reach / std::numbers::pi};
    }
    case EmitterKind::mesh: {
      if (is_mesh_of_points()) {
        const int count = points_of_mesh(e, from_);
        const double n = patch + 1;
        const auto first = static_cast<Real>(fractional(0.5 + n / plastic));
        const auto second = static_cast<Real>(fractional(0.5 + n / (plastic * plastic)));
        const double third = fractional(0.5 + n / (plastic * plastic * plastic));
        constexpr Real below_one = 0x1.fffffep-1_r;
        return {emission_point(e, std::min(first, below_one), std::min(second, below_one), third),
                1.0 / count};
      }
      const Vec3* c = &e.corners[3 * patch];
      const double before = patch > 0 ? e.texel_cdf[patch - 1] : 0;
      const Vec3 p = c[0] + u * ((c[1] - c[0]) + v * (c[2] - c[1]));
      return {{p, glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]))},
              2 * static_cast<double>(u) * (e.texel_cdf[patch] - before)};
    }
  }
  return {{e.origin, down}, 0};
}

EmitterCells::SeenCell EmitterCells::sight_of(const EmitterCell& cell) const {
  const Vec3 a = at(cell.patch, cell.u0, cell.v0).point.position;
  const Vec3 b = at(cell.patch, cell.u1, cell.v0).point.position;
  const Vec3 c = at(cell.patch, cell.u1, cell.v1).point.position;
  const Vec3 d = at(cell.patch, cell.u0, cell.v1).point.position;
  const Vec3 middle =
      at(cell.patch, 0.5_r * (cell.u0 + cell.u1), 0.5_r * (cell.v0 + cell.v1)).point.position;
  SeenCell sight;
  sight.width_u = std::max(length_of(b - a), length_of(c - d));
  sight.width_v = std::max(length_of(d - a), length_of(c - b));
  sight.distance = length_of(middle - from_.place);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& corner : {a, b, c, d}) {
    const auto height = static_cast<double>(glm::dot(from_.normal, corner - from_.place));
    low = std::min(low, height);
    high = std::max(high, height);
  }
  sight.cut_by_horizon = low < 0 && high > 0;
  return sight;
}

/// Ratio of a cell's width to its allowed width: light falls with the fourth power of the distance,
/// or as fast as exp(-sigma_t d), or to zero at the horizon.
double EmitterCells::excess_width(const EmitterCell& cell, const SeenCell& sight) const {
  const double width = sight.width() * (1 + from_.sigma_t * sight.distance / 4);
  const bool one_point = cell.whole || emitter_->kind == EmitterKind::sign_face;
  const double allowed = from_.part_share * (one_point ? whole_share : 2) * sight.distance;
  const double excess = allowed > 0 ? width / allowed : std::numeric_limits<double>::infinity();
  return sight.cut_by_horizon && !from_.clipped ? at_horizon * excess : excess;
}

/// Whether one point represents the whole of a rectangle, disc or sphere; four for a disc.
bool EmitterCells::small_whole(EmitterCell& cell) const {
  const CompiledEmitter& e = *emitter_;
  const bool round = e.kind == EmitterKind::disc || e.kind == EmitterKind::sphere;
  if (!round && e.kind != EmitterKind::rectangle) return false;
  SeenCell sight;
  sight.width_u = static_cast<double>(e.size.x);
  sight.width_v = static_cast<double>(round ? e.size.x : e.size.y);
  sight.distance = length_of(e.origin - from_.place);
  const auto height = static_cast<double>(glm::dot(from_.normal, e.origin - from_.place));
  sight.cut_by_horizon = std::abs(height) < sight.width();
  cell.whole = true;
  if (excess_width(cell, sight) <= 1) return true;
  cell.whole = false;
  // Four points of a disc are exact to the third power, like those of a cell.
  const bool four =
      e.kind == EmitterKind::disc && !sight.cut_by_horizon && excess_width(cell, sight) <= 1;
  cell.whole = four;
  return four;
}

std::vector<EmitterCell> EmitterCells::patches() const {
  const CompiledEmitter& e = *emitter_;
  EmitterCell all;
  if (e.kind == EmitterKind::point || e.kind == EmitterKind::sign_face || small_whole(all))
    return {all};
  std::vector<EmitterCell> cells;
  if (e.kind == EmitterKind::mesh) {
    for (uint32_t k = 0; 3 * k < e.corners.size(); ++k) {
      if (e.texel_cdf[k] <= (k > 0 ? e.texel_cdf[k - 1] : 0.0)) continue;  // has no normal
      EmitterCell cell{k};
      cell.whole = true;
      cell.whole = excess_width(cell, sight_of(cell)) <= 1;
      cells.push_back(cell);
    }
    return cells;
  }
  if (e.kind == EmitterKind::rectangle) return {all};
  if (e.kind == EmitterKind::sphere && emits_outwards() &&
      !(glm::length(from_.place - e.origin) > 0.5_r * e.size.x))
    return {};
  if (e.kind == EmitterKind::tube && emits_outwards()) {
    const Vec3 o = from_.place - e.origin;
    const Vec2 beside(glm::dot(o, e.axes[1]), glm::dot(o, e.axes[2]));
    if (!(glm::length(beside) > 0.5_r * e.size.y)) return {};
  }
  for (const Real v : {0.0_r, 0.25_r, 0.5_r, 0.75_r}) cells.push_back({0, 0, v, 1, v + 0.25_r});
  return cells;
}

std::vector<EmitterCell> EmitterCells::mesh_points() const {
  std::vector<EmitterCell> cells(static_cast<size_t>(points_of_mesh(*emitter_, from_)));
  for (uint32_t i = 0; i < cells.size(); ++i) cells[i].patch = i;
  return cells;
}

std::vector<EmitterCell> EmitterCells::cut() const {
  if (is_mesh_of_points()) return mesh_points();
  if (emitter_->kind == EmitterKind::volume) {
    std::vector<EmitterCell> cells(scene_->volume_points.at(emitter_->medium).size());
    for (uint32_t i = 0; i < cells.size(); ++i) cells[i].patch = i;
    return cells;
  }
  std::vector<EmitterCell> cells = patches(), small;
  if (emitter_->kind == EmitterKind::point) return cells;
  for (size_t next = 0; next < cells.size(); ++next) {
    const EmitterCell cell = cells[next];
    const SeenCell sight = cell.whole ? SeenCell{} : sight_of(cell);
    const bool room = small.size() + (cells.size() - next) < limits::direct_cells;
    if (cell.whole || !room || excess_width(cell, sight) <= 1) {
      small.push_back(cell);
      continue;
    }
    const Real u = 0.5_r * (cell.u0 + cell.u1), v = 0.5_r * (cell.v0 + cell.v1);
    if (sight.width_u >= sight.width_v) {
      cells.push_back({cell.patch, cell.u0, cell.v0, u, cell.v1});
      cells.push_back({cell.patch, u, cell.v0, cell.u1, cell.v1});
    } else {
      cells.push_back({cell.patch, cell.u0, cell.v0, cell.u1, v});
      cells.push_back({cell.patch, cell.u0, v, cell.u1, cell.v1});
    }
  }
  return small;
}

std::vector<EmitterCell> EmitterCells::quarters(const EmitterCell& cell) const {
  const bool round = emitter_->kind == EmitterKind::disc || emitter_->kind == EmitterKind::sphere;
  std::vector<EmitterCell> out;
  if (cell.whole && round) {
    for (const Real v : {0.0_r, 0.25_r, 0.5_r, 0.75_r}) out.push_back({0, 0, v, 1, v + 0.25_r});
    return out;
  }
  const Real u = 0.5_r * (cell.u0 + cell.u1), v = 0.5_r * (cell.v0 + cell.v1);
  for (const auto& [u0, u1] : {std::pair{cell.u0, u}, std::pair{u, cell.u1}})
    for (const auto& [v0, v1] : {std::pair{cell.v0, v}, std::pair{v, cell.v1}})
      out.push_back({cell.patch, u0, v0, u1, v1});
  return out;
}

/// A small emitter, or a small triangle of one.
CellPoints EmitterCells::whole_points() const {
  const CompiledEmitter& e = *emitter_;
  CellPoints out;
  const Vec3 to_place = from_.place - e.origin;
  const Real away = glm::length(to_place);
  if (e.kind == EmitterKind::sphere) {
    // A sphere is as bright in all directions as a point at its centre; the line ends at its near
    // side.
    const Vec3 n = to_place / away;
    const auto near = static_cast<double>((away - 0.5_r * e.size.x) / away);
    const bool turned = emits_outwards();
    const double exponent =
        e.distribution == Distribution::cosine_power ? static_cast<double>(e.exponent) : 1;
    const double share = (turned ? 1 / (2 * (exponent + 1)) : 1) * near * near;
    out.point[out.count++] = {
        {e.origin + n * (0.5_r * e.size.x), e.distribution == Distribution::web ? -e.axes[2] : n},
        share};
    return out;
  }
  const double relative = static_cast<double>(e.size.x / away);
  if (e.kind == EmitterKind::disc && relative > whole_share * from_.part_share) {
    const Real r = 0.35355339059327379_r * e.size.x;  // of the radius, 1 / sqrt(2)
    for (const auto& [x, y] : {std::pair{r, 0.0_r}, {0.0_r, r}, {-r, 0.0_r}, {0.0_r, -r}})
      out.point[out.count++] = {{e.origin + e.axes[0] * x + e.axes[1] * y, -e.axes[2]}, 0.25};
    return out;
  }
  out.point[out.count++] = {{e.origin, -e.axes[2]}, 1};
  return out;
}

/// All light of a cell of a sign's texels, from the centroid of that light.
EmitterPart EmitterCells::sign_part(const EmitterCell& cell) const {
  const CompiledEmitter& e = *emitter_;
  const auto columns = static_cast<size_t>(e.texel_columns);
  const size_t rows = e.texel_cdf.size() / columns;
  const auto edge = [](Real share, size_t count) {
    return static_cast<size_t>(
        std::lround(static_cast<double>(share) * static_cast<double>(count)));
  };
  const size_t x0 = edge(cell.u0, columns), x1 = edge(cell.u1, columns);
  const auto until = [&](size_t texel) { return texel > 0 ? e.texel_cdf[texel - 1] : 0.0; };
  constexpr size_t blocks = 4;  // per row, each represented by its middle
  double share = 0, x_sum = 0, y_sum = 0;
  for (size_t y = edge(cell.v0, rows); y < edge(cell.v1, rows); ++y) {
    for (size_t k = 0; k < blocks; ++k) {
      const size_t from = x0 + (x1 - x0) * k / blocks, to = x0 + (x1 - x0) * (k + 1) / blocks;
      const double here = until(y * columns + to) - until(y * columns + from);
      share += here;
      x_sum += here * 0.5 * static_cast<double>(from + to);
      y_sum += here * (static_cast<double>(y) + 0.5);
    }
  }
  if (!(share > 0)) return {{e.origin, e.axes[2]}, 0};
  EmitterPart part = at(0, static_cast<Real>(x_sum / (share * static_cast<double>(columns))),
                        static_cast<Real>(y_sum / (share * static_cast<double>(rows))));
  part.share = share;
  return part;
}

CellPoints EmitterCells::points(const EmitterCell& cell) const {
  CellPoints out;
  switch (emitter_->kind) {
    case EmitterKind::point:
    case EmitterKind::volume:
      out.point[out.count++] = at(cell.patch, 0, 0);
      return out;
    case EmitterKind::sign_face:
      out.point[out.count++] = sign_part(cell);
      return out;
    default:
      break;
  }
  if (is_mesh_of_points()) {
    out.point[out.count++] = at(cell.patch, 0, 0);
    return out;
  }
  if (cell.whole && emitter_->kind != EmitterKind::mesh) return whole_points();
  if (cell.whole) {  // at the triangle's centre, where the map's share is 4/3 of the whole
    EmitterPart part = at(cell.patch, 2 / 3.0_r, 0.5_r);
    part.share *= 0.75;
    out.point[out.count++] = part;
    return out;
  }
  const Real du = cell.u1 - cell.u0, dv = cell.v1 - cell.v0;
  const double area = 0.25 * static_cast<double>(du) * static_cast<double>(dv);
  for (const Real gu : gauss)
    for (const Real gv : gauss) {
      EmitterPart part = at(cell.patch, cell.u0 + gu * du, cell.v0 + gv * dv);
      part.share *= area;
      out.point[out.count++] = part;
    }
  return out;
}

CellPoints EmitterCells::corner_points(const EmitterCell& cell) const {
  CellPoints out;
  if (!can_be_cut()) return out;
  const bool round = emitter_->kind == EmitterKind::disc || emitter_->kind == EmitterKind::sphere;
  if (cell.whole && round) {
    for (const Real v : {0.0_r, 0.25_r, 0.5_r, 0.75_r})
      out.point[out.count++] = at(0, 1 - inset, v);
    return out;
  }
  const Real du = inset * (cell.u1 - cell.u0), dv = inset * (cell.v1 - cell.v0);
  for (const Real u : {cell.u0 + du, cell.u1 - du})
    for (const Real v : {cell.v0 + dv, cell.v1 - dv}) out.point[out.count++] = at(cell.patch, u, v);
  return out;
}

EmitterPart EmitterCells::point_in(const EmitterCell& cell, const glm::dvec2& uv,
                                   double share) const {
  EmitterPart part = at(cell.patch, cell.u0 + static_cast<Real>(uv.x) * (cell.u1 - cell.u0),
                        cell.v0 + static_cast<Real>(uv.y) * (cell.v1 - cell.v0));
  part.share = share;
  return part;
}

std::vector<glm::dvec3> EmitterCells::polygon(const EmitterCell& cell) const {
  const auto corner = [&](Real u, Real v) {
    return glm::dvec3(at(cell.patch, u, v).point.position) - glm::dvec3(from_.place);
  };
  std::vector<glm::dvec3> out;
  out.push_back(corner(cell.u0, cell.v0));
  out.push_back(corner(cell.u1, cell.v0));
  out.push_back(corner(cell.u1, cell.v1));
  // A triangle's first edge degenerates to a point.
  if (emitter_->kind != EmitterKind::mesh || cell.u0 > 0) out.push_back(corner(cell.u0, cell.v1));
  return out;
}

}  // namespace luxodus
