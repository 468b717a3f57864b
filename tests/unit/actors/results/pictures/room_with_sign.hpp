// A room with signs, and what its picture shows of them.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "actors/results/pictures/picture_tiles.hpp"
#include "actors/results/pictures/signs_in_view.hpp"
#include "actors/results/pictures/view_files.hpp"
#include "scenes/light/optics/chromaticity.hpp"
#include "tests/unit/actors/results/files/display_fixture.hpp"

namespace luxodus::test {

/// A room with a lamp and a library sign on its wall, seen from 2.2 m. `more`: smoke. A screen
/// hides the right half of a second sign beside it.
inline std::string room_with_sign(const std::string& drawing, double lamp_lm, double white_cd_m2,
                                  const std::string& more = "") {
  const std::string file = std::string(LUX_SOURCE_DIR) + "/scenes/library/signs/" + drawing;
  const auto sign = [&](const std::string& name, const std::string& place) {
    return "[[sign]]\nname = \"" + name + "\"\nposition = " + place +
           "\nfacing = [-1, 0, 0]\nwidth = 0.4\nheight = 0.2\nfile = \"" + file +
           "\"\nsmallest_detail = 0.01\nmains_white = " + std::to_string(white_cd_m2) +
           "\nmains_green = " + std::to_string(white_cd_m2 / 6) +
           "\nemergency_white = 1\nemergency_green = 0.1\n";
  };
  return R"([run]
max_bands = 6
[[material]]
name = "wall"
reflectance = 0.5
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [3, 3, 2.5]
material = "wall"
[[object]]
name = "screen"
shape = "box"
low = [2.5, 0.3, 1]
high = [2.55, 0.8, 2.2]
material = "wall"
[[emitter]]
name = "lamp"
shape = "rectangle"
size = [0.5, 0.5]
position = [1, 1.5, 2.49]
flux_lm = )" +
         std::to_string(lamp_lm) + "\n" + sign("seen", "[2.98, 1.8, 1.7]") +
         sign("half hidden", "[2.98, 0.62, 1.7]") + more + R"([[camera]]
name = "view"
eye = [0.8, 1.5, 1.6]
target = [3, 1.4, 1.65]
width = 160
height = 90
)";
}

inline ShownView view_of(const LocalRun& run, int paths) {
  const Camera& camera = run.scene().description->cameras[0];
  PictureOptions options;
  options.raw = true;
  const PictureFlux flux = picture_flux(run, options);
  ViewPasses passes(run, camera, 0, flux.radiance.get(), flux.sight);
  REQUIRE(passes.add(paths, options));
  return {passes.picture(), paths, options, 1};
}

/// Mean luminance of these pixels on a monitor whose white is 1.
inline double shown_luminance(const PngImage& image, const std::vector<size_t>& pixels) {
  const auto linear = [](uint8_t byte) {
    const double v = byte / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  double sum = 0;
  for (const size_t i : pixels)
    sum += xyz_from_linear_srgb(
        {linear(image.rgb[3 * i]), linear(image.rgb[3 * i + 1]), linear(image.rgb[3 * i + 2])})[1];
  return sum / static_cast<double>(pixels.size());
}

/// Smoke of extinction 1 /m.
inline const std::string room_smoke = R"([[medium]]
name = "smoke"
kind = "homogeneous"
extinction = 1
angstrom = 1.5
albedo = 0.6
)";

}  // namespace luxodus::test
