// The uniform numbers of a scattering event, and of the parts that a path is split into. Plain
// values; any thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "scenes/light/geometry/real.hpp"

namespace luxodus {

/// `u` shifted by `steps` times `size`, modulo 1: a uniform number stays uniform.
template <class Number>
Number moved_on(Number u, int steps, double size) {
  const double sum = static_cast<double>(u) + steps * size;
  return std::min(static_cast<Number>(sum - std::floor(sum)), std::nextafter(Number{1}, Number{0}));
}

/// 32 uniform bits for a part's flight; those of the `parts` parts are evenly spaced.
inline uint32_t bits_of_part(uint32_t bits, int part, int parts) {
  const uint64_t step = (uint64_t{1} << 32) / static_cast<uint64_t>(parts);
  return bits + static_cast<uint32_t>(step * static_cast<uint64_t>(part));
}

struct TurnNumbers {
  double choice = 1;  // whether the direction is guided; 1: it is not
  Real lobe = 0, u = 0, v = 0;

  /// Numbers for a part of the path: each uniform, and together evenly distributed (the additive
  /// recurrence by powers of the generalised golden ratio of four dimensions: M. Roberts, "The
  /// unreasonable effectiveness of quasirandom sequences", 2018).
  TurnNumbers of_part(int part) const {
    if (part == 0) return *this;
    constexpr double golden = 1.1673039782614187;
    constexpr double step = 1 / golden;
    TurnNumbers out;
    if (choice < 1) out.choice = moved_on(choice, part, step);
    out.u = moved_on(u, part, step * step);
    out.v = moved_on(v, part, step * step * step);
    out.lobe = moved_on(lobe, part, step * step * step * step);
    return out;
  }
};

}  // namespace luxodus
