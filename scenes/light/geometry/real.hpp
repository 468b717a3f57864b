// The floating-point type that light is computed with. What is *stored* (corners of triangles,
// arrays of smoke, texels, files, pictures) is float in every build. What is computed from it
// (rays, hits, directions, densities) is Real: float, or double in a build with
// LUX_PRECISION=double, which checks whether float is enough (tests/precision). Optical depths and
// all read-out are double in both. docs/precision.md lists which is used where, and the cost. Plain
// values; any thread.
#pragma once

#include <glm/glm.hpp>
#include <type_traits>

namespace luxodus {

#ifdef LUX_DOUBLE
using Real = double;
#else
using Real = float;
#endif
inline constexpr bool computes_in_double = std::is_same_v<Real, double>;

using Vec2 = glm::vec<2, Real>;
using Vec3 = glm::vec<3, Real>;
using Mat3 = glm::mat<3, 3, Real>;

/// A constant of the computation, 0.5_r, rounded once at compile time to the build's type.
consteval Real operator""_r(long double value) {
  return static_cast<Real>(value);
}

}  // namespace luxodus
