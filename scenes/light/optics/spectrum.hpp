// Spectra on one grid of 5 nm from 380 to 780 nm, the CIE functions, and the illuminants that a
// scene can name. Emission shapes are per nm and relative unless stated. Plain values; any thread.
#pragma once

#include <array>
#include <string_view>

namespace luxodus {

inline constexpr int spectrum_samples = 81;
inline constexpr double spectrum_first_nm = 380.0;
inline constexpr double spectrum_step_nm = 5.0;
inline constexpr double spectrum_last_nm = 780.0;

/// Luminous efficacy of monochromatic radiation at 540 THz [lm/W] (SI definition, K_cd = 683).
inline constexpr double luminous_efficacy_lm_per_w = 683.0;
/// Scotopic counterpart [lm'/W].
inline constexpr double scotopic_efficacy_lm_per_w = 1700.05;

struct Spectrum {
  std::array<double, spectrum_samples> value{};

  static Spectrum constant(double v);
  static double wavelength_nm(int i) { return spectrum_first_nm + spectrum_step_nm * i; }

  /// Linear interpolation; constant beyond the ends.
  double at(double wavelength_nm) const;
  /// Trapezoidal integral over [380, 780] nm.
  double integral() const;
  /// Integral of the product with another spectrum.
  double integral_with(const Spectrum& other) const;
  bool is_constant(double relative_tolerance = 1e-6) const;
};

Spectrum operator*(const Spectrum& a, double k);
Spectrum operator+(const Spectrum& a, const Spectrum& b);
Spectrum operator*(const Spectrum& a, const Spectrum& b);

/// CIE 1931 2-degree colour-matching functions; y is V(lambda). V' is CIE 1951 scotopic.
const Spectrum& cie_x();
const Spectrum& cie_y();
const Spectrum& cie_z();
const Spectrum& cie_scotopic();

/// Relative spectral shapes, normalised to an integral of 1 over [380, 780] nm.
Spectrum blackbody_shape(double kelvin);
Spectrum illuminant_a_shape();
Spectrum illuminant_d65_shape();
/// A phosphor-converted white LED of about the given correlated colour temperature (2700..6500 K).
Spectrum white_led_shape(double cct_kelvin);
/// A light-emitting diode of one colour, without phosphor.
enum class LedColour { red, yellow, green, blue };
Spectrum coloured_led_shape(LedColour colour);
/// The afterglow of strontium aluminate with europium and dysprosium, as in safety signs.
Spectrum afterglow_shape();
Spectrum equal_energy_shape();

/// Luminous flux [lm] per radiant watt within [380, 780] nm of a shape.
double efficacy_lm_per_w(const Spectrum& shape);

/// A smooth reflectance in [0, 1] whose colour under equal-energy light is the given linear sRGB.
/// Grey input gives a constant spectrum exactly.
Spectrum reflectance_from_linear_srgb(double r, double g, double b);
/// An emission shape (integral 1) whose chromaticity is that of the given linear sRGB.
Spectrum emission_shape_from_linear_srgb(double r, double g, double b);

/// Linear sRGB (D65 white) from CIE XYZ; may be outside [0, 1].
std::array<double, 3> linear_srgb_from_xyz(const std::array<double, 3>& xyz);

}  // namespace luxodus
