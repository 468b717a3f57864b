// Boxes around flames, which lines that miss them need not look into.
#include "scenes/transport/flame_boxes.hpp"

#include <catch2/catch.hpp>

#include "runtime/core/random.hpp"
#include "scenes/optics/sampling.hpp"
#include "scenes/transport/compile.hpp"
#include "scenes/transport/resolver.hpp"
#include "tests/kit/described.hpp"

using namespace luxodus;

namespace {

const std::string two_flames = R"(
[[object]]
name = "room"
shape = "room"
low = [5, 5, 0]
high = [15, 12, 3]
material = "grey50"

[[medium]]
name = "cone of fire"
kind = "bounded"
body = "cone"
position = [7, 8, 0.5]
radius = 0.4
height = 1.2
extinction = 1
albedo = 0.2
emission = { power_w = 1000, temperature_k = 1400 }

[[medium]]
name = "column of fire"
kind = "bounded"
body = "cylinder"
position = [12, 10, 0.5]
radius = 0.5
height = 1
extinction = 1
albedo = 0.2
emission = { power_w = 1000, temperature_k = 1400 }
)";

}  // namespace

TEST_CASE("no line that meets a flame misses its box", "[transport]") {
  const auto d = test::described_text(two_flames);
  const auto scene = compile_scene(d, find_scenario(*d, "").value(), {}).value();
  EmbreeDevice device;
  const SceneIndex index(device, *scene);
  MergedResolver resolver(*scene, index);
  const std::vector<FlameBox> boxes = flame_boxes(*scene);
  REQUIRE(boxes.size() == 2);
  Random random(1, RandomStream::test);
  random.start(0);
  int met = 0, passed_by = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 size = scene->local_high - scene->local_low;
    const Vec3 part(random.uniform(), random.uniform(), random.uniform());
    const Real u = random.uniform(), v = random.uniform();
    Ray ray{scene->local_low + size * part, uniform_sphere(u, v)};
    if (i % 4 == 0) ray.direction = Vec3(i % 8 == 0 ? 1 : -1, 0, 0);  // along an axis
    const Real length = 6 * random.uniform();
    for (const FlameBox& box : boxes) {
      const int medium = static_cast<int>(scene->emitters[box.emitter].medium);
      bool meets = false;
      for_each_segment(scene->media, 0, ray.origin, ray.direction, length, resolver,
                       [&](const MediaSegment& s) {
                         for (const EmissionPart& e : s.emission) meets |= e.medium == medium;
                         return true;
                       });
      if (meets) REQUIRE(box.may_meet(ray, length));
      met += meets ? 1 : 0;
      passed_by += box.may_meet(ray, length) ? 0 : 1;
    }
  }
  CHECK(met > 300);
  CHECK(passed_by > 30'000);
}
