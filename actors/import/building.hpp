// A building that an import makes from an IFC model and its shapes: bodies by storey and material,
// door leaves with their hinges, rooms as outlines, fixtures with place and direction of their
// light, and notes for the user. Plain values in scene axes [m]; nothing is written here. Any
// thread.
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
/// Relative difference of a shape's volume from its authored one that is reported.
inline constexpr double volume_difference = 0.02;
/// Products farther than this from the middle of the others are left out [m]: they would cost all
/// others their precision.
inline constexpr double stray_m = 10'000;
/// Smallest floor of a room that becomes an area [m2].
inline constexpr double smallest_floor_m2 = 0.25;
}  // namespace limits

/// A hinge, and the angle by which the leaf turns about the vertical through it.
struct DoorHinge {
  glm::dvec3 point{0};
  double open_angle_deg = 90;
};

/// A body with one material.
struct BuildingPart {
  std::string name;  // "wall South 184YnOisRDcpvyUltx0008"
  std::string material;
  Mesh mesh;
  bool furniture = false;
  bool open = false;  // of a solid that is not closed
  std::optional<DoorHinge> hinge;
};

struct BuildingStorey {
  std::string name;
  double elevation_m = 0;
  std::vector<BuildingPart> parts;
};

/// The display colour of a material, which is all that a model says about its optics.
struct BuildingMaterial {
  double grey = 0.5;  // luminance of its display colour
  bool clear = false;
};

struct BuildingRoom {
  std::string name, guid;
  std::vector<glm::dvec2> outline;
  double z_m = 0, height_m = 0;  // z: of the floor that rays find
  /// Share of rays from its middle that hit nothing, and the direction of most of them; 0: it is
  /// closed.
  double open_share = 0;
  std::string open_towards;
  double floor_share = 0;  // share of the outline with a floor under it, at any level
  double level_share = 0;  // share of it at this level
};

struct BuildingFixture {
  std::string name, guid, type;
  bool is_sign = false;
  std::string document;            // photometric file that the model names; "" if none
  std::string photometry;          // IES file of the intensities that the model states; "" if none
  std::vector<std::string> says;   // "SecurityLightingType SAFETYLIGHT": shown to the user
  glm::dvec3 position{0};          // of the light, or the centre of the sign
  glm::dvec3 direction{0, 0, -1};  // direction of the light, or of the sign's face
  double rotation_deg = 0;
  double width_m = 0, height_m = 0;  // of a sign
  bool double_sided = false;
  std::vector<BuildingPart> body;  // empty if its light comes from a photometric file
  std::string storey;
};

struct BuildingExit {
  std::string name, guid;
  glm::dvec3 position{0};   // in front of the door, on the side of a room
  bool final_exit = false;  // leads outside
};

/// A solid whose shape is not closed.
struct OpenSolid {
  std::string guid, name;
  uint64_t id = 0;
  double area_m2 = 0;  // of the missing faces
};

struct VolumeDifference {
  std::string guid, name;
  uint64_t id = 0;
  double authored_m3 = 0, mesh_m3 = 0;
};

struct IfcBuilding {
  std::string title, file, schema;
  std::vector<BuildingStorey> storeys;  // upwards; only those with parts
  std::map<std::string, BuildingMaterial> materials;
  std::vector<BuildingRoom> rooms;
  std::vector<BuildingFixture> fixtures;
  std::vector<BuildingExit> exits;
  std::vector<VolumeDifference> differences;  // largest first
  std::vector<OpenSolid> open_solids;         // largest first
  size_t volumes_compared = 0;
  std::vector<std::string> unread;  // what could not be read, with its instance number
  std::vector<std::string> notes;   // other notes for the user
};

/// Combines a model and its shapes. Nothing is guessed: what is missing is in `unread`. `told`,
/// where given, receives the current step and its share done.
using ImportProgress = std::function<void(const std::string& what, double share)>;
IfcBuilding building_of(const IfcModel& model, IfcShapes shapes, const ImportProgress& told = {});

// ---- steps of it, apart for tests
// ----------------------------------------------------------------

/// The connected pieces of a mesh; vertices at one place are merged.
std::vector<Mesh> connected_pieces(const Mesh& mesh);

/// A leaf of a door, with its hinge by the door's operation and the pieces within it (panes,
/// handles); or the fixed rest. `place`: local x or y along the width; a leaf opens towards the
/// other one.
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

/// A level floor of a closed body: an outline, counter-clockwise, without points on straight lines.
struct FloorOutline {
  std::vector<glm::dvec2> outline;
  double z_m = 0;
};

/// The floors of a closed body, upwards: the outer boundaries of its faces that look down. Faces
/// below limits::smallest_floor_m2 are left out.
std::vector<FloorOutline> floor_outlines(const Mesh& mesh);

/// Casts rays at the parts of storeys, which outlive it. A tree of their boxes in double precision
/// finds parts: a model may be far from its origin.
class PartRays {
 public:
  enum class Hit { all, no_furniture };
  explicit PartRays(const std::vector<BuildingStorey>& storeys, Hit hit = Hit::all);

  /// Distance to the first part that a ray hits; nothing if it hits none.
  std::optional<double> first(const glm::dvec3& from, const glm::dvec3& direction) const;

 private:
  struct Part {
    const Mesh* mesh;
    Bounds box;
  };
  /// A leaf node has parts. The first child of an inner node follows it directly.
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

/// The share of rays from the middle of a room that hit no part, and the direction of most of them.
void look_for_openings(const PartRays& rays, BuildingRoom& room);

/// Sets the room on the floor that most rays down from its outline find, above screed and finish,
/// and shortens it by as much. `solids`: without furniture.
void set_on_floor(const PartRays& solids, BuildingRoom& room);

}  // namespace luxodus
