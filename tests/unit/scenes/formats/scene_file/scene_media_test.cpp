// Media of a correct scene, read field by field, with the conversions of extinction.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"
#include "tests/unit/scenes/formats/scene_file/scene_fixture.hpp"

namespace luxodus {

TEST_CASE("extinction means the same in every unit", "[format][scene]") {
  SceneFolder f;
  // K = 1 /m in the units of fire protection, by T = exp(-K d).
  CHECK(smoke_optics(f, "extinction = 1").extinction.sigma_t == 1);
  CHECK(smoke_optics(f, "od_per_m = 0.4342944819032518").extinction.sigma_t == near(1));
  CHECK(smoke_optics(f, "db_per_m = 4.342944819032518").extinction.sigma_t == near(1));
  CHECK(smoke_optics(f, "percent_per_m = 63.21205588285577").extinction.sigma_t == near(1));
  CHECK(smoke_optics(f, "percent_per_ft = 26.27291861900436").extinction.sigma_t == near(1));
  const Extinction flaming = smoke_optics(f, "smoke = \"flaming\"\nsoot_density = 1e-4").extinction;
  CHECK(flaming.sigma_t == near(0.87));
  CHECK(flaming.angstrom == 1);
  CHECK(flaming.wavelength_nm == 633);
  const Extinction own =
      smoke_optics(
          f,
          "smoke = \"smouldering\"\nsoot_density = 1e-4\nmass_extinction = 4000\nangstrom = 2\n"
          "wavelength_nm = 550")
          .extinction;
  CHECK(own.sigma_t == near(0.4));
  CHECK(own.angstrom == 2);
  CHECK(own.wavelength_nm == 550);
  CHECK(smoke_optics(f, "extinction = 1").extinction.angstrom == 0);
  const Extinction table = smoke_optics(f, "extinction_table = [[400, 2], [800, 1]]").extinction;
  REQUIRE(table.table.has_value());
  CHECK(table.table->at(600) == near(1.5));
}

TEST_CASE("media of every kind are read with their place, phase function and flames",
          "[format][scene]") {
  SceneFolder f;
  f.put("fire.nrrd",
        "NRRD0004\ntype: float\ndimension: 3\nsizes: 2 1 1\nencoding: ascii\n"
        "space directions: (0.5,0,0) (0,0.5,0) (0,0,0.5)\nspace origin: (1,1,1)\n\n0.5 0.25\n");
  const auto s = good(f, R"(
[[medium]]
name = "all"
kind = "homogeneous"
extinction = 0.1
albedo = "white80"
phase = "hg"
g = 0.7
box = [[3, 4], [1, 2]]
z_low = 1
z_high = 2
[[medium]]
name = "layers"
kind = "layered"
polygon = [[0, 0], [4, 0], [4, 4]]
[[medium.layer]]
z_low = 2
z_high = 3
extinction = 2
albedo = 0.5
phase = "rayleigh"
[[medium.layer]]
z_low = 1
z_high = 2
extinction = 1
albedo = 0.5
phase = "table"
phase_table = [[-1, 1], [0, 2], [1, 5]]
[[medium]]
name = "flame"
kind = "bounded"
body = "cone"
radius = 0.3
height = 1
position = [1, 2, 0]
rotate_deg = [0, 0, 30]
extinction = 3
albedo = 0.1
emission = { power_w = 1000, temperature_k = 1400, group = "fire" }
[[medium]]
name = "blob"
kind = "bounded"
body = "ellipsoid"
radii = [1, 2, 3]
position = [0, 0, 0]
extinction = 3
albedo = 0.1
[[medium]]
name = "pillar"
kind = "bounded"
body = "cylinder"
radius = 1
height = 2
position = [0, 0, 0]
extinction = 3
albedo = 0.1
[[medium]]
name = "bowl"
kind = "bounded"
body = "paraboloid"
radius = 1
height = 2
position = [0, 0, 0]
extinction = 3
albedo = 0.1
[[medium]]
name = "by hand"
kind = "bounded"
body = "quadric"
a = [1, 1, 1, 0, 0, 0]
c = -1
low = [-1, -1, -1]
high = [1, 1, 1]
clip = [{ normal = [0, 0, 2], offset = 0.5 }]
position = [0, 0, 0]
extinction = 3
albedo = 0.1
[[scenario]]
name = "burning"
media = { all = 0.5 }
)");
  const Medium& all = named(s.media, "all");
  CHECK(all.optics.phase.kind == PhaseKind::henyey_greenstein);
  CHECK(all.optics.phase.g == 0.7);
  CHECK(all.optics.albedo.at(500) == 0.8);
  REQUIRE(all.footprint.polygon.size() == 4);
  CHECK(all.footprint.polygon[0] == glm::dvec2(1, 2));
  CHECK(all.footprint.polygon[2] == glm::dvec2(3, 4));
  CHECK(all.footprint.z_low == 1);
  CHECK(all.footprint.z_high == 2);
  const Medium& layers = named(s.media, "layers");
  CHECK(layers.kind == MediumKind::layered);
  REQUIRE(layers.layers.size() == 2);
  CHECK(layers.layers[0].z_low == 1);  // sorted by height
  CHECK(layers.layers[0].optics.phase.kind == PhaseKind::tabulated);
  CHECK(layers.layers[0].optics.phase.table_value == std::vector<double>{1, 2, 5});
  CHECK(layers.layers[1].optics.phase.kind == PhaseKind::rayleigh);
  CHECK(layers.footprint.polygon.size() == 3);
  const Medium& flame = named(s.media, "flame");
  CHECK(flame.kind == MediumKind::bounded);
  CHECK(same(flame.frame.origin, {1, 2, 0}));
  CHECK(flame.frame.axes[0].y == near(0.5));
  CHECK(flame.local_bounds.high.z == near(1));
  REQUIRE(flame.emission.has_value());
  CHECK(flame.emission->power_w == 1000);
  CHECK(flame.emission->group == "fire");
  CHECK(flame.emission->spectrum.integral() == Approx(1));
  CHECK(named(s.media, "blob").local_bounds.high.y == near(2));
  CHECK(named(s.media, "pillar").quadric.clips.size() == 2);
  CHECK(named(s.media, "bowl").local_bounds.high.z == near(2));
  CHECK(named(s.media, "by hand").quadric.clips.at(0).normal.z == near(1));
}

}  // namespace luxodus
