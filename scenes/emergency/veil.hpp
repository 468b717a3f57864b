// Disability glare: the veiling luminance that bright sources cause in the eye (CIE 146:2002).
// Which sources count for a view of a sign is decided elsewhere
// (actors/judge/assess/sights_in_lights.cpp). Pure function; any thread.
#pragma once

namespace luxodus {

/// Veiling luminance per lux at the eye, for illuminance perpendicular to the line of sight from a
/// source at this angle from it [cd/m2 per lx]: the general disability glare equation of CIE 146
/// for brown eyes. The equation covers 0.1 to 100 degrees; outside, the value at the nearer end is
/// used.
double veil_per_lux(double angle_deg, double age_years);

}  // namespace luxodus
