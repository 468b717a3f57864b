// Limits of the rules for emergency lighting, each with the id of its rule (rule_table.cpp has
// edition, clause and source). A limit of a national deviation has a constant and a rule of its
// own. Constant data; any thread.
#pragma once

#include <array>

namespace luxodus::rule_limit {

// Illuminance [lx]
inline constexpr double route_lx = 1.0;         // E1: EN 1838, centre line of a route
inline constexpr double band_lx = 0.5;          // E2: its middle half
inline constexpr double open_lx = 0.5;          // E6: core of an open area
inline constexpr double bs_open_lx = 1;         // E6k
inline constexpr double max_diversity = 40;     // E4, E6, N3: largest over smallest
inline constexpr double strip_m = 2;            // E3: wider routes are several strips
inline constexpr double wide_edge_m = 0.5;      // E5: edge of a route, not assessed
inline constexpr double open_border_m = 0.5;    // E6: border of an area, not assessed
inline constexpr double task_lx = 15;           // E7
inline constexpr double task_share = 0.1;       // E7: of the task's mains illuminance
inline constexpr double task_uniformity = 0.1;  // E7: smallest over largest
inline constexpr double equipment_lx = 5;       // E13: vertical, at equipment
inline constexpr double first_mean_lx = 10.8, min_first_lx = 1.1;      // N1: NFPA 101, initially
inline constexpr double last_mean_lx = 6.5, min_last_lx = 0.65;        // N2: at the end
inline constexpr double min_failed_lx = 2.2;                           // N4: with one unit failed
inline constexpr double ibc_first_mean_lx = 11, ibc_min_first_lx = 1;  // I1
inline constexpr double ibc_last_mean_lx = 6, ibc_min_last_lx = 0.6;   // I2
inline constexpr double face_lx = 54;  // N6: on an externally lit sign

// Onset [s] and duration [h]
inline constexpr double half_s = 5, full_s = 60, task_s = 0.5, nfpa_s = 10, german_s = 15;  // E10
inline constexpr double duration_h = 1, national_duration_h = 3, us_duration_h = 1.5;  // E11, N10

// Places
inline constexpr double near_m = 2;     // E12, S6: "near" a point of emphasis
inline constexpr double bend_deg = 30;  // our threshold for a change of direction
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
inline constexpr double min_green = 2, min_green_in_smoke = 10;      // S1 [cd/m2]
inline constexpr double max_evenness = 10;                           // S2: largest over smallest
inline constexpr double min_contrast = 5, max_contrast = 15;         // S3: white over green
inline constexpr double mains_white = 500;                           // S5 [cd/m2]
inline constexpr double min_height_m = 2;                            // S6
inline constexpr double max_elevation_deg = 20;                      // S6
inline constexpr double min_letter_m = 0.152, min_stroke_m = 0.019;  // N7
inline constexpr double max_nearest_m = 30;                          // N8

}  // namespace luxodus::rule_limit
