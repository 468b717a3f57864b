// An order in which to trace the particles of a batch when parts of the scene have to be fetched:
// particles of neighbouring emitters follow each other, since they need the same cells. The order
// affects neither which particles a batch has, nor their histories, nor the integer sums. Pure; any
// thread.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

/// The emitter that this particle of a source group will come from: the first draw of the tracer.
uint32_t emitter_of_particle(const CompiledScene& scene, uint64_t seed, int group,
                             uint64_t particle);

/// For each emitter, its position on a space-filling (Morton) curve.
std::vector<uint32_t> places_of_emitters(const CompiledScene& scene);

/// Fills `order` with 0 to count - 1: the particles from `first` on, sorted by the curve position
/// of their emitters, ties by number.
void order_by_emitter(const CompiledScene& scene, const std::vector<uint32_t>& places,
                      uint64_t seed, int group, uint64_t first, uint32_t count,
                      std::vector<uint32_t>& order);

}  // namespace luxodus
