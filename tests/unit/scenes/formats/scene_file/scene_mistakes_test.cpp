// Every mistake in a scene file gives one problem, with its line and a remedy.
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "runtime/toml/text_scan.hpp"
#include "scenes/formats/scene_file/scene_reading.hpp"
#include "tests/unit/scenes/formats/scene_file/scene_fixture.hpp"

namespace luxodus {
namespace {

struct Mistake {
  std::string text;
  int line;
  std::string fragment;
};

const std::string quad =
    "[[object]]\nname = \"q\"\nshape = \"quad\"\ncorner = [0, 0, 0]\nedge_u = [1, 0, 0]\n"
    "edge_v = [0, 1, 0]\n";
const std::string point = "[[emitter]]\nname = \"e\"\nshape = \"point\"\nposition = [0, 0, 1]\n";
const std::string backed =
    "emergency = true\nemergency_factor = 0.2\nmaintenance_factor = 0.8\n"
    "end_of_duration_factor = 0.7\n";
const std::string lamp = "[[luminaire]]\nname = \"l\"\nfile = \"lamp.ies\"\nposition = [0, 0, 1]\n";
const std::string smoke = "[[medium]]\nname = \"s\"\nkind = \"homogeneous\"\n";
const std::string sign =
    "[[sign]]\nname = \"x\"\nposition = [0, 0, 1]\nfacing = [1, 0, 0]\nwidth = 0.6\nheight = 0.3\n";
const std::string lit =
    "mains_white = 1\nmains_green = 1\nemergency_white = 1\nemergency_green = 1\n";
const std::string cone =
    "[[medium]]\nname = \"c\"\nkind = \"bounded\"\nbody = \"cone\"\nposition = [0, 0, 0]\nradius = "
    "1\n"
    "height = 1\nextinction = 1\nalbedo = 0\n";
const std::string import =
    "[[import]]\nname = \"i\"\nfile = \"cube.obj\"\nunits = \"m\"\nup = \"z\"\n";

/// Each text must give exactly the one problem beside it.
void check(const std::vector<Mistake>& mistakes) {
  SceneFolder folder;
  for (const Mistake& m : mistakes) {
    const ReadScene read = folder.read(m.text);
    INFO("---- scene\n"
         << m.text << "\n---- problems\n"
         << all_problems(read) << "---- expected line " << m.line << ": " << m.fragment);
    CHECK_FALSE(read.scene.has_value());
    CHECK(read.problems.list().size() == 1);
    if (read.problems.empty()) continue;
    const Problem& p = read.problems.list().front();
    CHECK(p.where.file.find("scene.toml") != std::string::npos);
    CHECK(p.where.line == m.line);
    CHECK(p.what.find(m.fragment) != std::string::npos);
  }
}

}  // namespace

TEST_CASE("a scene file with excessive nesting is one problem, not a crash", "[format][scene]") {
  std::string key;
  for (size_t i = 0; i <= limits::toml_nesting; ++i) key += "a.";
  const std::string list(limits::toml_nesting + 1, '[');
  check({
      {"\n" + key + "a = 1\n", 2, "do not nest so deep"},
      {"[" + key + "a]\n", 1, "do not nest so deep"},
      {"x = " + list + "\n", 1, "do not nest so deep"},
  });
}

TEST_CASE("a misspelt word is one problem that names the intended one", "[format][scene]") {
  check({
      {"titel = \"x\"\n", 1, "unknown key 'titel'; did you mean 'title'?"},
      {"\n[[materail]]\nname = \"m\"\nreflectance = 0.5\n", 2, "did you mean 'material'?"},
      {"[[material]]\nname = \"m\"\nreflectence = 0.5\n", 3, "did you mean 'reflectance'?"},
      {"[[material]]\nnmae = \"m\"\nreflectance = 0.5\n" + quad + "material = \"m\"\n", 2,
       "did you mean 'name'?"},
      {"[[material]]\nname = \"m\"\nreflectance = 0.5\nzzzzzzzzzz = 1\n", 4,
       "known here: name kind"},
      {quad + "material = \"grey50\"\nheight = 2\n", 8, "unknown key 'height'"},
      {"[[object]]\nname = \"q\"\nshape = \"qaud\"\nmaterial = \"grey50\"\nradius = 3\n", 3,
       "did you mean \"quad\"?"},
      {"[run]\nseeed = 3\n", 2, "did you mean 'seed'?"},
      {"[run]\ngroups = \"circuits\"\n", 2, "did you mean \"circuit\"?"},
      {"[[material]]\nname = \"whitewash\"\nreflectance = 0.5\n" + quad +
           "material = \"witewash\"\n",
       10, "there is no material 'witewash'; did you mean 'whitewash'?"},
      {"title = \"a\ntitle = 2\n", 1, "this is not TOML"},
      {"title = \"a\"\ntitle = \"b\"\n", 2, "this is not TOML"},
  });
}

TEST_CASE("a value of a wrong type, range or form is one problem that says what is right",
          "[format][scene]") {
  const std::string m = "[[material]]\nname = \"m\"\n";
  check({
      {m + "reflectance = true\n", 3, "'reflectance' must be a number, not true or false"},
      {m + "reflectance = 1.2\n", 3, "'reflectance' is 1.2 but must lie in [0, 1]"},
      {m + "reflectance = nan\n", 3, "'reflectance' must be a finite number, not nan"},
      {m + "reflectance = -inf\n", 3, "must be a finite number, not -inf"},
      {m + "reflectance = \"beige\"\n", 3, "a text here names a grey"},
      {m + "reflectance = [0.5, 0.5, 0.5]\n", 3, "rows [wavelength in nm, value]"},
      {m + "reflectance = [[500, 0.5], [400, 0.5]]\n", 3, "ascending wavelengths"},
      {m + "reflectance = { rgb = [1, 1, 1] }\n", 3, "{ srgb = [r, g, b] }"},
      {m + "reflectance = { srgb = [1, 2, 1] }\n", 3, "colour values in [0, 1]"},
      {m + "reflectance = 0.9\nkind = \"glossy\"\nspecular = 0.2\n", 5,
       "'reflectance' + 'specular' is 1.1"},
      {m + "reflectance = 0.9\nkind = \"glossy\"\nspecular = 0.1\nroughness = 0\n", 6,
       "'roughness' is 0 but must lie in (0, 1]"},
      {m + "kind = \"glass\"\nior = 0.5\n", 4, "'ior' is 0.5"},
      {m, 1, "the key 'reflectance' is missing"},
      {m + "reflectance = 0.5\nimage = \"none.png\"\n", 4, "there is no file 'none.png'"},
      {"[[material]]\nname = \"a/b\"\nreflectance = 0.5\n", 2,
       "'name' must be 1 to 200 characters"},
      {"patch_edge_m = -1\n", 1, "'patch_edge_m' is -1 but must lie in [0, 1e4] m"},
      {"title = 3\n", 1, "'title' must be a text, not an integer"},
      {"[run]\nseed = 1.5\n", 2, "'seed' must be a whole number"},
      {"[run]\nvoxels = 1\n", 2, "'voxels' must be true or false, not an integer"},
      {"[run]\nband_edges_nm = [380, 500]\n", 2, "the last 780"},
      {"run = 4\n", 1, "'run' must be a table"},
      {"material = 4\n", 1, "each opened by [[material]]"},
      {"[material]\nname = \"m\"\n", 1, "each opened by [[material]]"},
  });
}

TEST_CASE("impossible objects and imports are rejected where they are stated", "[format][scene]") {
  const std::string name = "[[object]]\nname = \"o\"\nmaterial = \"grey50\"\n";
  check({
      {quad, 1, "the key 'material' is missing"},
      {quad + "material = \"none\"\n", 7,
       "there is no material 'none'; this scene has none at all"},
      {quad + "material = \"grey101\"\n", 7, "there is no material 'grey101'"},
      {quad + "material = \"grey50\"\n" + quad + "material = \"grey50\"\n", 9,
       "the object 'q' is defined twice"},
      {quad + "material = \"grey50\"\nscale = 0\n", 8, "'scale' is 0"},
      {quad + "material = \"grey50\"\ntranslate = [1, 2]\n", 8, "a list of 3 numbers, not of 2"},
      {quad + "material = \"grey50\"\ntags = [\"a\", 3]\n", 8, "a list of texts"},
      {quad + "material = \"grey50\"\ndoor = { axis = [0, 0, 1] }\n", 8, "'hinge' is missing"},
      {quad + "material = \"grey50\"\ndoor = { hinge = [0, 0, 0], axis = [0, 0, 0] }\n", 8,
       "must not be the zero vector"},
      {name + "shape = \"quad\"\ncorner = [0, 0, 0]\nedge_u = [1, 0, 0]\nedge_v = [2, 0, 0]\n", 1,
       "parallel"},
      {name + "shape = \"box\"\nlow = [0, 0, 0]\nhigh = [1, 0, 1]\n", 1, "must lie above 'low'"},
      {name + "shape = \"room\"\nlow = [0, 0, 0]\nhigh = [1, 1, 1]\nomit = [\"roof\"]\n", 7,
       "a room has no face 'roof'"},
      {name + "shape = \"sphere\"\nradius = -1\n", 5, "'radius' is -1 but must lie in (0, 1e5] m"},
      {name + "shape = \"tube\"\nouter_radius = 1\ninner_radius = 2\nlength = 1\n", 1,
       "must be less than 'outer_radius'"},
      {name + "shape = \"wall\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nheight = 2\nthickness = 0.1\n"
              "opening = [{ at = 0.5, width = 1, height = 1 }]\n",
       9, "reaches outside its wall"},
      {name +
           "shape = \"wall\"\nfrom = [0, 0, 0]\nto = [4, 0, 0]\nheight = 2\nthickness = 0.1\n"
           "opening = [{ at = 0.5, width = 1, height = 1 }, { at = 1, width = 1, height = 1 }]\n",
       9, "overlaps opening 1 of its wall"},
      {name + "shape = \"wall\"\nfrom = [0, 0, 0]\nto = [4, 0, 0]\nheight = 2\nthickness = 100\n",
       8, "100 mm is 0.1"},
      {name + "shape = \"polygon\"\noutline = [[0, 0], [1, 1], [1, 0], [0, 1]]\n", 1, "cross"},
      {name + "shape = \"stairs\"\nsteps = 1000\nrise = 0.1\ngoing = 0.3\nwidth = 1\n", 5,
       "'steps' is 1000"},
      {import + "materials = { paint = \"grey50\" }\n", 1,
       "neither 'materials' nor 'material' maps"},
      {"[[import]]\nname = \"i\"\nfile = \"cube.obj\"\nup = \"z\"\nmaterial = \"grey50\"\n", 1,
       "the key 'units' is missing"},
      {import + "material = \"grey50\"\nmaterials = { pain = \"grey50\" }\n", 7,
       "did you mean 'paint'?"},
      {import + "material = \"grey50\"\npart = [{ match = \"roof\" }]\n", 7,
       "no part of this file is called 'roof'"},
      {"[[import]]\nname = \"i\"\nfile = \"gone.obj\"\nunits = \"m\"\nup = \"z\"\n"
       "[[surface_group]]\nname = \"g\"\nobjects = [\"i.roof\"]\n",
       3, "there is no file 'gone.obj'"},
  });
}

TEST_CASE("impossible lights, and lights without emergency values, are rejected",
          "[format][scene]") {
  check({
      {point, 1, "one of the keys 'flux_lm', 'flux_w', 'luminance_cd_m2' is needed"},
      {point + "flux_lm = 1\nflux_w = 1\n", 6, "say the same thing"},
      {point + "flux_lm = 0\n", 5, "'flux_lm' is 0"},
      {point + "luminance_cd_m2 = 5\n", 5, "a point has no luminance"},
      {point + "flux_lm = 5\nspot_outer_deg = 3\n", 6, "belongs to distribution = \"spot\""},
      {point + "flux_lm = 5\ndistribution = \"spot\"\nspot_inner_deg = 50\n", 7, "must not exceed"},
      {point + "flux_lm = 5\nspectrum = \"blue\"\n", 6, "\"led 4000 K\""},
      {point + "flux_lm = 5\nspectrum = \"20 K\"\n", 6, "needs a temperature in"},
      {point + "flux_lm = 5\nspectrum = [[900, 1], [950, 1]]\n", 6, "emits nothing"},
      {point + "flux_lm = 5\nbody_material = \"tin\"\n", 6, "there is no material 'tin'"},
      {"[[emitter]]\nname = \"e\"\nshape = \"rectangle\"\nposition = [0, 0, 1]\nsize = [1, 0]\n"
       "flux_lm = 1\n",
       5, "'size' is 0"},
      {"[[emitter]]\nname = \"e\"\nshape = \"rectangle\"\nposition = [0, 0, 1]\nsize = [1e-8, "
       "1e-8]\n"
       "flux_lm = 1\n",
       1, "has no area to emit from"},
      {"[[emitter]]\nname = \"e\"\nshape = \"sphere\"\nposition = [0, 0, 1]\ndiameter = 1\n"
       "flux_lm = 1\ndistribution = \"collimated\"\n",
       7, "needs a point, a rectangle or a disc"},
      {"[[luminaire]]\nname = \"l\"\nfile = \"none.ldt\"\nposition = [0, 0, 1]\n", 3,
       "there is no file 'none.ldt'"},
      {lamp + "direction = [0, 0, 0]\n", 5, "must not be the zero vector"},
      {lamp + "target = [0, 0, 1]\n", 5, "must not be the position itself"},
      {lamp + "target = [0, 0, 2]\ndirection = [0, 0, 1]\n", 5, "say the same thing"},
      {lamp + "emergency = true\nmaintenance_factor = 0.8\nend_of_duration_factor = 0.7\n", 1,
       "'emergency_flux', 'emergency_factor' is needed"},
      {lamp + "emergency = true\nemergency_factor = 0.2\nend_of_duration_factor = 0.7\n", 1,
       "'maintenance_factor' is needed"},
      {lamp + "emergency = true\nemergency_factor = 0.2\nmaintenance_factor = 0.7\n", 1,
       "'end_of_duration_factor' is needed"},
      {lamp + backed + "emergency_flux_is = \"rated\"\n", 8, "exclude each other"},
      {lamp + backed + "emergency_flux_is = \"least\"\n", 9, "must be one of"},
      {lamp + backed + "initial_flux = 300\n", 9, "belongs to emergency_flux_is"},
      {lamp + "emergency = true\nemergency_flux = 20\nmaintenance_factor = 0.7\n"
              "emergency_flux_is = \"rated\"\ninitial_flux = 10\n",
       9, "'initial_flux' is below the rated flux of 20"},
      {lamp + "emergency_factor = 0.2\n", 5, "but 'emergency' is not"},
      {lamp + "emergency_flux_is = \"rated\"\n", 5, "but 'emergency' is not"},
      {lamp + "lamp_set = 1\n", 5, "'lamp_set' belongs to an EULUMDAT file"},
      {lamp + "onset = [[0, 0], [5, 1]]\n", 5, "but 'emergency' is not"},
      {lamp + backed + "onset = [[1, 0], [5, 1]]\n", 9, "'onset' needs rows"},
      {lamp + backed + "onset = [[0, 0], [5, 0.9]]\n", 9, "'onset' needs rows"},
      {lamp + backed + "onset = [[0, 0.5], [5, 0.4], [6, 1]]\n", 9, "'onset' needs rows"},
      {lamp + backed + "onset = [[0, 0], [0, 1]]\n", 9, "'onset' needs rows"},
      {lamp + backed + "onset = []\n", 9, "'onset'"},
      {lamp + backed + "onset = [[0, 0], [5, 1.5]]\n", 9, "'onset'"},
      {lamp + "emergency = \"sometimes\"\n", 5, "must be one of \"false\", \"true\""},
      {lamp + "maintenance_factor = 1.3\n", 5, "must lie in (0, 1]"},
      {lamp + lamp, 6, "'l' is defined twice"},
  });
}

TEST_CASE("signs with missing or contradictory keys are rejected", "[format][scene]") {
  const std::string plain = "plain = \"white\"\nsmallest_detail = 0.1\n";
  check({
      {sign + lit, 1, "one of the keys 'file', 'text', 'plain' is needed"},
      {sign + lit + "plain = \"white\"\n", 1, "'smallest_detail' [m] is needed"},
      {sign + lit + "text = \"EXIT\"\nplain = \"white\"\nsmallest_detail = 0.1\n", 12,
       "say the same"},
      {sign + lit + "text = \"EXIT\"\nletter_height = 0.5\nstroke = 0.02\n", 12, "exceed 0.3 m"},
      {sign + lit + "file = \"exit.svg\"\nsmallest_detail = 0.1\n", 11,
       "there is no file 'exit.svg'"},
      {sign + plain + "mains_white = 1\nmains_green = 1\nemergency_white = 1\n", 1,
       "'emergency_green' is missing"},
      {sign + plain + "lighting = \"external\"\nmains_white = 1\n", 10, "externally lit"},
      {sign + plain + "lighting = \"photoluminescent\"\nemergency_white = 1\nemergency_green = 1\n",
       1, "'decay' is missing"},
      {sign + plain +
           "lighting = \"photoluminescent\"\nemergency_white = 1\nemergency_green = 1\n"
           "decay = [[5, 1], [6, 0.5]]\n",
       12, "ascending from 0"},
      {sign + plain + lit + "decay = [[0, 1], [6, 0.5]]\n", 13,
       "belongs to a photoluminescent sign"},
      {sign + plain + lit + "up = [1, 0, 0]\n", 13, "must not be parallel to 'facing'"},
      {sign + plain + lit + "stroke = 0.01\n", 13, "belongs to a sign with 'text'"},
  });
}

TEST_CASE("signs with missing, unknown or contradictory colours are rejected", "[format][scene]") {
  const auto colour = [](const std::string& name, const std::string& more = "") {
    return "[[sign.colours]]\nname = \"" + name + "\"\nmains = 9\nemergency = 9\n" + more;
  };
  const std::string exit = sign + "text = \"EXIT\"\n";
  check({
      {sign + lit + "plain = \"red\"\nsmallest_detail = 0.1\n", 11,
       "the sign's colours are white, green; state others in [[sign.colours]]"},
      {exit + colour("red") + colour("white"), 7,
       "a text needs 'legend', the colour of its letters: of the colours red, white"},
      {exit + "legend = \"blue\"\n" + colour("red") + colour("white"), 8,
       "'legend' is \"blue\", and the sign's colours are red, white"},
      {exit + "legend = \"red\"\nground = \"red\"\n" + colour("red") + colour("white"), 9,
       "legend and ground have the same colour"},
      {exit + "legend = \"red\"\nmains_white = 5\n" + colour("red") + colour("white"), 9,
       "'mains_white' belongs to a sign of white and green without [[sign.colours]]"},
      {exit + "legend = \"red\"\n" + colour("red") + colour("pink"), 14, "needs 'drawn'"},
      {exit + "legend = \"red\"\n" + colour("red") + colour("pink", "drawn = \"rose\"\n"), 17,
       "'drawn' is a colour like"},
      {exit + "legend = \"red\"\n" + colour("red") + colour("pink", "drawn = \"#9A2422\"\n"), 17,
       "drawn so alike"},
      {exit + "legend = \"red\"\n" + colour("red") + colour("red"), 14, "is there twice"},
      {exit + "legend = \"red\"\n" + colour("red") + colour("surround", "drawn = \"#112233\"\n"),
       14, "cannot name a colour"},
      {exit + "legend = \"red\"\n" + colour("red") +
           "[[sign.colours]]\nname = \"white\"\nemergency = 9\n",
       13, "the key 'mains' is missing"},
  });
}

TEST_CASE(
    "a length of a sign beyond its face is rejected with value, limit and the value of mm in m",
    "[format][scene]") {
  const std::string metres = "10 mm is 0.01";
  check({
      {sign + lit + "plain = \"white\"\nsmallest_detail = 10\n", 12, metres},
      {sign + lit + "plain = \"white\"\nsmallest_detail = 10\n", 12, "must not exceed 0.3 m"},
      {sign + lit + "plain = \"white\"\nsmallest_detail = 12\n", 12, "12 mm is 0.012"},
      {sign + lit + "plain = \"white\"\nsmallest_detail = 0.31\n", 12, "must not exceed 0.3 m"},
      {sign + lit + "text = \"EXIT\"\nletter_height = 10\n", 12, metres},
      {sign + lit + "text = \"EXIT\"\nletter_height = 0.1\nstroke = 1.5\n", 13, "1.5 mm is 0.0015"},
      {sign + lit + "text = \"EXIT\"\nletter_height = 0.1\nstroke = 0.01\nspacing = 2\n", 14,
       "2 mm is 0.002"},
      {sign + lit + "plain = \"white\"\nsmallest_detail = 0.1\nthickness = 0.9\n", 13,
       "must not exceed 0.6 m"},
  });
  SceneFolder folder;
  good(folder, sign + lit + "plain = \"white\"\nsmallest_detail = 0.3\nthickness = 0.1\n");
}

TEST_CASE("media that contradict themselves or physics are rejected", "[format][scene]") {
  const std::string layer = "[[medium.layer]]\nextinction = 1\nalbedo = 0\n";
  const std::string layered = "[[medium]]\nname = \"s\"\nkind = \"layered\"\n";
  check({
      {smoke + "albedo = 0\n", 1, "one of the keys 'extinction', 'od_per_m'"},
      {smoke + "albedo = 0\nextinction = -1\n", 5,
       "'extinction' is -1 but must lie in [0, 1e6] 1/m"},
      {smoke + "albedo = 0\nextinction = 1\nod_per_m = 1\n", 6, "say the same thing"},
      {smoke + "albedo = 0\npercent_per_m = 100\n", 5, "must lie in [0, 100) %"},
      {smoke + "albedo = 1.5\nextinction = 1\n", 4, "'albedo' is 1.5 but must lie in [0, 1]"},
      {smoke + "albedo = [[400, 0.5], [500, 2]]\nextinction = 1\n", 4, "'albedo' is 2"},
      {smoke + "extinction = 1\n", 1, "the key 'albedo' is missing"},
      {smoke + "albedo = 0\nsmoke = \"smouldering\"\nsoot_density = 1e-4\n", 1,
       "only smoke = \"flaming\" has a default"},
      {smoke + "albedo = 0\nextinction = 1\nmass_extinction = 1\n", 6, "belongs to 'soot_density'"},
      {smoke + "albedo = 0\nextinction = 1\nphase = \"hg\"\n", 1, "'g' is missing"},
      {smoke + "albedo = 0\nextinction = 1\nphase = \"hg\"\ng = 1\n", 7, "'g' is 1"},
      {smoke + "albedo = 0\nextinction = 1\ng = 0.5\n", 6, "belongs to phase = \"hg\""},
      {smoke + "albedo = 0\nextinction = 1\nphase = \"table\"\nphase_table = [[-1, 1], [0, 1]]\n",
       7, "the first -1 and the last 1"},
      {smoke + "albedo = 0\nextinction = 1\nz_low = 2\nz_high = 1\n", 7, "must lie above 'z_low'"},
      {smoke + "albedo = 0\nextinction = 1\nbox = [[0, 0], [0, 1]]\n", 6, "enclose an area"},
      {smoke + "albedo = 0\nextinction = 1\npolygon = [[0, 0], [1, 1], [1, 0], [0, 1]]\n", 6,
       "'polygon'"},
      {layered, 1, "the key 'layer' is missing"},
      {layered + layer + "z_low = 0\nz_high = 2\n" + layer + "z_low = 1\nz_high = 3\n", 9,
       "overlaps the one at line 4"},
      {layered + layer + "z_low = 2\nz_high = 2\n", 8, "must lie above"},
      {"[[medium]]\nname = \"s\"\nkind = \"fog\"\nextinction = 1\n", 3,
       "must be one of \"homogeneous\""},
      {cone + "emission = { power_w = 5 }\n", 10, "'temperature_k' is missing"},
      {cone + "emission = { power_w = -5, temperature_k = 1400 }\n", 10, "'power_w' is -5"},
      {cone + "layer = []\n", 10, "unknown key 'layer'"},
      {smoke + "albedo = 0\nextinction = 1\n" + smoke + "albedo = 0\nextinction = 1\n", 7,
       "the medium 's' is defined twice"},
      {"[[medium]]\nname = \"d\"\nkind = \"data_set\"\nfile = \"none.vti\"\n"
       "quantity = \"extinction\"\nalbedo = 0\n",
       4, "there is no file 'none.vti'"},
      {"[[medium]]\nname = \"d\"\nkind = \"data_set\"\nfile = \"lamp.ies\"\n"
       "quantity = \"soot_density\"\nalbedo = 0\n",
       1, "'mass_extinction' [m2/kg] is needed"},
  });
}

TEST_CASE("measurements and scenarios may only name existing things", "[format][scene]") {
  const std::string plane = "[[plane]]\nname = \"p\"\ncorner = [0, 0, 0]\nedge_u = [1, 0, 0]\n";
  const std::string scenario = "[[scenario]]\nname = \"s\"\n";
  check({
      {plane + "edge_v = [2, 0, 0]\ncell_m = 0.1\n", 4, "span no area"},
      {plane + "edge_v = [0, 1, 0]\n", 1, "'cells', 'cell_m' is needed"},
      {plane + "edge_v = [0, 1, 0]\ncells = [1.5, 2]\n", 6, "two whole numbers"},
      {plane + "edge_v = [0, 1, 0]\ncells = [10000, 10000]\n", 6, "10000 x 10000 cells"},
      {"[[surface_group]]\nname = \"g\"\nobjects = []\n", 3, "names nothing"},
      {"[[surface_group]]\nname = \"g\"\nobjects = [\"wall\"]\n", 3, "no object or tag 'wall'"},
      {"[[volume_group]]\nname = \"g\"\nshape = \"shell\"\ncentre = [0, 0, 0]\nradius = 1\n"
       "inner_radius = 1\n",
       6, "must be less than 'radius'"},
      {"[[observer]]\nname = \"o\"\neye = [0, 0, 0]\n", 1, "'gaze', 'target' is needed"},
      {"[[camera]]\nname = \"c\"\neye = [0, 0, 0]\ntarget = [0, 0, 1]\n", 1, "'up' must not be"},
      {"[[camera]]\nname = \"c\"\neye = [0, 0, 0]\ntarget = [0, 0, 0]\n", 4, "must not be where"},
      {"[[camera]]\nname = \"c\"\neye = [0, 0, 2]\ntarget = [1, 0, 0]\ncut = 2\n", 5,
       "below the camera's eye"},
      {scenario + "operation = \"night\"\n", 3, "must be one of \"mains\""},
      {scenario + "circuits = { c1 = 0.5 }\n", 3, "there is no circuit 'c1'"},
      {point + "flux_lm = 1\ncircuit = \"c1\"\n" + scenario + "circuits = { cl = 0.5 }\n", 9,
       "there is no circuit 'cl'; known: 'c1'"},
      {point + "flux_lm = 1\ncircuit = \"c1\"\n" + scenario + "circuits = { c1 = -1 }\n", 9,
       "'circuits' of 'c1' is -1"},
      {scenario + "media = { smoke = 0 }\n", 3, "there is no medium 'smoke'"},
      {scenario + "doors_open = [\"gate\"]\n", 3, "there is no door 'gate'"},
      {quad + "material = \"grey50\"\n" + scenario + "doors_open = [\"q\"]\n", 10,
       "there is no door 'q'"},
      {scenario + "smoke_factor = -1\n", 3, "'smoke_factor' is -1"},
      {scenario + "seconds_after_failure = 5\n", 3, "has no meaning while operation is \"mains\""},
      {scenario + scenario, 4, "the scenario 's' is defined twice"},
      {"include = [\"other.toml\"]\n", 1, "there is no file 'other.toml'"},
      {"include = [\"scene.toml\"]\n", 1, "in a circle"},
  });
}

TEST_CASE("all mistakes of all files are reported at once, by file and line", "[format][scene]") {
  SceneFolder f;
  f.put("base.toml", "[[material]]\nname = \"m\"\nreflectance = 2\n");
  const ReadScene read = f.read("include = [\"base.toml\"]\n[run]\nseed = -1\nvoxels = 3\n" +
                                point + "flux_lm = -1\nspectrum = \"x\"\n");
  INFO(all_problems(read));
  REQUIRE(read.problems.list().size() == 5);
  CHECK(read.problems.list()[0].where.line == 3);
  CHECK(read.problems.list()[1].where.line == 4);
  CHECK(read.problems.list()[2].where.line == 9);
  CHECK(read.problems.list()[3].where.line == 10);
  CHECK(read.problems.list()[4].text().find("base.toml:3: ") != std::string::npos);
}

TEST_CASE("a broken included file hides its names, and references to them are not blamed",
          "[format][scene]") {
  SceneFolder f;
  f.put("base.toml", "[[material]\nname = \"m\"\n");
  const ReadScene read = f.read("include = [\"base.toml\"]\n" + quad + "material = \"m\"\n");
  INFO(all_problems(read));
  REQUIRE(read.problems.list().size() == 1);
  CHECK(read.problems.list()[0].text().find("base.toml:1: this is not TOML") != std::string::npos);
}

TEST_CASE("a file that cannot be a scene is rejected by name", "[format][scene]") {
  SceneFolder f;
  CHECK(read_scene(f.path() / "none.toml").problems.list().at(0).what ==
        "there is no such scene file");
  CHECK(read_scene(f.path()).problems.list().size() == 1);
  CHECK(f.read(std::string("a\0b", 3)).problems.list().size() == 1);
  CHECK(f.read(std::string(scene_limits::file_bytes + 1, '#'))
            .problems.list()
            .at(0)
            .what.find("at most") != std::string::npos);
  // Deep nesting must end in a sentence, not in the stack.
  CHECK(f.read("title = " + std::string(100'000, '[')).problems.list().size() == 1);
}

TEST_CASE(
    "a photometric file's own fault is reported with its line, and the place that names the file",
    "[format][scene]") {
  SceneFolder f;
  f.put("bad.ies",
        "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 10\n0 45 90\n0\n1 x 3\n");
  const ReadScene read =
      f.read("[[luminaire]]\nname = \"l\"\nfile = \"bad.ies\"\nposition = [0, 0, 1]\n");
  INFO(all_problems(read));
  REQUIRE(read.problems.list().size() == 1);
  CHECK(read.problems.list()[0].where.file.find("bad.ies") != std::string::npos);
  CHECK(read.problems.list()[0].what.find("scene.toml:3") != std::string::npos);
}

TEST_CASE("a flood of mistakes is cut off with a sentence", "[format][scene]") {
  SceneFolder f;
  std::string text;
  for (int i = 0; i < 1500; ++i) text += "[[probe]]\nname = \"p" + std::to_string(i) + "\"\n";
  const ReadScene read = f.read(text);
  CHECK(read.problems.list().size() == limits::toml_problems + 1);
  CHECK(read.problems.list().back().what.find("more problems follow") != std::string::npos);
}

}  // namespace luxodus
