// What direct light at a point is asked for by, and what is answered: plain values, for whoever
// calls the computation (direct.hpp, which is a template of the resolver and costs compile time).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scenes/light/geometry/real.hpp"

namespace luxodus {

struct DirectLight {
  std::vector<double> illuminance_lx;  // per source group
  std::vector<double> fluence_lm_m2;   // per source group, all directions alike
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

/// What is known of an emitter before it is looked at, from places around.
enum class KnownSight : uint8_t { nothing, hidden, clear };

struct DirectOptions {
  bool media = true;             // false: as in clear air (what regulations calculate)
  double part_share = 1.0 / 16;  // spacing of an emitter's points over their distance
  /// Of all light that arrives, what shadows' edges across emitters may err by. Coarser where many
  /// points are averaged: their errors are of either sign.
  double tolerance = 1e-3;
  /// By emitter; empty: nothing. Those that are hidden are left out, those that are clear take no
  /// shadow rays.
  std::span<const KnownSight> known{};
  /// Numbers of emitters, ascending: no other is looked at, and answers are of these alone, in
  /// their order. Empty: all.
  std::span<const uint32_t> only{};
};

/// Light from one emitter.
struct DirectFromEmitter {
  double illuminance_lx = 0;
  double fluence_lm_m2 = 0;
  double clear_air_lx = 0;  // illuminance as if there were no media
  double open_lx = 0;       // illuminance as if nothing solid stood in the way

  DirectFromEmitter& operator+=(const DirectFromEmitter& o) {
    illuminance_lx += o.illuminance_lx;
    fluence_lm_m2 += o.fluence_lm_m2;
    clear_air_lx += o.clear_air_lx;
    open_lx += o.open_lx;
    return *this;
  }
};

/// Light that arrives from one point of an emitter, or one cell of it.
struct ArrivingLight {
  uint32_t emitter = 0;
  Vec3 direction{0};  // towards the emitter
  double illuminance_lx = 0;
};

}  // namespace luxodus
