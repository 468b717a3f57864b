#include "scenes/light/geometry/mesh_tools.hpp"

#include <catch2/catch.hpp>

#include "scenes/light/geometry/primitives.hpp"
#include "scenes/light/geometry/transform.hpp"

using namespace luxodus;

TEST_CASE("degenerate triangles are dropped and counted, slivers stay", "[geometry][mesh]") {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, 0}, {0.5, 1e-9, 0}, {1, 0, 0}};
  mesh.triangles = {
      {0, 1, 2},  // stays
      {0, 0, 2},  // repeats an index
      {0, 1, 3},  // three collinear points
      {0, 1, 4},  // a sliver of 1 nm: thin, but valid
      {0, 1, 5},  // repeats a position
      {2, 1, 0},  // stays
  };
  CHECK(clean_mesh(mesh) == 3);
  const std::vector<glm::uvec3> left = {{0, 1, 2}, {0, 1, 4}, {2, 1, 0}};
  CHECK(mesh.triangles == left);
  CHECK(clean_mesh(mesh) == 0);
}

TEST_CASE("flatness is judged by shape, not by size or place", "[geometry][mesh]") {
  for (const double scale : {1e-160, 1e-3, 1.0, 1e7, 1e160}) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {scale, 0, 0}, {0, scale, 0}, {2 * scale, 0, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}};
    CHECK(clean_mesh(mesh) == 1);
  }
  // Collinear but not along an axis, so that products round.
  Mesh slanted;
  slanted.positions = {
      {0.1, 0.2, 0.3}, {0.1 + 1.1, 0.2 + 0.7, 0.3 + 0.13}, {0.1 + 2.2, 0.2 + 1.4, 0.3 + 0.26}};
  slanted.triangles = {{0, 1, 2}};
  CHECK(clean_mesh(slanted) == 1);
}

TEST_CASE("equal vertices become one and triangles stay where they are", "[geometry][mesh]") {
  Mesh mesh = shapes::box({1, 2, 3}).value().mesh;
  mesh.texture_uv.clear();
  const double volume = signed_volume_of(mesh);
  join_identical_vertices(mesh);
  CHECK(mesh.positions.size() == 8);
  CHECK(mesh.triangles.size() == 12);
  CHECK(signed_volume_of(mesh) == Approx(volume));
}

TEST_CASE("vertices with different texture coordinates stay apart", "[geometry][mesh]") {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  mesh.texture_uv = {{0, 0}, {1, 0}, {0, 0}};
  mesh.triangles = {{0, 1, 2}};
  join_identical_vertices(mesh);
  CHECK(mesh.positions.size() == 2);
  CHECK(mesh.texture_uv.size() == 2);
  CHECK(mesh.triangles[0] == glm::uvec3(0, 1, 0));
}

TEST_CASE("joined meshes keep both areas, and one uv per position", "[geometry][mesh]") {
  const Mesh with = shapes::quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}).value().mesh;
  Mesh without = with;
  without.texture_uv.clear();
  for (const auto& [first, second] : {std::pair{with, without}, {without, with}, {with, with}}) {
    Mesh sum = first;
    append(sum, second);
    CHECK(area_of(sum) == Approx(2));
    CHECK(sum.texture_uv.size() == sum.positions.size());
  }
  Mesh plain = without;
  append(plain, without);
  CHECK(plain.texture_uv.empty());
  Mesh empty;
  append(empty, with);
  CHECK(empty.texture_uv == with.texture_uv);
}

TEST_CASE("volume keeps its digits far from the origin", "[geometry][mesh]") {
  Mesh mesh = shapes::box({1, 1, 1}).value().mesh;
  apply(translation({1e6, -2e6, 5e5}), mesh);
  CHECK(signed_volume_of(mesh) == Approx(1).epsilon(1e-9));
  flip(mesh);
  CHECK(signed_volume_of(mesh) == Approx(-1).epsilon(1e-9));
}
