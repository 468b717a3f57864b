#include "scenes/light/transport/value_scores.hpp"

#include <cmath>

#include "scenes/light/tally/batch_scores.hpp"

namespace luxodus {

double light_quantum_of(double flux_lm) {
  if (flux_lm > limits::large_flux_lm)
    return std::ldexp(limits::value_quantum, std::ilogb(flux_lm / limits::large_flux_lm) + 1);
  if (flux_lm > 0 && flux_lm < limits::small_flux_lm)
    return std::ldexp(limits::value_quantum, std::ilogb(flux_lm / limits::small_flux_lm));
  return limits::value_quantum;
}

double quantum_of(const CompiledScene& scene, uint32_t block, uint32_t quantity) {
  const bool share =
      block == scene.blocks.views && quantity >= static_cast<uint32_t>(EyeQuantity::transmission);
  return share ? limits::value_quantum : scene.light_quantum;
}

int64_t value_score(double mean, double quantum) {
  const double scaled = mean / quantum;
  if (!(std::abs(scaled) <= limits::largest_value)) return limits::out_of_range;
  return static_cast<int64_t>(std::llround(scaled));
}

}  // namespace luxodus
