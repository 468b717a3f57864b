// False colour: values to colours whose lightness and hue both tell the value, on linear or
// logarithmic scales, with ticks at numbers people read. Pure functions; any thread.
//
// The map runs from dark violet through blue, teal and green to light yellow: lightness L* rises
// from 18 to 92 while the hue turns; chroma stays inside sRGB. It is re-parametrised by its length
// in CIELAB, so that equal steps in value are equal steps in colour difference, and it reads in
// grey print and for most colour-blind eyes, since lightness alone orders it.
#pragma once

#include <string>
#include <vector>

#include "scenes/vision/picture.hpp"

namespace luxodus {

/// Colour at position t of the map; t is clamped to [0, 1].
Rgb8 map_colour(double t);

/// What a value that is no number looks like: a grey that is not in the map.
inline constexpr Rgb8 no_value_colour{128, 128, 128};

struct FalseColourScale {
  double low = 0;            // value of the map's first colour
  double high = 1;           // value of its last; > low
  bool logarithmic = false;  // needs low > 0

  /// Position of a value on the scale: 0 at low, 1 at high, clamped to [0, 1]. NaN for NaN.
  double position(double value) const;
};

/// Largest span of a logarithmic scale [decades]: below the top by more than this nothing is drawn
/// apart.
inline constexpr double most_decades = 6;

/// A scale that holds these values between nice numbers (1, 2, 5 times powers of ten), a linear one
/// from 0 if they are not negative. Logarithmic scales ignore values <= 0. No usable value gives
/// 0..1 (or 0.1..1).
FalseColourScale nice_scale(const std::vector<float>& values, bool logarithmic);

/// Colour of a value; values outside take the end colours, NaN `no_value_colour`.
Rgb8 false_colour(const FalseColourScale& scale, double value);

/// A picture of width * height values, row-major. Requires: values.size() == width * height.
SrgbPicture false_colour_picture(const std::vector<float>& values, int width, int height,
                                 const FalseColourScale& scale);

struct Tick {
  double value = 0;
  double position = 0;  // on the scale, [0, 1]
  std::string text;     // "0.5", "1", "200"; without unit
};

/// At most `most` ticks (at least 2 are tried for) at nice numbers within the scale, ascending: 1,
/// 2, 5 per decade on a logarithmic scale as far as they fit, else whole decades; even steps on a
/// linear one.
std::vector<Tick> nice_ticks(const FalseColourScale& scale, int most);

/// A number as a person writes it on a scale: no exponent between 1e-4 and 1e6, no trailing zeros.
std::string number_text(double value);

}  // namespace luxodus
