// Paths that carry all bands, against closed forms and against paths of one band.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "actors/results/pictures/flux_radiance.hpp"
#include "tests/unit/actors/results/files/display_fixture.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// A box whose walls glow uniformly, with a coloured spectrum, in front of a surface that reflects
/// a half. A medium without absorption cannot change its light. Each wall is tiles^2 emitters.
std::string coloured_furnace(const std::string& medium, int tiles) {
  std::string toml = R"(
patch_edge_m = 0.5
[run]
max_bands = 5
[[material]]
name = "wall"
reflectance = 0.5
[[object]]
name = "box"
shape = "room"
low = [0, 0, 0]
high = [2, 2, 2]
material = "wall"
)" + medium;
  constexpr double before_wall = 0.0005;
  const double edge = 2.0 / tiles;
  const auto list = [](const double* v) {
    return "[" + std::to_string(v[0]) + ", " + std::to_string(v[1]) + ", " + std::to_string(v[2]) +
           "]\n";
  };
  int number = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {1.0, -1.0})
      for (int tile = 0; tile < tiles * tiles; ++tile) {
        double position[3], direction[3] = {0, 0, 0};
        const int row = tile / tiles;
        position[axis] = side > 0 ? before_wall : 2 - before_wall;
        position[(axis + 1) % 3] = edge * (row + 0.5);
        position[(axis + 2) % 3] = edge * (tile - row * tiles + 0.5);
        direction[axis] = side;
        const std::string size = std::to_string(edge);
        toml += "[[emitter]]\nname = \"tile " + std::to_string(number++) +
                "\"\nshape = \"rectangle\"\nsize = [" + size + ", " + size +
                "]\nluminance_cd_m2 = 100\nspectrum = [[400, 0.2], [700, 1]]\nposition = " +
                list(position) + "direction = " + list(direction);
      }
  return toml;
}

/// Smoke without absorption, four times as dense in blue as in red.
const std::string white_soot = R"(
[[medium]]
name = "smoke"
kind = "homogeneous"
extinction = 0.8
angstrom = 2.5
albedo = 1
phase = "hg"
g = 0.6
)";

/// Also grey smoke in a part of the room: extinctions have no common ratio.
const std::string two_smokes = white_soot + R"(
[[medium]]
name = "grey"
kind = "bounded"
body = "ellipsoid"
position = [1, 1, 1]
radii = [0.6, 0.8, 0.5]
extinction = 1.5
albedo = 1
)";

/// A room with everything that depends on the band: coloured walls, a glossy floor, a coloured
/// pane, soot in layers, brown smoke.
const std::string coloured_room = R"(
patch_edge_m = 0.5
[run]
max_bands = 5
voxel_edge_m = 0.5
[[material]]
name = "ochre"
reflectance = [[400, 0.1], [700, 0.8]]
[[material]]
name = "floor"
kind = "glossy"
reflectance = [[400, 0.5], [700, 0.1]]
specular = [[400, 0.05], [700, 0.4]]
roughness = 0.3
[[material]]
name = "green glass"
kind = "glass"
transmittance = [[400, 0.3], [550, 0.9], [700, 0.2]]
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [4, 3, 2.5]
material = "ochre"
[[object]]
name = "carpet"
shape = "quad"
corner = [0.2, 0.2, 0.01]
edge_u = [3.6, 0, 0]
edge_v = [0, 2.6, 0]
material = "floor"
[[object]]
name = "window"
shape = "quad"
corner = [2.2, 0.01, 0.02]
edge_u = [0, 2.98, 0]
edge_v = [0, 0, 2]
material = "green glass"
[[medium]]
name = "soot"
kind = "layered"
layer = [
  { z_low = 0, z_high = 1.2, extinction = 0.1, angstrom = 1.5, albedo = 0.4 },
  { z_low = 1.2, z_high = 2.5, extinction = 0.8, angstrom = 1.5, albedo = 0.4 },
]
[[medium]]
name = "brown"
kind = "bounded"
body = "ellipsoid"
position = [1.2, 1.5, 1]
radii = [0.6, 0.5, 0.5]
extinction = 1
albedo = [[400, 0.2], [700, 0.9]]
[[emitter]]
name = "lamp"
shape = "rectangle"
size = [0.6, 0.3]
position = [1.5, 1.5, 2.4]
flux_lm = 1000
spectrum = "A"
[[emitter]]
name = "blue"
shape = "sphere"
diameter = 0.2
position = [3, 2, 1.8]
flux_lm = 100
spectrum = [[400, 1], [600, 0.1]]
)";

/// A flame that has soot of its own, in a coloured room with other soot.
const std::string flame_room = R"(
patch_edge_m = 0.5
[run]
max_bands = 4
[[material]]
name = "ochre"
reflectance = [[400, 0.2], [700, 0.7]]
[[object]]
name = "room"
shape = "room"
low = [-1.5, -1.5, 0]
high = [1.5, 1.5, 2.5]
material = "ochre"
[[medium]]
name = "flame"
kind = "bounded"
body = "ellipsoid"
position = [0, 0, 1]
radii = [0.5, 0.5, 0.5]
extinction = 1.5
albedo = 0
emission = { power_w = 100000, temperature_k = 1400 }
[[medium]]
name = "soot"
kind = "homogeneous"
extinction = 0.4
angstrom = 1
albedo = 0.4
phase = "hg"
g = 0.6
)";

/// Smoke that scatters red light and absorbs the rest.
const std::string red_smoke_room = R"(
patch_edge_m = 0.5
[run]
band_edges_nm = [380, 480, 560, 600, 680, 780]
voxel_edge_m = 0.5
[[material]]
name = "grey"
reflectance = 0.2
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [4, 3, 2.5]
material = "grey"
[[medium]]
name = "smoke"
kind = "homogeneous"
extinction = 0.6
albedo = [[380, 0], [600, 0], [610, 0.95], [780, 0.95]]
[[emitter]]
name = "lamp"
shape = "rectangle"
size = [0.6, 0.3]
position = [1.5, 1.5, 2.4]
flux_lm = 1000
)";

/// Haze in which few free flights collide, six times as many in blue as in red: more of the first
/// ones are forced to collide.
const std::string hazy_room = R"(
patch_edge_m = 0.5
[run]
max_bands = 4
voxel_edge_m = 0.5
[[material]]
name = "ochre"
reflectance = [[400, 0.1], [700, 0.4]]
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [4, 3, 2.5]
material = "ochre"
[[medium]]
name = "haze"
kind = "homogeneous"
extinction = 0.03
angstrom = 3
albedo = 0.95
[[emitter]]
name = "lamp"
shape = "rectangle"
size = [0.6, 0.3]
position = [1.5, 1.5, 2.4]
flux_lm = 1000
)";

/// Light of a band along some rays, by many paths.
struct BandLight {
  double mean = 0, error = 0;
};

enum class Paths { of_all_bands, of_one_band };

/// For each band, the mean over rays from `eye` through a fan of directions around `towards`.
std::vector<BandLight> seen(const LocalRun& run, const glm::vec3& eye, const glm::vec3& towards,
                            int paths, Paths way, const RadianceCache* flux, bool with_emitted) {
  const auto bands = static_cast<size_t>(run.scene().bands.count());
  const glm::vec3 local(glm::dvec3(eye) - run.scene().local_origin);
  std::vector<double> sums(bands), squares(bands), counts(bands);
  run.rows().run(1, [&](const GeometryAccess& access) -> ParallelFor::Worker {
    const std::shared_ptr<PictureTracer> tracer =
        make_picture_tracer(run.scene(), access, 3, make_emitter_sight(run.scene()));
    return [&, tracer](int64_t) {
      FirstHit first;
      for (uint32_t i = 0; i < static_cast<uint32_t>(paths); ++i) {
        tracer->start(uint64_t{i} << 20, 1, 0);  // every path has a set of its own: independent
        const glm::vec3 spread(tracer->uniform() - 0.5f, tracer->uniform() - 0.5f,
                               tracer->uniform() - 0.5f);
        const Ray ray{local, glm::normalize(towards + 0.8f * spread)};
        const int hero = tracer->choose_band(static_cast<double>(tracer->uniform()));
        const auto add = [&](size_t b, double light) {
          if (with_emitted) light += first.emitted[b];
          sums[b] += light;
          squares[b] += light * light;
          counts[b] += 1;
        };
        if (way == Paths::of_one_band) {
          const auto b = static_cast<size_t>(i % bands);
          add(b, tracer->radiance_in_band(ray, static_cast<int>(b), flux));
          continue;
        }
        const auto light = tracer->radiance(ray, hero, flux, &first);
        for (size_t b = 0; b < bands; ++b) add(b, light[b]);
      }
    };
  });
  std::vector<BandLight> out;
  for (size_t b = 0; b < bands; ++b) {
    const double mean = sums[b] / counts[b];
    out.push_back({mean, std::sqrt((squares[b] / counts[b] - mean * mean) / counts[b])});
  }
  return out;
}

void check_alike(const std::string& toml, const glm::vec3& eye, const glm::vec3& towards,
                 bool gather) {
  const auto run = traced(toml, 1 << 16);
  REQUIRE(run->scene().bands.count() >= 4);
  const auto flux = gather ? flux_radiance(*run) : nullptr;
  const auto all = seen(*run, eye, towards, 1 << 15, Paths::of_all_bands, flux.get(), false);
  const auto one = seen(*run, eye, towards, 1 << 17, Paths::of_one_band, flux.get(), false);
  for (size_t b = 0; b < all.size(); ++b) {
    INFO("band " << b << ": " << all[b].mean << " +- " << all[b].error << " against " << one[b].mean
                 << " +- " << one[b].error);
    CHECK(one[b].error < 0.04 * one[b].mean);
    CHECK(all[b].error < 0.04 * all[b].mean);
    CHECK(std::abs(all[b].mean - one[b].mean) < 4 * std::hypot(all[b].error, one[b].error));
  }
}

void check_furnace(const LocalRun& run, int paths, double wanted_error) {
  const auto light =
      seen(run, {0.7f, 0.9f, 1.1f}, {1, 0.3f, -0.3f}, paths, Paths::of_all_bands, nullptr, true);
  for (size_t b = 0; b < light.size(); ++b) {
    const CompiledEmitter& tile = run.scene().emitters[0];
    const double wall = tile.power_w[b] / (std::numbers::pi * static_cast<double>(tile.area_m2));
    const double exact = wall / (1 - 0.5);
    INFO("band " << b << ": " << light[b].mean << " +- " << light[b].error << ", exact " << exact);
    CHECK(light[b].error < wanted_error * exact);
    // The emitters are 0.5 mm in front of the walls, which loses 0.1 % at the edges.
    CHECK(std::abs(light[b].mean - exact) < 4 * light[b].error + 0.003 * exact);
  }
}

}  // namespace

TEST_CASE(
    "a path of all bands sees uniform light in every band through any smoke without absorption",
    "[display]") {
  const bool mixed = GENERATE(false, true);
  const auto run = traced(coloured_furnace(mixed ? two_smokes : white_soot, 1), 1 << 12);
  REQUIRE(run->scene().bands.count() == 5);
  check_furnace(*run, 1 << 16, 0.015);
}

TEST_CASE("uniform light stays uniform where scattering is aimed at parts of it", "[display]") {
  // Tiles of half a metre: no place in the middle of the box is within their spheres.
  const auto run = traced(coloured_furnace(white_soot, 4), 1 << 12);
  REQUIRE(run->scene().bands.count() == 5);
  check_furnace(*run, 1 << 16, 0.025);
}

TEST_CASE("a path of all bands gives in each band what a path of that band gives", "[display]") {
  const bool gather = GENERATE(false, true);
  SECTION("coloured walls, gloss, glass, soot and brown smoke") {
    check_alike(coloured_room, {0.3f, 0.4f, 1.5f}, {1, 0.4f, -0.2f}, gather);
  }
  SECTION("smoke that scatters only some bands") {
    check_alike(red_smoke_room, {0.3f, 0.4f, 1.5f}, {1, 0.4f, -0.2f}, gather);
  }
  SECTION("haze that is thicker in blue") {
    check_alike(hazy_room, {0.3f, 0.4f, 1.5f}, {1, 0.4f, -0.2f}, gather);
  }
  SECTION("haze in the open") {
    const std::string beam = R"([[object]]
name = "wall"
shape = "quad"
corner = [4, -2, -2]
edge_u = [0, 6, 0]
edge_v = [0, 0, 6]
material = "ochre"
[[medium]])";
    const size_t room = hazy_room.find("[[object]]"), medium = hazy_room.find("[[medium]]");
    const std::string text = hazy_room.substr(0, room) + beam +
                             hazy_room.substr(medium + std::string("[[medium]]").size());
    check_alike(text, {0.3f, 0.4f, 1.5f}, {-1, 0.4f, -0.2f}, gather);
  }
  SECTION("a flame in soot") {
    check_alike(flame_room, {-1.3f, -1.0f, 1.3f}, {1, 0.9f, -0.3f}, gather);
  }
}

TEST_CASE("a path of all bands adds no colour in grey air", "[display]") {
  // One spectrum and grey walls: every path has the colours of the lamp.
  const auto run = traced(R"(
patch_edge_m = 0.5
[run]
band_edges_nm = [380, 480, 560, 640, 780]
[[material]]
name = "grey"
reflectance = 0.5
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [4, 3, 2.5]
material = "grey"
[[medium]]
name = "haze"
kind = "homogeneous"
extinction = 0.2
albedo = 0.8
[[emitter]]
name = "lamp"
shape = "rectangle"
size = [0.6, 0.3]
position = [2, 1.5, 2.4]
flux_lm = 1000
spectrum = "A"
)",
                          1 << 12);
  const std::vector<double>& power = run->scene().groups[0].power_w;
  REQUIRE(power.size() == 4);
  run->rows().run(1, [&](const GeometryAccess& access) -> ParallelFor::Worker {
    const std::shared_ptr<PictureTracer> tracer =
        make_picture_tracer(run->scene(), access, 3, make_emitter_sight(run->scene()));
    return [&, tracer](int64_t) {
      for (uint32_t i = 0; i < 64; ++i) {
        tracer->start(0, 64, i);
        const Ray ray{glm::vec3(glm::dvec3(0.3, 0.4, 1.5) - run->scene().local_origin),
                      glm::normalize(glm::vec3(1, 0.4f, -0.2f))};
        const auto light = tracer->radiance(ray, static_cast<int>(i % 4), nullptr, nullptr);
        for (size_t b = 1; b < 4; ++b)
          CHECK(light[b] * power[0] == Approx(light[0] * power[b]).epsilon(1e-9));
      }
    };
  });
}
