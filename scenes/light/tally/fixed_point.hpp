// Statistical weights as integers. A particle is born with weight 2^32 units; every event splits
// that integer without remainder, so the balance closes exactly and sums do not depend on order.
// Rounding is randomised by the particle's own random numbers, so the split has the right
// expectation. Pure functions; any thread.
#pragma once

#include <cstdint>

#include "runtime/core/wide.hpp"

namespace luxodus {

using Weight = uint64_t;

inline constexpr Weight unit_weight = Weight{1} << 32;

/// A weight as a number of units. Weights stay below 2^63, so it is converted as a signed number:
/// one instruction, where an unsigned one takes a branch.
inline double to_double(Weight weight) {
  return static_cast<double>(static_cast<int64_t>(weight));
}

/// A fraction in [0, 1] in units of 2^-32; 1 is 2^32 exactly.
using Fraction = uint64_t;

inline Fraction to_fraction(double x) {
  if (!(x > 0)) return 0;
  if (x >= 1) return unit_weight;
  return static_cast<Fraction>(x * 0x1p32 + 0.5);
}
inline double from_fraction(Fraction f) {
  return static_cast<double>(f) * 0x1p-32;
}

/// The part of `weight` that continues when a fraction of it does; the rest is weight minus this.
/// Its expectation over the 32 random bits is exactly weight * fraction / 2^32. Never more than
/// weight.
inline Weight split(Weight weight, Fraction fraction, uint32_t random_bits) {
  const UInt128 product = static_cast<UInt128>(weight) * fraction + random_bits;
  return static_cast<Weight>(product >> 32);
}

}  // namespace luxodus
