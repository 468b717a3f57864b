// Groups take turns by largest deficit. Their shares are the scene's; if it states none, half of
// the batches are distributed evenly, half in proportion to lumens, since a designer may look at a
// weak circuit alone.
#include "actors/results/run/batch_plan.hpp"

#include <algorithm>

#include "scenes/light/transport/history.hpp"

namespace luxodus {

namespace {
/// Batches of each group in the first round: enough for a standard error that is itself known to 25
/// %.
constexpr int64_t first_round_batches = 8;

std::vector<double> shares_by_lumens(const CompiledScene& scene) {
  double total = 0;
  for (const Group& g : scene.groups) total += g.luminous_flux_lm;
  const auto n = static_cast<double>(scene.groups.size());
  std::vector<double> shares;
  for (const Group& g : scene.groups)
    shares.push_back(0.5 / n + (total > 0 ? 0.5 * g.luminous_flux_lm / total : 0.5 / n));
  return shares;
}

}  // namespace

BatchPlan::BatchPlan(const CompiledScene& scene)
    : share_(scene.batch_shares.empty() ? shares_by_lumens(scene) : scene.batch_shares),
      issued_(scene.groups.size()),
      batch_particles_(scene.batch_particles) {}

Batch BatchPlan::next() {
  size_t chosen = 0;
  double most = -1e300;
  for (size_t g = 0; g < share_.size(); ++g) {
    const double deficit =
        share_[g] * static_cast<double>(given_ + 1) - static_cast<double>(issued_[g]);
    if (deficit > most) {
      most = deficit;
      chosen = g;
    }
  }
  Batch batch;
  batch.number = given_++;
  batch.group = static_cast<int>(chosen);
  batch.first_particle = (uint64_t{chosen} << limits::group_id_shift) +
                         static_cast<uint64_t>(issued_[chosen]++ * batch_particles_);
  return batch;
}

void BatchPlan::skip(int64_t count) {
  while (given_ < count) next();
}

int64_t BatchPlan::round_end(int64_t done) const {
  int64_t end = first_round_batches * static_cast<int64_t>(share_.size());
  while (end <= done) end += std::max<int64_t>(1, end / 4);
  return end;
}

}  // namespace luxodus
