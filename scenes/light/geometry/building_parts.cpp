#include "scenes/light/geometry/building_parts.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "scenes/light/geometry/mesh_tools.hpp"
#include "scenes/light/geometry/polygon.hpp"
#include "scenes/light/geometry/shape_checks.hpp"
#include "scenes/light/geometry/transform.hpp"

namespace luxodus::shapes {
namespace {

/// The prism over a checked outline: floor down, ceiling up, walls out.
Result<Mesh> prism(std::span<const glm::dvec2> outline, double height) {
  Result<std::vector<glm::uvec3>> flat = triangulate(outline);
  if (!flat) return flat.problem();
  const auto n = static_cast<uint32_t>(outline.size());
  Mesh mesh;
  for (const double z : {0.0, height}) {
    for (const glm::dvec2& p : outline) mesh.positions.push_back({p.x, p.y, z});
  }
  for (const glm::uvec3& t : flat.value()) {
    mesh.triangles.push_back({t.x, t.z, t.y});
    mesh.triangles.push_back(t + n);
  }
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t next = (i + 1) % n;
    add_quad(mesh, i, next, next + n, i + n);
  }
  return mesh;
}

/// A body whose profile lies in the x z plane and which is `width` wide in y.
Result<Shape> extrude_profile(std::span<const glm::dvec2> profile, double width) {
  Result<std::vector<glm::dvec2>> outline = checked_outline(profile);
  if (!outline) return outline.problem();
  Result<Mesh> body = prism(outline.value(), width);
  if (!body) return body.problem();
  // (x, y) of the profile become (x, z), and the extrusion's height becomes y. This is a mirror
  // transform; `apply` restores the winding.
  Transform stand;
  stand.linear = glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0));
  apply(stand, body.value());
  return Shape{std::move(body.value()), 0};
}

// ---- the wall ----------------------------------------------------------------------------------

/// The wall's face cut along every edge of every opening. Each cell is entirely wall or entirely
/// hole, and all faces are made of the same cells: no edge ends in the middle of another.
class WallGrid {
 public:
  WallGrid(double length, double height, double thickness, std::span<const WallOpening> openings)
      : x_{0, length}, z_{0, height}, thickness_(thickness), openings_(openings) {
    for (const WallOpening& o : openings) {
      x_.insert(x_.end(), {o.x, o.x + o.width});
      z_.insert(z_.end(), {o.z, o.z + o.height});
    }
    for (std::vector<double>* cuts : {&x_, &z_}) {
      const double most = cuts == &x_ ? length : height;
      for (double& cut : *cuts) cut = std::min(cut, most);  // a rounding error past the end
      std::sort(cuts->begin(), cuts->end());
      cuts->erase(std::unique(cuts->begin(), cuts->end()), cuts->end());
    }
  }

  Mesh build() {
    for (int i = 0; i < columns(); ++i) {
      for (int k = 0; k < rows(); ++k) {
        if (solid(i, k)) add_cell(i, k);
      }
    }
    return std::move(mesh_);
  }

 private:
  int columns() const { return static_cast<int>(x_.size()) - 1; }
  int rows() const { return static_cast<int>(z_.size()) - 1; }
  double x(int i) const { return x_[static_cast<size_t>(i)]; }
  double z(int k) const { return z_[static_cast<size_t>(k)]; }

  bool solid(int i, int k) const {
    if (i < 0 || k < 0 || i >= columns() || k >= rows()) return false;
    const double mid_x = 0.5 * (x(i) + x(i + 1)), mid_z = 0.5 * (z(k) + z(k + 1));
    return std::none_of(openings_.begin(), openings_.end(), [&](const WallOpening& o) {
      return mid_x > o.x && mid_x < o.x + o.width && mid_z > o.z && mid_z < o.z + o.height;
    });
  }

  uint32_t vertex(int i, int k, bool back) {
    const auto [place, is_new] =
        index_.try_emplace({i, k, back}, static_cast<uint32_t>(mesh_.positions.size()));
    if (is_new) mesh_.positions.push_back({x(i), back ? thickness_ : 0.0, z(k)});
    return place->second;
  }

  void add_cell(int i, int k) {
    const uint32_t a = vertex(i, k, false), b = vertex(i + 1, k, false);
    const uint32_t c = vertex(i + 1, k + 1, false), d = vertex(i, k + 1, false);
    const uint32_t e = vertex(i, k, true), f = vertex(i + 1, k, true);
    const uint32_t g = vertex(i + 1, k + 1, true), h = vertex(i, k + 1, true);
    add_quad(mesh_, a, b, c, d);  // y = 0, seen from -y
    add_quad(mesh_, f, e, h, g);  // y = thickness
    if (!solid(i - 1, k)) add_quad(mesh_, e, a, d, h);
    if (!solid(i + 1, k)) add_quad(mesh_, b, f, g, c);
    if (!solid(i, k - 1)) add_quad(mesh_, e, f, b, a);
    if (!solid(i, k + 1)) add_quad(mesh_, d, c, g, h);
  }

  std::vector<double> x_, z_;
  double thickness_;
  std::span<const WallOpening> openings_;
  Mesh mesh_;
  std::map<std::tuple<int, int, bool>, uint32_t> index_;
};

Result<void> check_opening(const WallOpening& o, size_t number, double length, double height) {
  if (auto ok = check_lengths({{"an opening's width", o.width}, {"an opening's height", o.height}});
      !ok) {
    return problem(fmt::format("opening {}: {}", number, ok.problem().what));
  }
  // 0.1 + 0.2 > 0.3: an opening that exceeds the end by rounding alone ends there.
  const double slack = 1e-12;
  const bool inside = o.x >= 0 && o.z >= 0 && o.x + o.width <= length * (1 + slack) &&
                      o.z + o.height <= height * (1 + slack);
  if (inside) return {};
  return problem(
      fmt::format("opening {} (x {:g} to {:g} m, z {:g} to {:g} m) reaches outside the wall of "
                  "{:g} m by {:g} m",
                  number, o.x, o.x + o.width, o.z, o.z + o.height, length, height));
}

Mesh stair_sheet(int steps, double rise, double going, double width) {
  Mesh mesh;
  const auto line = [&](double x, double z) {
    mesh.positions.insert(mesh.positions.end(), {{x, 0, z}, {x, width, z}});
  };
  line(0, 0);
  for (int i = 0; i < steps; ++i) {
    line(i * going, (i + 1) * rise);
    line((i + 1) * going, (i + 1) * rise);
  }
  for (uint32_t k = 0; k + 2 < mesh.positions.size(); k += 2)
    add_quad(mesh, k, k + 2, k + 3, k + 1);
  return mesh;
}

}  // namespace

Result<Shape> polygon(std::span<const glm::dvec2> outline) {
  Result<std::vector<glm::dvec2>> checked = checked_outline(outline);
  if (!checked) return checked.problem();
  Result<std::vector<glm::uvec3>> flat = triangulate(checked.value());
  if (!flat) return flat.problem();
  Shape shape;
  for (const glm::dvec2& p : checked.value()) shape.mesh.positions.push_back({p.x, p.y, 0});
  shape.mesh.triangles = std::move(flat.value());
  return shape;
}

Result<Shape> extrude(std::span<const glm::dvec2> outline, double height) {
  if (auto ok = check_lengths({{"the height", height}}); !ok) return ok.problem();
  Result<std::vector<glm::dvec2>> checked = checked_outline(outline);
  if (!checked) return checked.problem();
  Result<Mesh> body = prism(checked.value(), height);
  if (!body) return body.problem();
  return Shape{std::move(body.value()), 0};
}

Result<Shape> wall(double length, double height, double thickness,
                   std::span<const WallOpening> openings) {
  if (auto ok = check_lengths(
          {{"the wall's length", length}, {"its height", height}, {"its thickness", thickness}});
      !ok)
    return ok.problem();
  if (openings.size() > limits::wall_openings) {
    return problem(fmt::format("a wall may have {} openings, this has {}: make it of several walls",
                               limits::wall_openings, openings.size()));
  }
  for (size_t i = 0; i < openings.size(); ++i) {
    if (auto ok = check_opening(openings[i], i + 1, length, height); !ok) return ok.problem();
  }
  Mesh mesh = WallGrid(length, height, thickness, openings).build();
  if (mesh.triangles.empty())
    return problem("the openings leave nothing of the wall: leave it out");
  return Shape{std::move(mesh), 0};
}

Result<Shape> stairs(int steps, double rise, double going, double width, StairUnderside underside) {
  if (auto ok =
          check_lengths({{"the rise of a step", rise}, {"its going", going}, {"the width", width}});
      !ok)
    return ok.problem();
  if (auto ok = check_count("the number of steps", steps, 1, limits::stair_steps); !ok)
    return ok.problem();
  if (underside == StairUnderside::none) return Shape{stair_sheet(steps, rise, going, width), 0};
  std::vector<glm::dvec2> profile = {{0, 0}};
  for (int i = 0; i < steps; ++i) {
    profile.push_back({i * going, (i + 1) * rise});
    profile.push_back({(i + 1) * going, (i + 1) * rise});
  }
  if (underside == StairUnderside::solid) {
    profile.push_back({steps * going, 0});
  } else {
    profile.push_back({steps * going, (steps - 1) * rise});
    if (steps > 1) profile.push_back({going, 0});
  }
  return extrude_profile(profile, width);
}

Result<Shape> ramp(double length, double width, double rise, RampUnderside underside) {
  if (auto ok =
          check_lengths({{"the ramp's length", length}, {"its width", width}, {"its rise", rise}});
      !ok)
    return ok.problem();
  if (underside == RampUnderside::none) return quad({0, 0, 0}, {length, 0, rise}, {0, width, 0});
  const std::vector<glm::dvec2> profile = {{0, 0}, {length, 0}, {length, rise}};
  return extrude_profile(profile, width);
}

}  // namespace luxodus::shapes
