#include "scenes/light/vision/adapted_white.hpp"

#include <cmath>
#include <glm/glm.hpp>

namespace luxodus {

namespace {

/// Responses of cones (Hunt, Pointer and Estevez), equal for equal energy.
const glm::dmat3 cones_of_xyz =
    glm::transpose(glm::dmat3(glm::dvec3(0.38971, 0.68898, -0.07868),
                              glm::dvec3(-0.22981, 1.18340, 0.04641), glm::dvec3(0, 0, 1)));

const glm::dmat3 xyz_of_cones = glm::inverse(cones_of_xyz);

glm::dvec3 vector_of(const Xyz& xyz) {
  return {xyz[0], xyz[1], xyz[2]};
}

/// Gain of each kind of cones of an eye that is adapted to this light.
glm::dvec3 gains(const Xyz& light) {
  const double root = std::cbrt(light[1]);
  const glm::dvec3 cones = cones_of_xyz * (vector_of(light) / light[1]);
  const double sum = cones.x + cones.y + cones.z;
  glm::dvec3 out(1);
  for (int k = 0; k < 3; ++k) {
    const double against_equal = 3 * cones[k] / sum;
    const double degree = (1 + root + against_equal) / (1 + root + 1 / against_equal);
    out[k] = degree / cones[k];
  }
  return out;
}

}  // namespace

AdaptedWhite::AdaptedWhite(const Xyz& light, double monitor_cd_m2) {
  const Xyz monitor{d65_white[0] * monitor_cd_m2, monitor_cd_m2, d65_white[2] * monitor_cd_m2};
  const glm::dvec3 factor = gains(light) / gains(monitor);
  factor_ = {factor.x, factor.y, factor.z};
}

Xyz AdaptedWhite::on_monitor(const Xyz& colour) const {
  const glm::dvec3 cones = cones_of_xyz * vector_of(colour);
  const glm::dvec3 seen = xyz_of_cones * (cones * glm::dvec3(factor_[0], factor_[1], factor_[2]));
  return with_luminance({seen.x, seen.y, seen.z}, colour[1]);
}

}  // namespace luxodus
