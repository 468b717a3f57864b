// The colour map for luminance and illuminance, used by false-colour pictures, isolux lines of
// plans, and the page of the live view (actors/apps/view/page/src/light/colour_map.js is generated
// from it). Lightness (OKLab) rises evenly from near black over violet, red and orange to pale
// yellow, so that the map works in grey and for colour-blind readers. Pure functions; any thread.
#pragma once

#include <array>
#include <cstdint>

namespace luxodus {

using LightColour = std::array<uint8_t, 3>;  // 8-bit sRGB

/// Colour at a place of the map: 0 darkest, 1 lightest; clamped, and that of 0 for NaN.
LightColour light_colour(double t);

/// A fixed scale over whole decades: equal steps on the map are equal ratios of values.
struct LightScale {
  double low = 0, high = 1;  // > 0
  /// Place on the map, not clamped; below 0 for values that are not positive.
  double place(double value) const;
};

/// The fixed scales for lx and cd/m2. Isolux lines of plans use the first, the page of the live
/// view the second. Maps as PNG have a scale bar of their own over the same colours, fitted to
/// their values (false_colour_png.hpp).
inline constexpr LightScale illuminance_scale{0.1, 100};  // [lx] dark enough for lines on paper
inline constexpr LightScale luminance_scale{1e-3, 1e3};   // [cd/m2] moonlit floor to luminaire

LightColour colour_of_illuminance(double illuminance_lx);

}  // namespace luxodus
