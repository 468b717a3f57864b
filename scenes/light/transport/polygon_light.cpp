#include "scenes/light/transport/polygon_light.hpp"

#include <array>
#include <cmath>

namespace luxodus {

namespace {

/// A polygon clipped at the horizon: at most one corner more.
struct Clipped {
  std::array<glm::dvec3, limits::polygon_corners + 1> corner{};
  size_t count = 0;
};

Clipped above_horizon(std::span<const glm::dvec3> corners, const glm::dvec3& normal) {
  Clipped out;
  const size_t n = corners.size();
  for (size_t i = 0; i < n; ++i) {
    const glm::dvec3& a = corners[i];
    const glm::dvec3& b = corners[(i + 1) % n];
    const double at_a = glm::dot(normal, a), at_b = glm::dot(normal, b);
    if (at_a >= 0) out.corner[out.count++] = a;
    if ((at_a >= 0) != (at_b >= 0)) out.corner[out.count++] = a + (b - a) * (at_a / (at_a - at_b));
  }
  return out;
}

}  // namespace

double projected_solid_angle(std::span<const glm::dvec3> corners, const glm::dvec3& normal) {
  const Clipped polygon = above_horizon(corners, normal);
  double sum = 0;
  for (size_t i = 0; i < polygon.count; ++i) {
    const glm::dvec3& a = polygon.corner[i];
    const glm::dvec3& b = polygon.corner[(i + 1) % polygon.count];
    const glm::dvec3 across = glm::cross(a, b);
    const double sine = glm::length(across);
    if (sine > 0) sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(normal, across) / sine;
  }
  return std::abs(sum) / 2;  // the sign depends on the corners' orientation
}

double solid_angle(std::span<const glm::dvec3> corners) {
  double sum = 0;
  const glm::dvec3& a = corners[0];
  for (size_t i = 1; i + 1 < corners.size(); ++i) {
    const glm::dvec3 &b = corners[i], &c = corners[i + 1];
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double volume = glm::dot(a, glm::cross(b, c));
    const double below =
        la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la;
    sum += 2 * std::atan2(volume, below);
  }
  return std::abs(sum);
}

}  // namespace luxodus
