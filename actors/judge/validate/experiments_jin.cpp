// Jin's experiments in a chamber of 1.2 by 1.2 by 5.5 m, as pyFDS-Evac reports them.
#include <fmt/format.h>

#include <numbers>

#include "actors/judge/validate/experiment.hpp"

namespace luxodus::light {

namespace {

constexpr const char* second_hand =
    "Second hand: pyFDS-Evac, site/content/fundamentals/visibility.md, whose authors read the "
    "paper; ";
constexpr const char* chamber_light =
    "Illuminance is horizontal, in the middle of the chamber and in clear air: the source does not "
    "say where. The last rows of T1 have it measured in the smoke.";

/// From the eye to the far wall [m].
constexpr double chamber_m = 5.5;

ExperimentRoom jin_chamber() {
  return {.width_m = 1.2, .height_m = 1.2, .walls = 0.8, .far_wall = 0.07};
}

/// A disc that is lit from behind, before the black wall.
ExperimentTarget lit_disc(double diameter_m, double luminance) {
  return {.shape = TargetShape::disc,
          .width_m = diameter_m,
          .luminance_cd_m2 = luminance,
          .ground_reflectance = 0.07};
}

// ---- T1: luminance of a lit disc ---------------------------------------------------------------

Trial disc_trial(double ratio, bool in_smoke, std::optional<double> observed) {
  constexpr double lux = 180;
  Trial trial;
  trial.name = fmt::format("pi B/E = {:g}{}", ratio, in_smoke ? ", E in the smoke" : "");
  trial.scene = {.distance_m = chamber_m,
                 .target = lit_disc(0.05, ratio * lux / std::numbers::pi),
                 .room = jin_chamber(),
                 .lamps = {.lux = lux, .in_smoke = in_smoke}};
  if (observed) trial.observed = Interval{*observed, *observed};
  if (observed) trial.scatter = "about three repeats";
  return trial;
}

Experiment luminance_of_a_disc() {
  Experiment out;
  out.id = "T1";
  out.title = "A lit disc of 5 cm in a lit chamber of white smoke: luminance";
  out.source =
      "T. Jin 1970, Visibility through fire smoke (I), Bulletin of the Fire Prevention Society of "
      "Japan 19(2) 1-8, Fig. 11";
  out.read = std::string(second_hand) + "the figure is a graph. The abstract was read (J-Stage).";
  out.assumed = {chamber_light,
                 "The disc reflects nothing: the stated luminance is all that leaves it.",
                 "White smoke: albedo 1, Henyey and Greenstein's g = 0.6."};
  out.beer =
      "A slope of 1 in ln B is Beer's law, as long as the threshold does not depend on B. What is "
      "tested is that the light of the disc in the smoke does not raise the threshold.";
  struct Row {
    double ratio, optical_depth;
  };
  for (const Row& row : {Row{1, 4.6}, Row{5, 6.2}, Row{20, 7.6}, Row{50, 8.5}})
    out.trials.push_back(disc_trial(row.ratio, false, row.optical_depth));
  for (const double ratio : {1.0, 50.0})
    out.trials.push_back(disc_trial(ratio, true, std::nullopt));
  for (size_t i = 0; i < 4; ++i) out.claims.push_back({Rule::seen, {i}, out.trials[i].name});
  out.claims.push_back({Rule::slope,
                        {0, 1, 2, 3},
                        "slope of the optical depth in ln B",
                        {.low = 0.95, .high = 1.05}});
  return out;
}

// ---- T2: threshold contrast --------------------------------------------------------------------

Experiment contrast_of_a_disc() {
  Experiment out;
  out.id = "T2";
  out.title = "Threshold contrast of a disc of 31 arcmin before 57 cd/m2";
  out.source = "T. Jin 1970, as T1, Table 1: by a photometer, without mirrors";
  out.read = std::string(second_hand) + "a table.";
  out.assumed = {"Clear air: the veil of smoke is replaced by a ground of the same luminance.",
                 "The luminance of the ground, 57 cd/m2, is that of 180 lx divided by pi."};
  Trial trial;
  trial.name = "contrast that is just seen";
  trial.scene = {.distance_m = chamber_m, .target = lit_disc(0.05, 0)};
  trial.scene.target.ground_cd_m2 = 57;
  trial.varied = Varied::contrast;
  trial.searched = {1e-4, 1};
  trial.observed = Interval{0.010, 0.013};
  trial.scatter = "the interval of all runs";
  out.trials = {trial};
  out.claims = {{Rule::value, {0}, "contrast that is just seen", {.low = 0.008, .high = 0.016}}};
  return out;
}

// ---- T5: size of a placard ---------------------------------------------------------------------

Experiment size_of_a_placard() {
  Experiment out;
  out.id = "T5";
  out.title = "A placard at 10 m that lamps light: size";
  out.source = "T. Jin 1970, as T1, Fig. 12";
  out.read = std::string(second_hand) + "their reading of a graph.";
  out.assumed = {"A grey disc of reflectance 0.30 before the black wall of 0.07, in 180 lx.",
                 chamber_light,
                 "The chamber is 10 m long: mirrors lengthen the line of sight in the real one."};
  constexpr double distance_m = 10;
  struct Row {
    double arcmin, extinction;
  };
  for (const Row& row : {Row{5, 0.2}, Row{27, 0.4}, Row{60, 0.4}}) {
    const double diameter = distance_m * row.arcmin / 60 * std::numbers::pi / 180;
    Trial trial;
    trial.name = fmt::format("{:g} arcmin", row.arcmin);
    trial.scene = {.distance_m = distance_m,
                   .target = lit_disc(diameter, 0),
                   .room = jin_chamber(),
                   .lamps = {.lux = 180}};
    trial.scene.target.reflectance = 0.30;
    const double depth = row.extinction * distance_m;
    trial.observed = Interval{depth, depth};
    trial.scatter = "not stated";
    out.trials.push_back(trial);
  }
  out.claims = {
      {Rule::quotient, {2, 1}, "K of 60 arcmin over that of 27 arcmin", {-unlimited, 1.15}},
      {Rule::quotient, {1, 0}, "K of 27 arcmin over that of 5 arcmin", {1.4, unlimited}}};
  return out;
}

// ---- T6: black smoke ---------------------------------------------------------------------------

Experiment black_smoke() {
  Experiment out;
  out.id = "T6";
  out.title = "A lit disc of 5 cm in white and in darker smoke";
  out.source =
      "T. Jin 1971, Visibility through fire smoke (II), Bulletin of the Japanese Association of "
      "Fire Science and Engineering 21(1) 17-23; Report 33 of the Fire Research Institute, Fig. 1";
  out.read = std::string(second_hand) + "their reading of a graph.";
  out.assumed = {
      "80 lx in the smoke, horizontal, in the middle of the chamber: in black smoke this differs "
      "from clear air by up to 2.7 in optical depth.",
      "Albedo 1 for smoke of smouldering, 0.6 for that of flames: the paper's share of scattering "
      "is a ratio to white smoke, not an albedo.",
      "The paper's unit of luminance is disputed by a factor of pi, 1.14 in optical depth; cd/m2 "
      "is taken.",
      "Which of the points belongs to which luminance is not known: all must lie in the range of "
      "all points."};
  for (const double albedo : {1.0, 0.6}) {
    for (const double luminance : {500.0, 2000.0}) {
      Trial trial;
      trial.name = fmt::format("{:g} cd/m2, albedo {:g}", luminance, albedo);
      trial.scene = {.distance_m = chamber_m,
                     .target = lit_disc(0.05, luminance),
                     .room = jin_chamber(),
                     .lamps = {.lux = 80, .in_smoke = true},
                     .smoke = {.albedo = albedo}};
      trial.observed = Interval{7.8, 9.8};
      trial.scatter = "the range of all points";
      out.trials.push_back(trial);
    }
  }
  const Interval range{7.8 - limits::seen_within, 9.8 + limits::seen_within};
  for (size_t i = 0; i < 4; ++i)
    out.claims.push_back({Rule::value, {i}, out.trials[i].name + " in the range", range});
  out.claims.push_back({Rule::beyond, {2, 0}, "500 cd/m2: seen farther in the darker smoke"});
  out.claims.push_back({Rule::beyond, {3, 1}, "2000 cd/m2: seen farther in the darker smoke"});
  return out;
}

// ---- T17: colours of lit discs -----------------------------------------------------------------

Trial coloured_trial(const char* colour, double light_nm, const char* smoke, double albedo) {
  Trial trial;
  trial.name = fmt::format("{}, {} smoke", colour, smoke);
  trial.scene = {.distance_m = chamber_m,
                 .target = lit_disc(0.05, 500),
                 .room = jin_chamber(),
                 .lamps = {.lux = 80},
                 .smoke = {.albedo = albedo, .angstrom = 1}};
  trial.scene.target.light_nm = light_nm;
  trial.searched = {2, 20};
  return trial;
}

Experiment colours_of_a_disc() {
  Experiment out;
  out.id = "T17";
  out.title = "Lit discs of equal luminance in red, green, blue and white: colour";
  out.source = "T. Jin 1974, in T. Jin 1978, Journal of Fire and Flammability 9, 135-155";
  out.read =
      "Third hand: pyFDS-Evac, and Boerger, Belt, Arnold 2024, section 1. The source computed "
      "distances from extinctions that it measured at 657 and 483 nm: red is seen 20 to 40 % "
      "farther than blue in white smoke, 20 to 30 % in black smoke.";
  out.assumed = {
      "Red and blue are light of 657 and 483 nm, green of 545 nm, all of 500 cd/m2 in a lit "
      "chamber (80 lx in clear air).",
      "Extinction is proportional to the inverse of the wavelength. For absorption by black carbon "
      "an exponent near 1 is measured (Lewis, Arnott, Moosmueller, Wold 2008, Journal of "
      "Geophysical Research 113, D16203, abstract); for white smoke it is only assumed.",
      "Optical depths are stated at 633 nm. At one extinction, a target of another threshold is "
      "seen so many times as far.",
      "White smoke has an albedo of 1, black smoke one of 0.3. Ageing smoke is not computed: of "
      "smoke of burning crude oil, extinctions at 450, 630 and 1000 nm were measured to stay as "
      "they are while it ages for two hours (Dobbins, Mulholland, Bryner 1994, Atmospheric "
      "Environment 28(5), abstract)."};
  out.beer =
      "That red is seen farther follows from Beer's law and the exponent. What is tested is that "
      "light of each colour meets its own extinction, and that scattered light does not change it.";
  for (const auto& [smoke, albedo] : {std::pair{"white", 1.0}, {"black", 0.3}})
    for (const auto& [colour, nm] :
         {std::pair{"red", 657.0}, {"green", 545.0}, {"blue", 483.0}, {"white", 0.0}})
      out.trials.push_back(coloured_trial(colour, nm, smoke, albedo));
  out.claims = {
      {Rule::quotient, {0, 2}, "white smoke: red seen 20 to 40 % farther than blue", {1.2, 1.4}},
      {Rule::quotient, {4, 6}, "black smoke: red seen 20 to 30 % farther than blue", {1.2, 1.3}},
      {Rule::beyond, {0, 1}, "white smoke: red seen farther than green"},
      {Rule::beyond, {1, 2}, "white smoke: green seen farther than blue"}};
  return out;
}

}  // namespace

void add_jin_experiments(Experiments& all) {
  all.push_back(luminance_of_a_disc());
  all.push_back(contrast_of_a_disc());
  all.push_back(size_of_a_placard());
  all.push_back(black_smoke());
  all.push_back(colours_of_a_disc());
}

}  // namespace luxodus::light
