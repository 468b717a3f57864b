// Luminaires, emitters and signs are read field by field, with the conversions of their keys.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "scenes/formats/scene_file/scene_file.hpp"
#include "tests/unit/scenes/formats/scene_file/scene_fixture.hpp"

namespace luxodus {

TEST_CASE("a luminaire's fluxes are the file's times the factors it states", "[format][scene]") {
  SceneFolder f;
  const auto s = good(f, R"(
[[luminaire]]
name = "both"
file = "lamp.ies"
position = [1, 2, 3]
target = [1, 5, 3]
circuit = "c1"
group = "g"
mains_factor = 0.5
emergency = true
emergency_factor = 0.2
maintenance_factor = 0.8
end_of_duration_factor = 0.75
onset = [[0, 0], [0.5, 0.5], [5, 1]]
spectrum = "2700 K"
body_material = "grey50"
[[luminaire]]
name = "only then"
file = "lamp.ies"
position = [0, 0, 0]
rotation_deg = 90
point_source = true
emergency = "non-maintained"
emergency_flux = 120
maintenance_factor = 0.8
end_of_duration_factor = 0.5
[[luminaire]]
name = "plain"
file = "lamp.ies"
position = [0, 0, 0]
maintenance_factor = 0.9
)");
  const Emitter& both = named(s.emitters, "both");
  REQUIRE(both.web != nullptr);
  const double flux = both.web->flux_lm();
  CHECK(both.distribution == Distribution::web);
  CHECK(both.shape == EmitterShape::disc);
  CHECK(both.size.x == near(0.2));
  CHECK(same(both.frame.origin, {1, 2, 3}));
  CHECK(same(both.frame.axes * glm::dvec3(0, 0, -1), {0, 1, 0}));
  CHECK(same(both.frame.axes * glm::dvec3(0, 1, 0), {0, 0, 1}));
  CHECK(both.mains_flux == near(flux * 0.5 * 0.8));
  CHECK(both.emergency_flux == near(flux * 0.2 * 0.8 * 0.75));
  CHECK(both.onset == std::vector<glm::dvec2>{{0, 0}, {0.5, 0.5}, {5, 1}});
  CHECK_FALSE(both.radiometric);
  CHECK(both.circuit == "c1");
  CHECK(both.group == "g");
  CHECK(both.body_material == "grey50");
  CHECK(both.spectrum.integral() == Approx(1));
  CHECK(both.spectrum.at(700) > 2 * both.spectrum.at(450));
  const Emitter& only = named(s.emitters, "only then");
  CHECK(only.web == both.web);  // read once
  CHECK(only.shape == EmitterShape::point);
  CHECK(only.mains_flux == 0);
  CHECK(only.emergency_flux == near(120 * 0.8 * 0.5));
  CHECK(same(only.frame.axes * glm::dvec3(1, 0, 0), {0, 1, 0}));
  CHECK(named(s.emitters, "plain").mains_flux == near(flux * 0.9));
  CHECK(named(s.emitters, "plain").emergency_flux == 0);
}

TEST_CASE("a rated emergency flux already is the least over the duration", "[format][scene]") {
  SceneFolder f;
  const std::string lamp =
      "[[luminaire]]\nname = \"l\"\nfile = \"lamp.ies\"\nposition = [0, 0, 0]\n"
      "emergency = \"non-maintained\"\nemergency_flux = 100\nmaintenance_factor = 0.8\n";
  const auto lit = [&](const std::string& more) { return good(f, lamp + more).emitters.at(0); };
  const Emitter unstated = lit("end_of_duration_factor = 0.5\n");
  CHECK(unstated.emergency_flux_is == EmergencyFluxIs::unstated);
  CHECK(unstated.emergency_flux == near(40));
  CHECK(unstated.emergency_ageing == near(0.4));
  const Emitter initial = lit("emergency_flux_is = \"initial\"\nend_of_duration_factor = 0.5\n");
  CHECK(initial.emergency_flux_is == EmergencyFluxIs::initial);
  CHECK(initial.emergency_flux == near(40));
  CHECK(initial.initial_flux_known);
  const Emitter rated = lit("emergency_flux_is = \"rated\"\n");
  CHECK(rated.emergency_flux_is == EmergencyFluxIs::rated);
  CHECK(rated.emergency_flux == near(80));
  CHECK(rated.end_of_duration_factor == 1);
  CHECK_FALSE(rated.initial_flux_known);
  const Emitter both = lit("emergency_flux_is = \"rated\"\ninitial_flux = 160\n");
  CHECK(both.emergency_flux == near(80));
  CHECK(both.emergency_flux / both.emergency_ageing == near(160));
  CHECK(both.initial_flux_known);
}

TEST_CASE("of several lamp sets the scene names one", "[format][scene]") {
  SceneFolder f;
  f.put("two.ldt",
        "M\n1\n1\n1\n0\n2\n180\nr\nn\nn\nf\nd\n9\n9\n9\n9\n9\n0\n0\n0\n0\n50\n125.66\n1\n0\n2\n"
        "1\nA\n1000\n4000\n80\n10\n1\nB\n2000\n4000\n80\n20\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n18"
        "0\n"
        "100\n100\n");
  const auto lamp = [](const std::string& file, const std::string& more) {
    return "[[luminaire]]\nname = \"l\"\nfile = \"" + file + "\"\nposition = [0, 0, 0]\n" + more;
  };
  const auto flux = [&](const std::string& more) {
    return good(f, lamp("two.ldt", more)).emitters.at(0).mains_flux;
  };
  CHECK(flux("lamp_set = 1\n") == Approx(4 * pi * 100));
  CHECK(flux("lamp_set = 2\n") == Approx(4 * pi * 200));
  const std::string unsaid = all_problems(f.read(lamp("two.ldt", "")));
  INFO(unsaid);
  CHECK(unsaid.find("lamp_set = 1 to 2: 1: A, 1000 lm; 2: B, 2000 lm") != std::string::npos);
  CHECK(all_problems(f.read(lamp("lamp.ies", "lamp_set = 1\n")))
            .find("'lamp_set' belongs to an EULUMDAT file") != std::string::npos);
  // A type of luminaires says it for all of them.
  const auto typed =
      good(f,
           "[[luminaire_type]]\nname = \"t\"\nfile = \"two.ldt\"\nlamp_set = 2\n[[luminaire]]\n"
           "name = \"l\"\ntype = \"t\"\nposition = [0, 0, 0]\n");
  CHECK(typed.emitters.at(0).mains_flux == Approx(4 * pi * 200));
}

TEST_CASE("a body and its luminaires share a number", "[format][scene]") {
  SceneFolder f;
  const auto lamp = [](const std::string& name, const std::string& more = "") {
    return "[[luminaire]]\nname = \"" + name + "\"\nfile = \"lamp.ies\"\nposition = [0, 0, 0]\n" +
           more;
  };
  const auto box = [](const std::string& name, const std::string& of) {
    return "[[object]]\nname = \"" + name +
           "\"\nshape = \"box\"\nlow = [0, 0, 0]\nhigh = [1, 1, 1]\nmaterial = \"grey50\"\n" +
           (of.empty() ? "" : "body_of = [" + of + "]\n");
  };
  const std::string import =
      "[[import]]\nname = \"i\"\nfile = \"cube.obj\"\nunits = \"mm\"\nup = \"z\"\n"
      "material = \"grey50\"\nbody_of = [\"a\", \"b\"]\n";
  const auto s = good(
      f, lamp("a") + lamp("b", "[[luminaire.repeat]]\ncount = 2\nstep = [1, 0, 0]\n") + lamp("c") +
             lamp("d") + box("x", "\"a\", \"b\"") + box("y", "\"c\"") + box("z", "") + import);
  const int shared = named(s.objects, "x").body, own = named(s.objects, "y").body;
  CHECK((shared != 0 && own != 0 && shared != own));
  CHECK(named(s.objects, "z").body == 0);
  CHECK(named(s.objects, "i.leaf").body == shared);
  CHECK(named(s.emitters, "a").body == shared);
  CHECK(named(s.emitters, "b").body == shared);
  CHECK(named(s.emitters, "b.2").body == shared);
  CHECK(named(s.emitters, "c").body == own);
  CHECK(named(s.emitters, "d").body == 0);
  CHECK(all_problems(f.read(lamp("a") + box("x", "\"e\""))).find("'e'") != std::string::npos);
  CHECK(all_problems(f.read(lamp("a") + lamp("b") + box("x", "\"a\"") + box("y", "\"a\", \"b\"")))
            .find("name the same in 'body_of' of both") != std::string::npos);
}

TEST_CASE("emitters of every shape have their size, distribution and flux", "[format][scene]") {
  SceneFolder f;
  const std::string head = "position = [0, 0, 1]\n";
  const auto s =
      good(f,
           "[[emitter]]\nname = \"p\"\nshape = \"point\"\ndistribution = \"isotropic\"\n"
           "flux_w = 3\n" +
               head +
               "[[emitter]]\nname = \"r\"\nshape = \"rectangle\"\nsize = [2, 3]\n"
               "luminance_cd_m2 = 100\n" +
               head +
               "[[emitter]]\nname = \"d\"\nshape = \"disc\"\ndiameter = 2\n"
               "luminance_cd_m2 = 100\n" +
               head +
               "[[emitter]]\nname = \"s\"\nshape = \"sphere\"\ndiameter = 2\n"
               "luminance_cd_m2 = 100\n" +
               head +
               "[[emitter]]\nname = \"t\"\nshape = \"tube\"\nlength = 2\ndiameter = 0.1\n"
               "luminance_cd_m2 = 100\n" +
               head +
               "[[emitter]]\nname = \"m\"\nshape = \"mesh\"\nfile = \"cube.obj\"\n"
               "units = \"cm\"\nup = \"z\"\nluminance_cd_m2 = 100\n"
               "[[emitter]]\nname = \"spot\"\nshape = \"disc\"\ndiameter = 0.1\n"
               "distribution = \"spot\"\nspot_inner_deg = 5\nspot_outer_deg = 12\n"
               "flux_lm = 800\ndirection = [2, 0, 0]\n" +
               head +
               "[[emitter]]\nname = \"c\"\nshape = \"point\"\n"
               "distribution = \"cosine_power\"\ncosine_power = 4\nflux_lm = 1\n" +
               head);
  CHECK(named(s.emitters, "p").radiometric);
  CHECK(named(s.emitters, "p").mains_flux == 3);
  CHECK(named(s.emitters, "p").distribution == Distribution::isotropic);
  CHECK(named(s.emitters, "r").mains_flux == near(pi * 100 * 6));
  CHECK(named(s.emitters, "d").mains_flux == near(pi * 100 * pi));
  CHECK(named(s.emitters, "s").mains_flux == near(pi * 100 * 4 * pi));
  CHECK(named(s.emitters, "t").mains_flux == near(pi * 100 * pi * 0.2));
  CHECK(named(s.emitters, "m").mains_flux == near(pi * 100 * 2));
  CHECK(named(s.emitters, "m").mesh.triangles.size() == 2);
  CHECK(named(s.emitters, "spot").spot_outer_deg == 12);
  CHECK(named(s.emitters, "spot").spot_inner_deg == 5);
  CHECK(same(named(s.emitters, "spot").frame.axes * glm::dvec3(0, 0, -1), {1, 0, 0}));
  CHECK(named(s.emitters, "c").cosine_power == 4);
}

TEST_CASE("signs have a face, luminances in both states, and a smallest detail",
          "[format][scene]") {
  SceneFolder f;
  const auto s = good(f, R"(
[[sign]]
name = "exit"
position = [5, 1, 2]
facing = [-2, 0, 0]
width = 0.6
height = 0.3
text = "EXIT"
letter_height = 0.15
stroke = 0.02
spacing = 0.01
legend = "green"
double_sided = true
mains_white = 500
mains_green = 60
emergency_white = 50
emergency_green = 6
angular_exponent = 0.5
circuit = "signs"
[[sign]]
name = "glow"
position = [5, 1, 2]
facing = [0, 0, 1]
up = [0, 1, 0]
width = 0.6
height = 0.3
plain = "white"
smallest_detail = 0.05
lighting = "photoluminescent"
emergency_white = 0.3
emergency_green = 0.03
decay = [[0, 1], [600, 0.2], [3600, 0.05]]
[[sign]]
name = "board"
position = [5, 1, 2]
facing = [1, 0, 0]
width = 0.6
height = 0.3
plain = "green"
smallest_detail = 0.05
lighting = "external"
white_reflectance = 0.8
[[scenario]]
name = "dim"
circuits = { signs = 0.5 }
)");
  const Sign& exit = named(s.signs, "exit");
  CHECK(exit.smallest_detail_m == 0.02);
  CHECK(exit.face.legend == 1);
  CHECK(exit.face.width == 256);
  CHECK(exit.double_sided);
  CHECK(exit.colours[0].mains_cd_m2 == 500);
  CHECK(exit.colours[1].emergency_cd_m2 == 6);
  CHECK(exit.angular_exponent == 0.5);
  CHECK(same(exit.frame.axes[2], {-1, 0, 0}));
  CHECK(same(exit.frame.axes[1], {0, 0, 1}));
  CHECK(exit.colours[1].shape.at(520) > exit.colours[1].shape.at(650));
  const Sign& glow = named(s.signs, "glow");
  CHECK(glow.lighting == SignLighting::photoluminescent);
  CHECK(glow.decay.size() == 3);
  CHECK(glow.colours[0].emergency_cd_m2 == 0.3);
  CHECK(named(s.signs, "board").lighting == SignLighting::external);
  CHECK(named(s.signs, "board").colours[0].reflectance.at(500) == 0.8);
}

TEST_CASE("a sign names its colours, and the safety colours bring their own drawing and paint",
          "[format][scene]") {
  SceneFolder f;
  const auto s = good(f, R"(
[[sign]]
name = "exit"
position = [5, 1, 2]
facing = [-2, 0, 0]
width = 0.32
height = 0.2
text = "EXIT"
legend = "red"
[[sign.colours]]
name = "white"
mains = 0
emergency = 0
[[sign.colours]]
name = "red"
mains = 60
emergency = 40
spectrum = "led red"
[[sign]]
name = "strip"
position = [5, 1, 2]
facing = [1, 0, 0]
width = 0.6
height = 0.3
plain = "signal orange"
smallest_detail = 0.05
lighting = "external"
[[sign.colours]]
name = "signal orange"
drawn = "#E75B12"
reflectance = 0.3
)");
  const Sign& exit = named(s.signs, "exit");
  REQUIRE(exit.colours.size() == 2);
  CHECK(exit.face.legend == 1);
  CHECK(exit.face.ground == 0);
  CHECK(exit.colours[1].drawn == std::array<uint8_t, 3>{0x9B, 0x24, 0x23});
  CHECK(exit.colours[1].emergency_cd_m2 == 40);
  CHECK(exit.colours[1].shape.at(630) > 1e3 * exit.colours[1].shape.at(560));
  CHECK(exit.colours[1].reflectance.at(650) > 3 * exit.colours[1].reflectance.at(520));
  CHECK(exit.colours[0].shape.value == white_led_shape(4000).value);
  const Sign& strip = named(s.signs, "strip");
  REQUIRE(strip.colours.size() == 1);
  CHECK(strip.face.legend == 0);
  CHECK(strip.face.ground == other_colour);
  CHECK(strip.colours[0].reflectance.at(500) == 0.3);
}

TEST_CASE("a type of signs has colours that its signs share", "[format][scene]") {
  SceneFolder f;
  const auto s = good(f, R"(
[[sign_type]]
name = "red exit"
width = 0.32
height = 0.2
text = "EXIT"
legend = "red"
[[sign_type.colours]]
name = "red"
mains = 60
emergency = 40
[[sign_type.colours]]
name = "white"
mains = 250
emergency = 200
[[sign]]
type = "red exit"
name = "east"
position = [5, 1, 2]
facing = [-1, 0, 0]
)");
  REQUIRE(s.signs.at(0).colours.size() == 2);
  CHECK(s.signs[0].colours[0].name == "red");
  CHECK(s.signs[0].colours[1].mains_cd_m2 == 250);
}

TEST_CASE("what a sign's drawing leaves out is warned of, once for each file", "[format][scene]") {
  const test::TemporaryFolder folder;
  folder.write("sign.svg",
               "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 400 200'>"
               "<rect width='400' height='200' fill='#237F52'/><image href='door.png'/>"
               "<rect x='100' y='50' width='100' height='100' fill='#ECECE7'/></svg>");
  std::string text;
  for (const char* name : {"east", "west"})
    text += "[[sign]]\nname = \"" + std::string(name) +
            "\"\nposition = [5, 1, 2]\nfacing = [1, 0, 0]\nwidth = 0.4\nheight = 0.2\n"
            "file = \"sign.svg\"\nsmallest_detail = 0.05\nmains_white = 500\nmains_green = 60\n"
            "emergency_white = 50\nemergency_green = 6\n";
  const ReadScene read = read_scene(folder.write("scene.toml", text));
  REQUIRE(read.scene);
  std::vector<std::string> told;
  for (const Problem& warning : read.scene->warnings)
    if (warning.what.find("sign.svg") != std::string::npos) told.push_back(warning.text());
  REQUIRE(told.size() == 1);
  CHECK(told.front().find("scene.toml:7") != std::string::npos);
  CHECK(told.front().find("its image \"door.png\" is left out") != std::string::npos);
}

}  // namespace luxodus
