// Spectra on the 5 nm grid. Every integral is the trapezoidal sum over the nodes, so that sums over
// bands (bands.cpp) and integrals over all wavelengths agree to rounding. Colours become spectra by
// Jakob and Hanika's sigmoid of a parabola ("A low-dimensional function space for efficient
// spectral upsampling", Eurographics 2019): smooth, within (0, 1) by construction, three
// coefficients for three tristimulus values, solved for each colour by damped Gauss-Newton steps
// instead of a table.
#include "scenes/light/optics/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scenes/light/optics/chromaticity.hpp"
#include "scenes/light/optics/cie_tables.hpp"

namespace luxodus {
namespace {

// Second radiation constant h c / k [nm K] (CODATA 2018, exact in the SI).
constexpr double second_radiation_nm_k = 1.438776877e7;

Spectrum normalised(Spectrum s) {
  return s * (1 / s.integral());
}

// Logarithm of Planck's law without its constant: finite at 10 K, where the radiance underflows.
double log_planck(double wavelength_nm, double kelvin) {
  const double x = second_radiation_nm_k / (wavelength_nm * kelvin);
  return -5 * std::log(wavelength_nm) - x - std::log1p(-std::exp(-x));
}

// Two half Gaussians that meet at the peak; widths are full widths at half maximum of each side
// [nm].
Spectrum lobe(double peak_nm, double width_below_nm, double width_above_nm) {
  Spectrum s;
  for (int i = 0; i < spectrum_samples; ++i) {
    const double off_nm = Spectrum::wavelength_nm(i) - peak_nm;
    const double half = 0.5 * (off_nm < 0 ? width_below_nm : width_above_nm);
    s.value[static_cast<size_t>(i)] = std::exp2(-(off_nm / half) * (off_nm / half));
  }
  return normalised(s);
}

using Vector3 = std::array<double, 3>;
using Columns3 = std::array<Vector3, 3>;

double triple(const Vector3& a, const Vector3& b, const Vector3& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// Cramer's rule for sum_k x_k column_k = right.
Vector3 solve(const Columns3& column, const Vector3& right) {
  const double d = triple(column[0], column[1], column[2]);
  return {triple(right, column[1], column[2]) / d, triple(column[0], right, column[2]) / d,
          triple(column[0], column[1], right) / d};
}

double sigmoid(double t) {
  return 0.5 + 0.5 * t / std::sqrt(1 + t * t);
}
double sigmoid_slope(double t) {
  const double r = 1 / std::sqrt(1 + t * t);
  return 0.5 * r * r * r;
}

// A reflectance sigmoid(c0 + c1 u + c2 u^2), u running from -1 to 1 over the grid.
struct SmoothReflectance {
  Vector3 c{};

  static double u(int i) { return 2.0 * i / (spectrum_samples - 1) - 1; }
  double argument(int i) const { return c[0] + u(i) * (c[1] + u(i) * c[2]); }
  Spectrum spectrum() const {
    Spectrum s;
    for (int i = 0; i < spectrum_samples; ++i)
      s.value[static_cast<size_t>(i)] = sigmoid(argument(i));
    return s;
  }
};

// Finds the smooth reflectance whose colour under one light is wanted.
class ColourMatch {
 public:
  explicit ColourMatch(const Spectrum& light) {
    const Spectrum l = light * (1 / light.integral_with(cie_y()));
    seen_by_ = {l * cie_x(), l * cie_y(), l * cie_z()};
  }

  Vector3 white() const { return colour(Spectrum::constant(1)); }

  // Levenberg-Marquardt from the grey of the wanted luminance. Very saturated colours would need
  // ever steeper sigmoids; then the best one within the step limit is returned.
  SmoothReflectance find(const Vector3& wanted) const {
    constexpr int max_steps = 200;
    constexpr double good_enough = 1e-24;  // squared XYZ distance: rounding
    SmoothReflectance best;
    const double grey = std::clamp(2 * wanted[1] - 1, -0.999, 0.999);
    best.c[0] = grey / std::sqrt(1 - grey * grey);
    double error = squared_error(best, wanted);
    double damping = 1e-3;
    for (int step = 0; step < max_steps && error > good_enough; ++step) {
      const SmoothReflectance next = damped_step(best, wanted, damping);
      const double next_error = squared_error(next, wanted);
      if (next_error < error) {
        best = next;
        error = next_error;
        damping = std::max(1e-14, damping * 0.2);
      } else {
        damping *= 5;
        if (damping > 1e12) break;
      }
    }
    return best;
  }

 private:
  Vector3 colour(const Spectrum& reflectance) const {
    return {seen_by_[0].integral_with(reflectance), seen_by_[1].integral_with(reflectance),
            seen_by_[2].integral_with(reflectance)};
  }

  double squared_error(const SmoothReflectance& r, const Vector3& wanted) const {
    const Vector3 is = colour(r.spectrum());
    double sum = 0;
    for (size_t k = 0; k < 3; ++k) sum += (is[k] - wanted[k]) * (is[k] - wanted[k]);
    return sum;
  }

  SmoothReflectance damped_step(const SmoothReflectance& at, const Vector3& wanted,
                                double damping) const {
    Spectrum slope;
    for (int i = 0; i < spectrum_samples; ++i)
      slope.value[static_cast<size_t>(i)] = sigmoid_slope(at.argument(i));
    Columns3 jacobian{};  // jacobian[j][k] = d colour_k / d c_j
    for (size_t j = 0; j < 3; ++j) {
      for (size_t k = 0; k < 3; ++k) jacobian[j][k] = slope.integral_with(seen_by_[k]);
      for (int i = 0; i < spectrum_samples; ++i)
        slope.value[static_cast<size_t>(i)] *= SmoothReflectance::u(i);
    }
    const Vector3 is = colour(at.spectrum());
    Columns3 normal{};
    Vector3 gradient{};
    for (size_t j = 0; j < 3; ++j) {
      for (size_t k = 0; k < 3; ++k) {
        gradient[j] += jacobian[j][k] * (wanted[k] - is[k]);
        for (size_t l = 0; l < 3; ++l) normal[j][l] += jacobian[j][k] * jacobian[l][k];
      }
    }
    // The floor keeps the system solvable where the sigmoid is flat, in addition to Marquardt's
    // scaling.
    for (size_t j = 0; j < 3; ++j) normal[j][j] += damping * (normal[j][j] + 1e-12);
    const Vector3 d = solve(normal, gradient);
    SmoothReflectance next = at;
    for (size_t j = 0; j < 3; ++j) next.c[j] += d[j];
    return next;
  }

  std::array<Spectrum, 3> seen_by_;
};

}  // namespace

// ---- the grid -----------------------------------------------------------------------------------

Spectrum Spectrum::constant(double v) {
  Spectrum s;
  s.value.fill(v);
  return s;
}

double Spectrum::at(double wavelength_nm) const {
  const double position = (wavelength_nm - spectrum_first_nm) / spectrum_step_nm;
  if (!(position > 0)) return value.front();
  if (position >= spectrum_samples - 1) return value.back();
  const auto i = static_cast<size_t>(position);
  const double f = position - static_cast<double>(i);
  return value[i] + f * (value[i + 1] - value[i]);
}

double Spectrum::integral() const {
  double sum = -0.5 * (value.front() + value.back());
  for (double v : value) sum += v;
  return spectrum_step_nm * sum;
}

double Spectrum::integral_with(const Spectrum& other) const {
  return (*this * other).integral();
}

bool Spectrum::is_constant(double relative_tolerance) const {
  const auto [low, high] = std::minmax_element(value.begin(), value.end());
  return *high - *low <= relative_tolerance * std::max(std::abs(*low), std::abs(*high));
}

Spectrum operator*(const Spectrum& a, double k) {
  Spectrum out;
  for (size_t i = 0; i < out.value.size(); ++i) out.value[i] = a.value[i] * k;
  return out;
}

Spectrum operator+(const Spectrum& a, const Spectrum& b) {
  Spectrum out;
  for (size_t i = 0; i < out.value.size(); ++i) out.value[i] = a.value[i] + b.value[i];
  return out;
}

Spectrum operator*(const Spectrum& a, const Spectrum& b) {
  Spectrum out;
  for (size_t i = 0; i < out.value.size(); ++i) out.value[i] = a.value[i] * b.value[i];
  return out;
}

// ---- illuminants --------------------------------------------------------------------------------

Spectrum blackbody_shape(double kelvin) {
  Spectrum s;
  for (int i = 0; i < spectrum_samples; ++i)
    s.value[static_cast<size_t>(i)] = log_planck(Spectrum::wavelength_nm(i), kelvin);
  const double highest = *std::max_element(s.value.begin(), s.value.end());
  for (double& v : s.value) v = std::exp(v - highest);
  return normalised(s);
}

Spectrum illuminant_a_shape() {
  // ISO/CIE 11664-2: 100 (560/w)^5 (e^(1.435e7/(2848*560)) - 1) / (e^(1.435e7/(2848 w)) - 1). These
  // constants are the definition, even though c2 has changed since (they give 2856 K on today's
  // scale).
  Spectrum s;
  for (int i = 0; i < spectrum_samples; ++i) {
    const double w = Spectrum::wavelength_nm(i);
    s.value[static_cast<size_t>(i)] = 100 * std::pow(560 / w, 5) *
                                      std::expm1(1.435e7 / (2848 * 560.0)) /
                                      std::expm1(1.435e7 / (2848 * w));
  }
  return normalised(s);
}

Spectrum illuminant_d65_shape() {
  return normalised(cie_d65_table());
}

Spectrum white_led_shape(double cct_kelvin) {
  // A blue pump (InGaN, 452 nm, 23 nm wide) and two broad phosphor lobes (garnet green-yellow,
  // nitride red), with typical widths of such phosphors. The weights of the three lobes solve a
  // linear system for three tristimulus values, so that the colour is that of the black body, at
  // distance 0 from the Planckian locus. They are positive for 1800..40000 K; the temperature is
  // clamped to that range.
  const double kelvin = std::clamp(cct_kelvin, 1800.0, 40000.0);
  const std::array<Spectrum, 3> lobes{lobe(452, 20, 26), lobe(536, 66, 106), lobe(617, 84, 104)};
  const Columns3 colours{xyz_of(lobes[0]), xyz_of(lobes[1]), xyz_of(lobes[2])};
  const Vector3 weight = solve(colours, xyz_of(blackbody_shape(kelvin)));
  return normalised(lobes[0] * weight[0] + lobes[1] * weight[1] + lobes[2] * weight[2]);
}

Spectrum coloured_led_shape(LedColour colour) {
  // Peaks and widths that data sheets of indicator and signal diodes usually state: AlInGaP for red
  // and yellow, InGaN for green and blue.
  switch (colour) {
    case LedColour::red:
      return lobe(632, 18, 18);
    case LedColour::yellow:
      return lobe(590, 15, 15);
    case LedColour::green:
      return lobe(525, 32, 32);
    case LedColour::blue:
      return lobe(468, 24, 24);
  }
  return lobe(632, 18, 18);
}

Spectrum afterglow_shape() {
  // SrAl2O4:Eu,Dy (Matsuzawa et al. 1996, J. Electrochem. Soc. 143, 2670): one band of the Eu2+
  // transition at 520 nm, some 80 nm wide.
  return lobe(520, 70, 90);
}

Spectrum equal_energy_shape() {
  return Spectrum::constant(1 / (spectrum_last_nm - spectrum_first_nm));
}

double efficacy_lm_per_w(const Spectrum& shape) {
  return luminous_efficacy_lm_per_w * shape.integral_with(cie_y()) / shape.integral();
}

// ---- from colours -------------------------------------------------------------------------------

Spectrum reflectance_from_linear_srgb(double r, double g, double b) {
  r = std::clamp(r, 0.0, 1.0);
  g = std::clamp(g, 0.0, 1.0);
  b = std::clamp(b, 0.0, 1.0);
  if (r == g && g == b) return Spectrum::constant(r);
  // sRGB is a colour under D65; under equal energy the surface has the adapted XYZ. The white used
  // for adaptation is that of the tables, which is (1, 1, 1) to 1e-5, so that a near grey is nearly
  // constant.
  const ColourMatch match(equal_energy_shape());
  const Vector3 wanted = adapt_white(xyz_from_linear_srgb({r, g, b}), d65_white, match.white());
  return match.find(wanted).spectrum();
}

Spectrum emission_shape_from_linear_srgb(double r, double g, double b) {
  r = std::max(r, 0.0);
  g = std::max(g, 0.0);
  b = std::max(b, 0.0);
  const double highest = std::max({r, g, b});
  if (highest <= 0 || (r == g && g == b)) return illuminant_d65_shape();
  // D65 through a filter. Only the chromaticity matters, so the filter may be dark: a fifth of full
  // brightness gives the sigmoid room for saturated colours without steep flanks.
  const double k = 0.2 / highest;
  const Vector3 wanted = xyz_from_linear_srgb({k * r, k * g, k * b});
  const Spectrum light = illuminant_d65_shape();
  return normalised(light * ColourMatch(light).find(wanted).spectrum());
}

}  // namespace luxodus
