// A building as an import makes it of an IFC model and its shapes: bodies by storey and material,
// door leaves with their hinges, rooms as outlines, fixtures with the place and way of their light,
// and all that a person must know of it. Plain values in scene axes [m]; nothing is written here.
// Any thread.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "actors/import/ifc_shapes.hpp"
#include "scenes/formats/ifc/ifc_model.hpp"
#include "scenes/light/geometry/mesh.hpp"

namespace luxodus {

namespace limits {
/// Relative difference of a shape's volume from its authored one that is told.
inline constexpr double volume_difference = 0.02;
}  // namespace limits

/// A hinge and how far the leaf turns about the vertical through it.
struct DoorHinge {
  glm::dvec3 point{0};
  double open_angle_deg = 90;
};

/// A body of one material.
struct BuildingPart {
  std::string name;  // "wall South 184YnOisRDcpvyUltx0008"
  std::string material;
  Mesh mesh;
  bool furniture = false;
  std::optional<DoorHinge> hinge;
};

struct BuildingStorey {
  std::string name;
  double elevation_m = 0;
  std::vector<BuildingPart> parts;
};

/// How a material shows on a screen, which is all that a model knows of its optics.
struct BuildingMaterial {
  double grey = 0.5;  // luminance of its display colour
  bool clear = false;
};

struct BuildingRoom {
  std::string name, guid;
  std::vector<glm::dvec2> outline;
  double z_m = 0, height_m = 0;
  /// Share of rays from its middle that meet nothing, and where most of them go; 0: it is closed.
  double open_share = 0;
  std::string open_towards;
  bool has_floor = false;  // something is under its middle, at its level
};

struct BuildingFixture {
  std::string name, guid, type;
  bool is_sign = false;
  std::string document;            // photometric file that the model names; "" where none
  std::vector<std::string> says;   // "SecurityLightingType SAFETYLIGHT": for the person who goes on
  glm::dvec3 position{0};          // of the light, or the middle of the sign
  glm::dvec3 direction{0, 0, -1};  // where the light goes, or the sign's face looks
  double rotation_deg = 0;
  double width_m = 0, height_m = 0;  // of a sign
  bool double_sided = false;
  std::vector<BuildingPart> body;  // left out where its light comes from a photometric file
  std::string storey;
};

struct BuildingExit {
  std::string name, guid;
  glm::dvec3 position{0};   // before the door, on the side of a room
  bool final_exit = false;  // leads outside
};

struct VolumeDifference {
  std::string guid, name;
  uint64_t id = 0;
  double authored_m3 = 0, mesh_m3 = 0;
};

struct Building {
  std::string title, file, schema;
  std::vector<BuildingStorey> storeys;  // upwards; those without parts are not there
  std::map<std::string, BuildingMaterial> materials;
  std::vector<BuildingRoom> rooms;
  std::vector<BuildingFixture> fixtures;
  std::vector<BuildingExit> exits;
  std::vector<VolumeDifference> differences;  // largest first
  size_t volumes_compared = 0;
  std::vector<std::string> unread;  // what could not be read, with its number
  std::vector<std::string> notes;   // what else a person must know
};

/// Puts a model and its shapes together. Nothing is guessed: what is missing is in `unread`.
/// `told`, where given, hears what is done and which share of that is.
using ImportProgress = std::function<void(const std::string& what, double share)>;
Building building_of(const IfcModel& model, IfcShapes shapes, const ImportProgress& told = {});

// ---- steps of it, apart for tests
// ----------------------------------------------------------------

/// The connected pieces of a mesh; vertices of one place are one.
std::vector<Mesh> connected_pieces(const Mesh& mesh);

/// The leaves of a door, each with its hinge by the door's operation and with what is within it
/// (panes, handles), and the rest, which stays. `place`: local x or y along the width; a leaf opens
/// towards the other one.
struct DoorPiece {
  Mesh mesh;
  std::string material;
};
struct DoorLeaf {
  std::vector<DoorPiece> pieces;
  DoorHinge hinge;
};
struct DoorPieces {
  std::vector<DoorLeaf> leaves;
  std::vector<DoorPiece> frame;
};
DoorPieces door_pieces(const std::vector<DoorPiece>& parts, const Transform& place,
                       const std::string& operation);

/// The floor of a closed body: the boundary of what lies in its lowest plane, counter-clockwise,
/// without points on straight lines. Empty where there is none.
std::vector<glm::dvec2> floor_outline(const Mesh& mesh);

/// Rays at the parts of storeys, which outlive it. Parts are found by a tree of their boxes, in
/// double precision: a model may stand far from its origin.
class PartRays {
 public:
  explicit PartRays(const std::vector<BuildingStorey>& storeys);

  /// Distance to the first part that a ray meets; nothing where it meets none.
  std::optional<double> first(const glm::dvec3& from, const glm::dvec3& direction) const;

 private:
  struct Part {
    const Mesh* mesh;
    Bounds box;
  };
  /// A leaf has parts. The first child of any other stands behind it.
  struct Node {
    Bounds box;
    size_t first = 0, end = 0;  // parts of a leaf
    size_t second_child = 0;
    bool is_leaf() const { return first < end; }
  };

  void grow(size_t first, size_t end);

  std::vector<Part> parts_;
  std::vector<Node> nodes_;
};

/// Share of rays from the middle of a room that meet none of the parts, the way most of them go,
/// and whether it has a floor.
void look_for_openings(const PartRays& rays, BuildingRoom& room);

}  // namespace luxodus
