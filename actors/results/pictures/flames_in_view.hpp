// How bright the steady flames are that a picture shows, for its exposure: they are exposed as a
// sign's face is (CameraCurve), so that they keep their colour and shape. Shown as bright as white,
// a flame would be white. Pure functions; any thread.
#pragma once

#include "scenes/light/transport/compiled_scene.hpp"
#include "scenes/light/vision/picture.hpp"
#include "scenes/light/vision/regression_filter.hpp"

namespace luxodus {

/// The luminance that one pixel in twenty of those with a flame exceeds [cd/m2]; 0 without any.
/// `features`: those of the picture, which may have another size than the camera says.
double brightest_flame(const CompiledScene& scene, const Camera& camera,
                       const NoisyPicture& features, const XyzPicture& light);

}  // namespace luxodus
