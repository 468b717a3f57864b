#include "scenes/light/transport/value_scores.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/light/tally/batch_scores.hpp"

namespace luxodus {

double light_quantum_of(double level) {
  // Beyond these no scene means anything, and quanta would end as 0 or infinite.
  constexpr double darkest = 1e-100, brightest = 1e100;
  if (!(level > 0)) return limits::value_quantum;
  const double within = std::clamp(level, darkest, brightest);
  if (within > limits::bright_level)
    return std::ldexp(limits::value_quantum, std::ilogb(within / limits::bright_level) + 1);
  if (within < limits::dark_level)
    return std::ldexp(limits::value_quantum, std::ilogb(within / limits::dark_level));
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
