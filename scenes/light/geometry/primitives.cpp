#include "scenes/light/geometry/primitives.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>

#include "scenes/light/geometry/mesh_tools.hpp"
#include "scenes/light/geometry/shape_checks.hpp"

namespace luxodus::shapes {
namespace {

/// Points of a circle in the plane z; exact at the four quarters where `segments` divides by four,
/// so that round bodies touch walls without a gap.
std::vector<glm::dvec3> circle(double radius, double z, int segments) {
  std::vector<glm::dvec3> points;
  points.reserve(static_cast<size_t>(segments));
  for (int k = 0; k < segments; ++k) {
    const double angle = 2 * std::numbers::pi * k / segments;
    glm::dvec3 p(radius * std::cos(angle), radius * std::sin(angle), z);
    if (4 * k == segments || 4 * k == 3 * segments) p.x = 0;
    if (k == 0 || 2 * k == segments) p.y = 0;
    points.push_back(p);
  }
  return points;
}

uint32_t add_points(Mesh& mesh, const std::vector<glm::dvec3>& points) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), points.begin(), points.end());
  return first;
}

/// The band between two rings of n points. The front is to the right of the direction from `low` to
/// `high`: outward for rings that run counter-clockwise about it.
void add_band(Mesh& mesh, uint32_t low, uint32_t high, uint32_t n) {
  for (uint32_t k = 0; k < n; ++k) {
    const uint32_t next = (k + 1) % n;
    add_quad(mesh, low + k, low + next, high + next, high + k);
  }
}

/// A fan from a centre over a ring that runs counter-clockwise seen from the front.
void add_fan(Mesh& mesh, const glm::dvec3& centre, uint32_t ring, uint32_t n, bool front_is_up) {
  const uint32_t middle = add_points(mesh, {centre});
  for (uint32_t k = 0; k < n; ++k) {
    const uint32_t a = ring + k, b = ring + (k + 1) % n;
    mesh.triangles.push_back(front_is_up ? glm::uvec3(middle, a, b) : glm::uvec3(middle, b, a));
  }
}

// ---- the sphere --------------------------------------------------------------------------------

struct Icosahedron {
  std::array<glm::dvec3, 12> corners;
  std::array<glm::uvec3, 20> faces;
};

/// Corners are the cyclic permutations of (0, +-1, +-golden ratio), on the unit sphere. Faces are
/// all triples of neighbours, turned outward: computed instead of listed, so that no row can be
/// mistyped.
Icosahedron icosahedron() {
  Icosahedron out;
  size_t at = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double one : {-1.0, 1.0}) {
      for (const double golden : {-std::numbers::phi, std::numbers::phi}) {
        glm::dvec3 p(0);
        p[(axis + 1) % 3] = one;
        p[(axis + 2) % 3] = golden;
        out.corners[at++] = glm::normalize(p);
      }
    }
  }
  const auto neighbours = [&](size_t a, size_t b) {
    return glm::dot(out.corners[a], out.corners[b]) >
           0.4;  // 1/sqrt(5) for neighbours, else negative
  };
  size_t face = 0;
  for (size_t a = 0; a < 12; ++a) {
    for (size_t b = a + 1; b < 12; ++b) {
      for (size_t c = b + 1; c < 12; ++c) {
        if (!neighbours(a, b) || !neighbours(b, c) || !neighbours(a, c)) continue;
        const glm::dvec3 normal =
            glm::cross(out.corners[b] - out.corners[a], out.corners[c] - out.corners[a]);
        const bool outward = glm::dot(normal, out.corners[a]) > 0;
        out.faces[face++] = outward ? glm::uvec3(a, b, c) : glm::uvec3(a, c, b);
      }
    }
  }
  return out;
}

/// Vertices of the split faces, shared across face edges: a point is identified by the corners it
/// lies between and its integer weights, so both faces of an edge find the same vertex with the
/// same bits.
class SphereVertices {
 public:
  SphereVertices(const Icosahedron& body, double radius) : body_(body), radius_(radius) {}

  uint32_t at(const glm::uvec3& face, int wa, int wb, int wc, Mesh& mesh) {
    Key key = {{{face.x, wa}, {face.y, wb}, {face.z, wc}}};
    for (auto& [corner, weight] : key) {
      if (weight == 0) corner = 12;  // unused corner: one value whatever the face
    }
    std::sort(key.begin(), key.end());
    const auto [place, is_new] =
        index_.try_emplace(key, static_cast<uint32_t>(mesh.positions.size()));
    if (is_new) {
      glm::dvec3 sum(0);
      for (const auto& [corner, weight] : key) {
        if (weight > 0) sum += static_cast<double>(weight) * body_.corners[corner];
      }
      mesh.positions.push_back(radius_ * glm::normalize(sum));
    }
    return place->second;
  }

 private:
  using Key = std::array<std::pair<uint32_t, int>, 3>;
  const Icosahedron& body_;
  double radius_;
  std::map<Key, uint32_t> index_;
};

Mesh split_sphere(double radius, int frequency) {
  Mesh mesh;
  const Icosahedron body = icosahedron();
  SphereVertices vertices(body, radius);
  const int n = frequency;
  for (const glm::uvec3& face : body.faces) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        const uint32_t a = vertices.at(face, n - i - j, i, j, mesh);
        const uint32_t b = vertices.at(face, n - i - j - 1, i + 1, j, mesh);
        const uint32_t c = vertices.at(face, n - i - j - 1, i, j + 1, mesh);
        mesh.triangles.push_back({a, b, c});
        if (i + j + 1 == n) continue;
        const uint32_t d = vertices.at(face, n - i - j - 2, i + 1, j + 1, mesh);
        mesh.triangles.push_back({b, d, c});
      }
    }
  }
  return mesh;
}

/// Largest distance of the unit sphere from the split body. It is largest above the largest
/// triangle, which holds a face's centre or lies next to it. The distance to the triangle's plane
/// bounds the distance to the triangle.
double unit_sphere_bound(int frequency) {
  const Icosahedron body = icosahedron();
  const glm::uvec3 face = body.faces[0];
  const auto at = [&](int wa, int wb, int wc) {
    return glm::normalize(static_cast<double>(wa) * body.corners[face.x] +
                          static_cast<double>(wb) * body.corners[face.y] +
                          static_cast<double>(wc) * body.corners[face.z]);
  };
  const int n = frequency;
  double bound = 0;
  const auto consider = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
    bound = std::max(bound, 1 - std::abs(glm::dot(normal, a)));
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      const glm::dvec3 b = at(n - i - j - 1, i + 1, j), c = at(n - i - j - 1, i, j + 1);
      consider(at(n - i - j, i, j), b, c);
      if (i + j + 1 < n) consider(b, at(n - i - j - 2, i + 1, j + 1), c);
    }
  }
  return bound;
}

/// Rounding of positions and of the bound itself, so that the bound holds in the last digit too.
constexpr double bound_slack = 4e-16;

}  // namespace

Mesh Room::all() const {
  Mesh mesh;
  for (const Mesh* part : {&floor, &ceiling, &x0, &x1, &y0, &y1}) append(mesh, *part);
  return mesh;
}

Result<Shape> quad(const glm::dvec3& corner, const glm::dvec3& edge_u, const glm::dvec3& edge_v,
                   int nu, int nv) {
  for (const auto& [name, v] :
       {std::pair{"corner", corner}, {"edge_u", edge_u}, {"edge_v", edge_v}}) {
    if (finite_within_limit(v)) continue;
    return problem(
        fmt::format("{} of a quad is not finite or beyond {:g} m", name, limits::shape_length_m));
  }
  if (auto ok = check_count("the number of splits along u", nu, 1, limits::quad_splits); !ok)
    return ok.problem();
  if (auto ok = check_count("the number of splits along v", nv, 1, limits::quad_splits); !ok)
    return ok.problem();
  const double lengths = glm::length(edge_u) * glm::length(edge_v);
  if (!(glm::length(glm::cross(edge_u, edge_v)) > 1e-12 * lengths)) {
    return problem("the edges of a quad are parallel or have no length: it has no area");
  }
  Shape shape;
  Mesh& mesh = shape.mesh;
  for (int j = 0; j <= nv; ++j) {
    for (int i = 0; i <= nu; ++i) {
      const double u = static_cast<double>(i) / nu, v = static_cast<double>(j) / nv;
      mesh.positions.push_back(corner + u * edge_u + v * edge_v);
      mesh.texture_uv.push_back(glm::vec2(u, v));
    }
  }
  const auto row = static_cast<uint32_t>(nu + 1);
  for (uint32_t j = 0; j < static_cast<uint32_t>(nv); ++j) {
    for (uint32_t i = 0; i < static_cast<uint32_t>(nu); ++i) {
      const uint32_t a = j * row + i;
      add_quad(mesh, a, a + 1, a + row + 1, a + row);
    }
  }
  return shape;
}

Result<Shape> box(const glm::dvec3& size, BoxAt at) {
  if (auto ok = check_lengths({{"the box's size in x", size.x},
                               {"the box's size in y", size.y},
                               {"the box's size in z", size.z}});
      !ok)
    return ok.problem();
  const glm::dvec3 low = at == BoxAt::centre ? -0.5 * size : glm::dvec3(0);
  const glm::dvec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
  Shape shape;
  add_picture_quad(shape.mesh, low + y, -y, z);      // x low
  add_picture_quad(shape.mesh, low + x, y, z);       // x high
  add_picture_quad(shape.mesh, low, x, z);           // y low
  add_picture_quad(shape.mesh, low + x + y, -x, z);  // y high
  add_picture_quad(shape.mesh, low + x, -x, y);      // z low
  add_picture_quad(shape.mesh, low + z, x, y);       // z high
  // Corners are sums in different orders; only equal bits make a closed body.
  for (glm::dvec3& p : shape.mesh.positions) {
    for (int i = 0; i < 3; ++i) p[i] = p[i] > low[i] + 0.5 * size[i] ? low[i] + size[i] : low[i];
  }
  return shape;
}

Result<Room> room(const glm::dvec3& size) {
  Result<Shape> outside = box(size, BoxAt::corner);
  if (!outside) return outside.problem();
  Room out;
  Mesh* const faces[] = {&out.x0, &out.x1, &out.y0, &out.y1, &out.floor, &out.ceiling};
  const Mesh& from = outside->mesh;
  for (size_t f = 0; f < 6; ++f) {
    Mesh& face = *faces[f];
    // Outside corners in the order b a d c: reversed, so that a picture reads correctly from
    // inside.
    for (const size_t k : {1u, 0u, 3u, 2u}) face.positions.push_back(from.positions[4 * f + k]);
    face.texture_uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    add_quad(face, 0, 1, 2, 3);
  }
  return out;
}

double sagitta(double radius, int segments) {
  // r (1 - cos(pi / n)), written without the cancellation.
  const double s = std::sin(0.5 * std::numbers::pi / segments);
  return 2 * radius * s * s;
}

Result<int> segments_within(double radius, double mesh_tolerance_m) {
  if (auto ok = check_lengths({{"the radius", radius}, {"the allowed distance", mesh_tolerance_m}});
      !ok)
    return ok.problem();
  const double half_angle =
      2 * std::asin(std::sqrt(std::min(1.0, mesh_tolerance_m / (2 * radius))));
  const double wanted = std::ceil(std::numbers::pi / half_angle * (1 - 1e-12));
  if (wanted > limits::shape_segments) {
    return problem(
        fmt::format("a circle of radius {:g} m within {:g} m needs {:.0f} segments, the most "
                    "are {}: allow a larger distance",
                    radius, mesh_tolerance_m, wanted, limits::shape_segments));
  }
  return std::max(3, static_cast<int>(wanted));
}

Result<Shape> cylinder(double radius, double height, int segments, Caps caps) {
  if (auto ok = check_lengths({{"the cylinder's radius", radius}, {"its height", height}}); !ok)
    return ok.problem();
  if (auto ok = check_count("the number of segments", segments, 3, limits::shape_segments); !ok)
    return ok.problem();
  const auto n = static_cast<uint32_t>(segments);
  Shape shape{{}, sagitta(radius, segments)};
  const uint32_t low = add_points(shape.mesh, circle(radius, 0, segments));
  const uint32_t high = add_points(shape.mesh, circle(radius, height, segments));
  add_band(shape.mesh, low, high, n);
  if (caps == Caps::both) {
    add_fan(shape.mesh, {0, 0, 0}, low, n, false);
    add_fan(shape.mesh, {0, 0, height}, high, n, true);
  }
  return shape;
}

Result<Shape> disc(double radius, int segments) {
  if (auto ok = check_lengths({{"the disc's radius", radius}}); !ok) return ok.problem();
  if (auto ok = check_count("the number of segments", segments, 3, limits::shape_segments); !ok)
    return ok.problem();
  Shape shape{{}, sagitta(radius, segments)};
  const uint32_t ring = add_points(shape.mesh, circle(radius, 0, segments));
  add_fan(shape.mesh, {0, 0, 0}, ring, static_cast<uint32_t>(segments), true);
  for (const glm::dvec3& p : shape.mesh.positions) {
    shape.mesh.texture_uv.push_back(glm::vec2(0.5 + 0.5 * p.x / radius, 0.5 + 0.5 * p.y / radius));
  }
  return shape;
}

Result<Shape> tube(double outer_radius, double inner_radius, double length, int segments) {
  if (auto ok = check_lengths({{"the tube's outer radius", outer_radius},
                               {"its inner radius", inner_radius},
                               {"its length", length}});
      !ok)
    return ok.problem();
  if (auto ok = check_count("the number of segments", segments, 3, limits::shape_segments); !ok)
    return ok.problem();
  if (inner_radius >= outer_radius) {
    return problem(
        fmt::format("the tube's inner radius {:g} m is not below its outer radius {:g} m",
                    inner_radius, outer_radius));
  }
  const auto n = static_cast<uint32_t>(segments);
  Shape shape{{}, sagitta(outer_radius, segments)};
  Mesh& mesh = shape.mesh;
  const uint32_t outer_low = add_points(mesh, circle(outer_radius, 0, segments));
  const uint32_t outer_high = add_points(mesh, circle(outer_radius, length, segments));
  const uint32_t inner_low = add_points(mesh, circle(inner_radius, 0, segments));
  const uint32_t inner_high = add_points(mesh, circle(inner_radius, length, segments));
  add_band(mesh, outer_low, outer_high, n);
  add_band(mesh, outer_high, inner_high, n);
  add_band(mesh, inner_high, inner_low, n);
  add_band(mesh, inner_low, outer_low, n);
  return shape;
}

Result<Shape> sphere(double radius, double mesh_tolerance_m) {
  if (auto ok = check_lengths(
          {{"the sphere's radius", radius}, {"the allowed distance", mesh_tolerance_m}});
      !ok)
    return ok.problem();
  // The bound falls with every step of the frequency (about as its square), so bisection finds the
  // least.
  int low = 1, high = limits::sphere_frequency;
  const double wanted = mesh_tolerance_m / radius;
  if (unit_sphere_bound(high) > wanted) {
    return problem(
        fmt::format("a sphere of radius {:g} m within {:g} m needs too many triangles: allow "
                    "{:g} m or more",
                    radius, mesh_tolerance_m, radius * unit_sphere_bound(high)));
  }
  while (low < high) {
    const int middle = (low + high) / 2;
    if (unit_sphere_bound(middle) <= wanted) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return Shape{split_sphere(radius, low), radius * (unit_sphere_bound(low) + bound_slack)};
}

}  // namespace luxodus::shapes
