// Every shape is scaled so that the quadric's value is about -1 inside: lengths enter as ratios, so
// millimetres and kilometres keep the same precision.
#include "scenes/light/optics/quadric_shapes.hpp"

namespace luxodus {

namespace {

Bounds upright_box(double radius, double height) {
  return {glm::dvec3(-radius, -radius, 0), glm::dvec3(radius, radius, height)};
}

glm::dmat3 diagonal(double x, double y, double z) {
  glm::dmat3 m(0.0);
  m[0][0] = x;
  m[1][1] = y;
  m[2][2] = z;
  return m;
}

void clip_between(Quadric& q, double z_low, double z_high) {
  q.clips.push_back({glm::dvec3(0, 0, -1), -z_low});
  q.clips.push_back({glm::dvec3(0, 0, 1), z_high});
}

}  // namespace

// (x/rx)^2 + (y/ry)^2 + (z/rz)^2 <= 1
QuadricShape ellipsoid(const glm::dvec3& radii) {
  QuadricShape out;
  const glm::dvec3 inverse = 1.0 / radii;
  out.quadric.a = diagonal(inverse.x * inverse.x, inverse.y * inverse.y, inverse.z * inverse.z);
  out.quadric.c = -1;
  out.bounds = {-radii, radii};
  return out;
}

// (x^2 + y^2) / r^2 <= 1
QuadricShape cylinder(double radius, double height) {
  QuadricShape out;
  const double k = 1 / (radius * radius);
  out.quadric.a = diagonal(k, k, 0);
  out.quadric.c = -1;
  clip_between(out.quadric, 0, height);
  out.bounds = upright_box(radius, height);
  return out;
}

// (x^2 + y^2) / r^2 <= (1 - z/h)^2; the clip at the apex cuts the second nappe away.
QuadricShape cone(double base_radius, double height) {
  QuadricShape out;
  const double k = 1 / (base_radius * base_radius);
  out.quadric.a = diagonal(k, k, -1 / (height * height));
  out.quadric.b = glm::dvec3(0, 0, 2 / height);
  out.quadric.c = -1;
  clip_between(out.quadric, 0, height);
  out.bounds = upright_box(base_radius, height);
  return out;
}

// (x^2 + y^2) / r^2 <= 1 - z/h
QuadricShape paraboloid(double base_radius, double height) {
  QuadricShape out;
  const double k = 1 / (base_radius * base_radius);
  out.quadric.a = diagonal(k, k, 0);
  out.quadric.b = glm::dvec3(0, 0, 1 / height);
  out.quadric.c = -1;
  clip_between(out.quadric, 0, height);
  out.bounds = upright_box(base_radius, height);
  return out;
}

}  // namespace luxodus
