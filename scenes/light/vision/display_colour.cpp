// Oklab takes cube roots of three cone signals. A colour's chroma at constant hue is scaled by s
// when each root is moved to L (1 + s d), where L is Oklab's lightness and d the root's relative
// distance from it. Oklab's lightness is not luminance, so L follows from the luminance wanted:
// XYZ, and with it linear sRGB, is proportional to L^3, and a sum of the cubes (1 + s d)^3.
#include "scenes/light/vision/display_colour.hpp"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace luxodus {

namespace {

/// Halvings of the interval of saturation: a thousandth is less than half a byte of any channel.
constexpr int halvings = 11;

/// Cone signals from XYZ (D65), and the weights of their roots in lightness: Ottosson 2020.
const glm::dmat3 cones_from_xyz =
    glm::transpose(glm::dmat3(0.8189330101, 0.3618667424, -0.1288597137, 0.0329845436, 0.9293118715,
                              0.0361456387, 0.0482003018, 0.2643662691, 0.6338517070));
constexpr glm::dvec3 lightness_weights{0.2104542553, 0.7936177850, -0.0040720468};

glm::dvec3 linear_srgb(const glm::dvec3& xyz) {
  const std::array<double, 3> rgb = linear_srgb_from_xyz({xyz.x, xyz.y, xyz.z});
  return {rgb[0], rgb[1], rgb[2]};
}

bool in_gamut(const glm::dvec3& rgb) {
  return std::min({rgb.x, rgb.y, rgb.z}) >= 0 && std::max({rgb.x, rgb.y, rgb.z}) <= 1;
}

}  // namespace

std::array<double, 3> display_colour(const Xyz& xyz, double shown) {
  const glm::dvec3 scaled = glm::dvec3(xyz[0], xyz[1], xyz[2]) * (shown / xyz[1]);
  glm::dvec3 inside = linear_srgb(scaled);
  if (!in_gamut(inside)) {
    static const glm::dmat3 xyz_from_cones = glm::inverse(cones_from_xyz);
    const glm::dvec3 cones = cones_from_xyz * scaled;
    const glm::dvec3 roots{std::cbrt(cones.x), std::cbrt(cones.y), std::cbrt(cones.z)};
    const double lightness = glm::dot(lightness_weights, roots);
    inside = glm::dvec3(shown);
    const glm::dvec3 apart = lightness > 0 ? roots / lightness - 1.0 : glm::dvec3(0);
    double low = 0, high = 1;
    for (int i = 0; i < halvings; ++i) {
      const double saturation = (low + high) / 2;
      const glm::dvec3 root = 1.0 + saturation * apart;
      const glm::dvec3 colour = xyz_from_cones * (root * root * root);
      const glm::dvec3 rgb = linear_srgb(colour * (shown / colour.y));
      const bool fits = colour.y > 0 && in_gamut(rgb);
      (fits ? low : high) = saturation;
      if (fits) inside = rgb;
    }
  }
  return {inside.x, inside.y, inside.z};
}

}  // namespace luxodus
