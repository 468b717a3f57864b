// A correct scene is read field by field, with the conversions of its keys.
#include "scenes/formats/scene_file/scene_file.hpp"

#include <xxhash.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "runtime/core/reading_share.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"
#include "tests/unit/scenes/formats/scene_file/scene_fixture.hpp"

namespace luxodus {

TEST_CASE("a scene's head and run settings are read, and unstated ones have their defaults",
          "[format][scene]") {
  SceneFolder f;
  const auto s = good(f, R"(
title = "A test"
[run]
seed = 9
max_bands = 3
band_edges_nm = [380, 500, 780]
voxels = false
groups = "circuit"
eye_path_factor = 0.5
)");
  CHECK(s.name == "scene");
  CHECK(s.title == "A test");
  CHECK(s.run.seed == 9);
  CHECK(s.run.max_bands == 3);
  CHECK(s.run.band_edges_nm == std::vector<double>{380, 500, 780});
  CHECK_FALSE(s.run.voxels);
  CHECK(s.run.groups == GroupRule::by_circuit);
  CHECK(s.run.eye_path_factor == 0.5);
  CHECK(s.run.band_tolerance == RunSettings{}.band_tolerance);
  CHECK(s.run.batch_particles == 0);
  CHECK_FALSE(s.run.analogue);
  CHECK(s.warnings.size() == 2);  // no light, no surfaces
}

TEST_CASE("a scene with a renamed key keeps the hash of its text from before", "[format][scene]") {
  SceneFolder f;
  const std::string before = "[run]\nbands_most = 3\neye_share = 0.5\n";
  CHECK(good(f, "[run]\nmax_bands = 3\neye_path_factor = 0.5\n").content_hash ==
        XXH3_64bits(before.data(), before.size()));
}

TEST_CASE("materials of every kind come with their optics, and their backs by name",
          "[format][scene]") {
  SceneFolder f;
  const auto s = good(f, R"(
[[material]]
name = "wall"
reflectance = 0.7
back = "film"
[[material]]
name = "film"
reflectance = [[400, 0.2], [600, 0.4]]
[[material]]
name = "paint"
kind = "glossy"
reflectance = "grey50"
specular = 0.04
roughness = 0.1
[[material]]
name = "silver"
kind = "mirror"
specular = 0.95
[[material]]
name = "pane"
kind = "glass"
ior = 1.5
transmittance = 0.9
[[material]]
name = "water"
kind = "dielectric"
ior = 1.33
[[material]]
name = "hole"
kind = "open"
[[object]]
name = "q"
shape = "quad"
corner = [0, 0, 0]
edge_u = [1, 0, 0]
edge_v = [0, 1, 0]
material = "wall"
)");
  CHECK(named(s.materials, "wall").reflectance.at(555) == 0.7);
  CHECK(named(s.materials, "film").reflectance.at(500) == near(0.3));
  CHECK(named(s.materials, "film").reflectance.at(385) == near(0.2));
  CHECK(named(s.materials, "film").reflectance.at(700) == near(0.4));
  const Material& paint = named(s.materials, "paint");
  CHECK(paint.kind == MaterialKind::glossy);
  CHECK(paint.reflectance.is_constant());
  CHECK(paint.reflectance.at(500) == 0.5);
  CHECK(paint.specular.at(500) == 0.04);
  CHECK(paint.roughness == 0.1);
  CHECK(named(s.materials, "silver").kind == MaterialKind::mirror);
  CHECK(named(s.materials, "silver").specular.at(600) == 0.95);
  CHECK(named(s.materials, "silver").reflectance.at(600) == 0);
  CHECK(named(s.materials, "pane").kind == MaterialKind::glass_pane);
  CHECK(named(s.materials, "pane").internal_transmittance.at(600) == 0.9);
  CHECK(named(s.materials, "pane").ior == 1.5);
  CHECK(named(s.materials, "water").kind == MaterialKind::dielectric);
  CHECK(named(s.materials, "water").ior == 1.33);
  CHECK(named(s.materials, "hole").kind == MaterialKind::open);
  const Object& q = s.objects.at(0);
  CHECK(s.materials[size_t(q.material)].name == "wall");
  CHECK(s.materials[size_t(q.back_material)].name == "film");
  CHECK(q.place.line == 31);
}

TEST_CASE("objects are built, transformed and tagged as written", "[format][scene]") {
  SceneFolder f;
  const auto s = good(f, R"(
patch_edge_m = 0.25
[[object]]
name = "table"
shape = "box"
low = [0, 0, 0]
high = [2, 1, 1]
material = "grey50"
scale = [1, 1, 2]
rotate_deg = [0, 0, 90]
translate = [10, 0, 0]
tags = ["furniture"]
group = "desks"
[[object]]
name = "hall"
shape = "room"
low = [-1, -1, 0]
high = [3, 3, 3]
material = "white80"
floor = "grey20"
omit = ["x1"]
patch_edge_m = 1
[[object]]
name = "wall"
shape = "wall"
from = [0, 5, 0]
to = [4, 5, 0]
height = 3
thickness = 0.2
material = "white80"
back_material = "black5"
opening = [{ at = 1, width = 1, height = 2 }, { at = 2.5, sill = 1, width = 1, height = 1 }]
[[object]]
name = "leaf"
shape = "quad"
corner = [1, 5, 0]
edge_u = [1, 0, 0]
edge_v = [0, 0, 2]
material = "grey50"
door = { hinge = [1, 5, 0], open = true, open_angle_deg = 80 }
[[object]]
name = "ball"
shape = "sphere"
radius = 0.5
mesh_tolerance_m = 0.01
material = "grey50"
[[object]]
name = "post"
shape = "cylinder"
radius = 0.1
height = 3
material = "grey50"
[[object]]
name = "pipe"
shape = "tube"
outer_radius = 0.1
inner_radius = 0.09
length = 1
material = "grey50"
[[object]]
name = "plate"
shape = "disc"
radius = 0.1
material = "grey50"
[[object]]
name = "flight"
shape = "stairs"
steps = 5
rise = 0.17
going = 0.29
width = 1.2
material = "grey50"
[[object]]
name = "slope"
shape = "ramp"
length = 3
width = 1
rise = 0.2
material = "grey50"
[[object]]
name = "lawn"
shape = "polygon"
outline = [[0, 0], [4, 0], [4, 3], [0, 3]]
z = -0.5
material = "grey20"
[[object]]
name = "pier"
shape = "prism"
outline = [[0, 0], [0.4, 0], [0.4, 0.3]]
z = 1
height = 2
material = "grey20"
)");
  const Object& table = named(s.objects, "table");
  CHECK(same(bounds_of(table.mesh).low, {9, 0, 0}));
  CHECK(same(bounds_of(table.mesh).high, {10, 2, 2}));
  CHECK(table.patch_edge_m == 0.25);
  CHECK(table.tags == std::vector<std::string>{"furniture"});
  CHECK(table.group == "desks");
  CHECK(signed_volume_of(table.mesh) == near(4));
  CHECK(table.material == table.back_material);
  CHECK(s.materials[size_t(table.material)].reflectance.at(500) == 0.5);

  CHECK(named(s.objects, "hall.floor").patch_edge_m == 1);
  CHECK(named(s.objects, "hall.floor").tags == std::vector<std::string>{"hall"});
  CHECK(s.materials[size_t(named(s.objects, "hall.floor").material)].name == "grey20");
  CHECK(s.materials[size_t(named(s.objects, "hall.y0").material)].name == "white80");
  CHECK(same(bounds_of(named(s.objects, "hall.ceiling").mesh).low, {-1, -1, 3}));
  for (const Object& o : s.objects) CHECK(o.name != "hall.x1");

  const Object& wall = named(s.objects, "wall");
  CHECK(same(bounds_of(wall.mesh).high, {4, 5.2, 3}));
  CHECK(signed_volume_of(wall.mesh) == Approx(0.2 * (12 - 2 - 1)));
  CHECK(s.materials[size_t(wall.back_material)].name == "black5");
  const Object& leaf = named(s.objects, "leaf");
  REQUIRE(leaf.door.has_value());
  CHECK(leaf.door->open);
  CHECK(leaf.door->open_angle_deg == 80);
  CHECK(same(leaf.door->hinge, {1, 5, 0}));
  CHECK(same(leaf.door->axis, {0, 0, 1}));
  CHECK(leaf.tags == std::vector<std::string>{"door"});
  CHECK(signed_volume_of(named(s.objects, "ball").mesh) == Approx(pi / 6).epsilon(0.06));
  CHECK(signed_volume_of(named(s.objects, "post").mesh) == Approx(pi * 0.03).epsilon(0.05));
  CHECK(bounds_of(named(s.objects, "pipe").mesh).high.z == near(1));
  CHECK(area_of(named(s.objects, "plate").mesh) == Approx(pi * 0.01).epsilon(0.05));
  CHECK(bounds_of(named(s.objects, "flight").mesh).high.z == near(0.85));
  CHECK(bounds_of(named(s.objects, "slope").mesh).high.z == near(0.2));
  CHECK(area_of(named(s.objects, "lawn").mesh) == near(12));
  CHECK(bounds_of(named(s.objects, "lawn").mesh).low.z == -0.5);
  CHECK(signed_volume_of(named(s.objects, "pier").mesh) == near(0.12));
}

TEST_CASE(
    "progress announces all meshes before the first is read, and does not know a simulation's "
    "bytes",
    "[scene]") {
  SceneFolder f;
  const auto import = [](const std::string& name, const std::string& units) {
    return "[[import]]\nname = \"" + name + "\"\nfile = \"cube.obj\"\nunits = \"" + units +
           "\"\nup = \"z\"\nmaterial = \"white70\"\n";
  };
  const auto told = [&](const std::string& text, ReadingShare& share) {
    return read_scene(f.put("scene.toml", text), std::nullopt, {}, FireFrames::between, &share);
  };
  ReadingShare both;
  const ReadScene read = told(import("a", "m") + import("b", "m"), both);
  INFO(all_problems(read));
  CHECK(read.problems.empty());
  CHECK(both.share() == std::optional(1.0));
  CHECK(both.all_known());
  // The second of the two is not read, because of its wrong unit: the first alone is half of the
  // bytes.
  ReadingShare half;
  CHECK_FALSE(told(import("a", "m") + import("b", "parsec"), half).problems.empty());
  CHECK(half.share() == std::optional(0.5));
  ReadingShare fire;
  CHECK_FALSE(told(import("a", "m") + "[[medium]]\nkind = \"fds\"\n", fire).problems.empty());
  CHECK_FALSE(fire.all_known());
}

TEST_CASE("the lamps of a glTF that holds nothing else become emitters", "[format][scene]") {
  SceneFolder f;
  f.put("lamps.gltf",
        R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0,1]}],"nodes":[)"
        R"({"name":"bulb","translation":[1,2,3],)"
        R"("extensions":{"KHR_lights_punctual":{"light":0}}},)"
        R"({"name":"bulb","rotation":[-0.70710678118654757,0,0,0.70710678118654757],)"
        R"("extensions":{"KHR_lights_punctual":{"light":1}}}],)"
        R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":100},)"
        R"({"type":"spot","intensity":100,"color":[1,0,0],)"
        R"("spot":{"innerConeAngle":0,"outerConeAngle":1.0471975511965976}}]}}})");
  const auto s = good(f,
                      "[[import]]\nname = \"ceiling\"\nfile = \"lamps.gltf\"\nunits = \"m\"\n"
                      "up = \"y\"\ntranslate = [10, 0, 0]\n");
  CHECK(s.objects.empty());
  REQUIRE(s.emitters.size() == 2);
  const Emitter& bulb = named(s.emitters, "ceiling.bulb");
  CHECK(same(bulb.frame.origin, {11, -3, 2}));
  CHECK(bulb.distribution == Distribution::isotropic);
  CHECK(bulb.mains_flux == near(400 * pi));
  CHECK(bulb.emergency_flux == 0);
  // The file's -z, turned to its -y, is down; smooth to 60 degrees: pi (1 - cos 60) sr for 1 cd;
  // red has 0.2126 of the luminance of white.
  const Emitter& spot = named(s.emitters, "ceiling.bulb#2");
  CHECK(spot.frame.axes[2].z == Approx(1));
  CHECK(spot.distribution == Distribution::spot);
  CHECK(spot.mains_flux == Approx(100 * 0.2126 * pi * 0.5));
  // Each lamp has its own body; the copies of one share it.
  const auto housed =
      good(f,
           "[[import]]\nname = \"i\"\nfile = \"lamps.gltf\"\nunits = \"m\"\nup = \"y\"\n"
           "[[import.repeat]]\ncount = 2\nstep = [5, 0, 0]\n"
           "[[object]]\nname = \"shade\"\nshape = \"box\"\nlow = [0, 0, 0]\nhigh = [1, 1, 1]\n"
           "material = \"grey50\"\nbody_of = [\"i.bulb\"]\n");
  REQUIRE(housed.emitters.size() == 4);
  const int shade = named(housed.objects, "shade").body;
  CHECK(shade != 0);
  for (const Emitter& e : housed.emitters)
    CHECK(e.body == (e.distribution == Distribution::isotropic ? shade : 0));
}

TEST_CASE("an imported file becomes objects by part, with materials from the table",
          "[format][scene]") {
  SceneFolder f;
  const auto s = good(f, R"(
[[import]]
name = "house"
file = "cube.obj"
units = "cm"
up = "z"
translate = [0, 0, 1]
materials = { paint = "white80", steel = "grey20" }
tags = ["imported"]
[[import.part]]
match = "lea*"
patch_edge_m = 0
tags = ["leaves"]
door = { hinge = [0, 0, 0] }
)");
  REQUIRE(s.objects.size() == 2);
  const Object& leaf = named(s.objects, "house.leaf");
  CHECK(same(bounds_of(leaf.mesh).high, {1, 2, 1}));
  CHECK(s.materials[size_t(leaf.material)].name == "white80");
  CHECK(leaf.door.has_value());
  CHECK(leaf.patch_edge_m == 0);
  CHECK(leaf.tags == std::vector<std::string>{"imported", "leaves", "house", "door"});
  const Object& frame = named(s.objects, "house.frame");
  CHECK(s.materials[size_t(frame.material)].name == "grey20");
  CHECK(frame.patch_edge_m == 0.5);
  CHECK(bounds_of(frame.mesh).high.z == near(1.5));

  const auto coloured = good(f, R"(
[[import]]
name = "house"
file = "cube.obj"
units = "m"
up = "y"
file_colours = true
part = [{ match = "frame", omit = true }]
)");
  REQUIRE(coloured.objects.size() == 1);
  CHECK(coloured.materials.at(0).name == "house.paint");
  CHECK(coloured.materials.at(0).reflectance.at(500) == Approx(0.5).margin(0.01));
}

TEST_CASE("a file imported twice keeps the units and directions of each import",
          "[format][scene]") {
  SceneFolder f;
  const auto placed = [](const char* name, const char* units, const char* up, const char* at) {
    return std::string("[[import]]\nname = \"") + name + "\"\nfile = \"cube.obj\"\nunits = \"" +
           units + "\"\nup = \"" + up + "\"\nmaterial = \"white80\"\ntranslate = " + at + "\n";
  };
  const auto s = good(
      f, placed("first", "cm", "z", "[0, 0, 0]") + placed("again", "cm", "z", "[5, 0, 0]") +
             placed("larger", "m", "z", "[0, 0, 0]") + placed("turned", "cm", "y", "[0, 0, 0]"));
  const auto bounds = [&](const std::string& name) {
    return bounds_of(named(s.objects, name + ".leaf").mesh);
  };
  const auto first = bounds("first");
  CHECK(same(bounds("again").low, first.low + glm::dvec3(5, 0, 0)));
  CHECK(same(bounds("again").high, first.high + glm::dvec3(5, 0, 0)));
  CHECK(same(bounds("larger").high, 100.0 * first.high));
  CHECK(bounds("turned").high.z == near(first.high.y));
  CHECK(named(s.objects, "again.leaf").mesh.triangles ==
        named(s.objects, "first.leaf").mesh.triangles);
}

TEST_CASE("a material is required where the file has no colour, unless a table gives it",
          "[format][scene]") {
  SceneFolder f;
  const std::string house =
      "[[import]]\nname = \"house\"\nfile = \"cube.obj\"\nunits = \"cm\"\nup = \"z\"\n"
      "file_colours = true\n";
  f.put("cube.mtl", "newmtl paint\nKd 0.5 0.5 0.5\n");
  const ReadScene bare = f.read(house);
  INFO(all_problems(bare));
  REQUIRE(bare.problems.list().size() == 1);
  const Problem problem = bare.problems.list().front();
  CHECK(problem.where.file == (f.path() / "cube.obj").string());
  CHECK(problem.where.line == 12);
  for (const char* words : {"the material 'steel' has no colour", "cube.mtl", "'materials'",
                            "named at ", "scene.toml:6"})
    CHECK(problem.what.find(words) != std::string::npos);
  const SceneDescription mapped = good(f, house + "materials = { steel = \"grey20\" }\n");
  CHECK(mapped.objects.size() == 2);
  CHECK(good(f, house + "part = [{ match = \"frame\", omit = true }]\n").objects.size() == 1);
}

TEST_CASE("measurements, views and scenarios are read as written", "[format][scene]") {
  SceneFolder f;
  const auto s = good(f, R"(
[[object]]
name = "leaf"
shape = "quad"
corner = [0, 0, 0]
edge_u = [1, 0, 0]
edge_v = [0, 0, 2]
material = "grey50"
door = { hinge = [0, 0, 0] }
tags = ["red"]
[[emitter]]
name = "e"
shape = "point"
position = [0, 0, 1]
flux_lm = 5
circuit = "c"
[[medium]]
name = "smoke"
kind = "homogeneous"
extinction = 1
albedo = 0
[[plane]]
name = "a"
corner = [0, 0, 0.02]
edge_u = [4, 0, 0]
edge_v = [0, 0.9, 0]
cell_m = 0.3
[[plane]]
name = "b"
corner = [0, 0, 0.02]
edge_u = [4, 0, 0]
edge_v = [0, 2, 0]
cells = [4, 2]
[[probe]]
name = "p"
position = [1, 1, 1]
normal = [0, 3, 0]
[[surface_group]]
name = "g"
objects = ["leaf", "red"]
[[volume_group]]
name = "box"
shape = "box"
low = [0, 0, 0]
high = [1, 1, 1]
[[volume_group]]
name = "shell"
shape = "shell"
centre = [1, 2, 3]
radius = 2
inner_radius = 1
[[volume_group]]
name = "layer"
shape = "layer"
z_low = 1
z_high = 2
[[counting_plane]]
name = "door way"
corner = [0, 0, 0]
edge_u = [1, 0, 0]
edge_v = [0, 0, 2]
[[observer]]
name = "o"
eye = [0, 0, 1.6]
target = [0, 5, 1.6]
[[camera]]
name = "cam"
eye = [0, 0, 1.6]
target = [0, 5, 1.6]
vertical_fov_deg = 45
cut = -0.5
width = 320
height = 200
[[scenario]]
name = "fails"
operation = "emergency"
seconds_after_failure = 60
circuits = { c = 0.5 }
media = { smoke = 2 }
smoke_factor = 3
emission_factor = 0.1
doors_open = ["leaf"]
)");
  CHECK(s.planes.at(0).cells_u == 14);
  CHECK(s.planes.at(0).cells_v == 3);
  CHECK(s.planes.at(1).cells_u == 4);
  CHECK(s.planes.at(1).cells_v == 2);
  CHECK(same(s.probes.at(0).normal, {0, 1, 0}));
  CHECK(s.surface_groups.at(0).objects == std::vector<std::string>{"leaf", "red"});
  CHECK(s.volume_groups.at(0).shape == VolumeGroupMeasure::Shape::box);
  CHECK(s.volume_groups.at(1).inner_radius == 1);
  CHECK(s.volume_groups.at(1).radius == 2);
  CHECK(s.volume_groups.at(2).low.z == 1);
  CHECK(s.volume_groups.at(2).high.z == 2);
  CHECK(s.counting_planes.at(0).edge_v.z == 2);
  CHECK(same(s.observers.at(0).gaze, {0, 1, 0}));
  CHECK(s.cameras.at(0).vertical_fov_deg == 45);
  CHECK(s.cameras.at(0).cut_m == -0.5);
  CHECK(s.cameras.at(0).width == 320);
  CHECK(s.cameras.at(0).height == 200);
  const Scenario& fails = s.scenarios.at(0);
  CHECK(fails.operation == Operation::emergency);
  CHECK(fails.seconds_after_failure == 60);
  CHECK(fails.says_seconds);
  CHECK(fails.circuits.at(0).name == "c");
  CHECK(fails.circuits.at(0).factor == 0.5);
  CHECK(fails.media.at(0).factor == 2);
  CHECK(fails.smoke_factor == 3);
  CHECK(fails.emission_factor == 0.1);
  CHECK(fails.doors_open == std::vector<std::string>{"leaf"});
}

TEST_CASE("including files share a building, and paths are relative to the file that states them",
          "[format][scene]") {
  SceneFolder f;
  std::filesystem::create_directory(f.path() / "parts");
  f.put("parts/lamp2.ies",
        "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n9 9\n");
  f.put("parts/building.toml", R"(
title = "from the building"
include = ["base.toml"]
[run]
seed = 5
max_bands = 2
[[luminaire]]
name = "l"
file = "lamp2.ies"
position = [0, 0, 2]
)");
  f.put("parts/base.toml", "[[material]]\nname = \"m\"\nreflectance = 0.3\n");
  const auto s = good(f, R"(
include = ["parts/building.toml", "parts/base.toml"]
[run]
seed = 6
[[object]]
name = "q"
shape = "quad"
corner = [0, 0, 0]
edge_u = [1, 0, 0]
edge_v = [0, 1, 0]
material = "m"
)");
  CHECK(s.title == "from the building");
  CHECK(s.run.seed == 6);
  CHECK(s.run.max_bands == 2);
  CHECK(s.materials.size() == 1);
  CHECK(s.emitters.at(0).place.file.find("building.toml") != std::string::npos);
}

TEST_CASE("the content hash covers every byte of every file, and nothing else", "[format][scene]") {
  SceneFolder f;
  const std::string text =
      "[[luminaire]]\nname = \"l\"\nfile = \"lamp.ies\"\nposition = [0, 0, 2]\n"
      "[[import]]\nname = \"i\"\nfile = \"cube.obj\"\nunits = \"m\"\nup = \"z\"\n"
      "material = \"grey50\"\n";
  const uint64_t first = good(f, text).content_hash;
  CHECK(good(f, text).content_hash == first);
  CHECK(good(f, text + "# a word\n").content_hash != first);
  f.put("cube.mtl", "newmtl paint\nKd 0.5 0.5 0.5\nnewmtl steel\nKd 0.3 0.2 0.2\n");
  const uint64_t other_mtl = good(f, text).content_hash;
  CHECK(other_mtl != first);
  f.put("lamp.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n9 9\n");
  CHECK(good(f, text).content_hash != other_mtl);
}

}  // namespace luxodus
