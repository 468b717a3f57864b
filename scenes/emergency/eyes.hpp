// Colours of a sign as eyes see them: the difference of chromaticity between legend and ground, and
// the luminances of protan eyes, which have no cones for long wavelengths and see red darker. Pure
// functions; any thread.
#pragma once

#include <array>

namespace luxodus {

/// CIE 1931 tristimulus values, Y a luminance [cd/m2].
using Tristimulus = std::array<double, 3>;

/// Estimated colours of the light that arrives at an eye from one sign. All zero: not known.
struct ColoursAtEye {
  Tristimulus legend{}, ground{}, face{};  // face: mean of the two by area
  Tristimulus difference{};  // legend minus ground, without light that smoke scatters into the eye
  Tristimulus room{};        // of the light in the room, from which veils come; Y = 1
};

/// Luminance [cd/m2] for eyes without L cones (protanopes): that of M cones alone, which for light
/// of equal energy is the luminance of normal eyes. Law: cone fundamentals of Smith and Pokorny
/// 1975 (Vision Research 15, 161) in the form of Wyszecki and Stiles, Color Science, 1982, table
/// 2(8.2.5), M = -0.15516 X + 0.45692 Y + 0.03287 Z. Their X, Y, Z are those of Judd and Vos, which
/// differ from CIE 1931 below 460 nm.
double protan_luminance(const Tristimulus& light);

/// Distance in the CIE 1976 uniform chromaticity diagram (u', v'); some 0.004 are just noticed side
/// by side. NaN where either is dark.
double chromatic_difference(const Tristimulus& a, const Tristimulus& b);

}  // namespace luxodus
