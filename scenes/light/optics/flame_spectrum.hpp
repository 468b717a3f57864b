// Spectrum of a flame from its temperature: Planck's law times the emissivity of a thin soot cloud,
// proportional to 1/wavelength (Rayleigh limit of small absorbing particles with a constant
// refractive index; Modest, Radiative Heat Transfer, ch. 12), or times a constant emissivity. Pure
// function; any thread.
#pragma once

#include "scenes/light/optics/spectrum.hpp"

namespace luxodus {

struct FlameSpectrum {
  Spectrum shape;           // integral 1 over 380..780 nm
  double visible_fraction;  // share of the power over all wavelengths that lies in 380..780 nm
};

/// Requires: kelvin in [600, 6000].
FlameSpectrum flame_spectrum(double kelvin, bool soot);

}  // namespace luxodus
