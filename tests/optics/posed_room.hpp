// An asymmetric room that can be described in many ways: moved, rotated, mirrored, scaled. Readings
// are converted to the room's original pose, so that those of all poses compare. It has everything
// that counts light: surfaces, planes, volumes, voxels, probes, an observed sign, and an open side.
// Test helpers; one thread.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "tests/optics/light_kit.hpp"

namespace luxodus::light {

/// The pose of a room: a point p goes to axes * (scale * p) + shift.
struct Pose {
  glm::dmat3 axes{1.0};
  double scale = 1;
  glm::dvec3 shift{0};

  glm::dvec3 point(const glm::dvec3& p) const { return axes * (scale * p) + shift; }
  glm::dvec3 way(const glm::dvec3& d) const { return axes * d; }
  bool mirrored() const { return glm::determinant(axes) < 0; }
};

/// A rotation after which no wall is horizontal or vertical. The frame about a normal changes at
/// horizontal normals, where rounding decides: a room in which equal random numbers are to make
/// equal histories has none.
glm::dmat3 turned();
/// A rotation by other angles.
glm::dmat3 turned_again();

/// Layers, boxes and voxels stay level for any rotation of the room.
enum class Level { with, without };

/// Surfaces of the room.
extern const std::vector<std::string> room_things;

/// Walls with an opening, a screen, smoke in a ball, in cells and in layers, two lamps and a sign.
/// Fluxes scale with areas, so that luminances stay.
SceneDescription posed_room(const Pose& pose = {}, Level level = Level::with);

/// Closes the opening by the missing third of its wall.
void close_opening(SceneDescription& room, const Pose& pose);

/// Expected accuracy of a reading: eye paths are few, and each counts for more.
enum class Known { well, rather, from_eyes };

struct Reading {
  std::string name;
  Estimate estimate;
  Known known = Known::well;
};

/// The room, or another scene with its pose and measurements, traced.
class RoomRun : public Run {
 public:
  RoomRun(SceneDescription scene, const Pose& pose, Level level, const RunOptions& options);

  /// In the units of the room at scale 1.
  const std::vector<Reading>& readings() const { return readings_; }

 private:
  void add(const std::string& name, const Estimate& estimate, double scale_power, Known known);
  void read_surfaces();
  void read_planes();
  void read_volumes();
  void read_eyes();

  Pose pose_;
  Level level_;
  std::vector<Reading> readings_;
};

/// Compares readings of equal histories, except for a few that rounding has changed. Differences
/// must be small parts of standard errors: if two runs share all but a share f of their histories,
/// they are sqrt(2 f) standard errors for any quantity.
void check_same_histories(const RoomRun& a, const RoomRun& b);
/// Compares to that relative difference; without eye results if `eyes` is false.
void check_same_values(const RoomRun& a, const RoomRun& b, double relative, bool eyes = true);
/// Compares readings of independent histories.
void check_same_light(const RoomRun& a, const RoomRun& b);
/// Compares the eye results of independent histories.
void check_same_views(const RoomRun& a, const RoomRun& b);

/// Deterministic direct light at some points [lx]; points and directions are given for the room's
/// original pose.
std::vector<double> direct_light_of(SceneDescription scene, const Pose& pose);

}  // namespace luxodus::light
