// &MOVE: a body or a box that is scaled, turned and shifted. Plain values; any thread.
//
// Semantics: FDS User's Guide (NIST SP 1019), "Transformed geometry": about X0, Y0, Z0 first
// scaled, then turned about AXIS, then shifted by DX, DY, DZ; or T34, the 3 x 4 matrix of the
// whole.
#pragma once

#include <optional>

#include "scenes/formats/fds_input/boxes.hpp"
#include "scenes/formats/fds_input/group_keys.hpp"
#include "scenes/light/geometry/mesh.hpp"

namespace luxodus::fds_input {

struct Move {
  glm::dmat3 turn{1};  // and scale
  glm::dvec3 shift{0};

  glm::dvec3 operator()(const glm::dvec3& place) const { return turn * place + shift; }
};

/// Errors: an axis without length, a scale of zero.
Move move_of(GroupKeys& keys);

/// A moved box; nothing where it does not stay along the axes.
std::optional<Box> moved(const Box& box, const Move& move);

/// Moves a mesh; triangles of a mirrored one still face outwards.
void move_mesh(Mesh& mesh, const Move& move);

}  // namespace luxodus::fds_input
