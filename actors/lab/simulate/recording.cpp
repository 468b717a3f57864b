#include "actors/lab/simulate/recording.hpp"

#include <algorithm>

#include "actors/lab/simulate/resident_parts.hpp"
#include "actors/results/run/batch_plan.hpp"
#include "runtime/core/check.hpp"

namespace luxodus {

namespace {

/// Minimum for every group, however small its share.
constexpr int64_t min_recorded = 256;

class ReplayTracer final : public BatchTracer {
 public:
  ReplayTracer(const Recording& recording, ObjectSource& source, SimClock& clock,
               const SimCosts& costs)
      : recording_(recording), source_(source), meter_(clock, Spent::tracing), costs_(costs) {}

  void trace(int group, uint64_t first, int64_t count, BatchScores& scores) override {
    const Recording::Group& of = recording_.group(group);
    for (int64_t i = 0; i < count; ++i) {
      const uint64_t id = first + static_cast<uint64_t>(i);
      replay(of, static_cast<size_t>(id % static_cast<uint64_t>(of.count())), scores);
    }
  }
  uint32_t look_units() const override { return 0; }
  void look(int64_t, uint32_t, BatchScores&) override {}

 private:
  void replay(const Recording::Group& group, size_t number, BatchScores& scores) {
    const Recording::Particle &here = group.particles[number], &next = group.particles[number + 1];
    for (uint32_t s = here.first_step; s < next.first_step; ++s) {
      meter_.charge(group.steps[s].before_ns);
      if (!ask(group.steps[s].object)) break;  // the batch will be discarded
      meter_.charge(costs_.reference_ns);
    }
    meter_.charge(here.after_ns);
    for (uint32_t s = here.first_score; s < next.first_score; ++s)
      scores.scores.data()[group.scores[s].bin] += group.scores[s].value;
    scores.balance.add(here.balance);
  }
  bool ask(uint32_t object) {
    const ScenePart& part = recording_.part(object);
    switch (part.kind) {
      case ScenePart::Kind::cell:
        return source_.cell(object, {}) != nullptr;
      case ScenePart::Kind::brick:
        return source_.brick(static_cast<int>(part.owner), static_cast<int>(part.index)) != nullptr;
      case ScenePart::Kind::tile:
        return source_.tile(part.owner, part.index) != nullptr;
    }
    return false;
  }

  const Recording& recording_;
  ObjectSource& source_;
  Meter meter_;
  const SimCosts costs_;
};

/// Traces one particle after another and records its references.
class Recorder {
 public:
  Recorder(const CompiledScene& scene, const SceneObjects& objects, uint64_t seed,
           const SimCosts& costs)
      : scene_(scene),
        costs_(costs),
        proxies_(device_, scene.cell_boxes),
        parts_(scene, objects, [this](uint32_t object) { note(object); }),
        tracer_(make_batch_tracer(scene, GeometryAccess::through(proxies_, parts_), seed)) {
    scores_.reset(scene.layout);
  }

  const BatchTracer& tracer() const { return *tracer_; }
  const std::optional<Problem>& problem() const { return parts_.problem(); }
  void record(Recording::Group& group, int number, int64_t count) {
    group_ = &group;
    for (int64_t id = 0; id < count; ++id) one(number, static_cast<uint64_t>(id));
    group.particles.push_back(beginning());
  }

 private:
  double computed_ns() {
    const EnergyBalance& now = scores_.balance;
    const double ns = costs_.ray_ns * static_cast<double>(now.rays - rays_) +
                      costs_.collision_ns * static_cast<double>(now.collisions - collisions_);
    rays_ = now.rays;
    collisions_ = now.collisions;
    return ns;
  }
  void note(uint32_t object) {
    group_->steps.push_back({object, static_cast<float>(computed_ns())});
  }
  Recording::Particle beginning() const {
    Recording::Particle particle;
    particle.first_step = static_cast<uint32_t>(group_->steps.size());
    particle.first_score = static_cast<uint32_t>(group_->scores.size());
    return particle;
  }
  void one(int group, uint64_t id) {
    scores_.reset(scene_.layout);
    rays_ = collisions_ = 0;
    Recording::Particle particle = beginning();
    tracer_->trace(group, id, 1, scores_);
    for (size_t bin = 0; bin < scores_.scores.size(); ++bin)
      if (const int64_t value = scores_.scores[bin]; value != 0)
        group_->scores.push_back({static_cast<uint32_t>(bin), value});
    particle.after_ns = static_cast<float>(costs_.particle_ns + computed_ns());
    particle.balance = scores_.balance;
    group_->particles.push_back(particle);
  }

  const CompiledScene& scene_;
  const SimCosts costs_;
  const EmbreeDevice device_;
  const ProxyScene proxies_;
  ResidentParts parts_;
  const std::unique_ptr<BatchTracer> tracer_;
  BatchScores scores_;
  Recording::Group* group_ = nullptr;
  uint64_t rays_ = 0;
  uint64_t collisions_ = 0;
};

}  // namespace

Result<std::shared_ptr<const Recording>> Recording::make(const CompiledScene& scene, uint64_t seed,
                                                         int64_t particles, const SimCosts& costs) {
  const std::array holders{NodeId{0}};
  const SceneObjects objects(scene, holders, 1);
  Recorder recorder(scene, objects, seed, costs);
  if (recorder.tracer().look_units() > 0)
    return problem("paths from eyes cannot be replayed: take tally = \"objects\"");
  std::shared_ptr<Recording> made(new Recording);
  for (uint32_t i = 0; i < objects.places().size(); ++i) made->parts_.push_back(objects.parts()[i]);
  const std::vector<double> shares = BatchPlan(scene).shares();
  made->groups_.resize(shares.size());
  for (size_t g = 0; g < shares.size(); ++g) {
    // As many as the run has of the group, in whole batches.
    const int64_t wanted = static_cast<int64_t>(shares[g] * static_cast<double>(particles)) +
                           2 * scene.batch_particles;
    recorder.record(made->groups_[g], static_cast<int>(g),
                    std::clamp(wanted, min_recorded, limits::recorded_particles));
  }
  if (recorder.problem()) return *recorder.problem();
  return std::shared_ptr<const Recording>(std::move(made));
}

double Recording::moves_per_particle(const std::vector<NodeId>& holders) const {
  double moves = 0, particles = 0;
  for (const Group& group : groups_) {
    for (int64_t i = 0; i < group.count(); ++i) {
      const auto at = static_cast<size_t>(i);
      NodeId last = no_node;
      for (uint32_t s = group.particles[at].first_step; s < group.particles[at + 1].first_step;
           ++s) {
        const NodeId holder = holders[group.steps[s].object];
        if (holder != last) ++moves;
        last = holder;
      }
      ++particles;
    }
  }
  return particles > 0 ? moves / particles : 0;
}

TracerMaker replaying_tracers(const Recording& recording, SimClock& clock, const SimCosts& costs) {
  return [&recording, &clock, costs](const CompiledScene&, const GeometryAccess& access, uint64_t) {
    LUX_CHECK(access.source != nullptr, "a replay refers to objects that nodes fetch");
    return std::make_unique<ReplayTracer>(recording, *access.source, clock, costs);
  };
}

// ---- objects built once ------------------------------------------------------------------------

class BuiltOnce::Builder final : public ObjectBuilder, private ObjectBuilder::Client {
 public:
  explicit Builder(BuiltOnce& all) : all_(all) {}

  void build(uint32_t object, SharedBytes bytes, ObjectBuilder::Client& client) override {
    auto& built = all_.built_[object];
    if (built == nullptr) all_.real_->build(object, std::move(bytes), *this);
    if (built != nullptr)
      client.built(object, built);
    else
      client.built(object, problem("these bytes are no part of the scene"));
  }

 private:
  void built(uint32_t object, Result<std::shared_ptr<const BuiltObject>> result) override {
    if (result) all_.built_[object] = std::move(result).value();
  }

  BuiltOnce& all_;
};

BuilderMaker BuiltOnce::builders() {
  return [this](const CompiledScene& scene, const SceneParts& parts) {
    if (real_ == nullptr) real_ = make_part_builder(scene, parts);
    return std::make_unique<Builder>(*this);
  };
}

}  // namespace luxodus
