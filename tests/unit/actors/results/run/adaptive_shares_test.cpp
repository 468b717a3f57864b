// Two closed halls, each with a lamp: measurements in one of them need no light of the other.
#include "actors/results/run/adaptive_shares.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "actors/judge/validate/scene_kit.hpp"
#include "scenes/light/transport/compile.hpp"

using namespace luxodus;

namespace {

const std::atomic<bool> no_interrupt{false};
constexpr auto no_report = [](const Progress&) {};

SceneDescription two_halls(GroupRule groups) {
  SceneDescription d;
  const int white = light::add_grey(d, 0.7);
  for (const std::string name : {"left", "right"}) {
    const double x = name == "left" ? 0 : 10;
    for (const light::BoxFace& f : light::faces_of_box({x, 0, 0}, {x + 6, 6, 3}))
      light::add_quad(d, name + f.name, f.corner, f.u, f.v, white);
    light::add_point(d, {x + 2, 3, 2.5}, name == "left" ? 1 : 20).name = name;
    PlaneMeasure plane;
    plane.name = name;
    plane.corner = {x + 1, 1, 0.5};
    plane.edge_u = {4, 0, 0};
    plane.edge_v = {0, 4, 0};
    d.planes.push_back(plane);
  }
  d.run.groups = groups;
  d.run.batch_particles = 512;
  return d;
}

std::shared_ptr<const CompiledScene> compiled(const SceneDescription& d,
                                              const std::vector<std::string>& error_of,
                                              const std::vector<double>& shares = {}) {
  auto description = std::make_shared<const SceneDescription>(d);
  const auto scene =
      compile_scene(description, find_scenario(*description, "").value(), {1, error_of, shares});
  REQUIRE(scene.ok());
  return scene.value();
}

std::vector<double> found(const std::shared_ptr<const CompiledScene>& scene) {
  const auto shares = find_adaptive_shares(scene, 1, 1, no_interrupt, no_report);
  REQUIRE(shares.ok());
  double sum = 0;
  for (const double share : shares.value()) sum += share;
  CHECK(sum == Approx(1));
  return shares.value();
}

/// Indirect flux onto a plane after a number of batches.
Estimate onto_plane(const std::shared_ptr<const CompiledScene>& scene, uint32_t plane) {
  LocalRun run(scene, 1, 1);
  StopRule stop;
  stop.particles = 2000 * scene->batch_particles;
  run.run(stop, no_interrupt, no_report);
  return Readout(*scene, run.totals()).lumens(scene->blocks.planes, plane, 1);
}

}  // namespace

TEST_CASE("light that no measurement needs gets few batches, and the error falls accordingly",
          "[need]") {
  const SceneDescription halls = two_halls(GroupRule::by_emitter);
  const auto usual = compiled(halls, {"plane left"});
  const std::vector<double> shares = found(usual);
  CHECK(shares[0] > 0.85);
  CHECK(shares[1] > 0);  // its own light is reported as well
  const Estimate before = onto_plane(usual, 0);
  const Estimate after = onto_plane(compiled(halls, {"plane left"}, shares), 0);
  // A quarter of the batches before, and nearly all now.
  const double gain = std::pow(before.standard_error / after.standard_error, 2);
  CHECK(gain > 2.4);
  CHECK(gain < 5);
  const double both = std::hypot(before.standard_error, after.standard_error);
  CHECK(std::abs(before.value - after.value) < 4.5 * both);
}

TEST_CASE("if everything is measured, batches are allocated to minimise the largest error",
          "[need]") {
  const SceneDescription halls = two_halls(GroupRule::by_emitter);
  const auto usual = compiled(halls, {"planes"});
  const auto by_need = compiled(halls, {"planes"}, found(usual));
  const auto worst = [](const std::shared_ptr<const CompiledScene>& scene) {
    return std::max(onto_plane(scene, 0).relative_error(), onto_plane(scene, 1).relative_error());
  };
  // The usual half by lumens leaves the dim lamp a quarter; equal halls need equal batches.
  CHECK(by_need->batch_shares[0] == Approx(0.5).margin(0.15));
  CHECK(worst(by_need) < worst(usual));
}

TEST_CASE("the reason is reported if batches cannot be allocated adaptively", "[need]") {
  const auto problem = [](const std::shared_ptr<const CompiledScene>& scene) {
    const auto shares = find_adaptive_shares(scene, 1, 1, no_interrupt, no_report);
    return shares.ok() ? "" : shares.problem().what;
  };
  CHECK(problem(compiled(two_halls(GroupRule::one), {"planes"})).find("one source group") !=
        std::string::npos);
  SceneDescription bare = two_halls(GroupRule::by_emitter);
  bare.planes.clear();
  bare.probes.push_back({});
  CHECK(problem(compiled(bare, {"probes"})).find("--error-of") != std::string::npos);
  const std::atomic<bool> stopped{true};
  const auto scene = compiled(two_halls(GroupRule::by_emitter), {"planes"});
  CHECK_FALSE(find_adaptive_shares(scene, 1, 1, stopped, no_report).ok());
}

TEST_CASE("shares must match the scene's groups, and are part of its hash", "[need]") {
  const auto description =
      std::make_shared<const SceneDescription>(two_halls(GroupRule::by_emitter));
  const Scenario scenario = find_scenario(*description, "").value();
  CHECK_FALSE(compile_scene(description, scenario, {1, {}, {0.2, 0.3, 0.5}}).ok());
  const auto one = compile_scene(description, scenario, {1, {}, {0.2, 0.8}});
  const auto other = compile_scene(description, scenario, {1, {}, {0.3, 0.7}});
  CHECK(one.value()->scene_hash != other.value()->scene_hash);
  BatchPlan plan(*one.value());
  int of_first = 0;
  for (int i = 0; i < 100; ++i) of_first += plan.next().group == 0 ? 1 : 0;
  CHECK(of_first == 20);
}
