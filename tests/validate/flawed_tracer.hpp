// The program's own loop with a deliberate mistake, chosen by name, to prove that validation
// detects it. Without a mistake it is the same loop. One flaw at a time in the whole process; set
// it while nothing is traced.
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
  no_cosine,           // Lambertian surfaces reflect uniformly into the hemisphere
  even_emission,       // Lambertian emitters emit uniformly into the hemisphere
  small_emitter,       // areas emit from their centre
  wrong_emitter,       // the next emitter is chosen
  linear_flight,       // optical depth of flights uniform in [0, 2]: right mean, wrong law
  short_flights,       // no flight is longer than three free paths
  lost_layer,          // collisions in the second layer are lost
  long_paths,          // detectors get lengths 2 % too long
  forward_phase,       // no light is scattered backwards
  backward_phase,      // g has the wrong sign
  wrong_glass,         // refractive index 1.40 instead of 1.52
  no_offset,           // rays leave surfaces exactly at the hit point
  repeated_histories,  // particles use the random numbers of earlier ones
  biased_points,       // the points that emission samples from omit a fiftieth of the unit square
  rough_gloss,         // glossy lobes twice as wide
  turned_web,          // luminaires are rotated by 90 degrees
  rising_flames,       // flames emit all their light upwards
  end,
};
inline constexpr int flaws = static_cast<int>(Flaw::end);
const char* name_of(Flaw flaw);

/// Sets the flaw for every thread. Requires: nothing is being traced.
void set_flaw(Flaw flaw);

/// For scenes of one band, without eyes. All references must outlive it.
std::unique_ptr<BatchTracer> make_flawed_tracer(const CompiledScene& scene,
                                                const GeometryAccess& access, uint64_t seed);

}  // namespace luxodus::light
