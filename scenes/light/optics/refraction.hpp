// A smooth boundary between two transparent media: Fresnel's equations give the reflected share of
// the light, Snell's law the direction of the rest. Pure functions; any thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "scenes/light/geometry/real.hpp"

namespace luxodus {

namespace surface_limits {
/// Least cosine of incidence (6e-5 degrees above the plane); smaller ones are raised to it, so that
/// Fresnel's terms stay defined.
inline constexpr Real min_cos = 1e-6_r;
/// Range of refractive indices relative to the outside: from a bubble in diamond to beyond any
/// transparent solid.
inline constexpr double min_ior = 0.2;
inline constexpr double max_ior = 5.0;
}  // namespace surface_limits

/// Reflectance r and 1 - r of one boundary for one polarisation; t is computed with an accuracy of
/// its own.
struct FresnelShares {
  Real r;
  Real t;
};

/// Fresnel's equations for both polarisations, and the cosine behind the boundary (0: total
/// reflection).
struct FresnelTerms {
  FresnelShares s;
  FresnelShares p;
  Real cos_behind;
};
inline FresnelTerms fresnel(Real cos_theta, Real ior) {
  const Real c = std::clamp(cos_theta, surface_limits::min_cos, 1.0_r);
  const Real square = ior * ior - (1.0_r - c) * (1.0_r + c);  // (n cos behind)^2
  if (square <= 0.0_r) return {{1.0_r, 0.0_r}, {1.0_r, 0.0_r}, 0.0_r};
  const Real b = std::sqrt(square);
  const Real cos_behind = b / ior;
  // r = ((x - y) / (x + y))^2 and 1 - r = 4 x y / (x + y)^2.
  const auto shares = [](Real x, Real y) {
    const Real inverse = 1.0_r / (x + y);
    const Real amplitude = (x - y) * inverse;
    return FresnelShares{amplitude * amplitude, 4.0_r * (x * inverse) * (y * inverse)};
  };
  return {shares(c, b), shares(ior * c, cos_behind), cos_behind};
}

/// Snell's law: the tangential part shrinks by 1 / ior, the normal part is `cos_behind` of
/// fresnel(). `incoming` travels towards the surface, against `normal`; both unit.
/// Requires: cos_behind > 0.
inline Vec3 refracted(const Vec3& incoming, const Vec3& normal, Real cos_theta, Real ior,
                      Real cos_behind) {
  const Real inverse = 1.0_r / ior;
  return glm::normalize(incoming * inverse + normal * (cos_theta * inverse - cos_behind));
}

}  // namespace luxodus
