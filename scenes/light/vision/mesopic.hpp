// Mesopic photometry after CIE 191:2010 (system MES2): luminance for an eye that uses rods and
// cones together, between 0.005 and 5 cd/m2, the range of the floors of an escape route. For
// peripheral vision; the fovea has no rods and stays photopic. Pure functions; any thread.
#pragma once

namespace luxodus {

struct MesopicLuminance {
  double cd_m2 = 0;       // mesopic luminance
  double adaptation = 1;  // m: 1 photopic (cones only), 0 scotopic (rods only)
};

/// Mesopic luminance of light of photopic luminance [cd/m2] and scotopic luminance [scotopic cd/m2]
/// seen by an eye adapted to that light. Negative and NaN count as 0.
MesopicLuminance mesopic_luminance(double photopic_cd_m2, double scotopic_cd_m2);

/// Mesopic luminance for an eye whose adaptation m is already known (from the surroundings).
double mesopic_luminance_adapted(double photopic_cd_m2, double scotopic_cd_m2, double adaptation);

/// Scotopic luminance estimated from XYZ alone, for pictures without spectra: Y (1.33 (1 + (Y+Z)/X)
/// - 1.68) (Ward Larson, Rushmeier and Piatko 1997, eq. 16), within [0, 10] times Y; never exact,
/// within some 10 % for daylight and lamps of broad spectra.
double scotopic_from_xyz(double x, double y, double z);

}  // namespace luxodus
