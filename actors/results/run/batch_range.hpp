// Batches of a state of a scene that changes in time: each source group counts its own from 0, and
// has its own stream of random numbers. In a lease a batch has one number that encodes all three;
// those of a group are consecutive. Plain values; any thread.
#pragma once

#include <cstdint>

#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

/// Batches [first, first + count) of a source group; or of a run, by their numbers: then group and
/// stream are 0.
struct BatchRange {
  int group = 0;
  int stream = 0;  // replaces the group in the ids of its particles
  int64_t first = 0;
  int64_t count = 0;

  friend bool operator==(const BatchRange&, const BatchRange&) = default;
};

/// The id of the first particle of a batch.
uint64_t first_particle_of(const CompiledScene& scene, int stream, int64_t batch);

namespace limits {
inline constexpr int batch_bits = 30;   // number of a batch within its group
inline constexpr int stream_bits = 19;  // ids of particles have one more bit
inline constexpr int group_bits = 13;
}  // namespace limits

/// The number of the first of these batches. Requires: all within the limits.
int64_t number_of(const BatchRange& batches);
/// The single batch of a number. Requires: number >= 0.
BatchRange batch_of(int64_t number);

}  // namespace luxodus
