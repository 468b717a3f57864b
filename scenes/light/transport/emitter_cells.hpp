// Cuts emitters into cells that are small as seen from a place, with the points of a quadrature
// rule on each: the basis of deterministic direct light. Every shape consists of patches, maps of
// the unit square: a rectangle, a disc in polar coordinates, the side of a sphere or a tube that
// faces the place, the triangles of a mesh, the texels of a sign, the points of a flame. Pure; any
// thread.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "scenes/light/geometry/real.hpp"
#include "scenes/light/transport/emission.hpp"

namespace luxodus {

namespace limits {
/// Cells of one emitter seen from one place; at the limit, cells are not cut further.
inline constexpr size_t direct_cells = 2048;
/// Meshes up to this size have one patch per triangle; larger ones are represented by points.
inline constexpr size_t direct_triangles = 1024;
inline constexpr int direct_points = 2048;  // of such a large mesh
}  // namespace limits

/// A piece of an emitter that is small as seen from a place, with its share of the power.
struct EmitterPart {
  EmissionPoint point;
  double share = 1;
};

/// The receiver of an emitter's light: decides how finely the emitter is cut.
struct Viewpoint {
  Vec3 place;
  Vec3 normal;            // of the receiver; light from below its horizon does not count
  double sigma_t = 0;     // mean extinction on the line to the emitter [1/m]
  double part_share = 0;  // spacing of points relative to distance
  bool clipped = false;   // the part below the horizon is removed in closed form
};

/// A piece of a patch, in the patch's coordinates from 0 to 1.
struct EmitterCell {
  uint32_t patch = 0;
  Real u0 = 0, v0 = 0, u1 = 1, v1 = 1;
  bool whole = false;  // the whole emitter, which is small: one point, or four for a disc
};

/// Up to four points.
struct CellPoints {
  std::array<EmitterPart, 4> point;
  size_t count = 0;
  std::span<const EmitterPart> all() const { return {point.data(), count}; }
};

/// Whether cells are flat polygons.
bool has_flat_cells(const CompiledEmitter& emitter);

/// The cells of an emitter, and the quadrature points of each.
class EmitterCells {
 public:
  /// Requires: scene and emitter outlive this.
  EmitterCells(const CompiledScene& scene, const CompiledEmitter& emitter, const Viewpoint& from)
      : scene_(&scene), emitter_(&emitter), from_(from) {}

  /// Cells small enough for the rule to err by less than 1e-3 where the light falls with distance
  /// and media, up to limits::direct_cells. Empty if no emitting side faces the place.
  std::vector<EmitterCell> cut() const;
  std::vector<EmitterCell> quarters(const EmitterCell& cell) const;
  CellPoints points(const EmitterCell& cell) const;
  /// Points near its corners, where occlusion shows first.
  CellPoints corner_points(const EmitterCell& cell) const;
  /// A point of a rectangle's cell with this share of the emitter's power; u, v from 0 to 1 across
  /// the cell. Requires: a rectangle.
  EmitterPart point_in(const EmitterCell& cell, const glm::dvec2& uv, double share) const;
  /// The corners in order, relative to the place. Requires: has_flat_cells.
  std::vector<glm::dvec3> polygon(const EmitterCell& cell) const;
  const Viewpoint& viewpoint() const { return from_; }
  /// Cutting does not improve points and signs.
  bool can_be_cut() const {
    return emitter_->kind != EmitterKind::point && emitter_->kind != EmitterKind::volume &&
           emitter_->kind != EmitterKind::sign_face && !is_mesh_of_points();
  }

 private:
  /// A cell's apparent dimensions.
  struct SeenCell {
    double width_u = 0, width_v = 0, distance = 0;
    bool cut_by_horizon = false;
    double width() const { return std::max(width_u, width_v); }
  };
  EmitterPart at(uint32_t patch, Real u, Real v) const;
  SeenCell sight_of(const EmitterCell& cell) const;
  double excess_width(const EmitterCell& cell, const SeenCell& sight) const;
  std::vector<EmitterCell> patches() const;
  std::vector<EmitterCell> mesh_points() const;
  bool is_mesh_of_points() const;
  bool emits_outwards() const;
  bool small_whole(EmitterCell& cell) const;
  CellPoints whole_points() const;
  EmitterPart sign_part(const EmitterCell& cell) const;

  const CompiledScene* scene_;
  const CompiledEmitter* emitter_;
  Viewpoint from_;
};

}  // namespace luxodus
