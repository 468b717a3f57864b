// Limits that depend on the building, and lengths and times that the rules speak of. The limits
// that are one number stand with their rule (rule_table.cpp), which has edition, clause and source.
// Constant data; any thread.
#pragma once

#include <array>

namespace luxodus::rule_limit {

// Where illuminance is judged [m]
inline constexpr double strip_m = 2;          // E3: wider routes are several strips
inline constexpr double wide_edge_m = 0.5;    // E5: edge of a route that is left out
inline constexpr double open_border_m = 0.5;  // E6: border of an area that is left out
inline constexpr double task_share = 0.1;     // E7: least share of the task's mains illuminance

// When it has to be there [s]
inline constexpr double half_s = 5, full_s = 60, task_s = 0.5, nfpa_s = 10, german_s = 15;  // E10

inline constexpr double bend_deg = 30;                          // a change of direction, ours
inline constexpr double zone_low_deg = 60, zone_high_deg = 90;  // E8, from straight down

/// Largest intensity of a luminaire by its height above the floor (E8).
struct GlareStep {
  double below_m;
  double candela;
};
inline constexpr std::array glare_steps{GlareStep{2.5, 500}, GlareStep{3, 900},
                                        GlareStep{3.5, 1600}, GlareStep{4, 2500},
                                        GlareStep{4.5, 3500}};
inline constexpr double max_glare_cd = 5000;

// Signs
inline constexpr double min_green = 2, min_green_in_smoke = 10;  // S1 [cd/m2]
inline constexpr double min_contrast = 5, max_contrast = 15;     // S3: white over green

}  // namespace luxodus::rule_limit
