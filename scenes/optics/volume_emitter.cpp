// Sums of a data set's emission by brick.
#include "scenes/optics/volume_emitter.hpp"

namespace luxodus {

VolumeEmitter::VolumeEmitter(SmokeGrid grid, const std::vector<Brick>& bricks)
    : medium_(grid.medium()), grid_(std::move(grid)) {
  if (!grid_.has_emission()) return;
  for (const Brick& b : bricks) {
    total_ += b.emission_cumulative.back();
    brick_cumulative_.push_back(total_);
  }
}

}  // namespace luxodus
