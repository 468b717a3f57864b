// The table of illuminant D65 as the CIE publishes it, for spectrum.cpp; other code uses
// illuminant_d65_shape(). The colour-matching functions are declared in spectrum.hpp. Constant
// data; any thread.
#pragma once

#include "scenes/light/optics/spectrum.hpp"

namespace luxodus {

/// Relative spectral power of CIE illuminant D65, 100 at 560 nm.
const Spectrum& cie_d65_table();

}  // namespace luxodus
