#include "scenes/light/geometry/primitives.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "tests/unit/scenes/light/geometry/mesh_checks.hpp"

using namespace luxodus;
using namespace luxodus::test;
using std::numbers::pi;

namespace {

/// Distance of p, outside a convex body, from its nearest triangle by dense sampling: a tight upper
/// bound.
double distance_to(const Mesh& mesh, const glm::dvec3& p) {
  double best = 1e300;
  const int n = 24;
  for (const glm::uvec3& t : mesh.triangles) {
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        const double u = i / double(n), v = j / double(n);
        const glm::dvec3 q =
            (1 - u - v) * mesh.positions[t.x] + u * mesh.positions[t.y] + v * mesh.positions[t.z];
        best = std::min(best, glm::length(p - q));
      }
    }
  }
  return best;
}

}  // namespace

TEST_CASE("a quad spans its edges, faces their cross product, and splits without a change of area",
          "[geometry][primitives]") {
  for (const auto& [nu, nv] : {std::pair{1, 1}, {3, 1}, {4, 5}}) {
    const Shape shape = shapes::quad({1, 2, 3}, {2, 0, 0}, {0, 0, 3}, nu, nv).value();
    CHECK(shape.mesh.triangles.size() == static_cast<size_t>(2 * nu * nv));
    CHECK(area_of(shape.mesh) == Approx(6));
    CHECK(all_face(shape.mesh, {0, -1, 0}));
    CHECK(shape.discretisation_bound_m == 0);
    const Bounds bounds = bounds_of(shape.mesh);
    CHECK(bounds.low == glm::dvec3(1, 2, 3));
    CHECK(bounds.high == glm::dvec3(3, 2, 6));
  }
}

TEST_CASE("a quad's texture runs from its corner along u and v", "[geometry][primitives]") {
  const Mesh mesh = shapes::quad({0, 0, 0}, {2, 0, 0}, {0, 4, 0}, 2, 2).value().mesh;
  REQUIRE(mesh.texture_uv.size() == mesh.positions.size());
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    CHECK(mesh.texture_uv[i].x == Approx(mesh.positions[i].x / 2));
    CHECK(mesh.texture_uv[i].y == Approx(mesh.positions[i].y / 4));
  }
}

TEST_CASE("a box is closed, looks outward, and has its volume", "[geometry][primitives]") {
  // Sizes whose halves and sums round: closed means equal bits, not nearly equal positions.
  const glm::dvec3 size(0.1, 0.7, 12.3);
  for (const auto at : {shapes::BoxAt::centre, shapes::BoxAt::corner}) {
    const Mesh mesh = shapes::box(size, at).value().mesh;
    CHECK(mesh.triangles.size() == 12);
    CHECK(is_closed(mesh));
    CHECK(signed_volume_of(mesh) == Approx(size.x * size.y * size.z));
    CHECK(area_of(mesh) == Approx(2 * (0.1 * 0.7 + 0.7 * 12.3 + 0.1 * 12.3)));
  }
  CHECK(bounds_of(shapes::box(size, shapes::BoxAt::corner).value().mesh).low == glm::dvec3(0));
  CHECK(bounds_of(shapes::box(size).value().mesh).high == 0.5 * size);
}

TEST_CASE("a picture stands upright on the sides of a box", "[geometry][primitives]") {
  const Mesh mesh = shapes::box({1, 1, 1}, shapes::BoxAt::corner).value().mesh;
  for (size_t i = 0; i < 16; ++i) {
    CHECK(static_cast<double>(mesh.texture_uv[i].y) == mesh.positions[i].z);
  }
  // Looking along +y at the front side, +x is to the right.
  for (size_t i = 8; i < 12; ++i) {
    CHECK(mesh.positions[i].y == 0);
    CHECK(static_cast<double>(mesh.texture_uv[i].x) == mesh.positions[i].x);
  }
}

TEST_CASE("a room is closed, looks inward, and gives each face by itself",
          "[geometry][primitives]") {
  const shapes::Room room = shapes::room({4, 3, 2.5}).value();
  CHECK(is_closed(room.all()));
  CHECK(signed_volume_of(room.all()) == Approx(-4 * 3 * 2.5));
  CHECK(all_face(room.floor, {0, 0, 1}));
  CHECK(all_face(room.ceiling, {0, 0, -1}));
  CHECK(all_face(room.x0, {1, 0, 0}));
  CHECK(all_face(room.x1, {-1, 0, 0}));
  CHECK(all_face(room.y0, {0, 1, 0}));
  CHECK(all_face(room.y1, {0, -1, 0}));
  CHECK(bounds_of(room.ceiling).low.z == 2.5);
  CHECK(bounds_of(room.x1).low.x == 4);
  CHECK(bounds_of(room.y1).low.y == 3);
  CHECK(area_of(room.floor) == Approx(12));
}

TEST_CASE("a cylinder is closed and deviates from the true one by the sagitta it states",
          "[geometry][primitives]") {
  const double radius = 0.7, height = 2;
  for (const int n : {3, 4, 16, 101}) {
    const Shape shape = shapes::cylinder(radius, height, n).value();
    CHECK(is_closed(shape.mesh));
    const double cap = 0.5 * n * radius * radius * std::sin(2 * pi / n);
    CHECK(signed_volume_of(shape.mesh) == Approx(cap * height));
    CHECK(shape.discretisation_bound_m == Approx(radius * (1 - std::cos(pi / n))));
    CHECK_FALSE(is_closed(shapes::cylinder(radius, height, n, shapes::Caps::none).value().mesh));
  }
}

TEST_CASE("round bodies reach the four quarters exactly where segments divide by four",
          "[geometry][primitives]") {
  const Bounds bounds = bounds_of(shapes::cylinder(0.3, 1, 12).value().mesh);
  CHECK(bounds.low == glm::dvec3(-0.3, -0.3, 0));
  CHECK(bounds.high == glm::dvec3(0.3, 0.3, 1));
}

TEST_CASE("a disc faces up, has a polygon's area, and carries its picture about its centre",
          "[geometry][primitives]") {
  const Shape shape = shapes::disc(2, 64).value();
  CHECK(all_face(shape.mesh, {0, 0, 1}));
  CHECK(area_of(shape.mesh) == Approx(0.5 * 64 * 4 * std::sin(2 * pi / 64)));
  for (size_t i = 0; i < shape.mesh.positions.size(); ++i) {
    CHECK(shape.mesh.texture_uv[i].x == Approx(0.5 + shape.mesh.positions[i].x / 4).margin(1e-7));
  }
}

TEST_CASE("a tube is closed and encloses the metal, not the bore", "[geometry][primitives]") {
  const int n = 32;
  const Shape shape = shapes::tube(0.5, 0.4, 3, n).value();
  CHECK(is_closed(shape.mesh));
  const double ring = 0.5 * n * std::sin(2 * pi / n) * (0.25 - 0.16);
  CHECK(signed_volume_of(shape.mesh) == Approx(ring * 3));
}

TEST_CASE("the segments chosen for a bound satisfy it, and one fewer does not",
          "[geometry][primitives]") {
  for (const double radius : {0.01, 1.0, 250.0}) {
    for (const double ratio : {0.3, 0.01, 1e-4, 1e-6}) {
      const double bound = radius * ratio;
      const int n = shapes::segments_within(radius, bound).value();
      CHECK(shapes::sagitta(radius, n) <= bound * (1 + 1e-9));
      if (n > 3) CHECK(shapes::sagitta(radius, n - 1) > bound);
    }
  }
  CHECK(shapes::segments_within(1, 5).value() == 3);
  CHECK_FALSE(shapes::segments_within(1, 1e-9).ok());
}

TEST_CASE("a sphere is closed, its vertices lie on it, and it keeps within the requested bound",
          "[geometry][primitives]") {
  const double radius = 1.5;
  double last_bound = 10;
  for (const double bound : {0.5, 0.1, 0.02, 0.005}) {
    const Shape shape = shapes::sphere(radius, bound).value();
    CHECK(is_closed(shape.mesh));
    CHECK(shape.discretisation_bound_m <= bound * (1 + 1e-12));
    CHECK(shape.discretisation_bound_m < last_bound);
    last_bound = shape.discretisation_bound_m;
    for (const glm::dvec3& p : shape.mesh.positions) {
      REQUIRE(glm::length(p) == Approx(radius).epsilon(1e-14));
    }
    // A body within distance d inside a sphere has at least the volume of the sphere of radius r -
    // d.
    const double inner = radius - shape.discretisation_bound_m;
    CHECK(signed_volume_of(shape.mesh) > 4.0 / 3 * pi * inner * inner * inner);
    CHECK(signed_volume_of(shape.mesh) < 4.0 / 3 * pi * radius * radius * radius);
  }
}

TEST_CASE(
    "a sphere's stated bound is the distance of its farthest point, not less and not much more",
    "[geometry][primitives]") {
  const Shape shape = shapes::sphere(1, 0.05).value();
  double worst = 0;
  for (size_t i = 0; i < shape.mesh.triangles.size(); ++i) {
    // The point of the sphere above a triangle's middle is the farthest from that triangle.
    const double d = distance_to(shape.mesh, normal_of(shape.mesh, i));
    worst = std::max(worst, d);
  }
  CHECK(worst <= shape.discretisation_bound_m + 2e-3);  // distance_to is slightly too large
  CHECK(worst >= 0.95 * shape.discretisation_bound_m);
}

TEST_CASE("measures that make no body are refused by name", "[geometry][primitives]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const auto says = [](const auto& result, const char* word) {
    return !result.ok() && result.problem().what.find(word) != std::string::npos;
  };
  for (const double bad : {0.0, -1.0, nan, inf, 1e9}) {
    CHECK(says(shapes::box({1, bad, 1}), "size in y"));
    CHECK(says(shapes::room({1, 1, bad}), "size in z"));
    CHECK(says(shapes::cylinder(bad, 1, 8), "radius"));
    CHECK(says(shapes::cylinder(1, bad, 8), "height"));
    CHECK(says(shapes::disc(bad, 8), "radius"));
    CHECK(says(shapes::sphere(bad, 0.1), "radius"));
    CHECK(says(shapes::sphere(1, bad), "distance"));
    CHECK(says(shapes::tube(1, 0.5, bad, 8), "length"));
  }
  CHECK(says(shapes::tube(0.5, 0.5, 1, 8), "inner radius"));
  CHECK(says(shapes::cylinder(1, 1, 2), "segments"));
  CHECK(says(shapes::disc(1, 1'000'000), "segments"));
  CHECK(says(shapes::sphere(1, 1e-9), "too many triangles"));
  CHECK(says(shapes::quad({nan, 0, 0}, {1, 0, 0}, {0, 1, 0}), "corner"));
  CHECK(says(shapes::quad({0, 0, 0}, {1, 0, 0}, {-2, 0, 0}), "parallel"));
  CHECK(says(shapes::quad({0, 0, 0}, {1, 0, 0}, {0, 0, 0}), "no area"));
  CHECK(says(shapes::quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0, 1), "along u"));
}
