// The profile of a scene: how often its light asks for each scene part, counted by a coarse run
// over a small share of particles. What it traces is thrown away and belongs to no result: its
// random numbers are its own. It gives counts, not order. A pure function of scene, seed and number
// of particles, so every process may make it, or read it from a file (profile_file.hpp).
// Thread rule: count_references() runs on the calling thread; profiles are plain values.
#pragma once

#include <cstdint>
#include <vector>

#include "actors/cast/parts/scene_objects.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Particles of a profile. An object that one in a hundred visits is then known to 1 %; more learns
/// nothing that matters.
inline constexpr int64_t profile_particles = 1'000'000;
}  // namespace limits

/// References of one kind of work.
struct ReferenceCounts {
  int64_t units = 0;                 // particles; of eye paths: batches
  std::vector<uint64_t> references;  // by object: times that it was asked for
  /// By object: histories that asked for it at all. A history comes back to its objects at once and
  /// finds them; what makes fetches is visits.
  std::vector<uint64_t> visits;

  friend bool operator==(const ReferenceCounts&, const ReferenceCounts&) = default;
};

struct ReferenceProfile {
  uint64_t scene_hash = 0;
  std::vector<ReferenceCounts> groups;  // by source group
  ReferenceCounts eyes;                 // eye paths belong to batches, whatever their group
  std::vector<uint64_t> built_bytes;    // by object, as measured; 0 where no ray came

  size_t objects() const { return built_bytes.size(); }
  friend bool operator==(const ReferenceProfile&, const ReferenceProfile&) = default;
};

/// Particles for each group: `particles` by the groups' shares, and at least a few of each.
std::vector<int64_t> profile_particles(const std::vector<double>& group_share, int64_t particles);

/// Traces so many particles of each group, and one batch's eye paths, and counts. Built objects
/// take `budget_bytes` at most, beyond which the one unused for the longest is built again.
/// Requires: a count for each group. Errors: bytes that are no part of the scene.
Result<ReferenceProfile> count_references(const CompiledScene& scene, const SceneObjects& objects,
                                          const ProxyScene& proxies, uint64_t seed,
                                          const std::vector<int64_t>& particles,
                                          uint64_t budget_bytes);

}  // namespace luxodus
