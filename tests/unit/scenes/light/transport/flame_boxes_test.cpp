// Bounding boxes of flames, which let lines skip the media.
#include "scenes/light/transport/flame_boxes.hpp"

#include <catch2/catch.hpp>
#include <memory>
#include <string>
#include <vector>

#include "runtime/core/random.hpp"
#include "scenes/light/optics/sampling.hpp"
#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/resolver.hpp"
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

/// Adds a third flame: cells of a fire, rotated about two axes, away from the origin.
std::shared_ptr<const SceneDescription> three_flames() {
  auto out = std::make_shared<SceneDescription>(*test::described_text(two_flames));
  Medium cells = out->media.front();
  cells.name = "cells of fire";
  cells.kind = MediumKind::data_set;
  cells.data.nx = cells.data.ny = cells.data.nz = 2;
  cells.data.extent = {1.2, 0.5, 1.6};
  cells.data.extinction = {1, 2, 0, 1, 1, 1, 2, 1};
  cells.data.emission = {1, 2, 0, 1, 3, 1, 1, 2};
  cells.frame.origin = {9.5, 6.5, 0.8};
  const glm::dmat3 about_z({0.8, 0.6, 0}, {-0.6, 0.8, 0}, {0, 0, 1});
  const glm::dmat3 about_x({1, 0, 0}, {0, 0.8, 0.6}, {0, -0.6, 0.8});
  cells.frame.axes = about_z * about_x;
  out->media.push_back(std::move(cells));
  return out;
}

}  // namespace

TEST_CASE("every line that meets a flame meets its box", "[transport]") {
  const auto d = three_flames();
  const auto scene = compile_scene(d, find_scenario(*d, "").value(), {}).value();
  EmbreeDevice device;
  const SceneIndex index(device, *scene);
  MergedResolver resolver(*scene, index);
  const std::vector<FlameBox> boxes = flame_boxes(*scene);
  REQUIRE(boxes.size() == 3);
  Random random(1, RandomStream::test);
  random.start(0);
  std::vector<int> met(boxes.size(), 0), passed_by(boxes.size(), 0);
  for (int i = 0; i < 60'000; ++i) {
    const Vec3 size = scene->local_high - scene->local_low;
    const Vec3 part(random.uniform(), random.uniform(), random.uniform());
    const Real u = random.uniform(), v = random.uniform();
    Ray ray{scene->local_low + size * part, uniform_sphere(u, v)};
    if (i % 4 == 0) ray.direction = Vec3(i % 8 == 0 ? 1 : -1, 0, 0);  // along an axis
    const Real length = 6 * random.uniform();
    for (size_t k = 0; k < boxes.size(); ++k) {
      const FlameBox& box = boxes[k];
      const int medium = static_cast<int>(scene->emitters[box.emitter].medium);
      bool meets = false;
      for_each_segment(scene->media, 0, ray.origin, ray.direction, length, resolver,
                       [&](const MediaSegment& s) {
                         for (const EmissionPart& e : s.emission) meets |= e.medium == medium;
                         return true;
                       });
      if (meets) REQUIRE(box.may_meet(ray, length));
      met[k] += meets ? 1 : 0;
      passed_by[k] += box.may_meet(ray, length) ? 0 : 1;
    }
  }
  for (size_t k = 0; k < boxes.size(); ++k) {
    INFO(d->media[scene->emitters[boxes[k].emitter].medium].name);
    CHECK(met[k] > 200);
    CHECK(passed_by[k] > 50'000);
  }
}
