// Options and results of the direct light at a point, for callers of direct.hpp that do not include
// that template of the resolver, which is slow to compile. Plain values; any thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scenes/light/geometry/real.hpp"

namespace luxodus {

struct DirectLight {
  std::vector<double> illuminance_lx;  // per source group
  std::vector<double> fluence_lm_m2;   // per source group, from all directions equally
  double total_lx() const {
    double sum = 0;
    for (const double e : illuminance_lx) sum += e;
    return sum;
  }
  double total_fluence() const {
    double sum = 0;
    for (const double e : fluence_lm_m2) sum += e;
    return sum;
  }
};

/// Visibility of an emitter known beforehand, from surrounding places.
enum class KnownSight : uint8_t { nothing, hidden, clear };

struct DirectOptions {
  bool media = true;             // false: as in clear air (as regulations calculate)
  double part_share = 1.0 / 16;  // spacing of an emitter's points relative to their distance
  /// Allowed error due to shadow edges across emitters, as a share of all light that arrives. May
  /// be larger if many points are averaged, since errors have either sign.
  double tolerance = 1e-3;
  /// Entries by emitter; empty: nothing is known. Hidden emitters are left out, clear ones take no
  /// shadow rays.
  std::span<const KnownSight> known{};
  /// Indices of emitters, ascending: only these are computed, and results are in their order.
  /// Empty: all.
  std::span<const uint32_t> only{};
};

/// Light from one emitter.
struct DirectFromEmitter {
  double illuminance_lx = 0;
  double fluence_lm_m2 = 0;
  double clear_air_lx = 0;  // illuminance without media
  double open_lx = 0;       // illuminance without solids in the way

  DirectFromEmitter& operator+=(const DirectFromEmitter& o) {
    illuminance_lx += o.illuminance_lx;
    fluence_lm_m2 += o.fluence_lm_m2;
    clear_air_lx += o.clear_air_lx;
    open_lx += o.open_lx;
    return *this;
  }
};

/// Light that arrives from one point or cell of an emitter.
struct ArrivingLight {
  uint32_t emitter = 0;
  Vec3 direction{0};  // towards the emitter
  double illuminance_lx = 0;
  double clear_air_lx = 0;  // illuminance without media
};

}  // namespace luxodus
