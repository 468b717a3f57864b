// Exports a finished run as glTF: surfaces with reflected light as vertex colours, luminaires as
// punctual lights, cameras. Reads the run only. Any thread, one call at a
// time per run.
#pragma once

#include "actors/results/formats/write_glb.hpp"
#include "actors/results/run/local_run.hpp"

namespace luxodus {

struct GlbOptions {
  std::string generator;
  /// Luminance shown as white, for a surface that scatters evenly [cd/m2]; 0: that which 98 % of
  /// the lit area stay below.
  double white_cd_m2 = 0;
};

/// One mesh for each surface of the scene. Corners shared by several patches of a surface get the
/// mean of their colours. A side without reflected light is omitted if the other side has some.
/// Light emitted by luminaires and signs is not among the colours.
/// Errors: more triangles than limits::triangles_drawn; a packed scene that cannot be read; a run
/// whose surfaces have no light.
Result<GlbScene> glb_scene_of(const LocalRun& run, const GlbOptions& options);

}  // namespace luxodus
