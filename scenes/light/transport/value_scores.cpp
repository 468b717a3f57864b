#include "scenes/light/transport/value_scores.hpp"

#include <cmath>

#include "scenes/light/tally/batch_scores.hpp"

namespace luxodus {

double light_quantum_of(double level) {
  if (level > limits::bright_level)
    return std::ldexp(limits::value_quantum, std::ilogb(level / limits::bright_level) + 1);
  if (level > 0 && level < limits::dark_level)
    return std::ldexp(limits::value_quantum, std::ilogb(level / limits::dark_level));
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
