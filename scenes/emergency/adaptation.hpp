// Eyes that come from a lit room: pigment that light has bleached acts like a light behind what
// they look at, until it has recovered. Pure functions; any thread.
#pragma once

namespace luxodus {

namespace limits {
/// Largest luminance before a failure of the mains [cd/m2]: that of a very bright room. Up to it
/// rods stay more sensitive than cones in the dark, so the law needs no cones.
inline constexpr double max_luminance_before = 1000;
}  // namespace limits

/// Share of rhodopsin, the pigment of rods, that is bleached, 0 to 1. `before_cd_m2`: mean
/// luminance of the view to which the eyes were adapted; `seconds`: since that light went out.
/// Requires: both >= 0, and a luminance of at most limits::max_luminance_before.
double bleached_rhodopsin(double before_cd_m2, double seconds);

/// Luminance [cd/m2] that, added to the background, raises the threshold as much as bleached
/// pigment does: the equivalent background (Crawford 1947; Blakemore and Rushton 1965, Journal of
/// Physiology 181, 612). 0 without light before. Law and sources: docs/decisions, "Eyes that come
/// from a lit room". Requires: as bleached_rhodopsin.
double equivalent_background(double before_cd_m2, double seconds);

}  // namespace luxodus
