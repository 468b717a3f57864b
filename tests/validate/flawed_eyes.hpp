// Flaws in what eyes, probes and computed direct light see: the program's own code gets a spoiled
// scene (a phase function, a sign's radiance) or geometry that does not block light, or its result
// is changed. Particles are traced without flaws. Thread rule: one caller.
#pragma once

#include "actors/judge/validate/traced.hpp"

namespace luxodus::light {

enum class EyeFlaw {
  none,
  even_phase,      // the veil treats scattering as isotropic
  missed_veil,     // light scattered by smoke into the line of sight is missing
  bright_sign,     // a sign's luminance is 3 % too high
  thin_smoke,      // eyes see 3 % too little extinction
  through_sheets,  // no solid blocks light
  bright_flames,   // the emission of gas is 3 % too high
  turned_web,      // a luminaire is rotated by 90 degrees
  bright_web,      // its table is normalised 3 % too high
  wrong_lobe,      // roughness is taken for its square
  tilted_probe,    // a probe's normal is wrong by 10 degrees
  end,
};
inline constexpr int eye_flaws = static_cast<int>(EyeFlaw::end);
const char* name_of(EyeFlaw flaw);

/// The program's own tracer, except for eyes.
LocalRun::MakeTracer eyes_with(EyeFlaw flaw);

enum class DirectFlaw {
  none,
  no_cosine,       // as if every receiver faced the light
  no_smoke,        // as in clear air
  through_sheets,  // neither solids nor panes block light
  coarse_lamps,    // large lamps are treated as points
  turned_web,
  bright_web,
  end,
};
inline constexpr int direct_flaws = static_cast<int>(DirectFlaw::end);
const char* name_of(DirectFlaw flaw);

DirectLightAt direct_light_with(DirectFlaw flaw);

/// Traces every batch four times under different numbers: estimates are correct, and their standard
/// errors are half of the true ones. Requires: the number of batches is a power of two.
LocalRun::MakeTracer repeated_batches();

}  // namespace luxodus::light
