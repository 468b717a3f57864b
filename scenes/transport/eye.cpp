#include "scenes/transport/eye.hpp"

namespace luxodus {

int64_t value_score(double mean) {
  constexpr double most = 0x1p62;
  const double scaled = mean / limits::value_quantum;
  return static_cast<int64_t>(std::llround(std::clamp(scaled, -most, most)));
}

}  // namespace luxodus
