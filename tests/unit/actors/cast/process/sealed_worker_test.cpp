// After its start a node's thread allocates nothing, whatever it traces, leads, holds, requests and
// sends; if it fetches cells, only for their bytes and the objects built from them.
#include <spdlog/spdlog.h>

#include <atomic>
#include <catch2/catch.hpp>

#include "actors/cast/process/in_process.hpp"
#include "runtime/observe/metrics_text.hpp"
#include "tests/kit/allocation_count.hpp"
#include "tests/unit/actors/cast/process/library_scene.hpp"

using namespace luxodus;

namespace {

uint64_t so_far() {
  return test::allocations_of_this_thread() - test::allocations_by_zmq();
}

/// Number of merged batches that the nodes of a process report.
double batches_shown(const Observation& seen) {
  double batches = 0;
  for (const MetricSample& sample : parse_metrics(seen.page()))
    if (sample.name == "luxodus_batches_total") batches += sample.value;
  return batches;
}

/// Allocations of a node's thread at the first and the last look.
struct Looked {
  uint64_t at_start = 0;
  uint64_t at_end = 0;
  int looks = 0;

  void look() {
    if (looks++ == 0) at_start = so_far();
    at_end = so_far();
  }
  uint64_t allocations() const { return at_end - at_start; }
};

struct Taken {
  uint64_t allocations = 0;  // without libzmq's messages
  WorkerReport report;       // of the whole run
};

/// Allocations of a run's only worker from its first batch on, over many rounds and flushes.
Taken taken_by_a_worker(const std::shared_ptr<const CompiledScene>& scene, NodesOptions options) {
  spdlog::set_level(spdlog::level::err);
  const auto seen = Observation::start({std::string("127.0.0.1"), uint16_t{0}, 0});
  REQUIRE(seen.ok());
  constexpr int max_looks = 300;  // 5 ms apart, or a turn
  std::atomic<bool> interrupt{false};
  bool started = false;
  uint64_t at_start = 0, at_end = 0;
  int looks = 0;
  options.nodes = 1;
  options.observation = seen.value().get();
  options.stop = [&] {  // on the worker's thread, between its turns
    if (!started) {
      started = batches_shown(*seen.value()) > 0;
      at_start = so_far();
    } else {
      at_end = so_far();
      if (++looks == max_looks) interrupt = true;
    }
    return false;
  };
  LocalRun run(scene, 1, 1);
  StopRule rounds;
  rounds.relative_error = 1e-9;
  NodesReport report;
  const auto ended = run_on_nodes(
      run, options, rounds, interrupt, [](const Progress&) {}, &report);
  REQUIRE(ended.ok());
  REQUIRE(looks >= max_looks);
  CHECK(report.flushes > 0);
  return {at_end - at_start, report.workers};
}

}  // namespace

TEST_CASE("a worker with its whole scene allocates nothing while it traces, flushes and publishes",
          "[nodes][seal]") {
  if (!test::allocations_are_counted()) {
    WARN("sanitizers have an allocator of their own: nothing is counted in this build");
    return;
  }
  NodesOptions options;
  options.fibers = 3;
  // An outbox slot grows once, for the longest list of leases sent through it.
  CHECK(taken_by_a_worker(scene_of("smoke_tank", "", 1), options).allocations <=
        defaults::outbox_messages);
}

TEST_CASE("a worker with a shard of the totals allocates nothing for the slices that it adds",
          "[nodes][seal]") {
  if (!test::allocations_are_counted()) return;
  NodesOptions options;
  options.fibers = 3;
  options.tally_shards = 2;  // the controller's, and its own
  CHECK(taken_by_a_worker(scene_of("smoke_tank", "", 1), options).allocations <=
        2 * defaults::outbox_messages);
}

TEST_CASE("a coordinator allocates nothing for the flushes that it counts", "[nodes][seal]") {
  if (!test::allocations_are_counted()) return;
  spdlog::set_level(spdlog::level::err);
  constexpr int warm = 8, looks = 30;  // a quarter of a second apart
  std::atomic<bool> interrupt{false};
  Looked looked;
  int seen = 0;
  LocalRun run(scene_of("smoke_tank", "", 1), 1, 1);
  StopRule rounds;
  rounds.relative_error = 1e-9;
  NodesOptions options;
  options.nodes = 2;
  options.fibers = 3;
  NodesReport report;
  const auto ended = run_on_nodes(
      run, options, rounds, interrupt,
      [&](const Progress&) {  // on the controller's thread
        if (++seen > warm) looked.look();
        if (looked.looks == looks) interrupt = true;
      },
      &report);
  REQUIRE(ended.ok());
  REQUIRE(looked.looks >= looks);
  REQUIRE(report.flushes > 4);
  INFO(looked.allocations() << " for " << report.flushes << " flushes, " << report.leases
                            << " leases");
  // Payload rooms grow stepwise to the longest flush of each worker. About sixty arrive.
  CHECK(looked.allocations() <= 16 + report.flushes / 4);
}

TEST_CASE("a worker that fetches allocates only for cells and objects built from them",
          "[nodes][seal]") {
  if (!test::allocations_are_counted()) return;
  const auto scene = scene_of("office_floor", "smoke_emergency", 64);
  NodesOptions options;
  options.fibers = 4;
  options.object_bytes = built_bytes_of(*scene) / 4;
  const Taken taken = taken_by_a_worker(scene, options);
  REQUIRE(taken.report.builds > 100);
  // The bytes, a cell's arrays, and the single allocations of Embree and its tasks.
  constexpr uint64_t of_a_cell = 200;
  INFO(taken.allocations << " for " << taken.report.builds << " builds");
  CHECK(taken.allocations < of_a_cell * taken.report.builds);
}
