// The quadric bodies that a scene can name, each as a Quadric with its bounding box, in local
// coordinates [m]. Axes of revolution are local z; the medium's Frame places and turns them. Other
// quadrics are given by their coefficients (medium.hpp). Pure functions, plain values; any thread.
#pragma once

#include <glm/glm.hpp>

#include "scenes/light/geometry/mesh.hpp"
#include "scenes/light/optics/medium.hpp"

namespace luxodus {

struct QuadricShape {
  Quadric quadric;
  Bounds bounds;
};

/// Centre at the origin. Requires (here and below): every length > 0 and finite.
QuadricShape ellipsoid(const glm::dvec3& radii);
/// A cylinder from z = 0 to z = height.
QuadricShape cylinder(double radius, double height);
/// Base of the given radius at z = 0, apex at z = height.
QuadricShape cone(double base_radius, double height);
/// Base of the given radius at z = 0, vertex at z = height.
QuadricShape paraboloid(double base_radius, double height);

}  // namespace luxodus
