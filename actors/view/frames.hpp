// Binary frames of PROTOCOL.md: geometry, light on surfaces, light in smoke, from a run's totals.
// Pure functions; any thread, while nobody adds to the totals.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "actors/source/local_run.hpp"

namespace luxodus {

using LiveFrame = std::shared_ptr<const std::string>;

/// A triangle of a frame: both sides' bins, and its area.
struct LivePatch {
  uint32_t front = 0, back = 0;
  uint32_t surface = 0;
  double area_m2 = 0;
};

struct LiveGeometry {
  LiveFrame frame;
  std::vector<LivePatch> patches;  // by triangle of the frame
};

/// Every flux patch as a triangle. Errors: a packed scene that cannot be read.
Result<LiveGeometry> geometry_of(const CompiledScene& scene, uint32_t generation);

/// Light of each source group on surfaces and, where there is smoke, in it; by the run's threads.
std::vector<LiveFrame> light_frames(const LocalRun& run, const std::vector<LivePatch>& patches,
                                    uint32_t generation);

/// Extinction of the voxels; none where no medium is.
LiveFrame smoke_frame(const CompiledScene& scene, const SceneIndex& index, uint32_t generation);

}  // namespace luxodus
