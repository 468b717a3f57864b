// Reads transforms of objects and frames of luminaires, and adds objects to the scene.
// Single-threaded like the KeyReader.
#pragma once

#include <span>
#include <vector>

#include "scenes/formats/scene_file/key_reader.hpp"
#include "scenes/light/geometry/transform.hpp"

namespace luxodus {

/// Applies `scale`, `rotate_deg`, `translate`, in this order.
Transform read_transform(KeyReader& keys);
/// The rotation about x, then y, then z.
glm::dmat3 turn_about_axes(const glm::dvec3& degrees);
/// Reads `position`, `direction` or `target`, `rotation_deg`.
Frame read_aim(KeyReader& keys);

/// Reads `repeat`: the offset of every copy, the first of which is zero; only that one if the key
/// is absent or wrong.
std::vector<glm::dvec3> read_repeat(KeyReader& keys);
/// Adds all copies to the mesh. A problem where that exceeds the limits of a scene.
void repeat_mesh(KeyReader& keys, std::span<const glm::dvec3> offsets, Mesh& mesh);

/// Reports a problem without a place (of a shape's dimensions) at this table.
void adopt_problem(KeyReader& keys, const Problem& problem);

/// The materials of an object, by name.
struct SurfaceWords {
  std::string material;
  SourcePlace material_place;
  std::string back_material;  // "" for the material's own back
  SourcePlace back_place;
};
/// Finishes an object: materials, limits, names and tags, then adds it to the scene.
void add_object(Object object, const SurfaceWords& words, SceneReading& reading);
/// Reads `back_material`, `patch_edge_m`, `tags`, `group` where given.
void read_surface(KeyReader& keys, Object& object, SurfaceWords& words);
/// Reads `door` where given.
void read_door(KeyReader& keys, Object& object);

}  // namespace luxodus
