// Changes without effect on results: a room's place, rotation, mirroring and scale, its
// triangulation, the order of its description, and the way a medium is described.
//
// With one seed, equivalent descriptions have equal histories up to rounding: directions follow
// from normals and random numbers alone, so the places of events stay as close to each other as
// single precision puts them, for any number of events. A few histories in 100 000 meet an edge
// within that distance and take another path. If the frames about normals rotate with the room,
// random numbers have another effect, and standard errors decide.
#include <algorithm>
#include <array>
#include <cmath>

#include "tests/optics/posed_room.hpp"

namespace luxodus::light {
namespace {

RunOptions of_seed(uint64_t seed, int64_t particles = 1 << 18) {
  RunOptions options;
  options.seed = seed;
  options.particles = particles;
  return options;
}

Pose tilted() {
  return {turned(), 1, glm::dvec3(0)};
}
Pose scaled(double scale) {
  return {turned(), scale, glm::dvec3(0)};
}
Pose far_away() {
  return {turned(), 1, {1e6, -1e6, 1e6}};
}
Pose in_a_mirror() {
  glm::dmat3 mirror(1.0);
  mirror[0].x = -1;
  return {mirror * turned(), 1, glm::dvec3(0)};
}

/// Particles where histories differ: surfaces are then accurate to 0.1 to 0.2 %.
constexpr int64_t for_chance = 1 << 20;

RoomRun traced(const Pose& pose) {
  return {posed_room(pose), pose, Level::with, of_seed(1)};
}

RoomRun traced_by_chance(SceneDescription scene, const Pose& pose, uint64_t seed) {
  return {std::move(scene), pose, Level::with, of_seed(seed, for_chance)};
}

RoomRun traced(SceneDescription scene) {
  return {std::move(scene), tilted(), Level::with, of_seed(1)};
}

}  // namespace

TEST_CASE("a room a million metres away is lit as at the origin, to the last history") {
  // At 1e6 m coordinates have steps of 1e-10 m, below single precision. Volumes keep theirs.
  check_same_values(traced(far_away()), traced(tilted()), 1e-8);
}

TEST_CASE("rooms of a millimetre and of sixteen kilometres are lit alike, to the last bit") {
  // Powers of two: rounding is unchanged.
  const RoomRun room = traced(tilted()), large = traced(scaled(0x1p12)),
                small = traced(scaled(0x1p-12));
  check_same_values(large, room, 0, false);
  check_same_values(small, room, 0, false);
  // Eye results are kept in quanta of their own; and the choice of lamps depends on squared
  // distances to which 1 mm2 is added.
  check_same_values(large, room, 1e-5);
  check_same_views(small, room);
}

TEST_CASE("rooms of a hand's width and of ten kilometres are lit alike") {
  const RoomRun room = traced(tilted());
  check_same_histories(traced(scaled(0.1 / 4)), room);
  check_same_histories(traced(scaled(1e4 / 4)), room);
}

TEST_CASE("objects and triangles in another order are lit alike") {
  SceneDescription other = posed_room(tilted());
  std::reverse(other.objects.begin(), other.objects.end());
  for (Object& o : other.objects) std::reverse(o.mesh.triangles.begin(), o.mesh.triangles.end());
  const RoomRun room = traced(tilted());
  // One ray in ten million hits an edge that two triangles share, and either is correct.
  check_same_histories(traced(other), room);
  // The order of emitters and media assigns random numbers: other histories.
  std::reverse(other.emitters.begin(), other.emitters.end());
  std::reverse(other.media.begin(), other.media.end());
  check_same_light(traced(std::move(other)),
                   RoomRun(posed_room(tilted()), tilted(), Level::with, of_seed(2)));
}

TEST_CASE("triangles cut into four, three times over, are lit alike") {
  SceneDescription other = posed_room(tilted());
  for (Object& o : other.objects) {
    for (int time = 0; time < 3; ++time) {
      Mesh cut;
      for (const glm::uvec3& t : o.mesh.triangles) {
        const glm::dvec3 a = o.mesh.positions[t.x], b = o.mesh.positions[t.y],
                         c = o.mesh.positions[t.z];
        const glm::dvec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
        for (const auto& part : {std::array{a, ab, ca}, std::array{ab, b, bc},
                                 std::array{ca, bc, c}, std::array{ab, bc, ca}}) {
          const auto first = static_cast<uint32_t>(cut.positions.size());
          cut.positions.insert(cut.positions.end(), part.begin(), part.end());
          cut.triangles.emplace_back(first, first + 1, first + 2);
        }
      }
      o.mesh = cut;
    }
  }
  check_same_histories(traced(std::move(other)), traced(tilted()));
}

TEST_CASE("a room that is turned is lit as before") {
  const Pose again{turned_again(), 1, glm::dvec3(0)};
  const auto run = [](const Pose& pose, uint64_t seed) {
    return RoomRun(posed_room(pose, Level::without), pose, Level::without,
                   of_seed(seed, for_chance));
  };
  check_same_light(run(again, 2), run(tilted(), 1));
}

TEST_CASE("a mirrored room is lit as before") {
  check_same_light(traced_by_chance(posed_room(in_a_mirror()), in_a_mirror(), 2),
                   traced_by_chance(posed_room(tilted()), tilted(), 1));
}

TEST_CASE("direct light is computed alike wherever a room stands, however large") {
  const auto check = [](const Pose& pose, Level level, bool signs, double relative) {
    const auto of = [&](const Pose& p) {
      SceneDescription scene = posed_room(p, level);
      if (!signs) scene.signs.clear();
      return direct_light_of(std::move(scene), p);
    };
    const std::vector<double> a = of(pose), b = of(tilted());
    for (size_t i = 0; i < a.size(); ++i) {
      INFO("point " << i / 2 << ", normal " << i % 2 << ": " << a[i] << " lx and " << b[i]);
      CHECK(std::abs(a[i] - b[i]) <= relative * b[i]);
    }
  };
  check(far_away(), Level::with, true, 1e-8);
  check(scaled(0x1p12), Level::with, true, 0);
  check(scaled(0x1p-12), Level::with, true, 0);
  check(scaled(0.1 / 4), Level::with, true, 1e-4);
  check(scaled(1e4 / 4), Level::with, true, 1e-4);
  check({turned_again(), 1, glm::dvec3(0)}, Level::without, true, 1e-4);
  // The points that represent a sign are not symmetric under reflection.
  check(in_a_mirror(), Level::with, false, 1e-4);
}

TEST_CASE("one medium described in eight ways is one medium") {
  // All extend beyond the room, which is closed, 4 x 3 x 2.5 m and tilted. The extinction is exact
  // in single precision, in which cells keep it. A flight takes the same random numbers for each
  // kind of medium: equal histories by four loops.
  const SmokeOptics optics = smoke(0.625, 0.7, 0.6), half = smoke(0.3125, 0.7, 0.6);
  const std::vector<glm::dvec2> around = {{-9, -8}, {9, -9}, {8, 9}, {0, 7.5}, {-8, 8}};
  using Add = std::function<void(SceneDescription&)>;
  const std::vector<std::pair<std::string, Add>> ways = {
      {"all-pervading", [&](SceneDescription& s) { add_homogeneous(s, optics); }},
      {"one layer", [&](SceneDescription& s) { add_layers(s, -8, {16}, {optics}); }},
      {"sixteen layers",
       [&](SceneDescription& s) {
         add_layers(s, -8, std::vector<double>(16, 1.0), std::vector<SmokeOptics>(16, optics));
       }},
      {"a large ball",
       [&](SceneDescription& s) {
         add_ball(s, {1, 1, 1}, 20, optics);
       }},
      {"cells",
       [&](SceneDescription& s) {
         add_cells(
             s, {-8, -8, -8}, {16, 16, 16}, 20, [](const glm::dvec3&) { return 0.625; }, 0.7, 0.6);
       }},
      {"a prism",
       [&](SceneDescription& s) {
         add_homogeneous(s, optics).footprint = {around, -8, 8};
       }},
      {"a prism of layers",
       [&](SceneDescription& s) {
         add_layers(s, -8, std::vector<double>(16, 1.0), std::vector<SmokeOptics>(16, optics))
             .footprint = {around, -8, 8};
       }},
      {"two halves over one another", [&](SceneDescription& s) {
         add_homogeneous(s, half);
         add_layers(s, -8, {16}, {half});
       }}};
  const auto run = [&](const Add& add) {
    SceneDescription scene = posed_room(tilted());
    close_opening(scene, tilted());
    scene.media.clear();
    add(scene);
    return traced(std::move(scene));
  };
  const RoomRun first = run(ways.front().second);
  for (size_t i = 1; i < ways.size(); ++i) {
    INFO(ways[i].first);
    check_same_values(run(ways[i].second), first, 1e-6);
  }
}

}  // namespace luxodus::light
