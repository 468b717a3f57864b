// A finished run as glTF: surfaces with the light that they send back as colours of their corners,
// luminaires as punctual lights, cameras. Reads the run, changes nothing. One call at a time per
// run.
#pragma once

#include "actors/results/formats/write_glb.hpp"
#include "actors/results/run/local_run.hpp"

namespace luxodus {

struct GlbOptions {
  std::string generator;
  /// Luminance that is white, of a surface that scatters evenly [cd/m2]; 0: that which 98 % of the
  /// lit area stay below.
  double white_cd_m2 = 0;
};

/// One mesh for each surface of the scene. Corners that several patches of a surface share have the
/// mean of their colours. A side that sends no light back is left out where the other side does.
/// What luminaires and signs send out themselves is not among the colours.
/// Errors: more triangles than limits::triangles_drawn; a packed scene that cannot be read; a run
/// whose surfaces have no light.
Result<GlbScene> glb_scene_of(const LocalRun& run, const GlbOptions& options);

}  // namespace luxodus
