// Where things stand: transforms of objects, frames of luminaires, and handing an object to the
// scene.
#pragma once

#include <span>
#include <vector>

#include "scenes/formats/scene_file/key_reader.hpp"
#include "scenes/light/geometry/transform.hpp"

namespace luxodus {

/// Of `scale`, `rotate_deg`, `translate`, in this order.
Transform read_transform(KeyReader& keys);
/// The turn about x, then y, then z.
glm::dmat3 turn_about_axes(const glm::dvec3& degrees);
/// Of `position`, `direction` or `target`, `rotation_deg`.
Frame read_aim(KeyReader& keys);

/// Of `repeat`: the offset of every copy, the first of which is none; just that where it is not
/// given or wrong.
std::vector<glm::dvec3> read_repeat(KeyReader& keys);
/// Makes the mesh all of its copies. A problem where that is more than a scene may have.
void repeat_mesh(KeyReader& keys, std::span<const glm::dvec3> offsets, Mesh& mesh);

/// Takes a problem that knows no place (a shape's measures) as one of this table.
void adopt_problem(KeyReader& keys, const Problem& problem);

/// What an object is made of, by name.
struct SurfaceWords {
  std::string material;
  SourcePlace material_place;
  std::string back_material;  // "" for the material's own back
  SourcePlace back_place;
};
/// Finishes an object: materials, limits, names and tags, then adds it to the scene.
void add_object(Object object, const SurfaceWords& words, SceneReading& reading);
/// `back_material`, `patch_edge_m`, `tags`, `group` where given.
void read_surface(KeyReader& keys, Object& object, SurfaceWords& words);
/// `door` where given.
void read_door(KeyReader& keys, Object& object);

}  // namespace luxodus
