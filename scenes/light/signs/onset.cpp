#include "scenes/light/signs/onset.hpp"

namespace luxodus {

double onset_share(const std::vector<glm::dvec2>& onset, double seconds) {
  if (onset.empty()) return 1;
  if (seconds <= onset.front().x) return onset.front().y;
  for (size_t i = 1; i < onset.size(); ++i) {
    const glm::dvec2 a = onset[i - 1], b = onset[i];
    if (seconds < b.x) return a.y + (b.y - a.y) * (seconds - a.x) / (b.x - a.x);
  }
  return onset.back().y;
}

}  // namespace luxodus
