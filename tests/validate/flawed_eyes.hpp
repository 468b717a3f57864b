// What eyes, probes and computed direct light see, with a mistake in it: the program's own code is
// given a scene that has been spoiled (a phase function, a sign's radiance), geometry that does not
// stop light, or its result is spoiled afterwards. Particles are traced without one.
#pragma once

#include "actors/judge/validate/traced.hpp"

namespace luxodus::light {

enum class EyeFlaw {
  none,
  even_phase,      // the veil takes every scattering as even
  missed_veil,     // what smoke scatters into the line of sight is left out
  bright_sign,     // a sign's luminance is 3 % too high
  thin_smoke,      // eyes see 3 % too little extinction
  through_sheets,  // nothing solid is in the way
  bright_flames,   // what gas gives off is 3 % too much
  turned_web,      // a luminaire hangs turned by 90 degrees
  bright_web,      // its table is normalised 3 % too high
  wrong_lobe,      // roughness is taken for its square
  tilted_probe,    // a probe's normal is 10 degrees off
  end,
};
inline constexpr int eye_flaws = static_cast<int>(EyeFlaw::end);
const char* name_of(EyeFlaw flaw);

/// The program's own tracer, but for the eyes.
LocalRun::MakeTracer eyes_with(EyeFlaw flaw);

enum class DirectFlaw {
  none,
  no_cosine,       // as if every receiver faced the light
  no_smoke,        // as in clear air
  through_sheets,  // nothing solid is in the way, nor any pane
  coarse_lamps,    // large lamps are taken for points
  turned_web,
  bright_web,
  end,
};
inline constexpr int direct_flaws = static_cast<int>(DirectFlaw::end);
const char* name_of(DirectFlaw flaw);

DirectLightAt direct_light_with(DirectFlaw flaw);

/// Traces every batch four times under different numbers: estimates are right, and their standard
/// errors are half of what they ought to be. Requires: batches of a power of two.
LocalRun::MakeTracer repeated_batches();

}  // namespace luxodus::light
