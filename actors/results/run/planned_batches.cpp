#include "actors/results/run/planned_batches.hpp"

namespace luxodus {

namespace {
/// A late lease is usually lent again while some hundred others are out.
constexpr size_t recent_batches = 1024;
}  // namespace

PlannedBatches::PlannedBatches(const CompiledScene& scene)
    : scene_(scene), plan_(scene), recent_(recent_batches) {}

Batch PlannedBatches::at(int64_t number) {
  const auto place = [&](int64_t n) { return static_cast<size_t>(n) % recent_.size(); };
  while (plan_.given() <= number) {
    const Batch next = plan_.next();
    recent_[place(next.number)] = next;
  }
  if (recent_[place(number)].number == number) return recent_[place(number)];
  BatchPlan again(scene_);  // from a lease that was late long ago
  again.skip(number);
  return again.next();
}

}  // namespace luxodus
