// The faces of signs that a picture shows, and how bright they are in it. For the exposure of
// pictures and for tests of them; verdicts come from luminance data that is traced for each sign.
// Pure functions; any thread.
#pragma once

#include <cstddef>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"
#include "scenes/light/vision/picture.hpp"
#include "scenes/light/vision/regression_filter.hpp"

namespace luxodus {

/// A face of a sign and the pixels that show it.
struct SignInView {
  size_t sign = 0;  // index in the description
  bool back = false;
  /// For each colour of the sign, the pixels whose centre shows it, as far as the face is not
  /// hidden. Each once.
  std::vector<std::vector<size_t>> colours;
};

/// Faces with at least one pixel of one of their colours, in the order of the scene's. `features`:
/// those of the picture, which may have another size than the camera says.
std::vector<SignInView> signs_in_view(const CompiledScene& scene, const Camera& camera,
                                      const NoisyPicture& features);

/// Mean luminance of these pixels [cd/m2]; 0 without any.
double mean_luminance(const XyzPicture& picture, const std::vector<size_t>& pixels);

/// Luminance of the brightest colour of all faces [cd/m2]; 0 without any.
double brightest_face(const XyzPicture& picture, const std::vector<SignInView>& signs);

}  // namespace luxodus
