// The program's own loop with a mistake in it, chosen by name: what proves that validation would
// notice. Without one it is the same loop. One flaw at a time in the whole process.
#pragma once

#include <memory>

#include "scenes/light/transport/trace.hpp"

namespace luxodus::light {

enum class Flaw {
  none,
  biased_roulette,     // survivors keep their weight and get no gain
  dark_albedo,         // albedo applied twice
  bright_walls,        // reflectance 2 % too high
  double_counting,     // patches count 2 % too much
  wrong_patch,         // hits are counted in the next patch
  wrong_exit,          // escapes are counted on the opposite side
  no_cosine,           // Lambertian surfaces reflect evenly into the hemisphere
  even_emission,       // Lambertian emitters send evenly into the hemisphere
  small_emitter,       // areas emit from their middle
  wrong_emitter,       // the next emitter is chosen
  linear_flight,       // optical depth of flights even in [0, 2]: right mean, wrong law
  short_flights,       // no flight passes more than three free paths
  lost_layer,          // collisions in the second layer are lost
  long_paths,          // detectors are told lengths 2 % too long
  forward_phase,       // nothing is scattered backwards
  backward_phase,      // g has the wrong sign
  wrong_glass,         // refractive index 1.40 instead of 1.52
  no_offset,           // rays leave surfaces from the very hit point
  repeated_histories,  // particles take the random numbers of earlier ones
  biased_points,  // the points that emission draws from leave out a fiftieth of the unit square
  rough_gloss,    // glossy lobes twice as wide
  turned_web,     // luminaires hang turned by 90 degrees
  rising_flames,  // flames send all their light upwards
  end,
};
inline constexpr int flaws = static_cast<int>(Flaw::end);
const char* name_of(Flaw flaw);

/// From now on, for every thread. Requires: nothing is being traced.
void set_flaw(Flaw flaw);

/// For scenes of one band, without eyes. All that is referred to must outlive it.
std::unique_ptr<BatchTracer> make_flawed_tracer(const CompiledScene& scene,
                                                const GeometryAccess& access, uint64_t seed);

}  // namespace luxodus::light
