// The uniform numbers of a path's turn, and of the parts that a path is split into. Plain values.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "scenes/light/geometry/real.hpp"

namespace luxodus {

/// `u` moved on by `steps` of a size, around the unit interval: of a uniform number a uniform one.
template <class Number>
Number moved_on(Number u, int steps, double size) {
  const double sum = static_cast<double>(u) + steps * size;
  return std::min(static_cast<Number>(sum - std::floor(sum)), std::nextafter(Number{1}, Number{0}));
}

/// 32 uniform bits of a part's flight: those of `parts` parts lie evenly.
inline uint32_t bits_of_part(uint32_t bits, int part, int parts) {
  const uint64_t step = (uint64_t{1} << 32) / static_cast<uint64_t>(parts);
  return bits + static_cast<uint32_t>(step * static_cast<uint64_t>(part));
}

struct TurnNumbers {
  double choice = 1;  // whether the turn is aimed; 1: it is not
  Real lobe = 0, u = 0, v = 0;

  /// Of a part of the path: uniform like these, and together spread evenly (the additive recurrence
  /// by powers of the generalised golden ratio of four dimensions: M. Roberts, "The unreasonable
  /// effectiveness of quasirandom sequences", 2018).
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
