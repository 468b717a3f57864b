// Records the references of a scene's particles, their order, and the computation between them from
// a real trace; photon-threads replay them instead of tracing. A replayed run exercises all of a
// node except Embree and the kernels: fetches, caches, leases, flushes. Scores are the recorded
// ones, so the flux equals that of tracing as long as no particle is replayed twice. It takes a
// twentieth of the time and little memory: a thousand nodes fit. Thread rule: recording on the
// calling thread; a recording is immutable.
#pragma once

#include <memory>
#include <vector>

#include "actors/lab/simulate/charging.hpp"

namespace luxodus {

namespace limits {
/// Most recorded particles per source group; further ones repeat them.
inline constexpr int64_t recorded_particles = 65'536;
}  // namespace limits

class Recording {
 public:
  struct Step {
    uint32_t object = 0;
    float before_ns = 0;  // computed since the previous step, excluding the access to that object
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
    std::vector<Particle> particles;  // plus one that marks the end of the last
    std::vector<Step> steps;
    std::vector<Score> scores;
    int64_t count() const { return static_cast<int64_t>(particles.size()) - 1; }
  };

  /// Traces `particles`, distributed over the groups by their shares, but at most
  /// limits::recorded_particles of each. Errors: parts that cannot be built; a scene with eye
  /// paths, which belong to batches.
  static Result<std::shared_ptr<const Recording>> make(const CompiledScene& scene, uint64_t seed,
                                                       int64_t particles, const SimCosts& costs);

  const Group& group(int number) const { return groups_[static_cast<size_t>(number)]; }
  const ScenePart& part(uint32_t object) const { return parts_[object]; }

  /// If particles migrated to objects instead: the average number of moves of a particle between
  /// holders, including the first one. `holders`: by object.
  double moves_per_particle(const std::vector<NodeId>& holders) const;

 private:
  Recording() = default;
  std::vector<Group> groups_;
  std::vector<ScenePart> parts_;
};

/// Replay. All makers require: their arguments outlive what they make.
TracerMaker replaying_tracers(const Recording& recording, SimClock& clock, const SimCosts& costs);

/// Built objects of all nodes of a world: an object built by one node is given to the others when
/// they build it, and charged to them in full. So each simulated machine accounts for its objects,
/// and the real machine holds them once.
class BuiltOnce {
 public:
  explicit BuiltOnce(size_t objects) : built_(objects) {}
  /// Builders that share objects. Requires: this outlives them, and so do scene and parts of the
  /// first one made.
  BuilderMaker builders();

 private:
  class Builder;
  std::unique_ptr<ObjectBuilder> real_;  // one for all: a thousand Embree devices are too many
  std::vector<std::shared_ptr<const BuiltObject>> built_;
};

}  // namespace luxodus
