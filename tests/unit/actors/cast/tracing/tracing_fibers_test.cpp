// Photon-threads let others run by the work they have done: a particle of a near-white room may
// have a million rays. A tracer that only counts plays the long histories. The totals that they
// hand over hold the batches of reported leases and no other, whenever they are taken.
#include "actors/cast/tracing/tracing_fibers.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <utility>

#include "actors/results/run/particle_portion.hpp"
#include "tests/kit/encode_flush.hpp"
#include "tests/kit/lone_actor.hpp"
#include "tests/unit/actors/cast/process/library_scene.hpp"
#include "tests/unit/actors/cast/tracing/noted_port.hpp"

using namespace luxodus;

namespace {

/// What all tracers have counted, and the most of it between two runs of another fiber.
struct Work {
  uint64_t rays = 0, paths = 0;
  uint64_t most_rays = 0, most_paths = 0;
};

struct CountingTracer final : BatchTracer {
  CountingTracer(Work& of, uint64_t each) : work(of), rays_of_particle(each) {}
  void trace(int, uint64_t, int64_t count, BatchScores& scores) override {
    const uint64_t rays = static_cast<uint64_t>(count) * rays_of_particle;
    scores.balance.particles += static_cast<uint64_t>(count);
    scores.balance.rays += rays;
    work.rays += rays;
  }
  uint32_t look_units() const override { return 1; }
  void look(int64_t, uint32_t, BatchScores&) override {
    for (int path = 0; path < 1000; ++path) {
      ++work.paths;
      rest();
    }
  }
  void rest_between_paths(std::function<void()> to_call) override { rest = std::move(to_call); }

  Work& work;
  const uint64_t rays_of_particle;
  std::function<void()> rest;
};

/// Traces two batches on some photon-threads, beside a fiber that is always ready.
Work traced(size_t fibers, uint64_t rays_of_particle) {
  const auto scene = scene_of("empty_room", "", 1);
  test::LoneNode node;
  Work work;
  test::NotedPort port;
  PhotonConfig config;
  config.fibers = fibers;
  TracingFibers tracing(*scene, GeometryAccess{}, 1, config, node.scheduler, port,
                        [&](const CompiledScene&, const GeometryAccess&, uint64_t) {
                          return std::make_unique<CountingTracer>(work, rays_of_particle);
                        });
  const auto watch = [&] {
    Work last;
    do {
      work.most_rays = std::max(work.most_rays, work.rays - last.rays);
      work.most_paths = std::max(work.most_paths, work.paths - last.paths);
      last = work;
    } while (node.scheduler.fibers().yield() != Wake::cancelled);
  };
  REQUIRE(node.scheduler.fibers().start("watch", watch));
  tracing.start();
  tracing.add(7, 0);
  tracing.add(8, 1);
  while (port.done.size() < 2) node.scheduler.turn();
  const auto particles = 2 * static_cast<uint64_t>(scene->batch_particles);
  CHECK(tracing.counters().particles == particles);
  CHECK(tracing.counters().rays == particles * rays_of_particle);
  node.end_fibers();
  return work;
}

}  // namespace

TEST_CASE("photon-threads let others run after a bounded number of rays and of paths from eyes",
          "[tracing]") {
  for (const size_t fibers : {1, 3}) {
    INFO(fibers << " fibers");
    const Work white = traced(fibers, 1'000'000);
    CHECK(white.most_rays <= fibers * 1'000'000);
    CHECK(white.most_paths <= fibers * 8);
    // Portions of usual rooms stay whole.
    const Work usual = traced(fibers, 10);
    CHECK(usual.most_rays >= 1000);
    CHECK(usual.most_rays <= fibers * limits::rays_per_portion);
  }
}

TEST_CASE("totals hold the batches of the reported leases, whenever they may be taken",
          "[tracing]") {
  const auto scene = fine_tank();
  const size_t in_work = GENERATE(1u, 2u);
  INFO(in_work << " batches in work at once");
  test::LoneNode node;
  Work work;
  test::NotedPort port;
  PhotonConfig config;
  config.fibers = 3;
  config.open_batches = in_work;
  TracingFibers tracing(*scene, GeometryAccess{}, 1, config, node.scheduler, port,
                        [&](const CompiledScene&, const GeometryAccess&, uint64_t) {
                          return std::make_unique<CountingTracer>(work, 1);
                        });
  tracing.start();
  constexpr size_t batches = 6;
  for (size_t i = 0; i < batches; ++i) tracing.add(10 + i, static_cast<int64_t>(i));
  size_t reported = 0, taken = 0;
  // A flush may take the totals at any time that they may be given: here, at every one.
  const auto take = [&] {
    if (!tracing.may_give()) return;
    const size_t now = port.done.size() - std::exchange(reported, port.done.size());
    const auto gain = decode_flush(test::encode_flush(tracing.give_totals()),
                                   static_cast<int>(scene->groups.size()), scene->layout.totals());
    REQUIRE(gain.ok());
    CHECK(gain->batches() == static_cast<int64_t>(now));
    taken += now;
  };
  const auto watch = [&] {
    do take();
    while (node.scheduler.fibers().yield() != Wake::cancelled);
  };
  REQUIRE(node.scheduler.fibers().start("watch", watch));
  while (taken < batches) node.scheduler.turn();
  CHECK(taken == batches);
  node.end_fibers();
}
