// Features that a scene does not need are neither in its loop nor in its tallies, and `luxodus
// check` reports it.
#include <catch2/catch.hpp>
#include <functional>

#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/scene_features.hpp"
#include "scenes/light/transport/trace.hpp"
#include "tests/optics/light_kit.hpp"

using namespace luxodus;
using namespace luxodus::light;

namespace {

SceneDescription plain_room() {
  SceneDescription scene;
  for (const BoxFace& f : faces_of_box({0, 0, 0}, {4, 3, 2.5}))
    add_quad(scene, f.name, f.corner, f.u, f.v, add_grey(scene, 0.5));
  add_rectangle(scene, {2, 1.5, 2.4}, {0, 0, -1}, 0.5, 0.5, 1);
  return scene;
}

std::shared_ptr<const CompiledScene> compiled(SceneDescription scene, const Scenario& scenario) {
  auto made =
      compile_scene(std::make_shared<const SceneDescription>(std::move(scene)), scenario, {});
  REQUIRE(made.ok());
  return made.value();
}

std::vector<std::string> names_of_those_on(const CompiledScene& scene) {
  std::vector<std::string> names;
  for (const SceneFeature& f : features_of(scene)) {
    INFO(f.name);
    CHECK_FALSE(f.why.empty());
    if (f.on) names.push_back(f.name);
  }
  return names;
}

/// A feature that is present but unused: its name, what adds it, and the scenario in which it is
/// unused.
struct Unused {
  const char* what;
  std::function<void(SceneDescription&)> add;
};

const std::vector<Unused>& unused_things() {
  static const std::vector<Unused> all = {
      {"smoke that the scenario takes away",
       [](SceneDescription& d) { add_homogeneous(d, smoke(0.5, 0.8)); }},
      {"a ball of it",
       [](SceneDescription& d) {
         add_ball(d, {2, 1, 1}, 0.5, smoke(0.5, 0.8));
       }},
      {"a glossy material on nothing",
       [](SceneDescription& d) { d.materials.emplace_back().kind = MaterialKind::glossy; }},
      {"a picture on nothing",
       [](SceneDescription& d) {
         d.materials.emplace_back().reflectance_image =
             std::make_shared<const Image>(Image{1, 1, 1, {0.5f}});
       }},
      {"many bands, all grey", [](SceneDescription& d) { d.run.max_bands = 8; }},
      {"groups by emitter, of one",
       [](SceneDescription& d) { d.run.groups = GroupRule::by_emitter; }},
      {"a lamp that is dark",
       [](SceneDescription& d) {
         add_rectangle(d, {1, 1, 2.4}, {0, 0, -1}, 0.5, 0.5, 0).emergency_flux = 1;
       }},
  };
  return all;
}

}  // namespace

TEST_CASE("unused features of a scene are neither in the loop nor in the tallies") {
  Scenario without_smoke;
  without_smoke.name = "no smoke";
  without_smoke.smoke_factor = 0;
  const auto plain = compiled(plain_room(), without_smoke);
  const auto on = names_of_those_on(*plain);
  CHECK(on == std::vector<std::string>{"low-discrepancy points"});
  for (const Unused& unused : unused_things()) {
    INFO(unused.what);
    SceneDescription scene = plain_room();
    unused.add(scene);
    const auto with = compiled(std::move(scene), without_smoke);
    CHECK(describe_kernel(*with) == describe_kernel(*plain));
    // A described medium keeps its two sums, absorbed and scattered, even if none of it is present.
    const auto sums = 2 * static_cast<int64_t>(with->description->media.size());
    CHECK(with->layout.scores() == plain->layout.scores() + sums);
    CHECK(with->layout.totals() == plain->layout.totals() + sums);
    CHECK(names_of_those_on(*with) == on);
  }
}

TEST_CASE("features that a scene uses are on, with their reason") {
  SceneDescription scene = plain_room();
  add_homogeneous(scene, smoke(0.5, 0.8));
  scene.materials[0].kind = MaterialKind::glossy;
  scene.materials[0].name = "varnish";
  add_layer_group(scene, 0, 1);
  const auto with = compiled(std::move(scene), Scenario{});
  CHECK(names_of_those_on(*with) ==
        std::vector<std::string>{"media", "surfaces other than Lambertian", "voxels",
                                 "scores along flights", "low-discrepancy points"});
  for (const SceneFeature& f : features_of(*with)) {
    if (f.name == "surfaces other than Lambertian") CHECK(f.why == "varnish");
    if (f.name == "scores along flights") CHECK(f.why == "1 volume group, voxels");
    if (f.name == "media") CHECK(f.why == "homogeneous: one extinction everywhere");
  }
}

TEST_CASE("a body of a luminaire is a feature of its own, and only if the luminaire is lit") {
  SceneDescription scene = plain_room();
  scene.objects.front().body = scene.emitters.front().body = 1;
  const auto lit = compiled(scene, Scenario{});
  CHECK(lit->features.bodies);
  CHECK_FALSE(lit->features.surfaces);
  scene.emitters.front().body = 0;
  add_rectangle(scene, {1, 1, 2.4}, {0, 0, -1}, 0.5, 0.5, 0).body = 1;
  CHECK_FALSE(compiled(scene, Scenario{})->features.bodies);
}
