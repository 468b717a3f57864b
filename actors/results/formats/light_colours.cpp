#include "actors/results/formats/light_colours.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "scenes/light/optics/chromaticity.hpp"

namespace luxodus {
namespace {

constexpr int table_steps = 2048;

/// OKLab in polar form to linear sRGB (B. Ottosson, "A perceptual color space for image
/// processing", 2020).
std::array<double, 3> linear_srgb_of_oklch(double lightness, double chroma, double hue) {
  const double a = chroma * std::cos(hue);
  const double b = chroma * std::sin(hue);
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

bool in_gamut(const std::array<double, 3>& rgb) {
  return std::all_of(rgb.begin(), rgb.end(), [](double c) { return c >= 0 && c <= 1; });
}

LightColour computed_colour(double t) {
  const double lightness = 0.10 + 0.87 * t;
  const double hue = (-78 + 186 * t) * std::numbers::pi / 180;  // violet, red, orange, yellow
  // Reduces the chroma at both ends, where sRGB holds little; bisection cuts the rest to the gamut,
  // so that no steps show.
  double chroma = 0.175 * std::pow(std::sin(std::numbers::pi * (0.06 + 0.86 * t)), 0.8);
  if (!in_gamut(linear_srgb_of_oklch(lightness, chroma, hue))) {
    double inside = 0;
    double outside = chroma;
    for (int i = 0; i < 40; ++i) {
      const double middle = (inside + outside) / 2;
      (in_gamut(linear_srgb_of_oklch(lightness, middle, hue)) ? inside : outside) = middle;
    }
    chroma = inside;
  }
  const std::array<double, 3> rgb = linear_srgb_of_oklch(lightness, chroma, hue);
  return {srgb_byte(rgb[0]), srgb_byte(rgb[1]), srgb_byte(rgb[2])};
}

}  // namespace

LightColour light_colour(double t) {
  // A picture needs millions of colours; this many are as fine as 8 bits a channel.
  static const std::vector<LightColour> table = [] {
    std::vector<LightColour> out;
    for (int i = 0; i <= table_steps; ++i)
      out.push_back(computed_colour(static_cast<double>(i) / table_steps));
    return out;
  }();
  t = std::isnan(t) ? 0 : std::clamp(t, 0.0, 1.0);
  return table[static_cast<size_t>(std::lround(t * table_steps))];
}

double LightScale::place(double value) const {
  return value > 0 ? std::log(value / low) / std::log(high / low) : -1;
}

LightColour colour_of_illuminance(double illuminance_lx) {
  return light_colour(illuminance_scale.place(illuminance_lx));
}

}  // namespace luxodus
