#include "scenes/light/optics/flame_spectrum.hpp"

#include <cmath>

namespace luxodus {

namespace {

/// Second radiation constant h c / k [m K] (CODATA 2018, exact in the SI).
constexpr double c2_m_k = 1.438776877e-2;

/// Integral of t^power / (e^t - 1) from x to infinity, as the sum over n of that of t^power e^(-n
/// t). Each term is Gamma(power + 1, n x) / n^(power + 1); x above 1 here, so that 40 terms leave
/// under e^-40.
double planck_tail(double x, int power) {
  double sum = 0;
  for (int n = 1; n <= 40; ++n) {
    // integral of t^p e^(-n t) from x = e^(-n x) (x^p / n + p x^(p-1) / n^2 + ... + p! / n^(p+1))
    double term = std::pow(x, power) / n, total = term;
    for (int k = power; k >= 1; --k) {
      term *= k / (x * n);
      total += term;
    }
    sum += std::exp(-n * x) * total;
  }
  return sum;
}

}  // namespace

FlameSpectrum flame_spectrum(double kelvin, bool soot) {
  // B(w) w^-1 dw ~ w^-6 / (e^(c2/wT) - 1) dw ~ t^4 / (e^t - 1) dt with t = c2/wT; black: t^3.
  FlameSpectrum f;
  for (int i = 0; i < spectrum_samples; ++i) {
    const double w = Spectrum::wavelength_nm(i);
    const double t = c2_m_k / (w * 1e-9 * kelvin);
    // Relative to 560 nm, so that 600 K does not underflow.
    const double t0 = c2_m_k / (560e-9 * kelvin);
    const double planck =
        std::pow(w / 560, -5) * std::exp(t0 - t) * -std::expm1(-t0) / -std::expm1(-t);
    f.shape.value[static_cast<size_t>(i)] = soot ? planck * 560 / w : planck;
  }
  f.shape = f.shape * (1 / f.shape.integral());
  const int power = soot ? 4 : 3;
  // Gamma(5) zeta(5) and Gamma(4) zeta(4) = pi^4 / 15: the integral over all t.
  const double all = soot ? 24 * 1.0369277551433699 : 6.4939394022668291;
  const double shortest = c2_m_k / (spectrum_first_nm * 1e-9 * kelvin);
  const double longest = c2_m_k / (spectrum_last_nm * 1e-9 * kelvin);
  f.visible_fraction = (planck_tail(longest, power) - planck_tail(shortest, power)) / all;
  return f;
}

}  // namespace luxodus
