// In which order to trace the particles of a batch where parts of the scene have to be waited for:
// those of neighbouring emitters after one another, since they look for the same cells. Which
// particles a batch has, and what becomes of each, does not depend on it, nor do sums of integers.
// Pure; any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

/// The emitter that this particle of a source group will come from: what the tracer draws first.
uint32_t emitter_of_particle(const CompiledScene& scene, uint64_t seed, int group,
                             uint64_t particle);

/// Emitters along a curve that fills space (Morton), by number: their places on it.
std::vector<uint32_t> places_of_emitters(const CompiledScene& scene);

/// Puts 0 to count - 1 into `order`: the particles from `first` on by the places of their emitters,
/// of equals the first.
void order_by_emitter(const CompiledScene& scene, const std::vector<uint32_t>& places,
                      uint64_t seed, int group, uint64_t first, uint32_t count,
                      std::vector<uint32_t>& order);

}  // namespace luxodus
