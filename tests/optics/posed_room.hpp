// One room, nothing of it symmetrical, that can be said in many ways: stood elsewhere, turned,
// mirrored, scaled. What is read of it is given as of the room where it stands at first, so that
// readings of all poses compare. It holds something of everything that counts light: surfaces,
// planes, volumes, voxels, probes, a sign that is looked at, and a side through which light leaves.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "tests/optics/light_kit.hpp"

namespace luxodus::light {

/// Where a room stands: a point p goes to axes * (scale * p) + shift.
struct Pose {
  glm::dmat3 axes{1.0};
  double scale = 1;
  glm::dvec3 shift{0};

  glm::dvec3 point(const glm::dvec3& p) const { return axes * (scale * p) + shift; }
  glm::dvec3 way(const glm::dvec3& d) const { return axes * d; }
  bool mirrored() const { return glm::determinant(axes) < 0; }
};

/// Turned by some angles, so that no wall is level or upright. The frame about a normal changes at
/// normals that are level, where a rounding decides: a room in which equal random numbers are to
/// make equal histories has none.
glm::dmat3 turned();
/// Turned by other angles.
glm::dmat3 turned_again();

/// Layers, boxes and voxels lie level whichever way the room is turned.
enum class Level { with, without };

/// Surfaces of the room.
extern const std::vector<std::string> room_things;

/// Walls with an opening, a screen, smoke in a ball, in cells and in layers, two lamps and a sign.
/// Fluxes grow as areas do, so that luminances stay.
SceneDescription posed_room(const Pose& pose = {}, Level level = Level::with);

/// Gives the wall with the opening its other third.
void close_opening(SceneDescription& room, const Pose& pose);

/// What is read of a room: paths from eyes are few, and one of them counts for more.
enum class Known { well, rather, from_eyes };

struct Reading {
  std::string name;
  Estimate estimate;
  Known known = Known::well;
};

/// The room, or another scene of its pose and measurements, traced.
class RoomRun : public Run {
 public:
  RoomRun(SceneDescription scene, const Pose& pose, Level level, const RunOptions& options);

  /// In the units of the room of scale 1.
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

/// Readings of the same histories, but for a few that a rounding has sent another way. Differences
/// are held to parts of standard errors: of two runs that share all but a share f of their
/// histories they are sqrt(2 f) standard errors, whatever is read.
void check_same_histories(const RoomRun& a, const RoomRun& b);
/// The same to that relative difference, but for what eyes see if `eyes` is false.
void check_same_values(const RoomRun& a, const RoomRun& b, double relative, bool eyes = true);
/// Readings with chances of their own.
void check_same_light(const RoomRun& a, const RoomRun& b);
/// The same of what eyes see alone.
void check_same_views(const RoomRun& a, const RoomRun& b);

/// Direct light at some points, computed without chance [lx], points and directions as of the room
/// where it stands at first.
std::vector<double> direct_light_of(SceneDescription scene, const Pose& pose);

}  // namespace luxodus::light
