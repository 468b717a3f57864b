// The energy balance: sources and sinks of all weight, exact in integers. Plain values; any thread.
//   emitted + roulette gain = absorbed on surfaces + absorbed in media + escaped + roulette loss +
//   lost
#pragma once

#include <cstdint>

#include "scenes/light/tally/fixed_point.hpp"

namespace luxodus {

struct EnergyBalance {
  Int128 emitted = 0;
  Int128 roulette_gain = 0;
  Int128 absorbed_surfaces = 0;
  Int128 absorbed_media = 0;
  Int128 escaped = 0;
  Int128 roulette_loss = 0;
  Int128 lost_too_long = 0;  // a history exceeded its limit of events, or a batch its limit of rays
  uint64_t particles = 0;
  uint64_t rays = 0;
  uint64_t hits = 0;
  uint64_t collisions = 0;

  void add(const EnergyBalance& other) {
    emitted += other.emitted;
    roulette_gain += other.roulette_gain;
    absorbed_surfaces += other.absorbed_surfaces;
    absorbed_media += other.absorbed_media;
    escaped += other.escaped;
    roulette_loss += other.roulette_loss;
    lost_too_long += other.lost_too_long;
    particles += other.particles;
    rays += other.rays;
    hits += other.hits;
    collisions += other.collisions;
  }

  Int128 lost() const { return lost_too_long; }
  bool closes() const {
    return emitted + roulette_gain ==
           absorbed_surfaces + absorbed_media + escaped + roulette_loss + lost();
  }
};

}  // namespace luxodus
