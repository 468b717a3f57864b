// The body of a luminaire from the parts of its model (L3D): their shapes are OBJ files, which the
// reader of meshes takes in, placed and joined to one mesh, with the diffuse colours of their
// materials. Any thread.
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
/// Of a body: many luminaires hang in a building, each with its own.
inline constexpr size_t luminaire_body_triangles = 200'000;
}  // namespace limits

/// The files of a body that luminaire_body() is to read later.
void foresee_body(const L3dModel& model, ReadingShare& reading);

struct LuminaireBody {
  Mesh mesh;  // metres, z up
  /// Diffuse colours of the model as linear RGB, each of all triangles up to the next.
  struct Colour {
    std::optional<glm::dvec3> value;  // none where the model says none
    size_t first_triangle = 0;
  };
  std::vector<Colour> colours;

  /// Whether the model says any.
  bool is_coloured() const;
};

/// The body in the model's metres, z up. `reading`, where given, hears how far it is.
/// Errors: a shape that cannot be read, by its name; more triangles than the limit; a place for the
/// shapes' files cannot be had.
Result<LuminaireBody> luminaire_body(const L3dModel& model, ReadingShare* reading = nullptr);

/// z of directions that are straight down, to within a degree, are below this.
inline constexpr double straight_down = -0.9998;

/// How far the body is moved, so that the middle of its luminous opening lies at the origin, and
/// whether it then hides light that goes down from there.
struct BodyPlace {
  glm::dvec3 offset_m{0};
  double below_m = 0;         // how far it reaches below the opening; 0: nothing is hidden
  glm::dvec3 down{0, 0, -1};  // where the opening shines
};

/// `opening`: its name in the model; where there is none of it, the one there is, else the lowest
/// point below the model's own origin. What reaches below an opening that shines straight down by
/// less than 0.1 m, as frames do, is raised to a millimetre above it, since intensities hold its
/// shadow already; nothing is lowered. Of other openings the body is a millimetre behind them.
BodyPlace body_place(const L3dModel& model, const Mesh& body, const std::string& opening);

/// Writes it as an OBJ file in metres, z up; of a coloured body with its material library beside
/// it, FILE.mtl. No colour reflects more than 0.9, as no paint does; what has none is grey of 0.7.
/// Errors: as write_file_atomically.
Result<void> write_body(const LuminaireBody& body, const std::filesystem::path& file);

}  // namespace luxodus
