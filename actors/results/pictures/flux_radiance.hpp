// Light that paths of pictures end in: what a run has counted in patches and voxels, as radiance.
// Its own errors are common to all paths that end there. Made after a run; then any thread.
#pragma once

#include <memory>
#include <vector>

#include "actors/results/run/local_run.hpp"
#include "scenes/light/transport/known_radiance.hpp"

namespace luxodus {

/// Outgoing radiance of every patch of the run, spread evenly over directions; and of smoke, by
/// the fluence and the net flux of its voxels. Requires: the run outlives it and traces nothing
/// meanwhile. Throws std::runtime_error where a packed scene cannot be read.
std::unique_ptr<KnownRadiance> flux_radiance(const LocalRun& run);

}  // namespace luxodus
