// Colour from spectra, and between white points: XYZ of a spectrum, linear sRGB in both directions,
// chromatic adaptation (Bradford), correlated colour temperature. Pure functions on CIE 1931 XYZ;
// any thread.
#pragma once

#include <array>
#include <cstdint>

#include "scenes/light/optics/spectrum.hpp"

namespace luxodus {

using Xyz = std::array<double, 3>;

/// XYZ of the white of sRGB (chromaticity 0.3127, 0.3290) with Y = 1: linear sRGB (1, 1, 1).
inline constexpr Xyz d65_white{0.95045592705167, 1.0, 1.08905775075988};
/// XYZ of equal energy with Y = 1.
inline constexpr Xyz equal_energy_white{1.0, 1.0, 1.0};

/// XYZ of light of this spectrum, Y being the integral of spectrum * V (no factor 683).
Xyz xyz_of(const Spectrum& light);

/// CIE XYZ of linear sRGB (IEC 61966-2-1), Y = 1 for (1, 1, 1).
Xyz xyz_from_linear_srgb(const std::array<double, 3>& rgb);

/// The sRGB byte of a linear value: clamped to [0, 1], encoded, rounded. NaN gives 0.
uint8_t srgb_byte(double linear);

/// The colour that looks under white `to` as `colour` does under white `from`: Bradford transform,
/// linear form (Lam 1985; ICC.1:2010 annex E).
Xyz adapt_white(const Xyz& colour, const Xyz& from, const Xyz& to);

/// The colour at another luminance; black stays black.
Xyz with_luminance(const Xyz& colour, double luminance);

/// A chromaticity relative to the Planckian locus.
struct ColourTemperature {
  double kelvin = 0;  // of the nearest black body in CIE 1960 (u, v)
  double duv = 0;     // distance to it, >= 0
};
/// Correlated colour temperature (CIE 015, section 9.5), searched over 1000..25000 K.
/// Requires: X + 15 Y + 3 Z > 0.
ColourTemperature correlated_colour_temperature(const Xyz& colour);

}  // namespace luxodus
