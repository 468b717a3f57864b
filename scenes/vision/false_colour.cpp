#include "scenes/vision/false_colour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "scenes/optics/chromaticity.hpp"

namespace luxodus {
namespace {

// ---- the map ------------------------------------------------------------------------------------

struct Lab {
  double l, a, b;
};

using Rgb = std::array<double, 3>;

// CIE 1976 L*a*b* to linear sRGB, D65 white.
Rgb linear_srgb_from_lab(const Lab& c) {
  const auto inverse = [](double t) {
    constexpr double d = 6.0 / 29;
    return t > d ? t * t * t : 3 * d * d * (t - 4.0 / 29);
  };
  const double fy = (c.l + 16) / 116;
  return linear_srgb_from_xyz({d65_white[0] * inverse(fy + c.a / 500), d65_white[1] * inverse(fy),
                               d65_white[2] * inverse(fy - c.b / 200)});
}

// Raw path, s in [0, 1]: straight in lightness, hue from violet (310 deg) by teal to yellow (100
// deg). Chroma is a parabola through 45 at the violet end, 26 at the teal in the middle and 75 at
// the yellow end: what sRGB can show at those lightnesses less a margin, so that nothing is clipped
// and the path has no corners.
Lab path(double s) {
  constexpr double first_lightness = 18, last_lightness = 92;
  constexpr double first_hue_deg = 310, last_hue_deg = 100;
  const double hue = (first_hue_deg + (last_hue_deg - first_hue_deg) * s) * std::acos(-1.0) / 180;
  const double chroma = 45 + s * (-106 + s * 136);
  return {first_lightness + (last_lightness - first_lightness) * s, chroma * std::cos(hue),
          chroma * std::sin(hue)};
}

double distance(const Lab& p, const Lab& q) {
  return std::sqrt((p.l - q.l) * (p.l - q.l) + (p.a - q.a) * (p.a - q.a) +
                   (p.b - q.b) * (p.b - q.b));
}

constexpr int map_entries = 256;
using ColourMap = std::array<Rgb8, map_entries>;

// Walks the path in steps of equal CIELAB length.
ColourMap make_map() {
  constexpr int fine = 2048;
  std::array<Lab, fine + 1> point;
  std::array<double, fine + 1> length{};
  for (int i = 0; i <= fine; ++i) {
    const auto k = static_cast<size_t>(i);
    point[k] = path(static_cast<double>(i) / fine);
    if (i > 0) length[k] = length[k - 1] + distance(point[k], point[k - 1]);
  }
  ColourMap map;
  size_t k = 1;
  for (int e = 0; e < map_entries; ++e) {
    const double wanted = length[fine] * e / (map_entries - 1);
    while (k < fine && length[k] < wanted) ++k;
    const double f = (wanted - length[k - 1]) / (length[k] - length[k - 1]);
    const Lab& p = point[k - 1];
    const Lab& q = point[k];
    const Rgb rgb =
        linear_srgb_from_lab({p.l + f * (q.l - p.l), p.a + f * (q.a - p.a), p.b + f * (q.b - p.b)});
    map[static_cast<size_t>(e)] = {srgb_byte(rgb[0]), srgb_byte(rgb[1]), srgb_byte(rgb[2])};
  }
  return map;
}

// ---- nice numbers -------------------------------------------------------------------------------

constexpr std::array<double, 3> nice_leads{1, 2, 5};
// Numbers within this of a nice one count as it: 0.3 / 0.1 is not 3 in binary.
constexpr double rounding = 1e-9;

// Correctly rounded, so that 0.2 is the 0.2 a person types: pow(10, -1) * 2 may not be.
double nice_number(double lead, int exponent) {
  const double power = std::pow(10.0, std::abs(exponent));
  return exponent < 0 ? lead / power : lead * power;
}

double nice_at_least(double v) {
  const int exponent = static_cast<int>(std::floor(std::log10(v))) - 1;
  for (int e = exponent;; ++e)
    for (double lead : nice_leads)
      if (nice_number(lead, e) >= v * (1 - rounding)) return nice_number(lead, e);
}

double nice_at_most(double v) {
  const int exponent = static_cast<int>(std::floor(std::log10(v))) + 1;
  for (int e = exponent;; --e)
    for (size_t k = nice_leads.size(); k-- > 0;)
      if (nice_number(nice_leads[k], e) <= v * (1 + rounding)) return nice_number(nice_leads[k], e);
}

Tick tick_at(const FalseColourScale& scale, double value) {
  return {value, scale.position(value), number_text(value)};
}

std::vector<Tick> linear_ticks(const FalseColourScale& scale, int most) {
  const double span = scale.high - scale.low;
  double step = nice_at_least(span / most);
  const auto count = [&] {
    return std::floor(scale.high / step + rounding) - std::ceil(scale.low / step - rounding) + 1;
  };
  while (count() > most) step = nice_at_least(step * 1.5);
  std::vector<Tick> out;
  const double first = std::ceil(scale.low / step - rounding);
  for (int i = 0; i < static_cast<int>(count()); ++i) {
    // A multiple by division where the step is below 1, so that 3 * 0.1 prints and compares as 0.3.
    const double multiple = first + i;
    const double value = step < 1 ? multiple / std::round(1 / step) : multiple * step;
    out.push_back(tick_at(scale, multiple == 0 ? 0 : value));
  }
  return out;
}

std::vector<Tick> logarithmic_ticks(const FalseColourScale& scale, int most) {
  const int first = static_cast<int>(std::floor(std::log10(scale.low) + rounding));
  const int last = static_cast<int>(std::ceil(std::log10(scale.high) - rounding));
  const auto collect = [&](const std::vector<double>& leads, int every) {
    std::vector<Tick> out;
    for (int e = first; e <= last; ++e)
      for (double lead : leads) {
        const double v = nice_number(lead, e);
        const bool within = v >= scale.low * (1 - rounding) && v <= scale.high * (1 + rounding);
        if (within && e % every == 0) out.push_back(tick_at(scale, v));
      }
    return out;
  };
  const auto fits = [&](const std::vector<Tick>& t) { return static_cast<int>(t.size()) <= most; };
  if (auto t = collect({1, 2, 5}, 1); fits(t)) return t;
  if (auto t = collect({1, 5}, 1); fits(t) && t.size() >= 2) return t;
  for (int every = 1;; ++every)
    if (auto t = collect({1}, every); fits(t)) return t;
}

}  // namespace

Rgb8 map_colour(double t) {
  static const ColourMap map = make_map();
  const double clamped = t > 0 ? std::min(t, 1.0) : 0.0;
  return map[static_cast<size_t>(std::lround(clamped * (map_entries - 1)))];
}

double FalseColourScale::position(double value) const {
  if (std::isnan(value)) return value;
  if (value <= low) return 0;
  if (value >= high) return 1;
  return logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

FalseColourScale nice_scale(const std::vector<float>& values, bool logarithmic) {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (const float f : values) {
    const auto v = static_cast<double>(f);
    if (!std::isfinite(v) || (logarithmic && v <= 0)) continue;
    lowest = std::min(lowest, v);
    highest = std::max(highest, v);
  }
  if (logarithmic) {
    if (!(highest > 0)) return {0.1, 1, true};
    const double high = nice_at_least(highest);
    const double floor = high * std::pow(10.0, -most_decades);
    double low = nice_at_most(std::max(lowest, floor));
    if (low >= high) low = nice_at_most(high / 10);
    return {low, high, true};
  }
  if (!(highest >= lowest)) return {0, 1, false};
  const double high = highest > 0 ? nice_at_least(highest) : 0;
  const double low = lowest < 0 ? -nice_at_least(-lowest) : 0;
  return high > low ? FalseColourScale{low, high, false} : FalseColourScale{0, 1, false};
}

Rgb8 false_colour(const FalseColourScale& scale, double value) {
  return std::isnan(value) ? no_value_colour : map_colour(scale.position(value));
}

SrgbPicture false_colour_picture(const std::vector<float>& values, int width, int height,
                                 const FalseColourScale& scale) {
  SrgbPicture out{width, height, {}};
  out.rgb.reserve(3 * values.size());
  for (const float v : values) {
    const Rgb8 c = false_colour(scale, static_cast<double>(v));
    out.rgb.insert(out.rgb.end(), {c.r, c.g, c.b});
  }
  return out;
}

std::vector<Tick> nice_ticks(const FalseColourScale& scale, int most) {
  most = std::max(most, 2);
  const bool drawable = std::isfinite(scale.low) && std::isfinite(scale.high) &&
                        scale.high > scale.low && (!scale.logarithmic || scale.low > 0);
  if (!drawable) return {};
  return scale.logarithmic ? logarithmic_ticks(scale, most) : linear_ticks(scale, most);
}

std::string number_text(double value) {
  if (value == 0) return "0";
  char text[64];
  const double size = std::abs(value);
  if (size < 1e-4 || size >= 1e6) {
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
  }
  const int decimals = std::max(0, 3 - static_cast<int>(std::floor(std::log10(size))));
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  std::string out = text;
  if (out.find('.') != std::string::npos) {
    out.erase(out.find_last_not_of('0') + 1);
    if (out.back() == '.') out.pop_back();
  }
  return out;
}

}  // namespace luxodus
