// Sums of a data set's emission by brick.
#include "scenes/light/optics/volume_emitter.hpp"

namespace luxodus {

VolumeEmitter::VolumeEmitter(SmokeGrid grid, const BrickTable& table)
    : medium_(grid.medium()), grid_(std::move(grid)) {
  if (!grid_.has_emission()) return;
  for (const BrickSummary& brick : table.bricks) {
    total_ += brick.emission;
    brick_cumulative_.push_back(total_);
  }
}

}  // namespace luxodus
