#include "scenes/light/geometry/transform.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "scenes/light/geometry/primitives.hpp"
#include "scenes/light/geometry/shape_checks.hpp"
#include "tests/unit/scenes/light/geometry/mesh_checks.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

const double nan_value = std::numeric_limits<double>::quiet_NaN();

void check_near(const glm::dvec3& a, const glm::dvec3& b, double within = 1e-12) {
  INFO(a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z);
  CHECK(glm::length(a - b) <= within);
}

/// Whether the axes are orthonormal and right-handed.
bool is_rigid(const Frame& frame) {
  const glm::dmat3 gram = glm::transpose(frame.axes) * frame.axes;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (!(std::abs(gram[i][j] - (i == j ? 1.0 : 0.0)) <= 1e-9)) return false;
  return shapes::finite_within_limit(frame.origin) && glm::determinant(frame.axes) > 0;
}

}  // namespace

TEST_CASE("a rotation is right-handed and exact at quarter turns", "[geometry][transform]") {
  const glm::dvec3 p(0.1, 0.7, 12.3);
  CHECK(rotation({0, 0, 1}, 90).value().point(p) == glm::dvec3(-0.7, 0.1, 12.3));
  CHECK(rotation({0, 0, 5}, -90).value().point(p) == glm::dvec3(0.7, -0.1, 12.3));
  CHECK(rotation({0, 1, 0}, 180).value().point(p) == glm::dvec3(-0.1, 0.7, -12.3));
  CHECK(rotation({1, 0, 0}, 450).value().point(p) == glm::dvec3(0.1, -12.3, 0.7));
  CHECK(rotation({1, 2, 3}, 720).value().point(p) == p);
  check_near(rotation({0, 0, 1}, 30).value().point({1, 0, 0}), {std::sqrt(3) / 2, 0.5, 0});
  check_near(rotation({1, 1, 1}, 120).value().point({1, 0, 0}), {0, 1, 0});
}

TEST_CASE("a rotation's axis may have any length above zero", "[geometry][transform]") {
  for (const double scale : {1e-200, 1e-3, 1.0, 1e200}) {
    check_near(rotation(scale * glm::dvec3(0, 0, 1), 90).value().point({1, 0, 0}), {0, 1, 0});
  }
  CHECK_FALSE(rotation({0, 0, 0}, 10).ok());
  CHECK_FALSE(rotation({0, nan_value, 1}, 10).ok());
  CHECK_FALSE(rotation({0, 0, 1}, nan_value).ok());
}

TEST_CASE("a product of transforms applies the right one first", "[geometry][transform]") {
  const Transform turn = rotation({0, 0, 1}, 90).value();
  const Transform move = translation({5, 0, 0});
  CHECK((turn * move).point({0, 0, 0}) == glm::dvec3(0, 5, 0));
  CHECK((move * turn).point({1, 0, 0}) == glm::dvec3(5, 1, 0));
  CHECK((move * scaling({2, 3, 4})).point({1, 1, 1}) == glm::dvec3(7, 3, 4));
}

TEST_CASE("a mirrored mesh keeps its fronts outward", "[geometry][transform]") {
  for (const glm::dvec3 factors : {glm::dvec3(2, 3, 4), {-2, 3, 4}, {-2, -3, 4}, {-2, -3, -4}}) {
    Mesh mesh = shapes::box({1, 1, 1}).value().mesh;
    apply(scaling(factors), mesh);
    CHECK(signed_volume_of(mesh) == Approx(24));
  }
}

TEST_CASE("a transform that flattens or is not finite is unusable", "[geometry][transform]") {
  CHECK(Transform{}.usable());
  CHECK(scaling({1e-3, 1e-3, 1e-3}).usable());
  CHECK_FALSE(scaling({1, 0, 1}).usable());
  CHECK_FALSE(scaling({1, nan_value, 1}).usable());
  CHECK_FALSE(translation({std::numeric_limits<double>::infinity(), 0, 0}).usable());
}

TEST_CASE("units of length are metres, exactly", "[geometry][transform]") {
  CHECK(metres_per_unit("m").value() == 1);
  CHECK(metres_per_unit("mm").value() == 0.001);
  CHECK(metres_per_unit("cm").value() == 0.01);
  CHECK(metres_per_unit("km").value() == 1000);
  CHECK(metres_per_unit("in").value() == 0.0254);
  CHECK(metres_per_unit("ft").value() == 0.3048);
  for (const char* other : {"", "M", "metre", "yd", "m "}) CHECK_FALSE(metres_per_unit(other).ok());
}

TEST_CASE("y up becomes z up without a mirror", "[geometry][transform]") {
  const Transform t = to_z_up(up_axis_named("y").value());
  CHECK(t.point({1, 2, 3}) == glm::dvec3(1, -3, 2));
  CHECK_FALSE(t.mirrors());
  CHECK(to_z_up(up_axis_named("z").value()).point({1, 2, 3}) == glm::dvec3(1, 2, 3));
  CHECK_FALSE(up_axis_named("x").ok());
}

TEST_CASE("a facing frame has z along its direction and y as near to up as possible",
          "[geometry][transform]") {
  const Frame sign = frame_facing({1, 2, 3}, {0, -4, 0}).value();
  CHECK(is_rigid(sign));
  check_near(sign.axes[2], {0, -1, 0});
  check_near(sign.axes[1], {0, 0, 1});
  check_near(sign.axes[0], {1, 0, 0});  // the reader, looking along +y, has +x to the right
  const Frame tilted = frame_facing({0, 0, 0}, {1, 1, 0.5}).value();
  CHECK(is_rigid(tilted));
  CHECK(tilted.axes[1].z > 0);
  CHECK(tilted.axes[0].z == Approx(0).margin(1e-15));
}

TEST_CASE("a facing frame exists for every direction, also along up", "[geometry][transform]") {
  const glm::dvec3 axes[] = {{0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {1e-9, 0, 1}};
  for (const glm::dvec3& direction : axes) {
    for (const glm::dvec3& up : axes) {
      const Frame frame = frame_facing({0, 0, 0}, direction, up).value();
      CHECK(is_rigid(frame));
      check_near(frame.axes[2], glm::normalize(direction));
    }
  }
  check_near(frame_facing({0, 0, 0}, {0, 0, -1}).value().axes[1], {0, 1, 0});
}

TEST_CASE("a frame that aims has -z along its direction, and look_at aims at the target",
          "[geometry][transform]") {
  // A luminaire that hangs horizontally: the frame of the scene itself.
  const Frame down = frame_aiming({0, 0, 2.5}, {0, 0, -1}).value();
  check_near(down.axes[0], {1, 0, 0});
  check_near(down.axes[1], {0, 1, 0});
  const Frame camera = look_at({1, 1, 1}, {4, 1, 1}).value();
  CHECK(is_rigid(camera));
  check_near(camera.axes * glm::dvec3(0, 0, -1), {1, 0, 0});
  check_near(camera.axes * glm::dvec3(1, 0, 0), {0, -1, 0});
  CHECK_FALSE(look_at({1, 1, 1}, {1, 1, 1}).ok());
  CHECK_FALSE(frame_facing({0, 0, 0}, {0, 0, 0}).ok());
  CHECK_FALSE(frame_facing({0, 0, nan_value}, {0, 0, 1}).ok());
  CHECK_FALSE(frame_facing({0, 0, 0}, {1, 0, 0}, {0, 0, 0}).ok());
}

TEST_CASE("a frame as a map takes its origin and axes into the scene", "[geometry][transform]") {
  const Frame frame = frame_facing({1, 2, 3}, {1, 2, -0.3}).value();
  const glm::dvec3 p(0.3, -7, 2);
  check_near(as_transform(frame).point(p), frame.origin + frame.axes * p);
}
