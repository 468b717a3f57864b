// Mistakes in luminaires, light, materials and signs: each is reported with its line, and similar
// correct scenes are not.
#include "tests/unit/actors/judge/inspect/inspect_kit.hpp"

using namespace luxodus;
using namespace luxodus::inspection;

namespace {

/// The furnished room with a luminaire of a sample file and these keys.
std::vector<Finding> with_luminaire(const std::string& keys,
                                    const std::string& file = "emergency_downlight.ldt") {
  const test::TemporaryFolder folder;
  std::filesystem::copy_file(
      std::filesystem::path(LUX_SOURCE_DIR) / "scenes/library/luminaires" / file,
      folder / "lamp.ldt");
  return inspected(described(
      folder.write("scene.toml", furnished_room + long_way +
                                     "[[luminaire]]\nname = \"light\"\nfile = \"lamp.ldt\"\n"
                                     "position = [3, 0, 2.97]\n" +
                                     keys)));
}

std::string emergency(const std::string& keys, const std::string& mode = "non-maintained") {
  return "emergency = \"" + mode + "\"\n" + keys +
         "\nmaintenance_factor = 0.8\nemergency_flux_is = \"initial\"\nend_of_duration_factor = "
         "0.7\n";
}

std::vector<Finding> with_lamp(const std::string& from, const std::string& to) {
  return found_in(closed_room + replaced(lamp, from, to) + exit_sign + long_way);
}

std::vector<Finding> with_exit_sign(const std::string& from, const std::string& to) {
  return found_in(closed_room + lamp + replaced(exit_sign, from, to) + long_way);
}

std::string glowing(const std::string& white, const std::string& decay) {
  return closed_room + lamp +
         replaced(exit_sign,
                  "mains_white = 500\nmains_green = 50\nemergency_white = 100\n"
                  "emergency_green = 10\n",
                  "lighting = \"photoluminescent\"\nemergency_white = " + white +
                      "\nemergency_green = 0.05\ndecay = " + decay + "\n") +
         long_way;
}

}  // namespace

TEST_CASE("emergency fluxes that equal the mains flux, are zero or are a share are reported",
          "[inspect][light]") {
  check_found(with_luminaire(emergency("emergency_flux = 0.15")), Severity::warning,
              "gives 0.15 lm in emergency operation: emergency_flux is in lm");
  check_found(with_luminaire(emergency("emergency_factor = 1", "maintained"), "office_panel.ldt"),
              Severity::warning, "gives all of its mains flux, 4000 lm, in emergency operation");
  check_found(with_luminaire(emergency("emergency_factor = 1", "maintained"), "bulkhead.ldt"),
              Severity::note, "gives all of its mains flux, 250 lm");
  check_found(with_luminaire(emergency("emergency_factor = 1"), "office_panel.ldt"),
              Severity::warning, "is that the flux of its mains operation?");
  check_found(with_luminaire(emergency("emergency_flux = 0", "maintained")), Severity::warning,
              "is an emergency luminaire whose emergency flux is 0");
  check_found(with_luminaire(emergency("emergency_flux = 0")), Severity::warning,
              "gives no light in any operation");
  check_found(with_lamp("emergency_flux = 500", "emergency_flux = 5000"), Severity::warning,
              "emitter \"lamp\" gives 5000 lm in emergency operation: is that the flux of its");
  check_no_alarm(with_luminaire(emergency("emergency_factor = 1")));
  check_no_alarm(
      with_luminaire(emergency("emergency_factor = 0.1", "maintained"), "office_panel.ldt"));
}

TEST_CASE("factors that state a loss, a percentage or no ageing are reported", "[inspect][light]") {
  check_found(with_lamp("maintenance_factor = 0.8", "maintenance_factor = 0.2"), Severity::warning,
              "it is the share that is left of the light, not the one that is lost");
  check_found(with_lamp("end_of_duration_factor = 0.75", "end_of_duration_factor = 0.25"),
              Severity::warning, "an end_of_duration_factor of 0.25");
  check_found(with_lamp("maintenance_factor = 0.8", "maintenance_factor = 1"), Severity::warning,
              "as if it never aged");
  check_found(with_lamp("end_of_duration_factor = 0.75", "end_of_duration_factor = 1"),
              Severity::note, "does not fall until the battery is empty");
  check_found(with_lamp("emergency_flux_is = \"initial\"\n", ""), Severity::warning,
              "does not say what its emergency flux is");
  check_found(with_lamp("emergency_flux_is = \"initial\"\nend_of_duration_factor = 0.75",
                        "emergency_flux_is = \"rated\""),
              Severity::note, "has a rated emergency flux and no initial_flux");
  check_found(with_luminaire("mains_factor = 50\n", "office_panel.ldt"), Severity::warning,
              "gives 50 times the 4000 lm of its file in mains operation");
  check_no_alarm(with_luminaire("mains_factor = 0.5\nmaintenance_factor = 0.8\n"));
}

TEST_CASE("an object that hides a luminaire's light, and may be its body, is reported",
          "[inspect][light]") {
  const auto housing = [](const std::string& more, const std::string& high = "[3.2, 0.2, 2.99]") {
    return with_luminaire(
        "[[object]]\nname = \"housing\"\nshape = \"box\"\n"
        "low = [2.8, -0.2, 2.975]\nhigh = " +
            high + "\nmaterial = \"grey50\"\n" + more,
        "bulkhead.ldt");
  };
  const std::string words = "the body needs body_of = [\"light\"]";
  check_found(housing(""), Severity::warning, words.c_str());
  CHECK(that_say(housing("body_of = [\"light\"]\n"), words).empty());
  // What is larger than any luminaire is none.
  CHECK(that_say(housing("", "[7.2, 0.2, 2.99]"), words).empty());
}

TEST_CASE("a finding shared by luminaires is reported once, with their number",
          "[inspect][light]") {
  const auto twice = found_in(
      closed_room + exit_sign + long_way +
      replaced(lamp, "maintenance_factor = 0.8", "maintenance_factor = 1") +
      replaced(replaced(replaced(lamp, "maintenance_factor = 0.8", "maintenance_factor = 1"),
                        "\"lamp\"", "\"other\""),
               "[6, 0, 2.5]", "[9, 0, 2.5]"));
  check_found(twice, Severity::warning, "is usual (and 1 other)");
}

TEST_CASE("the only luminaire of a file that goes off with the mains is noted",
          "[inspect][light]") {
  const auto found = [](const std::string& first, int more) {
    std::string others;
    for (int i = 1; i <= more; ++i)
      others += "[[luminaire]]\nname = \"light " + std::to_string(i) +
                "\"\nfile = \"lamp.ldt\"\nposition = [" + std::to_string(3 + i) + ", 1, 2.97]\n" +
                emergency("emergency_factor = 0.5");
    return with_luminaire(first + others);
  };
  check_found(found("", 2), Severity::note,
              "luminaire \"light\" fails with the mains, and the other 2 of its file \"lamp.ldt\"");
  const std::string words = "fails with the mains, and";
  CHECK(that_say(found("", 1), words).empty());
  CHECK(that_say(found(emergency("emergency_factor = 0.5"), 2), words).empty());
}

TEST_CASE("photometric files in another unit, with too little light or normalised are reported",
          "[inspect][light]") {
  const auto with_file = [](const std::string& from, const std::string& to) {
    const test::TemporaryFolder folder;
    std::ifstream in(std::filesystem::path(LUX_SOURCE_DIR) /
                     "scenes/library/luminaires/wall_bulkhead.ies");
    std::string text{std::istreambuf_iterator<char>(in), {}};
    text = replaced(text, from, to);
    folder.write("lamp.ies", text);
    return inspected(described(folder.write(
        "scene.toml", furnished_room + "[[luminaire]]\nname = \"light\"\nfile = \"lamp.ies\"\n"
                                       "position = [3, 0, 2.9]\n")));
  };
  std::ifstream in(std::filesystem::path(LUX_SOURCE_DIR) /
                   "scenes/library/luminaires/wall_bulkhead.ies");
  std::string line, numbers;
  while (std::getline(in, line))
    if (line.starts_with("TILT=")) std::getline(in, numbers);
  // lamps, lumens, multiplier, angles, type, unit, width, length, height
  std::istringstream words(numbers);
  std::string lamps, lumens, multiplier, rest;
  words >> lamps >> lumens >> multiplier;
  std::getline(words, rest);
  const auto scaled = [&](const std::string& factor) {
    return lamps + " " + lumens + " " + factor + rest;
  };
  REQUIRE(lumens == "-1");
  const auto weak = with_file(numbers, scaled("0.001"));
  CHECK(that_say(weak, "whose intensities add up to 0.4 lm").size() == 1);
  const auto normalised = with_file(numbers, scaled("2.5"));
  CHECK(that_say(normalised, "are they candela per 1000 lm").size() == 1);
  const auto strong = with_file(numbers, scaled("20"));
  CHECK(that_say(strong, "more than any lamp gives").size() == 1);
  for (const auto& found : {weak, normalised, strong}) CHECK_FALSE(has_error(found));
}

TEST_CASE("colour temperatures with a digit too many or too few are reported", "[inspect][light]") {
  check_found(with_lamp("flux_lm = 1000", "flux_lm = 1000\nspectrum = \"65000 K\""),
              Severity::warning, "'spectrum' is a black body of 65000 K");
  check_no_alarm(with_lamp("flux_lm = 1000", "flux_lm = 1000\nspectrum = \"2700 K\""));
}

TEST_CASE("implausible reflectances, and black rooms, are reported", "[inspect][light]") {
  const auto walls = [](const std::string& material, const std::string& more = long_way) {
    return found_in(replaced(closed_room, "grey50", material) + lamp + exit_sign + more);
  };
  check_found(found_in("[[material]]\nname = \"snow\"\nreflectance = 0.97\n" +
                       replaced(closed_room, "grey50", "snow") + lamp + exit_sign + long_way),
              Severity::warning, "material \"snow\" reflects 0.97 of the light");
  CHECK(that_say(walls("black0"), "all surfaces are black").size() == 1);
  CHECK(that_say(walls("black0", ""), "all surfaces are black").front().severity == Severity::note);
  check_no_alarm(walls("black5"));
  check_no_alarm(walls("white85"));
}

TEST_CASE("signs that are dark, reversed or brighter than their kind are reported",
          "[inspect][light]") {
  check_found(with_exit_sign("emergency_white = 100\nemergency_green = 10",
                             "emergency_white = 0\nemergency_green = 0"),
              Severity::warning, "it is dark when the mains fail");
  check_found(with_exit_sign("emergency_white = 100\nemergency_green = 10",
                             "emergency_white = 10\nemergency_green = 100"),
              Severity::warning, "white is the brighter one; are they swapped?");
  check_found(with_exit_sign("emergency_white = 100\nemergency_green = 10",
                             "emergency_white = 100\nemergency_green = 80"),
              Severity::warning, "its legend hardly stands out");
  check_found(with_exit_sign("emergency_green = 10", "emergency_green = 0.1"), Severity::warning,
              "has white 1e+03 times as bright as green");
  check_found(with_exit_sign("emergency_white = 100\nemergency_green = 10",
                             "emergency_white = 800\nemergency_green = 80"),
              Severity::warning, "is brighter in emergency operation (800 cd/m2 of white)");
  check_found(with_exit_sign("mains_white = 500\nmains_green = 50",
                             "mains_white = 50000\nmains_green = 5000"),
              Severity::warning, "as bright as a lamp");
  check_no_alarm(with_exit_sign("mains_white = 500", "mains_white = 400"));
}

TEST_CASE("glows that are too bright, too long, or rise are reported", "[inspect][light]") {
  check_found(found_in(glowing("300", "[[0, 1], [600, 0.05]]")), Severity::warning,
              "as much as a sign that is lit from within");
  check_found(found_in(glowing("1", "[[0, 1], [1, 0.9], [60, 0.7]]")), Severity::warning,
              "are the times of 'decay' in minutes?");
  check_found(found_in(glowing("1", "[[0, 0.5], [600, 0.05]]")), Severity::warning,
              "begins with a share of 0.5");
  check_found(found_in(glowing("1", "[[0, 1], [60, 0.2], [600, 0.3]]")), Severity::warning,
              "rises at 600 s");
  check_no_alarm(found_in(glowing("1.5", "[[0, 1], [120, 0.35], [600, 0.08]]")));
}

TEST_CASE("externally lit faces with swapped colours, and large details, are reported",
          "[inspect][light]") {
  const auto external = [](const std::string& more) {
    return found_in(closed_room + lamp +
                    replaced(exit_sign,
                             "mains_white = 500\nmains_green = 50\nemergency_white = 100\n"
                             "emergency_green = 10\n",
                             "lighting = \"external\"\n" + more) +
                    long_way);
  };
  check_found(external("white_reflectance = 0.1\ngreen_reflectance = 0.6\n"), Severity::warning,
              "its white reflects 0.1, its green 0.6");
  CHECK(that_say(external(""), "swapped").empty());
  check_found(with_exit_sign("emergency_green = 10",
                             "emergency_green = 10\nwhite_reflectance = 0.1\n"
                             "green_reflectance = 0.9"),
              Severity::warning, "its white reflects 0.1, its green 0.9");
  check_found(with_exit_sign("emergency_green = 10", "emergency_green = 10\nangular_exponent = 8"),
              Severity::note, "shines ahead alone");
  check_found(with_exit_sign("letter_height = 0.15", "letter_height = 0.15\nsmallest_detail = 0.1"),
              Severity::warning, "more than a third of its shorter side of 0.2 m");
}

TEST_CASE("a smallest detail that the drawing does not have is reported", "[inspect][light]") {
  const auto drawn = [](const std::string& body, const std::string& detail) {
    const std::string sign = replaced(exit_sign, "text = \"EXIT\"\nletter_height = 0.15\n",
                                      "file = \"sign.svg\"\nsmallest_detail = " + detail + "\n");
    return found_in(closed_room + lamp + sign + long_way,
                    {{"sign.svg",
                      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 400 200'>"
                      "<rect width='400' height='200' fill='#237F52'/><g fill='#ECECE7'>" +
                          body + "</g></svg>"}});
  };
  const std::string block = "<rect x='100' y='50' width='100' height='100'/>";
  check_no_alarm(drawn(block, "0.03"));
  check_found(drawn("<rect width='3' height='3'/>", "0.016"), Severity::warning,
              "nothing in its drawing is so large: its widest part is 0.0031 m wide");
  std::string lines;
  for (int i = 0; i < 9; ++i)
    lines += "<rect x='220' y='" + std::to_string(20 + 18 * i) + "' width='150' height='6'/>";
  check_found(drawn(block + lines, "0.016"), Severity::warning, "of its drawing is finer");
  check_no_alarm(drawn(block + lines, "0.006"));
  // The stroke of a text is its detail.
  check_found(
      with_exit_sign("letter_height = 0.15", "letter_height = 0.15\nsmallest_detail = 0.05"),
      Severity::warning, "smallest_detail of 0.05 m");
}
