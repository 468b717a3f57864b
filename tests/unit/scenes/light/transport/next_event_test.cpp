// Next-event estimation, combined with hits of emitters.
#include "scenes/light/transport/next_event.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "tests/kit/room_texts.hpp"
#include "tests/unit/scenes/light/transport/seen_scene.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

const std::string smoky_room_with_panel = white_room("[4, 4, 3]") + R"(
[[emitter]]
name = "panel"
shape = "rectangle"
distribution = "lambertian"
position = [2, 2, 2.9]
direction = [0, 0, -1]
size = [1, 1]
flux_lm = 1000
[[medium]]
name = "smoke"
kind = "homogeneous"
extinction = 1
albedo = 0.6
)";

}  // namespace

TEST_CASE("hits of an emitter weigh more the nearer it is, and wholly on its face", "[transport]") {
  SeenScene seen(smoky_room_with_panel);
  Random random(1, RandomStream::test);
  random.start(0);
  NextEvent next_event(*seen.scene, seen.resolver, random, false, nullptr);
  const PathBands band = PathBands::one(0);
  const Vec3 panel = seen.at(2, 2, 2.9);
  // A path scatters in the smoke at some distance below the panel, and then meets it.
  const auto weight_at = [&](Real distance_m, double apparent_sr) {
    ScatteringVertex vertex;
    vertex.place = panel - Vec3(0, 0, distance_m);
    vertex.pdf = 0.08;
    vertex.in_medium = true;
    vertex.segment = {{seen.at(2, 2, 0.5), Vec3(0, 0, 1)}, 2.4_r, 1, band};
    vertex.t = 2.4_r - distance_m;
    return next_event.weight_of_hit(vertex, 0, panel, apparent_sr, band);
  };
  const double far = weight_at(2, 0.25), near = weight_at(0.01_r, 1e4);
  CHECK(far > 0);
  CHECK(far < near);
  CHECK(near < 1);
  CHECK(weight_at(0, std::numeric_limits<double>::infinity()) == 1);
  CHECK(weight_at(2, 0) == 0);
}
