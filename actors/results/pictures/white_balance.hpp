// The white of PNG files: which light of a scene or a picture they show as white. Plain values; any
// thread. Luminance data are never balanced.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "actors/results/pictures/pictures.hpp"
#include "scenes/light/optics/chromaticity.hpp"
#include "scenes/light/transport/compiled_scene.hpp"
#include "scenes/light/vision/picture.hpp"

namespace luxodus {

struct WhiteBalance {
  PictureWhite white = PictureWhite::d65;
  std::optional<Xyz> lamps;     // the light of all sources together, if it looks white
  std::optional<Xyz> surfaces;  // the light on the surfaces in view; nothing: none is lit
  double monitor_cd_m2 = 200;   // white of the monitor

  /// The picture as it looks on a monitor whose white is D65. Luminances stay.
  XyzPicture balanced(XyzPicture picture) const;
  /// The text "White" of PNG files.
  std::string text() const;
};

/// The light of all sources of a scenario together; nothing if it does not look white: within 0.02
/// of black bodies of 2500 to 10000 K in the uv plane. Flames alone stay orange.
std::optional<Xyz> white_of_lamps(const CompiledScene& scene);

/// One light for pictures that share a white: the geometric mean of luminances, and means of X/Y
/// and Z/Y, over the pictures in which a surface is lit.
std::optional<Xyz> mean_light(const std::vector<std::optional<Xyz>>& lights);

}  // namespace luxodus
