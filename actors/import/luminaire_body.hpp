// The body of a luminaire from the parts of its model (L3D): their shapes are OBJ files, which the
// mesh reader reads, placed and joined to one mesh, with the diffuse colours of their materials.
// Plain values; any thread.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>

#include "runtime/core/result.hpp"
#include "scenes/formats/photometry/l3d.hpp"
#include "scenes/light/geometry/mesh.hpp"

namespace luxodus {

class ReadingShare;

namespace limits {
/// Triangles of a body: a building has many luminaires, each with its own.
inline constexpr size_t luminaire_body_triangles = 200'000;
}  // namespace limits

/// Announces the files of a body that luminaire_body() will read.
void foresee_body(const L3dModel& model, ReadingShare& reading);

struct LuminaireBody {
  Mesh mesh;  // metres, z up
  /// Diffuse colours of the model as linear RGB, each for all triangles up to the next.
  struct Colour {
    std::optional<glm::dvec3> value;  // none if the model states none
    size_t first_triangle = 0;
  };
  std::vector<Colour> colours;

  /// Whether the model states any colour.
  bool is_coloured() const;
};

/// Parts of a model: all, those that were measured with the light, which do not stop it, and those
/// that were not.
enum class BodyParts { all, measured, others };
bool has_parts(const L3dModel& model, BodyParts which);

/// The body of these parts in the model's metres, z up. `reading`, where given, receives the
/// progress. Errors: a shape that cannot be read, by its name; more triangles than the limit; no
/// temporary folder for the shapes' files.
Result<LuminaireBody> luminaire_body(const L3dModel& model, ReadingShare* reading = nullptr,
                                     BodyParts which = BodyParts::all);

/// Directions within a degree of straight down have a z below this.
inline constexpr double straight_down = -0.9998;

/// How far to move the body, so that the centre of its luminous opening is at the origin, and how
/// far it then reaches below.
struct BodyPlace {
  glm::dvec3 offset_m{0};
  double below_m = 0;         // how far it extends below the opening
  glm::dvec3 down{0, 0, -1};  // direction of the opening
};

/// `opening`: its name in the model; if it does not exist, the only one, else the lowest point
/// below the model's own origin. If a body extends less than 0.1 m below an opening that shines
/// straight down, like a frame, it is raised to a millimetre above it, so that eyes below see the
/// opening; it is never lowered. For other directions the body is moved a millimetre behind the
/// opening.
BodyPlace body_place(const L3dModel& model, const Mesh& body, const std::string& opening);

/// The opening of this name, or the only one; null if there is neither.
const L3dOpening* opening_of(const L3dModel& model, const std::string& name);

/// Writes it as an OBJ file in metres, z up; for a coloured body also its material library,
/// FILE.mtl. Reflectances are at most 0.9, like those of paints; without a colour they are grey,
/// 0.7.
/// Errors: as write_file_atomically.
Result<void> write_body(const LuminaireBody& body, const std::filesystem::path& file);

}  // namespace luxodus
