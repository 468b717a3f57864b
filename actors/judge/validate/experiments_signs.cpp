// Signs in smoke, by others than Jin.
#include <fmt/format.h>

#include <numbers>

#include "actors/judge/validate/experiment.hpp"

namespace luxodus::light {

namespace {

/// Extinction of an optical density of 1/m [1/m].
constexpr double of_density = std::numbers::ln10;

// ---- T8: Landolt's ring ------------------------------------------------------------------------

Experiment landolt_ring_in_smoke() {
  Experiment out;
  out.id = "T8";
  out.title = "The gap of a lit Landolt ring at 1 lx, at three distances";
  out.source =
      "Cheung, Bielawski, Arnold, Huang, Wegrzynski 2026, Fire Safety Journal 159, 104573, "
      "sections 4.2 and 4.3";
  out.read =
      "Second hand: pyFDS-Evac, site/content/fundamentals/visibility.md, printed values. One "
      "observer with an acuity of 1.0.";
  out.assumed = {
      "A chamber of 2.4 by 2.4 m, as long as the line of sight, walls as in Jin's: mirrors fold "
      "the line in the real one.",
      "1 lx: horizontal, in the middle of the chamber, in clear air.",
      "Smoke of oil: albedo 1, Henyey and Greenstein's g = 0.6.",
      "The observer is 23 years old; adaptation to 1 lx is complete."};
  struct Row {
    double ring_m, luminance, distance_m, optical_depth;
  };
  for (const Row& row :
       {Row{0.05, 189, 5.5, 8.3}, Row{0.10, 202, 10.5, 8.4}, Row{0.15, 492, 15.5, 7.8}}) {
    Trial trial;
    trial.name =
        fmt::format("{:g} cm, {:g} cd/m2, {:g} m", 100 * row.ring_m, row.luminance, row.distance_m);
    trial.scene = {.distance_m = row.distance_m,
                   .target = {.shape = TargetShape::landolt_ring,
                              .width_m = row.ring_m,
                              .luminance_cd_m2 = row.luminance,
                              .ground_reflectance = 0.07},
                   .room = {.width_m = 2.4, .height_m = 2.4, .walls = 0.8, .far_wall = 0.07},
                   .lamps = {.lux = 1}};
    trial.observed = Interval{row.optical_depth, row.optical_depth};
    trial.scatter = "two repeats, one observer";
    trial.of_reading = true;
    out.trials.push_back(trial);
    out.claims.push_back({Rule::read, {out.trials.size() - 1}, trial.name});
  }
  return out;
}

// ---- T12: EXIT signs of aircraft ---------------------------------------------------------------

Experiment aircraft_exit_sign() {
  Experiment out;
  out.id = "T12";
  out.title = "EXIT of 38 mm in white smoke, at three distances and in two sizes";
  out.source = "Rasmussen, Garner, Blethrow, Lowrey 1979, DOT/FAA/AM-79/22";
  out.read =
      "The abstract: identified at total optical densities of 3.00 to 3.55, and larger letters "
      "help only moderately. The sign is that of 14 CFR 25.812(b), which was read.";
  out.assumed = {
      "Distances: 1, 2 and 3 m; the report's is not in the abstract.",
      "Letters of 8.6 on a ground of 86 cd/m2: the regulation asks for at least that ground, and "
      "a contrast of at least 10 to 1. Stroke: 5.9 mm.",
      "A dark chamber of 3 by 1 by 1 m with walls of 0.2: they are several free paths away. White "
      "smoke: albedo 1, g = 0.6.",
      "Colour is left out: the letters are red."};
  out.beer =
      "That one sign has about the same optical density at 1, 2 and 3 m is Beer's law; what "
      "differs is the angle of the stroke.";
  constexpr double from = 3.00 * of_density, to = 3.55 * of_density;
  for (const double size : {1.0, 3.0}) {
    for (const double distance_m : {1.0, 2.0, 3.0}) {
      Trial trial;
      trial.name = fmt::format("{:.0f} mm, {:g} m", 38 * size, distance_m);
      trial.scene = {
          .distance_m = distance_m,
          .target = {.shape = TargetShape::text,
                     .width_m = 0.038 * size,
                     .stroke_m = 0.0059 * size,
                     .text = "EXIT",
                     .luminance_cd_m2 = 8.6,
                     .ground_cd_m2 = 86},
          .room = {.width_m = 1, .height_m = 1, .length_m = 3, .walls = 0.2, .far_wall = 0.2}};
      if (size == 1) trial.observed = Interval{from, to};
      if (size == 1) trial.scatter = "the range of the abstract";
      trial.searched = {2, 13};
      trial.of_reading = true;
      out.trials.push_back(trial);
      if (size == 1) out.claims.push_back({Rule::read, {out.trials.size() - 1}, trial.name});
    }
  }
  for (size_t i = 0; i < 3; ++i)
    out.claims.push_back({Rule::difference,
                          {i + 3, i},
                          "three times the size gains 0.2 to 1.0 in density, read at " +
                              out.trials[i].name.substr(7),
                          {0.2 * of_density, 1.0 * of_density},
                          7});
  return out;
}

// ---- T14: light on the floor -------------------------------------------------------------------

Experiment light_of_the_corridor() {
  Experiment out;
  out.id = "T14";
  out.title = "A lit pictogram in a dark, a dim and a lit corridor";
  out.source =
      "Wright and Webber, Visibility of four exit signs and two exit door markings in smoke as "
      "gauged by twenty people, Building Research Establishment";
  out.read =
      "The abstract: total optical density when first seen, in the dark as at 1 to 2 lx (no "
      "significant difference), more than at 130 to 190 lx.";
  out.assumed = {
      "Luminances of 50, 200 and 500 cd/m2, mean of the pictogram: they are not in the abstract.",
      "0.2 by 0.1 m before a wall of reflectance 0.5; a corridor of 20 by 2 by 2.5 m, walls 0.5.",
      "Illuminance is on the floor, half-way along the corridor, in clear air; the lamps face the "
      "ceiling.",
      "An optical density of 1/m in white smoke (0.8 to 1.4/m in the source).",
      "The program's eye is adapted to what it looks at, but in the rows that say otherwise: there "
      "it has been adapted to a view of 100 cd/m2 until 10 s before. People came from the light; "
      "from how much, and when, is not in the abstract."};
  const double luminances[] = {50, 200, 500};
  const auto add = [&](double luminance, double lux, const LightBefore& before) {
    Trial trial;
    trial.name = fmt::format("{:g} cd/m2, {:g} lx{}", luminance, lux,
                             before.seconds_ago ? ", from the light" : "");
    trial.scene = {
        .target = {.shape = TargetShape::rectangle,
                   .width_m = 0.2,
                   .height_m = 0.1,
                   .luminance_cd_m2 = luminance,
                   .ground_reflectance = 0.5},
        .room = {.width_m = 2, .height_m = 2.5, .length_m = 20, .walls = 0.5, .far_wall = 0.5},
        .lamps = {.lux = lux, .on_floor = true},
        .smoke = {.extinction = of_density},
        .before = before};
    trial.varied = Varied::distance;
    trial.searched = {1.5, 20};
    out.trials.push_back(trial);
    return out.trials.size() - 1;
  };
  for (const double luminance : luminances) {
    const size_t dark = add(luminance, 0, {}), dim = add(luminance, 1.5, {}),
                 lit = add(luminance, 160, {});
    const std::string at = fmt::format("{:g} cd/m2: ", luminance);
    out.claims.push_back({Rule::about_equal, {dark, dim}, at + "in the dark as at 1.5 lx"});
    out.claims.push_back({Rule::beyond, {dim, lit}, at + "farther at 1.5 lx than at 160 lx"});
    out.claims.push_back({Rule::beyond, {dark, lit}, at + "farther in the dark than at 160 lx"});
  }
  for (const double luminance : luminances) {
    const LightBefore room{100, 10};
    out.claims.push_back(
        {Rule::about_equal,
         {add(luminance, 0, room), add(luminance, 1.5, room)},
         fmt::format("{:g} cd/m2, from the light: in the dark as at 1.5 lx", luminance)});
  }
  return out;
}

// ---- T16: size in the dark ---------------------------------------------------------------------

Experiment size_in_the_dark() {
  Experiment out;
  out.id = "T16";
  out.title = "Square signs of 10 and 20 cm in the dark";
  out.source =
      "Yamada, Kubota, Abe, Iida 2004, 6th Asia-Oceania Symposium on Fire Science and Technology; "
      "SFPE Handbook, chapters 61 and 68";
  out.read =
      "Third hand: pyFDS-Evac reports the handbook. Slopes of distance over 1/K: 12.6 for the "
      "small square sign, 22.5 for the medium one. Signs of 250 to 800 cd/m2, K = 1/m.";
  out.assumed = {
      "10 and 20 cm: the sizes are not in what was read.",
      "No light but the sign's; a room of 32 by 4 by 3 m with walls of 0.5. White smoke: albedo 1, "
      "g = 0.6.",
      "The rectangular sign (lost at about 10 m) is left out, since its size is not known.",
      "\"Much farther\" is taken as more than what rule O calls about equal."};
  const auto add = [&](double edge_m, double luminance, const ExperimentSmoke& smoke,
                       const std::string& note) {
    Trial trial;
    trial.name = fmt::format("{:g} cm, {:g} cd/m2{}", 100 * edge_m, luminance, note);
    trial.scene = {
        .target = {.shape = TargetShape::rectangle,
                   .width_m = edge_m,
                   .luminance_cd_m2 = luminance,
                   .ground_reflectance = 0.5},
        .room = {.width_m = 4, .height_m = 3, .length_m = 32, .walls = 0.5, .far_wall = 0.5},
        .smoke = smoke};
    trial.varied = Varied::distance;
    trial.searched = {3, 30};
    out.trials.push_back(trial);
    return out.trials.size() - 1;
  };
  const auto observe = [&](size_t trial, double observed) {
    out.trials[trial].observed = Interval{observed, observed};
    out.trials[trial].scatter = "R2 of the lines 0.93";
  };
  for (const double luminance : {250.0, 800.0}) {
    const size_t small = add(0.10, luminance, {.extinction = 1}, "");
    const size_t medium = add(0.20, luminance, {.extinction = 1}, "");
    observe(small, 13);
    observe(medium, 22.5);
    out.trials[medium].scatter = "a slope of distance over 1/K, perhaps with an intercept";
    out.claims.push_back({Rule::seen, {small}, out.trials[small].name});
    out.claims.push_back(
        {Rule::much_beyond,
         {medium, small},
         fmt::format("{:g} cd/m2: 20 cm seen much farther than 10 cm", luminance)});
  }
  // Not judged: the same without the sign's light in the smoke, and with narrower scattering.
  for (const double edge_m : {0.10, 0.20})
    add(edge_m, 250, {.extinction = 1, .albedo = 0}, ", smoke of albedo 0");
  for (const double edge_m : {0.10, 0.20})
    add(edge_m, 250, {.extinction = 1, .g = 0.85}, ", g = 0.85");
  return out;
}

}  // namespace

void add_sign_experiments(Experiments& all) {
  all.push_back(landolt_ring_in_smoke());
  all.push_back(aircraft_exit_sign());
  all.push_back(light_of_the_corridor());
  all.push_back(size_in_the_dark());
}

}  // namespace luxodus::light
