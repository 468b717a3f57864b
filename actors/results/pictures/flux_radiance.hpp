// The radiance that paths of pictures end in: a run's counts on patches and in voxels. All paths
// that end there share its errors. Made after a run; then immutable, any thread.
#pragma once

#include <memory>
#include <vector>

#include "actors/results/run/local_run.hpp"
#include "scenes/light/transport/radiance_cache.hpp"

namespace luxodus {

/// Outgoing radiance of every patch of the run, uniform over directions; and of smoke, from the
/// fluence and the net flux of its voxels. Requires: the run outlives it and traces nothing
/// meanwhile. Throws std::runtime_error if a packed scene cannot be read.
std::unique_ptr<RadianceCache> flux_radiance(const LocalRun& run);

}  // namespace luxodus
