#include "scenes/light/geometry/transform.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "runtime/core/printable.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"

namespace luxodus {
namespace {

/// Sine and cosine of an angle in degrees, exact where they are 0 or +-1.
std::pair<double, double> sine_cosine(double degrees) {
  const double turn = std::remainder(degrees, 360.0);  // exact; [-180, 180]
  if (turn == 0) return {0.0, 1.0};
  if (turn == 90) return {1.0, 0.0};
  if (turn == -90) return {-1.0, 0.0};
  if (std::abs(turn) == 180) return {0.0, -1.0};
  const double radians = turn * std::numbers::pi / 180.0;
  return {std::sin(radians), std::cos(radians)};
}

/// Below this sine of the angle to `up`, the component of `up` across the direction is mostly
/// rounding.
constexpr double parallel_sine = 1e-6;

/// The length is taken after scaling by the largest component, so that 1e-200 and 1e200 work too.
glm::dvec3 unit(const glm::dvec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return glm::normalize(v / largest);
}

}  // namespace

bool Transform::usable() const {
  for (int column = 0; column < 3; ++column) {
    if (!is_finite(linear[column])) return false;
  }
  const double determinant = glm::determinant(linear);
  return is_finite(offset) && std::isfinite(determinant) && determinant != 0;
}

Transform operator*(const Transform& second, const Transform& first) {
  return {second.linear * first.linear, second.linear * first.offset + second.offset};
}

Transform scaling(const glm::dvec3& factors) {
  Transform out;
  for (int i = 0; i < 3; ++i) out.linear[i][i] = factors[i];
  return out;
}

Transform translation(const glm::dvec3& offset) {
  Transform out;
  out.offset = offset;
  return out;
}

Result<Transform> rotation(const glm::dvec3& axis, double degrees) {
  if (!is_finite(axis) || !std::isfinite(degrees)) {
    return problem("a rotation needs a finite axis and angle");
  }
  if (axis == glm::dvec3(0))
    return problem("the axis of a rotation is (0, 0, 0): give a direction");
  const glm::dvec3 n = unit(axis);
  const auto [s, c] = sine_cosine(degrees);
  // Rodrigues: R = c I + s [n]x + (1 - c) n n^T; glm matrices are indexed [column][row].
  const glm::dmat3 cross(glm::dvec3(0, n.z, -n.y), glm::dvec3(-n.z, 0, n.x),
                         glm::dvec3(n.y, -n.x, 0));
  Transform out;
  out.linear = c * glm::dmat3(1.0) + s * cross + (1 - c) * glm::outerProduct(n, n);
  return out;
}

void apply(const Transform& transform, Mesh& mesh) {
  for (glm::dvec3& p : mesh.positions) p = transform.point(p);
  if (transform.mirrors()) flip(mesh);
}

Result<double> metres_per_unit(std::string_view unit_name) {
  constexpr std::pair<std::string_view, double> units[] = {
      {"m", 1.0}, {"mm", 0.001}, {"cm", 0.01}, {"km", 1000.0}, {"in", 0.0254}, {"ft", 0.3048}};
  for (const auto& [name, metres] : units) {
    if (name == unit_name) return metres;
  }
  return problem(fmt::format("unknown unit of length \"{}\": use m, mm, cm, km, in or ft",
                             excerpt(unit_name)));
}

Transform to_z_up(UpAxis up) {
  Transform out;
  if (up == UpAxis::y) {
    out.linear = glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0));
  }
  return out;
}

Result<UpAxis> up_axis_named(std::string_view word) {
  if (word == "y") return UpAxis::y;
  if (word == "z") return UpAxis::z;
  return problem(fmt::format("unknown up axis \"{}\": use \"y\" or \"z\"", excerpt(word)));
}

Result<Frame> frame_facing(const glm::dvec3& origin, const glm::dvec3& direction,
                           const glm::dvec3& up) {
  if (!is_finite(origin) || !is_finite(direction) || !is_finite(up)) {
    return problem("a position or direction is not finite");
  }
  if (direction == glm::dvec3(0)) return problem("a direction is (0, 0, 0)");
  if (up == glm::dvec3(0)) return problem("the up direction is (0, 0, 0)");
  const glm::dvec3 z = unit(direction);
  glm::dvec3 x = glm::cross(unit(up), z);
  if (glm::length(x) < parallel_sine) x = glm::cross(glm::dvec3(0, 1, 0), z);
  // If `up` is the y axis and parallel to the direction, y does not help either.
  if (glm::length(x) < parallel_sine) x = glm::cross(glm::dvec3(0, 0, 1), z);
  x = glm::normalize(x);
  return Frame{origin, glm::dmat3(x, glm::normalize(glm::cross(z, x)), z)};
}

Result<Frame> frame_aiming(const glm::dvec3& origin, const glm::dvec3& direction,
                           const glm::dvec3& up) {
  return frame_facing(origin, -direction, up);
}

Result<Frame> look_at(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up) {
  if (eye == target)
    return problem("the target is where the eye is: there is no direction to look");
  return frame_aiming(eye, target - eye, up);
}

Transform as_transform(const Frame& frame) {
  return {frame.axes, frame.origin};
}

}  // namespace luxodus
