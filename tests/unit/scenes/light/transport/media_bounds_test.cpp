#include "scenes/light/transport/media_bounds.hpp"

#include <catch2/catch.hpp>
#include <vector>

using namespace luxodus;

namespace {

const Bounds scene_bounds{{0, 0, 0}, {10, 8, 3}};

Bounds bounds_of(const std::vector<Medium>& media) {
  std::vector<const Medium*> list;
  for (const Medium& m : media) list.push_back(&m);
  return media_bounds(list, scene_bounds);
}

void check_box(const Bounds& box, const glm::dvec3& low, const glm::dvec3& high) {
  for (int a = 0; a < 3; ++a) {
    CHECK(box.low[a] == Approx(low[a]).margin(1e-12));
    CHECK(box.high[a] == Approx(high[a]).margin(1e-12));
  }
}

Medium everywhere() {
  Medium m;
  m.optics.extinction.sigma_t = 1;
  return m;
}

Medium layers(const std::vector<glm::dvec3>& low_high_sigma) {
  Medium m;
  m.kind = MediumKind::layered;
  for (const glm::dvec3& l : low_high_sigma) {
    SmokeOptics optics;
    optics.extinction.sigma_t = l.z;
    m.layers.push_back({l.x, l.y, optics});
  }
  return m;
}

Medium ball(const glm::dvec3& centre, double radius) {
  Medium m;
  m.kind = MediumKind::bounded;
  m.frame.origin = centre;
  m.local_bounds = {glm::dvec3(-radius), glm::dvec3(radius)};
  return m;
}

}  // namespace

TEST_CASE("a medium without bounds has the bounds of the scene") {
  check_box(bounds_of({everywhere()}), scene_bounds.low, scene_bounds.high);
  check_box(bounds_of({ball({5, 4, 1}, 1), everywhere()}), scene_bounds.low, scene_bounds.high);
}

TEST_CASE("layers are bounded by their extinction, their footprint and the scene") {
  const Medium smoke = layers({{0, 1, 0}, {1.5, 2, 0.3}, {2, 5, 1}});
  check_box(bounds_of({smoke}), {0, 0, 1.5}, {10, 8, 3});
  Medium in_a_room = smoke;
  in_a_room.footprint.polygon = {{2, -1}, {6, -1}, {6, 5}, {2, 5}};
  check_box(bounds_of({in_a_room}), {2, 0, 1.5}, {6, 5, 3});
}

TEST_CASE("a body and a data set have the bounds of their boxes, turned and together") {
  check_box(bounds_of({ball({5, 4, 1}, 1.5)}), {3.5, 2.5, 0}, {6.5, 5.5, 2.5});
  Medium data;
  data.kind = MediumKind::data_set;
  data.data.extent = {2, 1, 1};
  data.frame.origin = {9, 1, 0.5};
  data.frame.axes = glm::dmat3({0, 1, 0}, {-1, 0, 0}, {0, 0, 1});  // rotated by 90 degrees about z
  check_box(bounds_of({data}), {8, 1, 0.5}, {9, 3, 1.5});
  check_box(bounds_of({data, ball({5, 4, 1}, 0.5)}), {4.5, 1, 0.5}, {9, 4.5, 1.5});
}

TEST_CASE("media outside the scene, or none, have empty bounds") {
  CHECK(bounds_of({}).empty());
  CHECK(bounds_of({ball({50, 4, 1}, 1)}).empty());
  CHECK(bounds_of({layers({{4, 5, 1}})}).empty());
}
