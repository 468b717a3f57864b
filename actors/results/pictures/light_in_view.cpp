#include "actors/results/pictures/light_in_view.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace luxodus {

namespace {

/// A darker surface tells little of its light, and its noise would count much.
constexpr float least_albedo = 0.05f;
/// Beyond it a pixel shows smoke rather than a surface.
constexpr float least_transmittance = 0.5f;

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::optional<Xyz> light_on_surfaces(const TracedPicture& traced) {
  std::array<std::vector<double>, 3> found;  // X/Y, Y, Z/Y
  for (size_t i = 0; i < traced.light.pixels(); ++i) {
    const float* features = &traced.noisy.features[picture_features * i];
    const float* albedo = features + 5;  // X, Y, Z, each 1 for white
    if (!is_light(traced.light, i) || !(features[4] >= least_transmittance) ||
        !(std::min({albedo[0], albedo[1], albedo[2]}) >= least_albedo))
      continue;
    Xyz light{};
    for (size_t c = 0; c < 3; ++c)
      light[c] = static_cast<double>((traced.light.xyz[3 * i + c] - traced.emitted[4 * i + c]) /
                                     albedo[c]);
    if (!(light[0] > 0 && light[1] > 0 && light[2] > 0)) continue;
    found[0].push_back(light[0] / light[1]);
    found[1].push_back(light[1]);
    found[2].push_back(light[2] / light[1]);
  }
  if (found[1].empty()) return std::nullopt;
  const double luminance = median(found[1]);
  return Xyz{median(found[0]) * luminance, luminance, median(found[2]) * luminance};
}

}  // namespace luxodus
