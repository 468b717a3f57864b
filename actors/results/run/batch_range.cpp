#include "actors/results/run/batch_range.hpp"

#include "runtime/core/check.hpp"
#include "scenes/light/transport/history.hpp"

namespace luxodus {

namespace {

bool fits(int64_t value, int bits) {
  return value >= 0 && value < (int64_t{1} << bits);
}

int64_t low(int64_t value, int bits) {
  return value & ((int64_t{1} << bits) - 1);
}

}  // namespace

uint64_t first_particle_of(const CompiledScene& scene, int stream, int64_t batch) {
  return (static_cast<uint64_t>(stream) << limits::group_id_shift) +
         static_cast<uint64_t>(batch * scene.batch_particles);
}

int64_t number_of(const BatchRange& batches) {
  LUX_CHECK(fits(batches.first, limits::batch_bits) && fits(batches.stream, limits::stream_bits) &&
                fits(batches.group, limits::group_bits),
            "a batch of a state has no number");
  return (int64_t{batches.stream} << (limits::group_bits + limits::batch_bits)) |
         (int64_t{batches.group} << limits::batch_bits) | batches.first;
}

BatchRange batch_of(int64_t number) {
  const int64_t above = number >> limits::batch_bits;
  return {static_cast<int>(low(above, limits::group_bits)),
          static_cast<int>(above >> limits::group_bits), low(number, limits::batch_bits), 1};
}

}  // namespace luxodus
