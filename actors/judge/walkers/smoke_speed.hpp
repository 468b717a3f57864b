// How fast people walk in smoke. Pure functions; any thread.
#pragma once

#include <algorithm>

namespace luxodus {

/// Frantzich and Nilsson's experiments in a tunnel with irritant smoke (Lund, report 3126, 2003) as
/// FDS+Evac uses them (Korhonen and Hostikka, VTT Working Papers 119, 2009, 3.4): a straight line
/// of the extinction K, alpha [m/s] and beta [m2/s], and a least share of the speed in clear air.
/// They measured between some 2 and 8 /m; below, the line is extrapolated.
inline constexpr double smoke_alpha_m_s = 0.706, smoke_beta_m2_s = -0.057, least_speed_share = 0.1;

/// Speed in smoke of somebody who walks at `clear_m_s` in clear air [m/s].
inline double speed_in_smoke(double clear_m_s, double extinction_per_m) {
  const double share = 1 + smoke_beta_m2_s / smoke_alpha_m_s * extinction_per_m;
  return clear_m_s * std::clamp(share, least_speed_share, 1.0);
}

}  // namespace luxodus
