// Light sources that an IFC model holds in the shape of a product: where they are, how they point,
// and their intensities where the model states them. Plain values, and a reader of them; one
// thread, since it reads through a StepGraph.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/light/geometry/transform.hpp"

namespace luxodus {

class StepGraph;
class StepNode;

namespace limits {
/// Intensities of one light source: 360 planes of 181 angles are 65 160.
inline constexpr size_t ifc_intensities = 100'000;
/// Light sources of one product that are looked at; the first counts.
inline constexpr size_t ifc_light_sources = 1'000;
}  // namespace limits

/// A half plane through the axis of a distribution of type C.
struct IfcLightPlane {
  double angle_deg = 0;
  std::vector<double> gammas_deg;
  std::vector<double> intensities;  // [cd/klm] or [cd/lm], see ies_text_of
};

struct IfcLightSource {
  std::string kind;        // "goniometric", "positional", "spot", "directional"
  glm::dvec3 position{0};  // in scene coordinates [m]
  glm::dvec3 axis{0, 0, -1};
  std::optional<glm::dvec3> zero_plane;  // direction of the plane C0; of goniometric ones
  std::string document;  // name of the photometric file that it names; "" where none
  std::optional<double> flux_lm;
  bool knows_angles = true;           // whether the model states the unit of its plane angles
  bool degrees_by_size = false;       // it states the radian, but its angles exceed a full circle
  std::vector<IfcLightPlane> planes;  // upwards by angle; empty where the model has none
  std::string type;                   // TYPE_C of the distribution
};

/// Units of a model that its light sources are in.
struct IfcLightUnits {
  double metres = 1;                   // of a length
  std::optional<double> angle_radian;  // of a plane angle; nothing where the model states none
};

/// The first light source in the shape of a product, which stands at `placement` (metres); a
/// goniometric one before others.
std::optional<IfcLightSource> ifc_light_of(StepGraph& graph, const StepNode& shape,
                                           const Transform& placement, const IfcLightUnits& units);

/// Its intensities as an IES file in absolute photometry, for its luminous flux. The schema allows
/// cd/klm and cd/lm: the unit is the one in which the source emits up to its flux, not more.
/// Errors: no flux or intensities, no unit of angles, a distribution of another type than C, planes
/// that differ in their angles, do not reach from 0 to 90 or 180 degrees, or leave a part of the
/// circle uncovered (they may end at 0, 90, 180 or 360 degrees, as in IES files, or one step before
/// 360 degrees), an intensity below 0.
Result<std::string> ies_text_of(const IfcLightSource& light, const std::string& name);

}  // namespace luxodus
