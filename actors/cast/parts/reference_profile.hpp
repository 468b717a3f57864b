// The reference profile of a scene: how often its light requests each scene part, counted by a
// coarse run over a small share of particles. The results of that run are discarded; it has random
// numbers of its own. It gives counts, not their order. A pure function of scene, seed and number
// of particles, so every process may compute it, or read it from a file (profile_file.hpp). Thread
// rule: count_references() runs on the calling thread; profiles are plain values.
#pragma once

#include <cstdint>
#include <vector>

#include "actors/cast/parts/scene_objects.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Particles of a profile: an object visited by one in a hundred is then known to 1 %; more
/// particles do not improve the plan.
inline constexpr int64_t profile_particles = 1'000'000;
}  // namespace limits

/// References by one kind of work.
struct ReferenceCounts {
  int64_t units = 0;                 // particles; for eye paths batches
  std::vector<uint64_t> references;  // by object: number of requests
  /// By object: histories that requested it at all. A history's repeated requests soon after are
  /// hits; only visits cause fetches.
  std::vector<uint64_t> visits;

  friend bool operator==(const ReferenceCounts&, const ReferenceCounts&) = default;
};

struct ReferenceProfile {
  uint64_t scene_hash = 0;
  std::vector<ReferenceCounts> groups;  // by source group
  ReferenceCounts eyes;                 // eye paths belong to batches, independent of their group
  std::vector<uint64_t> built_bytes;    // by object, as measured; 0 if no ray reached it

  size_t objects() const { return built_bytes.size(); }
  friend bool operator==(const ReferenceProfile&, const ReferenceProfile&) = default;
};

/// Particles for each group: `particles` by the groups' shares, with a minimum for each.
std::vector<int64_t> profile_particles(const std::vector<double>& group_share, int64_t particles);

/// Traces this many particles of each group, and one batch's eye paths, and counts. Built objects
/// take at most `budget_bytes`; beyond it the least recently used is evicted. Requires: a count for
/// each group. Errors: bytes that are no part of the scene.
Result<ReferenceProfile> count_references(const CompiledScene& scene, const SceneObjects& objects,
                                          const ProxyScene& proxies, uint64_t seed,
                                          const std::vector<int64_t>& particles,
                                          uint64_t budget_bytes);

}  // namespace luxodus
