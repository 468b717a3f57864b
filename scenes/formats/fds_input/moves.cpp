#include "scenes/formats/fds_input/moves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace luxodus::fds_input {

namespace {

/// Rodrigues' formula: a turn about an axis of length 1 by an angle [degrees].
glm::dmat3 turn_about(const glm::dvec3& axis, double degrees) {
  // Quarter turns are exact.
  double sine = std::sin(degrees * std::numbers::pi / 180);
  double cosine = std::cos(degrees * std::numbers::pi / 180);
  if (const double quarters = degrees / 90; quarters == std::round(quarters)) {
    sine = std::round(sine);
    cosine = std::round(cosine);
  }
  // Columns.
  const glm::dmat3 cross(0, axis.z, -axis.y, -axis.z, 0, axis.x, axis.y, -axis.x, 0);
  return glm::dmat3(1) + sine * cross + (1 - cosine) * cross * cross;
}

}  // namespace

Move move_of(GroupKeys& keys) {
  Move out;
  if (keys.has("T34")) {
    // By columns, as Fortran stores it.
    const std::vector<double> t = keys.numbers("T34");
    if (t.size() != 12) {
      keys.fail("T34", "T34 of &MOVE is not twelve numbers in one list");
      return {};
    }
    for (int column = 0; column < 3; ++column)
      for (int row = 0; row < 3; ++row)
        out.turn[column][row] = t[static_cast<size_t>(3 * column + row)];
    out.shift = {t[9], t[10], t[11]};
  } else {
    const glm::dvec3 about(keys.number("X0", 0), keys.number("Y0", 0), keys.number("Z0", 0));
    const std::vector<double> axis = keys.array("AXIS", {0, 0, 1});
    const double all = keys.number("SCALE", 1);
    const glm::dvec3 scale(keys.number("SCALEX", all), keys.number("SCALEY", all),
                           keys.number("SCALEZ", all));
    const glm::dvec3 along(axis[0], axis[1], axis[2]);
    if (!(glm::length(along) > 1e-9)) {
      keys.fail("AXIS", "AXIS of &MOVE has no length");
      return {};
    }
    out.turn = turn_about(glm::normalize(along), keys.number("ROTATION_ANGLE", 0)) *
               glm::dmat3(scale.x, 0, 0, 0, scale.y, 0, 0, 0, scale.z);
    out.shift = about - out.turn * about +
                glm::dvec3(keys.number("DX", 0), keys.number("DY", 0), keys.number("DZ", 0));
  }
  if (!(std::abs(glm::determinant(out.turn)) > 1e-12)) {
    keys.fail("ID", "this &MOVE makes bodies flat");
    return {};
  }
  return out;
}

std::optional<Box> moved(const Box& box, const Move& move) {
  // Each axis becomes one axis: one number in each row of the matrix.
  constexpr double none = 1e-9;
  for (int row = 0; row < 3; ++row) {
    int any = 0;
    for (int column = 0; column < 3; ++column)
      any += std::abs(move.turn[column][row]) > none ? 1 : 0;
    if (any != 1) return std::nullopt;
  }
  const glm::dvec3 a = move(box.low), b = move(box.high);
  Box out{glm::min(a, b), glm::max(a, b)};
  const glm::dvec3 far = glm::max(glm::abs(out.low), glm::abs(out.high));
  return std::max({far.x, far.y, far.z}) <= limits::farthest_m ? std::optional(out) : std::nullopt;
}

void move_mesh(Mesh& mesh, const Move& move) {
  for (glm::dvec3& p : mesh.positions) p = move(p);
  if (glm::determinant(move.turn) > 0) return;
  for (auto& triangle : mesh.triangles) std::swap(triangle.y, triangle.z);
}

}  // namespace luxodus::fds_input
