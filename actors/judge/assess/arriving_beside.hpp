// Light that arrives straight at an eye that looks at a sign, but for that of the sign: disability
// glare. Deterministic. Thread rule: called within Building::each, with that call's access.
#pragma once

#include <vector>

#include "actors/judge/assess/assessment.hpp"
#include "actors/judge/inspect/building.hpp"

namespace luxodus {

/// Angle between two directions.
double angle_deg(const glm::dvec3& a, const glm::dvec3& b);

/// Factors of a scene's source groups, by mixture.
using GroupFactors = std::vector<std::vector<double>>;
GroupFactors factors_of(const CompiledScene& scene, const std::vector<GroupMixture>& mixtures);

struct ArrivingBeside {
  EyeLight at_eye;                               // of the first mixture
  std::vector<std::vector<double>> veils_cd_m2;  // veiling luminance, by age and mixture
};

/// Light that arrives at an eye which looks at the centre of a sign (its index in the scene). Each
/// part of an extended emitter, such as a flame, counts with its own direction and with the smoke
/// before it.
ArrivingBeside arriving_beside(const Building& building, const GeometryAccess& access,
                               const glm::dvec3& eye, const glm::dvec3& centre, uint32_t sign,
                               const std::vector<double>& ages, const GroupFactors& factors);

}  // namespace luxodus
