// Eyes, probes and computed direct light with a deliberate mistake: the program's own code gets an
// altered scene (a phase function, a sign's radiance) or geometry that does not block light, or its
// result is altered afterwards. Particles are traced without a mistake. One thread per tracer.
#pragma once

#include "actors/judge/validate/traced.hpp"

namespace luxodus::light {

enum class EyeFlaw {
  none,
  even_phase,      // the veil treats every scattering as isotropic
  missed_veil,     // light scattered into the line of sight is left out
  bright_sign,     // a sign's luminance is 3 % too high
  thin_smoke,      // eyes see 3 % too little extinction
  through_sheets,  // no solid blocks light
  bright_flames,   // emission of gas is 3 % too high
  turned_web,      // a luminaire is rotated by 90 degrees
  bright_web,      // its table is normalised 3 % too high
  wrong_lobe,      // roughness is used as its square
  tilted_probe,    // a probe's normal is 10 degrees off
  end,
};
inline constexpr int eye_flaws = static_cast<int>(EyeFlaw::end);
const char* name_of(EyeFlaw flaw);

/// The program's own tracer, with flawed eyes.
LocalRun::MakeTracer eyes_with(EyeFlaw flaw);

enum class DirectFlaw {
  none,
  no_cosine,       // as if every receiver faced the light
  no_smoke,        // as in clear air
  through_sheets,  // no solid blocks light, and no pane attenuates it
  coarse_lamps,    // large lamps are treated as points
  turned_web,
  bright_web,
  end,
};
inline constexpr int direct_flaws = static_cast<int>(DirectFlaw::end);
const char* name_of(DirectFlaw flaw);

DirectLightAt direct_light_with(DirectFlaw flaw);

/// Traces every batch four times under different numbers: estimates are correct, and their standard
/// errors are half the correct size. Requires: batches of a power of two.
LocalRun::MakeTracer repeated_batches();

}  // namespace luxodus::light
