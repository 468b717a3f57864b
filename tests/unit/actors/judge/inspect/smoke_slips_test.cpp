// Mistakes in smoke, scenarios and the settings of an assessment.
#include "tests/unit/actors/judge/inspect/inspect_kit.hpp"

using namespace luxodus;
using namespace luxodus::inspection;

namespace {

const std::string judged_room = furnished_room + long_way;

std::string even(const std::string& optics, const std::string& where = "") {
  return "[[medium]]\nname = \"smoke\"\nkind = \"homogeneous\"\n" + optics + "\n" + where;
}

std::string layer(double low, double high, double extinction) {
  return "{ z_low = " + std::to_string(low) + ", z_high = " + std::to_string(high) +
         ", extinction = " + std::to_string(extinction) + ", albedo = 0.3 },";
}

std::string layered(const std::string& layers, const std::string& where = "") {
  return "[[medium]]\nname = \"smoke\"\nkind = \"layered\"\n" + where + "layer = [" + layers +
         "]\n";
}

std::string state(const std::string& keys) {
  return "[[scenario]]\nname = \"fire\"\noperation = \"emergency\"\n" + keys;
}

}  // namespace

TEST_CASE("extinctions in another unit are reported, with the factor of a scenario",
          "[inspect][smoke]") {
  check_found(found_in(judged_room + even("extinction = 500\nalbedo = 0.3")), Severity::warning,
              "has an extinction of 500 /m");
  check_found(found_in(judged_room + even("extinction = 10\nalbedo = 0.3")), Severity::note,
              "is it a visibility in metres?");
  check_found(found_in(judged_room + even("extinction = 0.0002\nalbedo = 0.3")), Severity::warning,
              "which takes 0.02 % of the light in a metre");
  check_found(
      found_in(judged_room + even("extinction = 0.5\nalbedo = 0.3") + state("smoke_factor = 80\n")),
      Severity::warning, "with the largest factor of a scenario, 80, an extinction of 40");
  check_found(found_in(judged_room + even("soot_density = 0.1\nsmoke = \"flaming\"\nalbedo = 0.3")),
              Severity::warning, "'soot_density' is 0.1 kg/m3");
  check_found(
      found_in(judged_room + even("soot_density = 1e-4\nmass_extinction = 8.7\nalbedo = 0.3")),
      Severity::warning, "8.7 m2/g is 8700 m2/kg");
  check_found(found_in(judged_room + even("percent_per_m = 0.5\nalbedo = 0.3")), Severity::warning,
              "'percent_per_m' is 0.5 %");
  check_no_alarm(found_in(judged_room + even("soot_density = 1e-4\nsmoke = \"flaming\"\n"
                                             "albedo = 0.3")));
}

TEST_CASE("implausible optics of smoke are reported", "[inspect][smoke]") {
  const auto found = [](const std::string& optics) {
    return found_in(judged_room + even("extinction = 0.5\n" + optics));
  };
  check_found(found("albedo = 1"), Severity::warning, "it absorbs nothing, as fog does");
  check_found(found("albedo = 0"), Severity::warning, "it scatters nothing");
  check_found(found("albedo = 0.9\nsmoke = \"flaming\""), Severity::warning,
              "is said to be of a flaming fire and has an albedo of 0.9");
  check_found(found("albedo = 0.2\nsmoke = \"smouldering\""), Severity::warning,
              "of smouldering smoke, whose droplets hardly absorb");
  check_found(found("albedo = 0.3\nphase = \"hg\"\ng = 0.99"), Severity::warning,
              "nearly all that it scatters goes straight on");
  check_found(found("albedo = 0.3\nphase = \"hg\"\ng = -0.6"), Severity::warning,
              "it would scatter back more than on");
  check_found(found("albedo = 0.3\nphase = \"rayleigh\""), Severity::warning,
              "as particles far smaller than a wavelength do");
  check_found(found("albedo = 0.3\nangstrom = 5"), Severity::warning, "an Angstrom exponent of 5");
  check_found(found("albedo = 0.3\nangstrom = 1\nwavelength_nm = 4000"), Severity::warning,
              "states its extinction at 4000 nm");
  check_no_alarm(found("albedo = 0.3\nphase = \"hg\"\ng = 0.6"));
  check_no_alarm(found("albedo = 0.95\nsmoke = \"smouldering\""));
  // Without people who look for signs it may be intended.
  check_no_alarm(found_in(closed_room + lamp + even("extinction = 0.5\nalbedo = 1")));
}

TEST_CASE("smoke upside down, with gaps, or over no judged place is reported", "[inspect][smoke]") {
  const auto found = [](const std::string& smoke) { return found_in(judged_room + smoke); };
  check_found(found(layered(layer(0, 1.5, 1) + layer(1.5, 3, 0.1))), Severity::warning,
              "is denser below than above: 1 /m in the lower half");
  check_found(found(layered(layer(1.5, 2.2, 0.8) + layer(2.2, 3, 0.2))), Severity::warning,
              "is densest below: 0.75 /m in its lower half");
  check_found(found(even("extinction = 0.5\nalbedo = 0.3", "z_high = 1.2\n")), Severity::warning,
              "is denser below than above");
  check_found(found(layered(layer(1.5, 2.7, 0.5))), Severity::warning,
              "leaves clear air above it, up to the ceiling at 3 m");
  check_found(found(layered(layer(0.5, 1.4, 0.1) + layer(1.9, 3, 0.5))), Severity::warning,
              "leaves clear air between two layers");
  check_found(found(layered(layer(1, 3, 0.5), "box = [[0, 1.2], [12, 2]]\n")), Severity::warning,
              "lies over no route and no open area");
  check_found(found(layered(layer(2.2, 3, 0.5))), Severity::note,
              "all eyes on routes and in open areas are below the smoke");
  CHECK(found(layered(layer(1, 2, 0.2) + layer(2, 3, 0.8))).empty());
  CHECK(found(even("extinction = 0.5\nalbedo = 0.3")).empty());
  // In a state without smoke there is no finding.
  CHECK(
      that_say(found(layered(layer(0, 1.5, 1) + layer(1.5, 3, 0.1)) + state("smoke_factor = 0\n")),
               "denser below")
          .empty());
}

TEST_CASE("flames in another unit are reported", "[inspect][smoke]") {
  const auto found = [](const std::string& emission) {
    return found_in(judged_room +
                    "[[medium]]\nname = \"fire\"\nkind = \"bounded\"\nbody = \"ellipsoid\"\n"
                    "position = [3, 1, 0.6]\nradii = [0.2, 0.2, 0.5]\nextinction = 0.5\n"
                    "albedo = 0.2\n[medium.emission]\n" +
                    emission);
  };
  check_found(found("power_w = 50\ntemperature_k = 1400\n"), Severity::warning, "Is it in kW?");
  check_found(found("power_w = 5e9\ntemperature_k = 1400\n"), Severity::warning, "Is it in kW?");
  check_found(found("power_w = 50000\ntemperature_k = 900\n"), Severity::warning,
              "900 degrees Celsius are 1173 K");
  check_no_alarm(found("power_w = 50000\ntemperature_k = 1400\n"));
}

TEST_CASE("smoke that is in no scenario is reported", "[inspect][smoke]") {
  const std::string smoke = even("extinction = 0.5\nalbedo = 0.3");
  check_found(found_in(judged_room + smoke + state("smoke_factor = 0\n")), Severity::warning,
              "no scenario has the smoke \"smoke\"");
  CHECK(found_in(judged_room + smoke + state("smoke_factor = 0\n") +
                 "[[scenario]]\nname = \"smoke\"\n")
            .empty());
}

TEST_CASE("smoke without extinction, or over few of the judged places, is reported",
          "[inspect][smoke]") {
  check_found(found_in(judged_room + even("extinction = 0\nalbedo = 0.3")), Severity::warning,
              "has an extinction of 0: it is clear air");
  check_found(found_in(judged_room + layered(layer(1, 3, 0.5), "box = [[0, -2], [3.5, 2]]\n")),
              Severity::note, "lies over 2 of the 6 places");
  CHECK(found_in(judged_room + layered(layer(1, 2, 0) + layer(2, 3, 0.5))).size() == 1);
}

TEST_CASE("settings that contradict the smoke are reported", "[inspect][smoke]") {
  const std::string flaming = even("extinction = 0.5\nsmoke = \"flaming\"\nalbedo = 0.3");
  const auto found = [&](const std::string& keys, const std::string& smoke) {
    return found_in(judged_room + smoke + state("") + "[assessment]\n" + keys);
  };
  check_found(found("irritant_smoke = false\n", flaming), Severity::warning,
              "is of a flaming fire, whose smoke does: say irritant_smoke = true");
  check_found(found("irritant_smoke = true\nsmoke_expected = false\n", flaming), Severity::warning,
              "signs would be judged by 2 cd/m2 instead of 10");
  check_no_alarm(found("irritant_smoke = true\n", flaming));
  check_no_alarm(found("irritant_smoke = false\n", even("extinction = 0.5\nalbedo = 0.9")));
  check_no_alarm(found("smoke_expected = false\n", ""));
}

TEST_CASE("scenarios with percentages, dark luminaires and late hours are reported",
          "[inspect][state]") {
  const std::string on_circuit =
      replaced(judged_room, "name = \"lamp\"\n", "name = \"lamp\"\ncircuit = \"lamps\"\n");
  check_found(found_in(on_circuit + state("circuits = { lamps = 80 }\n")), Severity::warning,
              "gives the circuit \"lamps\" 80 times its flux");
  check_found(found_in(on_circuit + state("circuits = { lamps = 0 }\n")), Severity::note,
              "has switched off luminaire \"lamp\" by its circuits");
  check_found(found_in(replaced(judged_room,
                                "emergency = \"non-maintained\"\nemergency_flux = 500\n"
                                "maintenance_factor = 0.8\nemergency_flux_is = "
                                "\"initial\"\nend_of_duration_factor = 0.75\n",
                                "") +
                       state("")),
              Severity::warning, "no luminaire of the scene is lit when the mains fail");
  check_found(found_in(judged_room + state("seconds_after_failure = 36000\n")), Severity::warning,
              "is 10 h after the failure of the mains");
  check_found(found_in(judged_room + state("seconds_after_failure = 7200\n")), Severity::note,
              "batteries rated for 1 h are empty");
  CHECK(found_in(judged_room + state("seconds_after_failure = 600\n")).empty());
}

TEST_CASE("supplies that are exhausted in a state are reported", "[inspect][state]") {
  const auto lasting = [](const std::string& hours) {
    return replaced(replaced(judged_room, "end_of_duration_factor = 0.75\n",
                             "end_of_duration_factor = 0.75\nduration_h = " + hours + "\n"),
                    "emergency_green = 10\n", "emergency_green = 10\nduration_h = " + hours + "\n");
  };
  const auto brief = found_in(lasting("0.01") + state("seconds_after_failure = 36\n"));
  check_found(brief, Severity::warning, "the supply of luminaire \"lamp\" lasts 36 s");
  check_found(brief, Severity::warning, "the supply of sign \"exit\" lasts 36 s");
  CHECK(found_in(lasting("0.01") + state("seconds_after_failure = 35\n")).empty());
  CHECK(found_in(lasting("2.5") + state("seconds_after_failure = 7200\n")).empty());
}

TEST_CASE("smoke scaled down to clear air is reported", "[inspect][state][smoke]") {
  const auto found = [](const std::string& keys) {
    return found_in(judged_room + even("extinction = 0.5\nalbedo = 0.3") + state(keys));
  };
  check_found(found("smoke_factor = 0.01\n"), Severity::warning,
              "leaves 0.01 of the smoke \"smoke\", at most 0.005 /m");
  check_found(found("media = { smoke = 0.05 }\n"), Severity::warning, "is seen for 320 m");
  check_no_alarm(found("smoke_factor = 0.5\n"));
  check_no_alarm(found("smoke_factor = 0.1\n"));
}

TEST_CASE("one of several smokes that is in no scenario is reported", "[inspect][smoke]") {
  const std::string haze =
      "[[medium]]\nname = \"haze\"\nkind = \"homogeneous\"\n"
      "extinction = 0.01\nalbedo = 0.3\n";
  const auto found = [&](const std::string& keys) {
    return found_in(judged_room + even("extinction = 0.5\nalbedo = 0.3") + haze + state(keys));
  };
  check_found(found("media = { smoke = 0 }\n"), Severity::warning,
              "no scenario has the smoke \"smoke\": signs are judged without it");
  CHECK(that_say(found(""), "no scenario has the smoke").empty());
}

TEST_CASE("a change that thins smoke is named, not the scenario", "[inspect][state][smoke]") {
  const auto found = [](const std::string& factor) {
    return found_in(
        "include = [\"base.toml\"]\n\n[[change]]\nkind = \"medium\"\n"
        "of = \"smoke\"\nfactor = " +
            factor + "\n",
        {{"base.toml", judged_room + even("extinction = 0.5\nalbedo = 0.3") + state("")}});
  };
  for (const char* factor : {"0.01", "0"}) {
    const auto findings = found(factor);
    check_found(findings, Severity::warning, "this [[change]] of \"smoke\" thins it");
    CHECK(that_say(findings, "thins it").front().problem.where.line == 3);
  }
  check_no_alarm(found("0.5"));
}

TEST_CASE("a glow that is judged at the moment of the failure is reported", "[inspect][state]") {
  const std::string glow =
      replaced(replaced(exit_sign, "mains_white = 500\nmains_green = 50\n", ""),
               "emergency_white = 100\nemergency_green = 10\n",
               "lighting = \"photoluminescent\"\nemergency_white = 1\nemergency_green = 0\n"
               "decay = [[0, 1], [60, 0.3], [600, 0.03], [3600, 0.005]]\n");
  const auto found = [&](const std::string& keys) {
    return found_in(closed_room + lamp + long_way + glow + state(keys));
  };
  check_found(found(""), Severity::warning,
              "the photoluminescent sign \"exit\" is judged as bright as at the failure");
  CHECK(that_say(found("seconds_after_failure = 600\n"), "as at the failure").empty());
}

TEST_CASE("better than normal sight is reported", "[inspect][state]") {
  const auto found = [](const std::string& keys) {
    return found_in(judged_room + state("") + "[assessment]\n" + keys);
  };
  check_found(found("age_years = 25\n"), Severity::note, "signs are judged by young eyes");
  check_found(found("eye_heights_m = [0.6]\n"), Severity::note, "nobody who walks upright");
  check_found(found_in(judged_room + even("extinction = 0.5\nalbedo = 0.3") + state("") +
                       "[assessment]\neye_heights_m = [0.6]\nirritant_smoke = true\n"),
              Severity::warning, "nobody who walks upright");
  check_found(found("eye_heights_m = [2.4]\n"), Severity::warning, "eyes of people are 1.4 to");
  check_found(found("spacing_m = 20\n"), Severity::note, "spacing_m = 20");
  check_found(found("rules = [\"en1838-2013\", \"en1838-2024\"]\n"), Severity::note,
              "rules names two editions of EN 1838");
  CHECK(found("age_years = 65\n").empty());
  check_found(
      found_in(judged_room + "[[task_area]]\nname = \"bench\"\noutline = [[2, -1], [4, -1], "
                             "[4, 1], [2, 1]]\nz = 0.85\nmains_lx = 0.5\n"),
      Severity::warning, "asks for 0.5 lx in mains operation");
}
