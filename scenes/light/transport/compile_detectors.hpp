// Part of compile: what counts light that arrives or passes, and the layout of the tally.
#pragma once

#include "scenes/light/transport/compile_light.hpp"

namespace luxodus {

/// Planes, counting planes and groups of volume. Requires: what leaves surfaces is compiled.
/// Errors: more cells of planes than are counted.
Result<void> compile_detectors(CompiledScene& scene);

/// The voxel grid, only where a medium is: elsewhere nobody asks for the light in the air.
/// Errors: more voxels than are counted.
Result<void> choose_voxels(CompiledScene& scene);

/// The signs that each observer is asked about.
void choose_eye_targets(CompiledScene& scene);

/// Requires: all of the above, and the source groups.
void lay_out_tally(CompiledScene& scene);

}  // namespace luxodus
