#include "scenes/light/optics/chromaticity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace luxodus {
namespace {

using Matrix3 = std::array<Xyz, 3>;

// IEC 61966-2-1 primaries (0.64, 0.33), (0.30, 0.60), (0.15, 0.06) and white (0.3127, 0.3290),
// carried to more digits than the four of the standard so that the two matrices invert each other.
constexpr Matrix3 xyz_from_srgb{{{0.41239079926596, 0.35758433938388, 0.18048078840183},
                                 {0.21263900587151, 0.71516867876776, 0.07219231536073},
                                 {0.01933081871559, 0.11919477979463, 0.95053215224966}}};
constexpr Matrix3 srgb_from_xyz{{{3.24096994190452, -1.53738317757009, -0.49861076029300},
                                 {-0.96924363628088, 1.87596750150772, 0.04155505740718},
                                 {0.05563007969699, -0.20397695888898, 1.05697151424288}}};

// Bradford cone responses and back (ICC.1:2010 annex E; the inverse to the same digits).
constexpr Matrix3 cones_from_xyz{
    {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
constexpr Matrix3 xyz_from_cones{{{0.986992905466712, -0.147054256420990, 0.159962651663731},
                                  {0.432305269723395, 0.518360271536777, 0.049291228212856},
                                  {-0.008528664575177, 0.040042821654085, 0.968486695787550}}};

Xyz product(const Matrix3& m, const Xyz& v) {
  Xyz out{};
  for (size_t i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return out;
}

struct Uv {
  double u;
  double v;
};

// CIE 1960 uniform chromaticity: the plane in which colour temperature is defined.
Uv uv_1960(const Xyz& c) {
  const double d = c[0] + 15 * c[1] + 3 * c[2];
  return {4 * c[0] / d, 6 * c[1] / d};
}

double distance_to_black_body(const Uv& p, double mired) {
  const Uv q = uv_1960(xyz_of(blackbody_shape(1e6 / mired)));
  return std::hypot(p.u - q.u, p.v - q.v);
}

}  // namespace

Xyz xyz_of(const Spectrum& light) {
  return {light.integral_with(cie_x()), light.integral_with(cie_y()), light.integral_with(cie_z())};
}

Xyz xyz_from_linear_srgb(const std::array<double, 3>& rgb) {
  return product(xyz_from_srgb, rgb);
}

std::array<double, 3> linear_srgb_from_xyz(const std::array<double, 3>& xyz) {
  return product(srgb_from_xyz, xyz);
}

// IEC 61966-2-1: a linear part near 0, then a power law.
uint8_t srgb_byte(double linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 255;
  const double encoded =
      linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
  return static_cast<uint8_t>(std::lround(255 * encoded));
}

Xyz adapt_white(const Xyz& colour, const Xyz& from, const Xyz& to) {
  const Xyz cones_from = product(cones_from_xyz, from);
  const Xyz cones_to = product(cones_from_xyz, to);
  Xyz cones = product(cones_from_xyz, colour);
  for (size_t i = 0; i < 3; ++i) cones[i] *= cones_to[i] / cones_from[i];
  return product(xyz_from_cones, cones);
}

Xyz with_luminance(const Xyz& colour, double luminance) {
  const double scale = colour[1] > 0 ? luminance / colour[1] : 0;
  return {colour[0] * scale, colour[1] * scale, colour[2] * scale};
}

ColourTemperature correlated_colour_temperature(const Xyz& colour) {
  const Uv p = uv_1960(colour);
  // In mired (1e6 / K), steps along the locus are nearly even. A coarse scan finds the right
  // minimum, since the distance has several for colours far from the locus; golden section search
  // then refines it.
  constexpr double coolest = 40, warmest = 1000, coarse = 10;
  double best = coolest;
  double least = std::numeric_limits<double>::infinity();
  for (double mired = coolest; mired <= warmest; mired += coarse) {
    const double d = distance_to_black_body(p, mired);
    if (d < least) {
      least = d;
      best = mired;
    }
  }
  double low = std::max(coolest, best - coarse);
  double high = std::min(warmest, best + coarse);
  const double ratio = (std::sqrt(5.0) - 1) / 2;
  while (high - low > 1e-4) {
    const double a = high - ratio * (high - low);
    const double b = low + ratio * (high - low);
    if (distance_to_black_body(p, a) < distance_to_black_body(p, b)) {
      high = b;
    } else {
      low = a;
    }
  }
  const double mired = 0.5 * (low + high);
  return {1e6 / mired, distance_to_black_body(p, mired)};
}

}  // namespace luxodus
