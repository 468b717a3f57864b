// What particles of a scene refer to, in which order, and what they compute in between: recorded
// from a real trace, and replayed by photon-threads in its place. A replayed run goes through all
// of a node but Embree and the kernels: fetches, caches, leases, flushes; scores are the recorded
// ones, so its flux is that of tracing as long as no particle is replayed twice. It takes a
// twentieth of the time, and its nodes little memory: a thousand of them fit.
// Thread rule: recording on the calling thread; a recording is immutable once made.
#pragma once

#include <memory>
#include <vector>

#include "actors/lab/simulate/charging.hpp"

namespace luxodus {

namespace limits {
/// Of one source group: what comes after them is what they did once more.
inline constexpr int64_t recorded_particles = 65'536;
}  // namespace limits

class Recording {
 public:
  struct Step {
    uint32_t object = 0;
    float before_ns = 0;  // computed since the step before, the look into that object aside
  };
  struct Score {
    uint32_t bin = 0;
    int64_t value = 0;
  };
  struct Particle {
    uint32_t first_step = 0;
    uint32_t first_score = 0;
    float after_ns = 0;  // computed after the last step
    EnergyBalance balance;
  };
  struct Group {
    std::vector<Particle> particles;  // and one more, where the last one ends
    std::vector<Step> steps;
    std::vector<Score> scores;
    int64_t count() const { return static_cast<int64_t>(particles.size()) - 1; }
  };

  /// Traces `particles` of each group by its share, but not more than limits::recorded_particles.
  /// Errors: parts that cannot be built; a scene with paths from eyes, which belong to batches.
  static Result<std::shared_ptr<const Recording>> make(const CompiledScene& scene, uint64_t seed,
                                                       int64_t particles, const SimCosts& costs);

  const Group& group(int number) const { return groups_[static_cast<size_t>(number)]; }
  const ScenePart& part(uint32_t object) const { return parts_[object]; }

  /// If particles travelled to objects instead: how often one changes from a holder to another,
  /// coming to the first included, on average. `holders`: by object.
  double moves_per_particle(const std::vector<NodeId>& holders) const;

 private:
  Recording() = default;
  std::vector<Group> groups_;
  std::vector<ScenePart> parts_;
};

/// Replays. Requires of all makers: what they are given outlives what is made.
TracerMaker replaying_tracers(const Recording& recording, SimClock& clock, const SimCosts& costs);

/// Built objects of all nodes of a world: what one has built, others are given when they build it,
/// and charged for in full. A simulated machine then holds what it should, and the real one that
/// runs the simulation holds it once.
class BuiltOnce {
 public:
  explicit BuiltOnce(size_t objects) : built_(objects) {}
  /// Builders that share through this. Requires: it outlives them, and so do scene and parts of the
  /// first that is made.
  BuilderMaker builders();

 private:
  class Builder;
  std::unique_ptr<ObjectBuilder> real_;  // one for all: a thousand devices of Embree are too many
  std::vector<std::shared_ptr<const BuiltObject>> built_;
};

}  // namespace luxodus
