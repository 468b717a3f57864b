#include "scenes/light/geometry/building_parts.hpp"

#include <catch2/catch.hpp>
#include <numeric>

#include "scenes/light/geometry/polygon.hpp"
#include "tests/unit/scenes/light/geometry/mesh_checks.hpp"

using namespace luxodus;
using namespace luxodus::test;
using Outline = std::vector<glm::dvec2>;

namespace {

const Outline l_shape = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}};
// Outlines with points on straight edges and with a concave corner.
const Outline awkward = {{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}, {0, 1}};
const Outline comb = {{0, 0}, {7, 0}, {7, 3}, {6, 3}, {6, 1}, {5, 1}, {5, 3}, {4, 3},
                      {4, 1}, {3, 1}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};

}  // namespace

TEST_CASE("a polygon is cut into triangles that cover it once", "[geometry][polygon]") {
  for (const Outline& outline : {l_shape, awkward, comb}) {
    Outline reversed(outline.rbegin(), outline.rend());
    for (const Outline& given : {outline, reversed}) {
      const Mesh mesh = shapes::polygon(given).value().mesh;
      CHECK(mesh.triangles.size() == given.size() - 2);
      CHECK(all_face(mesh, {0, 0, 1}));  // so equal areas mean no overlap
      CHECK(area_of(mesh) == Approx(std::abs(signed_area(given))));
    }
  }
  CHECK(signed_area(l_shape) == Approx(6));
}

TEST_CASE("outlines that are not simple are refused with the point or edge",
          "[geometry][polygon]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Row {
    Outline outline;
    const char* says;
  };
  const Row rows[] = {
      {{{0, 0}, {1, 0}}, "3 points"},
      {{{0, 0}, {1, 0}, {1, 0}, {0, 1}}, "points 2 and 3"},
      {{{0, 0}, {1, 0}, {0, 1}, {0, 0}}, "points 4 and 1"},
      {{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, "edges 1 and 3"},          // crossing
      {{{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}}, "edges 1 and 3"},  // touching
      {{{0, 0}, {2, 0}, {1, 0}, {1, 1}}, "point 2"},                // a spike
      {{{0, 0}, {nan, 0}, {1, 1}}, "point 2"},
      {{{0, 0}, {1, 0}, {2, 0}}, "turns back"},
      {Outline(3000, glm::dvec2(0)), "2048"},
  };
  for (const Row& row : rows) {
    const auto result = shapes::polygon(row.outline);
    REQUIRE_FALSE(result.ok());
    INFO(result.problem().what);
    CHECK(result.problem().what.find(row.says) != std::string::npos);
  }
}

TEST_CASE("an extruded outline is closed, looks outward, and has its volume", "[geometry][parts]") {
  for (const Outline& outline : {l_shape, awkward, comb}) {
    const Mesh mesh = shapes::extrude(outline, 2.7).value().mesh;
    CHECK(is_closed(mesh));
    CHECK(signed_volume_of(mesh) == Approx(2.7 * std::abs(signed_area(outline))));
  }
}

TEST_CASE("a wall with a door and windows is a closed solid less its openings",
          "[geometry][parts]") {
  using Openings = std::vector<shapes::WallOpening>;
  const double length = 6, height = 2.8, thickness = 0.15;
  struct Row {
    Openings openings;
    double open_area;
  };
  const Row rows[] = {
      {{}, 0},
      {{{1, 0, 0.9, 2.1}}, 0.9 * 2.1},
      {{{1, 0, 0.9, 2.1}, {3, 0.9, 1.2, 1.1}}, 0.9 * 2.1 + 1.2 * 1.1},
      {{{0, 0, 1, 2}}, 2},                                         // at the end of the wall
      {{{2, 0, 1, 2.8}}, 2.8},                                     // full height: two pieces
      {{{1, 1, 1, 1}, {1.5, 1.5, 1, 1}}, 1.75},                    // overlapping: counted once
      {{{1, 0, 0.9, 2.1}, {1.9, 1, 0.5, 1.1}}, 0.9 * 2.1 + 0.55},  // side by side
  };
  for (const Row& row : rows) {
    const Mesh mesh = shapes::wall(length, height, thickness, row.openings).value().mesh;
    CHECK(is_closed(mesh));
    CHECK(signed_volume_of(mesh) == Approx((length * height - row.open_area) * thickness));
    CHECK(bounds_of(mesh).high == glm::dvec3(length, thickness, height));
  }
}

TEST_CASE("an opening is free from front to back", "[geometry][parts]") {
  const shapes::WallOpening door{1, 0, 0.9, 2.1};
  const Mesh mesh = shapes::wall(4, 2.5, 0.2, {{door}}).value().mesh;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 middle =
        (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0;
    const bool in_hole = middle.x > 1 + 1e-9 && middle.x < 1.9 - 1e-9 && middle.z < 2.1 - 1e-9;
    CHECK_FALSE(in_hole);
  }
}

TEST_CASE("openings that do not fit are refused by number", "[geometry][parts]") {
  const auto refused = [](std::vector<shapes::WallOpening> openings, const char* word) {
    const auto result = shapes::wall(4, 2.5, 0.2, openings);
    return !result.ok() && result.problem().what.find(word) != std::string::npos;
  };
  CHECK(refused({{1, 0, 1, 2}, {3.5, 0, 1, 2}}, "opening 2"));
  CHECK(refused({{1, 1, 1, 2}}, "outside"));
  CHECK(refused({{-0.1, 0, 1, 2}}, "outside"));
  CHECK(refused({{std::numeric_limits<double>::quiet_NaN(), 0, 1, 2}}, "outside"));
  CHECK(refused({{1, 0, 0, 2}}, "width"));
  CHECK(refused({{0, 0, 4, 2.5}}, "nothing"));
  CHECK(refused(std::vector<shapes::WallOpening>(65, {1, 1, 0.1, 0.1}), "64"));
  // 0.1 + 0.2 rounds to more than 0.3: the opening counts as ending there, not as outside.
  CHECK(shapes::wall(0.3, 1, 0.1, {{shapes::WallOpening{0.1, 0.2, 0.2, 0.5}}}).ok());
}

TEST_CASE("open stairs are treads that face up and risers that face a person climbing",
          "[geometry][parts]") {
  const int steps = 7;
  const Mesh mesh = shapes::stairs(steps, 0.17, 0.29, 1.2).value().mesh;
  CHECK(mesh.triangles.size() == 4 * steps);
  double treads = 0, risers = 0;
  for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    Mesh one = mesh;
    one.triangles = {mesh.triangles[i]};
    if (all_face(one, {0, 0, 1})) treads += area_of(one);
    if (all_face(one, {-1, 0, 0})) risers += area_of(one);
  }
  CHECK(treads == Approx(steps * 0.29 * 1.2));
  CHECK(risers == Approx(steps * 0.17 * 1.2));
  CHECK(bounds_of(mesh).high.z == Approx(steps * 0.17));
}

TEST_CASE("closed stairs are closed and have the volume of their steps", "[geometry][parts]") {
  const double rise = 0.17, going = 0.29, width = 1.2;
  for (const int n : {1, 2, 12, 500}) {
    const Mesh solid =
        shapes::stairs(n, rise, going, width, shapes::StairUnderside::solid).value().mesh;
    CHECK(is_closed(solid));
    CHECK(signed_volume_of(solid) == Approx(rise * going * width * 0.5 * n * (n + 1)));
    const Mesh stairs =
        shapes::stairs(n, rise, going, width, shapes::StairUnderside::soffit).value().mesh;
    CHECK(is_closed(stairs));
    // One whole step, then per step a parallelogram of one rise and half a step on it.
    CHECK(signed_volume_of(stairs) == Approx(rise * going * width * (1 + 1.5 * (n - 1))));
  }
}

TEST_CASE("a flight whose corners are collinear but for rounding is still triangulated",
          "[geometry][parts]") {
  // 0.17 m and 0.28 m are not exact in double: the inner corners are collinear up to the last
  // digit.
  const double rise = 0.17, going = 0.28, width = 1.2;
  for (int n = 2; n <= 40; ++n) {
    const auto stairs = shapes::stairs(n, rise, going, width, shapes::StairUnderside::soffit);
    REQUIRE(stairs.ok());
    CHECK(is_closed(stairs.value().mesh));
    CHECK(signed_volume_of(stairs.value().mesh) ==
          Approx(rise * going * width * (1 + 1.5 * (n - 1))));
  }
}

TEST_CASE("a ramp is a slope facing up, or a closed wedge", "[geometry][parts]") {
  const Mesh sheet = shapes::ramp(6, 1.5, 0.5).value().mesh;
  CHECK(area_of(sheet) == Approx(1.5 * std::hypot(6, 0.5)));
  CHECK(all_face(sheet, glm::normalize(glm::dvec3(-0.5, 0, 6))));
  const Mesh wedge = shapes::ramp(6, 1.5, 0.5, shapes::RampUnderside::solid).value().mesh;
  CHECK(is_closed(wedge));
  CHECK(signed_volume_of(wedge) == Approx(0.5 * 6 * 0.5 * 1.5));
}

TEST_CASE("parts of no size are refused", "[geometry][parts]") {
  CHECK_FALSE(shapes::stairs(0, 0.17, 0.29, 1).ok());
  CHECK_FALSE(shapes::stairs(1000, 0.17, 0.29, 1).ok());
  CHECK_FALSE(shapes::stairs(3, -0.17, 0.29, 1).ok());
  CHECK_FALSE(shapes::ramp(0, 1, 1).ok());
  CHECK_FALSE(shapes::extrude(l_shape, 0).ok());
  CHECK_FALSE(shapes::wall(1, 1, 0).ok());
}
