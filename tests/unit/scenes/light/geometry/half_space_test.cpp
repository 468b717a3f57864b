// Cuts of closed meshes by planes, and whether meshes are closed, against volumes of solids.
#include "scenes/light/geometry/half_space.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/core/random.hpp"
#include "scenes/light/geometry/closed_mesh.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"
#include "scenes/light/geometry/primitives.hpp"
#include "scenes/light/geometry/transform.hpp"

using namespace luxodus;

namespace {

/// A box from the origin whose corners are shared by its faces.
Mesh box_of(const glm::dvec3& size) {
  auto shape = shapes::box(size);
  REQUIRE(shape.ok());
  Mesh mesh = std::move(shape).value().mesh;
  for (glm::dvec3& p : mesh.positions) p += size / 2.0;
  mesh.texture_uv.clear();
  join_identical_vertices(mesh);
  return mesh;
}

HalfSpace below(const glm::dvec3& at, const glm::dvec3& normal) {
  const glm::dvec3 n = glm::normalize(normal);
  return {n, glm::dot(n, at)};
}

/// Volume of what a cut leaves, which must be closed.
double left_m3(const Mesh& mesh, const HalfSpace& keep) {
  const auto part = cut(mesh, keep, 1e-6);
  REQUIRE(part);
  CHECK(open_edges(*part).closed());
  return signed_volume_of(*part);
}

}  // namespace

TEST_CASE("a plane along an edge of a body leaves a closed body", "[half-space]") {
  const Mesh wall = box_of({4, 0.2, 3});
  // From the top edge on one side down to the bottom edge on the other: half of it.
  CHECK(left_m3(wall, below({0, 0, 3}, {3, 0, 4})) == Approx(4 * 0.2 * 3 / 2.0));
  // A mitre through a vertical edge takes a triangle of 0.2 m x 0.2 m.
  CHECK(left_m3(wall, below({4, 0, 0}, {1, 1, 0})) == Approx((4 * 0.2 - 0.02) * 3));
  // Through three corners: a sixth.
  CHECK(left_m3(box_of({1, 1, 1}), below({1, 0, 1}, {1, 1, 1})) == Approx(1 - 1 / 6.0));
}

TEST_CASE("a plane along a face takes nothing or all", "[half-space]") {
  const Mesh wall = box_of({4, 0.2, 3});
  CHECK(left_m3(wall, below({0, 0, 3}, {0, 0, 1})) == Approx(2.4));
  const auto none = cut(wall, below({0, 0, 0}, {0, 0, 1}), 1e-6);
  REQUIRE(none);
  CHECK(none->triangles.empty());
}

TEST_CASE("cuts of a turned body at any place add up to it", "[half-space]") {
  Random random(1, RandomStream::test);
  random.start(0);
  const auto number = [&](double low, double high) {
    return low + (high - low) * random.uniform_double();
  };
  for (int i = 0; i < 300; ++i) {
    Mesh mesh = box_of({2, 1, 3});
    const auto turn = rotation({number(-1, 1), number(-1, 1), 1}, number(0, 360));
    REQUIRE(turn.ok());
    apply(turn.value(), mesh);
    const glm::dvec3 at = turn->point({number(0, 2), number(0, 1), number(0, 3)});
    const HalfSpace first = below(at, {number(-1, 1), number(-1, 1), number(-1, 1)});
    CHECK(left_m3(mesh, first) + left_m3(mesh, first.complement()) == Approx(6));
    // A second cut goes through the face of the first.
    const auto part = cut(mesh, first, 1e-6);
    REQUIRE(part);
    if (part->triangles.empty()) continue;
    const HalfSpace second = below(at, {number(-1, 1), 1, number(-1, 1)});
    CHECK(left_m3(*part, second) + left_m3(*part, second.complement()) ==
          Approx(signed_volume_of(*part)));
  }
}

TEST_CASE("a face with holes is filled around them", "[half-space]") {
  const std::vector<std::vector<glm::dvec2>> rings{{{0, 0}, {10, 0}, {10, 10}, {0, 10}},
                                                   {{2, 2}, {2, 4}, {4, 4}, {4, 2}},
                                                   {{6, 6}, {6, 8}, {8, 8}, {8, 6}},
                                                   {{6, 2}, {6, 4}, {8, 4}, {8, 2}}};
  std::vector<glm::dvec2> points;
  for (const auto& ring : rings) points.insert(points.end(), ring.begin(), ring.end());
  const auto triangles = fill(rings);
  REQUIRE(triangles);
  double area = 0;
  for (const glm::uvec3& t : *triangles) {
    const glm::dvec2 a = points[t.x], b = points[t.y], c = points[t.z];
    const double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    CHECK(twice > 0);
    area += twice / 2;
  }
  CHECK(area == Approx(100 - 12));
  CHECK_FALSE(fill(std::vector<std::vector<glm::dvec2>>{{{0, 0}, {1, 0}}}));
}

TEST_CASE("a missing face is found, with its area", "[closed-mesh]") {
  Mesh mesh = box_of({4, 0.2, 3});
  CHECK(open_edges(mesh).closed());
  Mesh open = mesh;
  std::erase_if(open.triangles, [&](const glm::uvec3& t) {
    return mesh.positions[t.x].z == 3 && mesh.positions[t.y].z == 3 && mesh.positions[t.z].z == 3;
  });
  REQUIRE(open.triangles.size() == 10);
  const OpenEdges found = open_edges(open);
  CHECK(found.edges == 4);
  CHECK(found.area_m2 == Approx(4 * 0.2));
  // Reversed triangles are no holes.
  std::swap(mesh.triangles[3].x, mesh.triangles[3].y);
  CHECK(open_edges(mesh).closed());
}

TEST_CASE("an edge along which two others lie is closed", "[closed-mesh]") {
  // A tetrahedron, of which one face is cut in two at the middle of an edge.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0, 0}};
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {0, 3, 2}, {0, 4, 3}, {4, 1, 3}};
  CHECK(open_edges(mesh).closed());
  mesh.triangles.pop_back();
  CHECK_FALSE(open_edges(mesh).closed());
}
