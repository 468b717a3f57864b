#include "actors/results/run/particle_worker.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "actors/results/run/particle_portion.hpp"
#include "scenes/light/transport/readout.hpp"

namespace luxodus {

ParticleWorker::ParticleWorker(const CompiledScene& scene, const GeometryAccess& access,
                               uint64_t seed, BatchNumbers numbers, int64_t portion,
                               const TracerMaker& make_tracer)
    : scene_(scene),
      tracer_(make_tracer(scene, access, seed)),
      portion_(portion),
      look_units_(numbers == BatchNumbers::of_run ? tracer_->look_units() : 0) {
  if (numbers == BatchNumbers::of_run) planned_.emplace(scene);
}

void ParticleWorker::begin(const BatchRange& batch) {
  batch_ = planned_ ? planned_->at(batch.first) : batch_of_groups(batch);
  traced_ = 0;
  looked_ = 0;
  if (!std::exchange(cleared_, false)) scores_.reset(scene_.layout);
  scores_.balance = {};
}

void ParticleWorker::merge_into(Totals& totals, const std::function<void()>& rest) {
  totals.merge(scores_, batch_.group, rest);
  scores_.scores.clear_in_steps(rest);
  cleared_ = true;
}

Batch ParticleWorker::batch_of_groups(const BatchRange& batch) const {
  if (static_cast<size_t>(batch.group) >= scene_.groups.size())
    throw std::runtime_error("a batch was lent of a source group that is not there");
  return {batch.first, batch.group, first_particle_of(scene_, batch.stream, batch.first)};
}

bool ParticleWorker::go_on() {
  if (traced_ < scene_.batch_particles) {
    const int64_t count = trace_portion(
        *tracer_, batch_.group, batch_.first_particle + static_cast<uint64_t>(traced_),
        std::min(portion_, scene_.batch_particles - traced_), limits::rays_per_portion, scores_);
    counters_.particles += static_cast<uint64_t>(count);
    traced_ += count;
  } else {
    tracer_->look(batch_.number, looked_++, scores_);
    ++counters_.eye_units;
  }
  return traced_ < scene_.batch_particles || looked_ < look_units_;
}

std::unique_ptr<Totals> empty_totals(const CompiledScene& scene) {
  return std::make_unique<Totals>(scene.layout, static_cast<int>(scene.groups.size()),
                                  photopic_weights(scene));
}

}  // namespace luxodus
