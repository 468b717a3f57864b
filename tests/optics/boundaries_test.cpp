// Light where single precision decides: along boundaries, walls and voxel faces, from emitters at
// walls, at walls of a millimetre in buildings of a hundred metres, on slivers, and in beams much
// narrower than they are long.
#include <cmath>
#include <numbers>

#include "scenes/light/geometry/primitives.hpp"
#include "scenes/light/geometry/transform.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/optics/posed_room.hpp"

namespace luxodus::light {
namespace {

/// A collimated emitter; its rays start on a line along `spread` with that length, or at one point.
void add_beam(SceneDescription& scene, const glm::dvec3& from, const glm::dvec3& way,
              const glm::dvec3& spread = glm::dvec3(0)) {
  Emitter& e = add_emitter(scene, EmitterShape::point, from, way, 1);
  e.distribution = Distribution::collimated;
  const double length = glm::length(spread);
  if (length > 0) {
    e.shape = EmitterShape::rectangle;
    e.frame.axes[0] = spread / length;
    e.frame.axes[1] = glm::cross(-way, e.frame.axes[0]);
    e.frame.axes[2] = -way;
    e.size = {length, 0, 0};
  }
}

void add_room(SceneDescription& scene, const glm::dvec3& low, const glm::dvec3& high,
              double reflectance, const std::string& name = "") {
  const int wall = add_grey(scene, reflectance);
  for (const BoxFace& f : faces_of_box(low, high))
    add_quad(scene, name + f.name, f.corner, f.u, f.v, wall);
}

RunOptions small(int64_t particles) {
  RunOptions options;
  options.particles = particles;
  return options;
}

}  // namespace

// ---- along boundaries of media and voxels ------------------------------------------------------

TEST_CASE("a level beam in the boundary of two layers is in the upper one") {
  // Heights are exact in single precision, and the boundary lies in a face of the voxels, too.
  constexpr double upper = 0.25, lower = 4, boundary = 2, from = 0.5, to = 8;
  for (const glm::dvec3& way : {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0)}) {
    for (const bool cells : {false, true}) {
      INFO((cells ? "cells" : "layers") << ", along " << way.x);
      SceneDescription scene;
      add_room(scene, {0, 0, 0}, {to, 4, 4}, 0);
      scene.run.voxel_edge_m = 1;
      if (cells) {
        // The beam runs along an edge of four cells.
        for (const double sigma : {lower, upper}) {
          add_cells(
              scene, {0, 0, 0}, {to, 4, 4}, 4,
              [&](const glm::dvec3& p) { return (p.z > boundary) == (sigma == upper) ? sigma : 0; },
              0);
        }
      } else {
        add_layers(scene, 0, {boundary}, {smoke(lower, 0)});
        add_layers(scene, boundary, {boundary}, {smoke(upper, 0)});
      }
      add_layer_group(scene, 0, boundary);
      add_layer_group(scene, boundary, 4);
      add_beam(scene, {way.x > 0 ? from : to - from, boundary, boundary}, way);
      const Run run(std::move(scene), small(1 << 18));
      const double depth = upper * (to - from);
      check_within(run.into(way.x > 0 ? "x1" : "x0"), std::exp(-depth), half_percent);
      check_within(run.absorbed_by_medium(1), -std::expm1(-depth), half_percent);
      CHECK(run.absorbed_by_medium(0).value == 0);
      CHECK(run.track_length(0).value == 0);
      check_within(run.track_length(1), -std::expm1(-depth) / upper, half_percent);
      double below = 0, above = 0;
      const VoxelGrid& grid = run.scene().voxels;
      for (uint32_t v = 0; v < grid.count(); ++v) {
        const double z = run.scene().local_origin.z + static_cast<double>(grid.low.z) +
                         (v / static_cast<uint32_t>(grid.nx * grid.ny)) * 1.0;
        (z >= boundary ? above : below) += run.watts(run.blocks().voxels, v).value;
      }
      CHECK(below == 0);
      CHECK(above == Approx(run.track_length(1).value).epsilon(1e-6));
    }
  }
}

TEST_CASE("beams within a wall's own plane and along its edges leave no closed room") {
  // Light in a wall's plane may hit that wall or the one at its end; behind either there must be
  // none.
  const glm::dvec3 low(0), high(4, 3, 2.5);
  for (const double shift : {0.0, 0.3}) {  // heights that are exact in single precision, or not
    SceneDescription scene;
    scene.run.voxels = false;
    add_room(scene, low + shift, high + shift, 0.5);
    const auto beam = [&](const glm::dvec3& from, const glm::dvec3& way,
                          const glm::dvec3& spread = glm::dvec3(0)) {
      add_beam(scene, from + shift, way, spread);
    };
    beam({1, 1.5, 0}, {1, 0, 0}, {0, 2, 0});        // in the floor
    beam({1, 1.5, 2.5}, {0, 1, 0}, {1, 0, 0});      // in the ceiling
    beam({0, 1.5, 1}, {0, 0, -1}, {0, 2, 0});       // in a wall
    beam({2, 1.5, 0}, {0.8, 0.6, 0}, {0, 0.5, 0});  // in the floor, across its diagonal
    beam({1, 0, 0}, {1, 0, 0});                     // along the edge of floor and wall
    beam({4, 3, 1}, {0, 0, 1});                     // along an upright edge, into a corner
    const Run run(std::move(scene), small(1 << 20));
    CHECK(run.balance().escaped == 0);
  }
}

// ---- emitters at walls -------------------------------------------------------------------------

TEST_CASE("emitters at walls send no light behind them") {
  // Emitters may lie in the wall itself: light starts off it, as it does on a lamp's own body.
  struct Lamp {
    double size_m, distance_m;
    bool body;
  };
  for (const Lamp& row : {Lamp{1, 1e-5, false}, Lamp{1, 0, false}, Lamp{30, 1e-3, false},
                          Lamp{30, 1e-5, false}, Lamp{30, 1e-6, false}, Lamp{30, 1e-7, false},
                          Lamp{30, 0, false}, Lamp{1, 0, true}, Lamp{30, 0, true}}) {
    for (const glm::dmat3& axes : {glm::dmat3(1.0), turned()}) {
      const Pose pose{axes, 1, glm::dvec3(0)};
      SceneDescription scene;
      const int wall = add_grey(scene, 0.5);
      const double size = row.size_m;
      for (const BoxFace& f : faces_of_box({0, 0, 0}, {size, 0.8 * size, 0.7 * size})) {
        add_quad(scene, f.name, pose.point(f.corner), pose.way(f.u), pose.way(f.v), wall);
        const glm::dvec3 at = f.corner + 0.5 * (f.u + f.v) + row.distance_m * f.inward;
        Emitter& e = add_rectangle(scene, pose.point(at), pose.way(f.inward), glm::length(f.u),
                                   glm::length(f.v), 1);
        e.frame.axes = axes * glm::dmat3(glm::normalize(f.u), -glm::normalize(f.v), -f.inward);
        if (row.body) e.body_material = scene.materials[0].name;
      }
      INFO(row.distance_m << " m from walls of " << size << " m, "
                          << (axes == glm::dmat3(1.0) ? "level" : "tilted"));
      const Run run(std::move(scene), small(1 << 18));
      CHECK(run.balance().escaped == 0);
    }
  }
}

// ---- thin walls --------------------------------------------------------------------------------

namespace {

constexpr double millimetre = 1e-3;

/// A hall of 100 m, a kilometre from the origin. In its far corner stand a closed cubicle with
/// walls of a millimetre, and a screen as thin. Objects: six walls of the hall, six inner and six
/// outer walls of the cubicle, the screen.
SceneDescription hall(const glm::dvec3& at) {
  SceneDescription scene;
  scene.run.voxels = false;
  add_room(scene, at, at + glm::dvec3(100, 80, 12), 0.8, "hall ");
  const glm::dvec3 low = at + glm::dvec3(96, 76, 0.5), high = low + glm::dvec3(3, 2.5, 2.4);
  add_room(scene, low, high, 0.8, "inner ");
  add_room(scene, low - millimetre, high + millimetre, 0.8, "outer ");
  Mesh screen = shapes::box({2, millimetre, 1.8}, shapes::BoxAt::corner)->mesh;
  for (glm::dvec3& p : screen.positions) p += low + glm::dvec3(-2.5, 0.3, 0.1);
  add_mesh(scene, "screen", std::move(screen), add_grey(scene, 0.8));
  return scene;
}

}  // namespace

TEST_CASE("walls of a millimetre keep light in and out in a building of a hundred metres") {
  const glm::dvec3 at(1000, -600, 30);
  for (const bool fog : {false, true}) {
    for (const bool inside : {false, true}) {
      INFO((fog ? "fog" : "clear air")
           << ", lamp " << (inside ? "in" : "beside") << " the cubicle");
      SceneDescription scene = hall(at);
      if (fog) add_homogeneous(scene, smoke(0.5, 0.95, 0.5));
      add_point(scene, at + (inside ? glm::dvec3(97.3, 77, 2) : glm::dvec3(95, 77, 2)), 1);
      // Two triangles per wall, four patches; the screen has twelve triangles, whose backs are
      // inside it.
      constexpr uint32_t inner = 4 * 6, outer = 4 * 12, screen = 4 * 18;
      BinSum dark{&TallyBlocks::patches, {}};
      for (uint32_t p = 0; p < 4 * 6; ++p) dark.bins.push_back((inside ? outer : inner) + p);
      for (uint32_t t = 0; t < 12; ++t) dark.bins.push_back(screen + 2 * t + 1);
      for (uint32_t p = 0; inside && p < 4 * 6; ++p) dark.bins.push_back(p);
      const Run run(std::move(scene), small(1 << 18), {dark});
      CHECK(run.sum(0).value == 0);
      CHECK(run.balance().escaped == 0);
      CHECK(run.into(inside ? "inner z1" : "screen").value > 0.1);
    }
  }
}

// ---- slivers -----------------------------------------------------------------------------------

namespace {

/// Strips a hundred-thousandth as wide as they are long, of two triangles each.
Mesh strips(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v, int count) {
  Mesh mesh;
  for (int i = 0; i <= count; ++i) {
    const glm::dvec3 across = (static_cast<double>(i) / count) * v;
    mesh.positions.push_back(corner + across);
    mesh.positions.push_back(corner + u + across);
    if (i == 0) continue;
    const auto k = static_cast<uint32_t>(2 * i);
    mesh.triangles.push_back({k - 2, k - 1, k + 1});
    mesh.triangles.push_back({k - 2, k + 1, k});
  }
  return mesh;
}

/// Triangles about one corner that cover an equal area, every other one a sliver.
Mesh fan(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v, int count) {
  Mesh mesh;
  mesh.positions.push_back(corner);
  for (int i = 0; i <= 4 * count; ++i) {
    const double along = (i / 2 + (i % 2 == 0 ? 0 : 1 - 1e-5)) / count;
    mesh.positions.push_back(along <= 1 ? corner + u + along * v : corner + v + (2 - along) * u);
    const auto k = static_cast<uint32_t>(i);
    if (i > 0) mesh.triangles.push_back({0, k, k + 1});
  }
  return mesh;
}

}  // namespace

TEST_CASE("walls of slivers reflect like whole ones and let nothing through") {
  constexpr int count = 100'000;
  const auto cube = [](int way) {
    SceneDescription scene;
    add_room(scene, {0, 0, 0}, {1, 1, 1}, 0.8);
    add_point(scene, {0.4, 0.5, 0.6}, 1);
    const std::vector<BoxFace> faces = faces_of_box({0, 0, 0}, {1, 1, 1});
    for (const size_t f : {4, 5}) {
      if (way == 1) scene.objects[f].mesh = strips(faces[f].corner, faces[f].u, faces[f].v, count);
      if (way == 2) scene.objects[f].mesh = fan(faces[f].corner, faces[f].u, faces[f].v, 50);
      scene.objects[f].one_patch = true;
    }
    return scene;
  };
  const Run whole(cube(0), small(1 << 18));
  for (const int way : {1, 2}) {
    INFO((way == 1 ? "strips" : "a fan"));
    const Run run(cube(way), small(1 << 18));
    CHECK(run.balance().escaped == 0);
    // Histories are equal except for those whose hits are kept off new edges.
    for (const BoxFace& f : faces_of_box({0, 0, 0}, {1, 1, 1})) {
      const Estimate found = run.into(f.name), expected = whole.into(f.name);
      INFO(f.name << ": " << found.value << " and " << expected.value << " +- "
                  << expected.standard_error);
      CHECK(expected.standard_error <= half_percent * expected.value);
      CHECK(std::abs(found.value - expected.value) <=
            0.3 * root_of_thrift * expected.standard_error);
    }
  }
}

// ---- narrow beams ------------------------------------------------------------------------------

namespace {

constexpr double hundredth_of_a_degree = 0.01;
constexpr double distance_m = 1000;

/// A spot that shines down a slope from a kilometre away, with its target.
SceneDescription spot_on(double inner_deg, Mesh target) {
  SceneDescription scene;
  const glm::dvec3 way = glm::normalize(glm::dvec3(2, 3, -6));
  Emitter& e = add_emitter(scene, EmitterShape::point, -distance_m * way, way, 1);
  e.distribution = Distribution::spot;
  e.spot_inner_deg = inner_deg;
  e.spot_outer_deg = hundredth_of_a_degree;
  const auto aimed = frame_aiming({0, 0, 0}, way);
  REQUIRE(aimed.ok());
  apply(as_transform(aimed.value()), target);
  add_mesh(scene, "target", std::move(target), add_grey(scene, 0));
  return scene;
}

}  // namespace

TEST_CASE("a small patch a kilometre away gets its share of a beam of a hundredth of a degree") {
  const double radius = distance_m * std::tan(glm::radians(hundredth_of_a_degree));
  constexpr double edge = 0.2;
  const Run even(spot_on(hundredth_of_a_degree,
                         shapes::quad({-edge / 2, -edge / 2, 0}, {edge, 0, 0}, {0, edge, 0})->mesh),
                 small(1 << 20));
  check_within(even.into("target"), edge * edge / (std::numbers::pi * radius * radius),
               half_percent, 1e-3);
  // With smooth fall-off, half of the angle holds the integral of 3 t^2 - 2 t^3 over [3/4, 1], out
  // of 1/2 over [0, 1], in a quarter of the solid angle.
  const double t = 0.75, share = 1 - 2 * (t * t * t - t * t * t * t / 2);
  const Run soft(spot_on(0, shapes::disc(radius / 2, 512)->mesh), small(1 << 20));
  check_within(soft.into("target"), share, half_percent, 1e-3);
}

TEST_CASE(
    "direct light of a beam of a hundredth of a degree is even, and ends where the beam does") {
  const double radius = distance_m * std::tan(glm::radians(hundredth_of_a_degree));
  const glm::dvec3 way = glm::normalize(glm::dvec3(2, 3, -6));
  const glm::dvec3 across = glm::normalize(glm::cross(way, glm::dvec3(0, 0, 1)));
  const Run run(spot_on(hundredth_of_a_degree, shapes::disc(2 * radius, 16)->mesh), small(1 << 16));
  const auto at = [&](double radii) { return run.direct_lx(radii * radius * across - way, -way); };
  REQUIRE(at(0) > 0);
  for (const double radii : {0.3, -0.5, 0.9, -0.97})
    CHECK(at(radii) == Approx(at(0)).epsilon(1e-4));
  for (const double radii : {1.03, -1.1, 1.5, -3.0}) CHECK(at(radii) == 0);
}

TEST_CASE("a beam of a millimetre hits its target a kilometre away, and nothing else") {
  for (const double part : {1.0, 0.5}) {
    SceneDescription scene;
    Emitter& e = add_rectangle(scene, {-distance_m, 0, 0}, {1, 0, 0}, 1e-3, 1e-3, 1);
    e.distribution = Distribution::collimated;
    add_quad(scene, "wall", {1, -50, -50}, {0, 100, 0}, {0, 0, 100}, add_grey(scene, 0));
    add_quad(scene, "target", {0, part == 1 ? -1e-3 : 0, -1e-3}, {0, 2e-3, 0}, {0, 0, 2e-3},
             add_grey(scene, 0));
    const Run run(std::move(scene), small(1 << 18));
    // Single precision places ray origins to 3e-5 m there, in a beam of a millimetre.
    check_near(run.into("target"), part, 1e-2, 0.03);
    CHECK(run.into("target").value + run.into("wall").value == Approx(1).epsilon(1e-9));
  }
}

}  // namespace luxodus::light
