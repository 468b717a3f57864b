// Part of compile: the detectors that count light, and the layout of the tally. One thread.
#pragma once

#include "scenes/light/transport/compile_light.hpp"

namespace luxodus {

/// Planes, counting planes and volume groups. Requires: compiled surfaces. Errors: more plane cells
/// than the limit.
Result<void> compile_detectors(CompiledScene& scene);

/// The voxel grid, only where a medium is: elsewhere the light in the air is not asked for. Errors:
/// more voxels than the limit.
Result<void> choose_voxels(CompiledScene& scene);

/// Chooses the signs that are estimated for each observer.
void choose_eye_targets(CompiledScene& scene);

/// Requires: all of the above was called, and the source groups are compiled.
void lay_out_tally(CompiledScene& scene);

}  // namespace luxodus
