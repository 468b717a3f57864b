// Acuity and signs in clear air: nothing of these is a matter of chance.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "actors/judge/validate/experiment.hpp"

namespace luxodus::light {

namespace {

// ---- T18: acuity -------------------------------------------------------------------------------

/// Acuity by luminance [cd/m2] and contrast [%], as Ikeda, Noda and Yamaguchi fitted it.
double measured_acuity(double luminance, double contrast) {
  const double root = 0.8034 * std::pow(contrast, -0.1876) + std::pow(luminance, 0.25);
  return luminance / (1.6293 * std::pow(contrast, -0.3234) * std::pow(root, 4));
}

Experiment acuity() {
  Experiment out;
  out.id = "T18";
  out.title = "Landolt rings at the limit of acuity, dark on bright";
  out.source = "Ikeda, Noda, Yamaguchi: acuity by contrast and luminance";
  out.read =
      "Second hand: a formula of Landolt rings in saecanet.com 000218_000347; people and details "
      "were not read.";
  out.assumed = {"Contrast is in per cent: only so are the values plausible.",
                 "An eye of 23 years, a distance of 5 m, and rings that differ in size."};
  Claim claim{Rule::acuity, {}, "level of the gap in every cell"};
  for (const double luminance : {0.1, 1.0, 10.0, 100.0}) {
    for (const double contrast : {50.0, 90.0}) {
      constexpr double distance_m = 5;
      const double arcmin = 1 / measured_acuity(luminance, contrast);
      const double gap_m = distance_m * std::tan(arcmin / 60 * std::numbers::pi / 180);
      Trial trial;
      trial.name =
          fmt::format("{:g} cd/m2, {:g} %, gap {:.2f} arcmin", luminance, contrast, arcmin);
      trial.scene = {.distance_m = distance_m,
                     .target = {.shape = TargetShape::landolt_ring,
                                .width_m = 5 * gap_m,
                                .luminance_cd_m2 = luminance * (1 - contrast / 100),
                                .ground_cd_m2 = luminance}};
      trial.varied = Varied::nothing;
      claim.trials.push_back(out.trials.size());
      out.trials.push_back(trial);
    }
  }
  out.claims = {claim};
  return out;
}

// ---- T20: distances of identification ----------------------------------------------------------

Experiment signs_in_clear_air() {
  Experiment out;
  out.id = "T20";
  out.title = "Distances at which signs are identified in clear air";
  out.source =
      "Wong and Lo 2007, Building and Environment 42, 1836-1842 (EXIT); Collins and Goodin 1991, "
      "NISTIR 4532 (chevron)";
  out.read =
      "Excerpt and abstract: 30 people identify EXIT of 150 mm at 90 m, and with confidence at "
      "59 m. Abstract: chevrons of 57 mm with a contrast of 0.4 to 0.5 are identified at 30.5 m on "
      "the average.";
  out.assumed = {
      "Luminances: 26 cd/m2, contrasts of 0.8 and 0.45. Letters are brighter than their ground, "
      "the chevron is darker.",
      "Strokes of 19 mm, of the chevron a third of its height: not in what was read.",
      "Surroundings are dark."};
  Trial exit_sign;
  exit_sign.name = "EXIT, 150 mm";
  exit_sign.scene.target = {.shape = TargetShape::text,
                            .width_m = 0.150,
                            .stroke_m = 0.019,
                            .text = "EXIT",
                            .luminance_cd_m2 = 26,
                            .ground_cd_m2 = 26 * (1 - 0.8)};
  exit_sign.observed = Interval{59, 90};
  exit_sign.scatter = "with confidence, and at all";
  Trial chevron;
  chevron.name = "chevron, 57 mm";
  chevron.scene.target = {.shape = TargetShape::rectangle,
                          .width_m = 0.057,
                          .detail_m = 0.019,
                          .luminance_cd_m2 = 26 * (1 - 0.45),
                          .ground_cd_m2 = 26};
  chevron.observed = Interval{30.5, 30.5};
  chevron.scatter = "a mean";
  out.trials = {exit_sign, chevron};
  for (Trial& trial : out.trials) {
    trial.varied = Varied::distance;
    trial.searched = {2, 400};
    trial.of_reading = true;
  }
  out.claims = {
      {Rule::value, {0}, "EXIT read at most at 59 m", {-unlimited, 59}, 7},
      {Rule::value, {0}, "EXIT: detail seen up to 60 to 120 m", {60, 120}},
      {Rule::value, {1}, "chevron read at most at 30.5 m", {-unlimited, 30.5}, 7},
      {Rule::value, {1}, "chevron: detail seen up to 30.5 m at least", {30.5, unlimited}}};
  return out;
}

}  // namespace

void add_clear_air_experiments(Experiments& all) {
  all.push_back(acuity());
  all.push_back(signs_in_clear_air());
}

}  // namespace luxodus::light
