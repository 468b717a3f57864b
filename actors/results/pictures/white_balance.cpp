#include "actors/results/pictures/white_balance.hpp"

#include <fmt/format.h>

#include <cmath>

#include "scenes/light/vision/adapted_white.hpp"

namespace luxodus {

namespace {

constexpr double min_white_kelvin = 2500, max_white_kelvin = 10000, max_white_duv = 0.02;

template <class Shown>
void recolour(XyzPicture& picture, const Shown& shown) {
  for (size_t i = 0; i < picture.pixels(); ++i) {
    float* p = &picture.xyz[3 * i];
    const Xyz seen =
        shown({static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
    for (size_t c = 0; c < 3; ++c) p[c] = static_cast<float>(seen[c]);
  }
}

}  // namespace

XyzPicture WhiteBalance::balanced(XyzPicture picture) const {
  if (white == PictureWhite::lamps && lamps)
    recolour(picture, [&](const Xyz& colour) {
      return with_luminance(adapt_white(colour, *lamps, d65_white), colour[1]);
    });
  if (white == PictureWhite::adapted && surfaces) {
    const AdaptedWhite adapted(*surfaces, monitor_cd_m2);
    recolour(picture, [&](const Xyz& colour) { return adapted.on_monitor(colour); });
  }
  return picture;
}

std::string WhiteBalance::text() const {
  if (white == PictureWhite::d65) return "D65";
  if (white == PictureWhite::lamps) return "light of all sources";
  if (!surfaces) return "D65: no lit surface is in view";
  const ColourTemperature of = correlated_colour_temperature(*surfaces);
  return fmt::format(
      "light on the surfaces in view, {:.0f} K, {:.3g} cd/m2, as far as an eye adapts to it "
      "(Fairchild 1991)",
      of.kelvin, (*surfaces)[1]);
}

std::optional<Xyz> white_of_lamps(const CompiledScene& scene) {
  Xyz light{0, 0, 0};
  for (const Group& g : scene.groups) {
    for (int b = 0; b < scene.bands.count(); ++b) {
      const double watts = g.power_w[static_cast<size_t>(b)];
      light[0] += watts * scene.bands[b].x_per_w;
      light[1] += watts * scene.bands[b].lm_per_w;
      light[2] += watts * scene.bands[b].z_per_w;
    }
  }
  const ColourTemperature white = correlated_colour_temperature(light);
  if (white.kelvin < min_white_kelvin || white.kelvin > max_white_kelvin ||
      white.duv > max_white_duv)
    return std::nullopt;
  return light;
}

std::optional<Xyz> mean_light(const std::vector<std::optional<Xyz>>& lights) {
  double count = 0, log_luminance = 0, x = 0, z = 0;
  for (const std::optional<Xyz>& light : lights) {
    if (!light) continue;
    count += 1;
    log_luminance += std::log((*light)[1]);
    x += (*light)[0] / (*light)[1];
    z += (*light)[2] / (*light)[1];
  }
  if (count == 0) return std::nullopt;
  const double luminance = std::exp(log_luminance / count);
  return Xyz{x / count * luminance, luminance, z / count * luminance};
}

}  // namespace luxodus
