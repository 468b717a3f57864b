// The veil that bright sources lay over the field of view (CIE 146:2002): disability glare of an
// eye. Which sources lie in a sign's field of view: actors/judge/assess/reality_mode. Pure; any
// thread.
#pragma once

namespace luxodus {

/// Veiling luminance for each lux that a source gives at the eye, perpendicular to the line of
/// sight, at this angle from it [cd/m2 per lx]: the general disability glare equation of CIE 146
/// for brown eyes. Held at 0.1 degrees below that, where the equation ends, and at 100 beyond.
double veil_per_lux(double angle_deg, double age_years);

}  // namespace luxodus
