// The wavelength law of an extinction, on the spectral grid.
#include "scenes/light/optics/medium.hpp"

#include <cmath>

namespace luxodus {

// Angstrom's law: sigma_t(w) = sigma_t(w0) (w0 / w)^alpha. A table, being measured, replaces it.
Spectrum Extinction::spectrum() const {
  if (table) return *table;
  Spectrum out;
  for (int i = 0; i < spectrum_samples; ++i) {
    out.value[static_cast<size_t>(i)] =
        sigma_t * std::pow(wavelength_nm / Spectrum::wavelength_nm(i), angstrom);
  }
  return out;
}

}  // namespace luxodus
