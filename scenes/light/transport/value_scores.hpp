// Values of eye paths, such as luminances, as integer scores: a batch's mean in quanta. The quantum
// of light follows the flux of a scene, so that neither a faint nor a bright scene loses digits; a
// value that no score holds is marked, never cut off. Pure functions; any thread.
#pragma once

#include <cstdint>

#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

namespace limits {
/// Quantum of a value score [its unit]: with 2^-40, a score holds up to 4 million cd/m2 per batch
/// mean. That of light is larger in scenes brighter than the second level, and smaller in those
/// darker than the first [lx, cd/m2].
inline constexpr double value_quantum = 0x1p-40, dark_level = 1e-4, bright_level = 1e4;
/// Scores of values are at most so many quanta, so that the sums of 2^26 batches fit.
inline constexpr double largest_value = 0x1p62;
}  // namespace limits

/// The quantum of values of light in a scene of this level, such as the flux of its sources over
/// the square of its size [lx]: a power of two, which is limits::value_quantum between dark_level
/// and bright_level. Scenes that differ in size alone have the same quantum.
double light_quantum_of(double level);

/// The quantum of a value score of a scene.
double quantum_of(const CompiledScene& scene, uint32_t block, uint32_t quantity);

/// A batch's mean as a score; limits::out_of_range beyond limits::largest_value quanta, and for
/// NaN.
int64_t value_score(double mean, double quantum);

}  // namespace luxodus
