#include "actors/apps/view/gloss.hpp"

#include <algorithm>

#include "scenes/light/optics/spectrum.hpp"

namespace luxodus {

namespace {

/// Linear sRGB of a share by band, relative to a white of equal power in all bands.
template <class Share>
std::array<double, 3> colour_of_share(const Bands& bands, const Share& share) {
  std::array<double, 3> xyz{}, white{};
  for (int b = 0; b < bands.count(); ++b) {
    const Band& band = bands[b];
    const std::array<double, 3> of_band = {band.x_per_w, band.lm_per_w, band.z_per_w};
    for (size_t k = 0; k < 3; ++k) {
      white[k] += of_band[k];
      xyz[k] += of_band[k] * share(static_cast<size_t>(b));
    }
  }
  const auto rgb = linear_srgb_from_xyz(xyz);
  const auto of_white = linear_srgb_from_xyz(white);
  std::array<double, 3> out{};
  for (size_t k = 0; k < 3; ++k)
    if (of_white[k] > 0) out[k] = std::clamp(rgb[k] / of_white[k], 0.0, 1.0);
  return out;
}

double luminance_of_share(const std::array<double, 3>& rgb) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

}  // namespace

std::vector<LiveGloss> gloss_of(const CompiledScene& scene) {
  std::vector<LiveGloss> out;
  for (size_t s = 0; s < scene.surfaces.size(); ++s)
    for (const size_t side : {size_t{0}, size_t{1}}) {
      if (out.size() == limits::view_gloss) return out;
      const CompiledMaterial& material = scene.materials[scene.surfaces[s].material[side]];
      if (material.kind != MaterialKind::glossy && material.kind != MaterialKind::mirror) continue;
      const std::vector<SurfaceModel>& models = material.by_band;
      const auto mirrored = [&](size_t b) { return static_cast<double>(models[b].specular); };
      LiveGloss gloss;
      gloss.surface = static_cast<uint32_t>(s);
      gloss.back = side == 1;
      gloss.mirrored = colour_of_share(scene.bands, mirrored);
      const double of_lobe = luminance_of_share(gloss.mirrored);
      if (!(of_lobe > 0)) continue;
      const double even = luminance_of_share(colour_of_share(
          scene.bands, [&](size_t b) { return static_cast<double>(models[b].reflectance); }));
      gloss.spread = even / (even + of_lobe);
      if (material.kind == MaterialKind::glossy)
        gloss.roughness = static_cast<double>(models.front().alpha);
      out.push_back(gloss);
    }
  return out;
}

}  // namespace luxodus
