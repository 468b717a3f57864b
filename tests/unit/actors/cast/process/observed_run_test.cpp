// What an observer sees of a run on nodes: its metrics over HTTP during the run, its memory plan
// before it.
#include <spdlog/spdlog.h>

#include <array>
#include <catch2/catch.hpp>

#include "actors/apps/deploy/cluster_status.hpp"
#include "actors/cast/node/node_plan.hpp"
#include "actors/cast/process/in_process.hpp"
#include "actors/cast/tally/flush_codec.hpp"
#include "runtime/observe/metrics_text.hpp"
#include "tests/kit/encode_flush.hpp"
#include "tests/unit/actors/cast/process/library_scene.hpp"
#include "topology/shipped.hpp"

using namespace luxodus;

namespace {

std::unique_ptr<Observation> watching() {
  ObserveOptions options;
  options.metrics_port = 0;
  auto seen = Observation::start(options);
  REQUIRE(seen.ok());
  return std::move(seen).value();
}

}  // namespace

TEST_CASE("during tracing the page shows what each node does", "[nodes][observe]") {
  spdlog::set_level(spdlog::level::err);
  const auto scene = scene_of("office_floor", "smoke_emergency", 64);
  const auto seen = watching();
  NodesOptions options;
  options.nodes = 2;
  options.fibers = 20;
  options.object_bytes = built_bytes_of(*scene) / 4;
  options.observation = seen.get();
  AskedProcess process{"here", {"127.0.0.1", seen->port().value()}, {"n0", "n1", "controller"}};
  std::atomic<bool> interrupt{false};
  std::vector<NodeStatus> rows;
  const auto complete = [&] {
    return rows.size() == 3 && rows[0].batches.value_or(0) > 0 && rows[1].batches.value_or(0) > 0 &&
           rows[2].state == NodeState::up;
  };
  LocalRun run(scene, 1, 1);
  StopRule endless;
  endless.particles = int64_t{1} << 40;
  const auto ended = run_on_nodes(run, options, endless, interrupt, [&](const Progress&) {
    rows = status_of({process}, ask({process}, seconds(30)));
    interrupt = complete();
  });
  REQUIRE(ended.ok());
  REQUIRE(complete());
  for (int worker : {0, 1}) {
    const NodeStatus& row = rows[static_cast<size_t>(worker)];
    CHECK(row.role == "worker");
    CHECK(row.state == NodeState::up);
    CHECK(row.fibers.value_or(0) >= 20);  // plus one that packs flushes
    CHECK(row.hit_rate.value_or(0) > 0.5);
    CHECK(row.resident_bytes.value_or(0) > 0);
    CHECK(row.resident_bytes.value_or(0) <= static_cast<double>(options.object_bytes));
    CHECK(row.credit_bytes.value_or(0) > 0);
  }
  CHECK(rows[2].role == "controller");
  bool by_hops = false;
  for (const MetricSample& sample : parse_metrics(seen->page()))
    by_hops = by_hops || (sample.name == "luxodus_fetch_delay_seconds_count" &&
                          sample.label("hops") == "1" && sample.value > 0);
  CHECK(by_hops);
}

TEST_CASE("the plan lists the memory of nodes, equal nodes once, and what they share",
          "[nodes][plan]") {
  const auto scene = scene_of("office_floor", "smoke_emergency", 64);
  LocalRun run(scene, 1, 1);
  NodesOptions options;
  options.nodes = 3;
  options.object_bytes = built_bytes_of(*scene) / 4;
  const auto plan = plan_on_nodes(run, options);
  REQUIRE(plan.ok());
  for (const char* part :
       {"process, shared", "geometry", "each of 3 nodes: n0, n1, n2", "fiber stacks", "timers",
        "frames on their way", "outboxes", "scores", "totals", "flush", "objects received",
        "table of objects", "histograms", "node controller", "flushes coming in"}) {
    INFO(part);
    CHECK(plan.value().find(part) != std::string::npos);
  }
}

TEST_CASE("no flush exceeds the plan's size of a flush", "[nodes][plan]") {
  const auto scene = scene_of("smoke_tank", "", 1);
  LocalRun run(scene, 1, 1);
  StopRule stop;
  stop.particles = 200'000;
  run.run(stop, std::atomic<bool>{false}, [](const Progress&) {});
  uint64_t planned = 0;
  const MemoryPlan plan = tally_plan(*scene, NodeSetup{});
  for (const MemoryPlan::Term& term : plan.terms())
    if (term.name == "flush") planned = term.bytes;
  const size_t packed = test::encode_flush(run.totals()).size();
  CHECK(packed > 0);
  CHECK(packed <= planned);
}

TEST_CASE("a budget that is too small is rejected with the key and the required value",
          "[nodes][plan]") {
  const auto scene = scene_of("smoke_tank", "", 1);
  AmpRequest request;
  request.nodes = 2;
  request.links = 2;
  const auto graph = minimum_path_graph(request);
  REQUIRE(graph.ok());
  const LocalRun local(scene, 1, 1);
  RunSetup run{*scene, &local.index(), nullptr, nullptr, 1, graph.value(), {"n0", "n1"}, nullptr};
  NodeSetup node;
  node.net.self = {1};
  const uint64_t needed =
      std::min(min_tally_bytes(*scene), tally_need(*scene, node.photons.batches_in_work()).all());
  node.tally_bytes = needed;
  CHECK(check_budget(run, node));
  CHECK(tally_plan(*scene, node).total_bytes() <= needed);
  node.tally_bytes = needed - 1;
  const auto fits = check_budget(run, node);
  REQUIRE_FALSE(fits);
  CHECK(fits.problem().what.find("node n1") == 0);
  CHECK(fits.problem().what.find("raise tally_bytes") != std::string::npos);

  const auto parts = scene_of("office_floor", "smoke_emergency", 8);
  const SceneObjects objects(*parts, std::array{NodeId{0}, NodeId{1}}, 1);
  RunSetup fetching{*parts, nullptr, nullptr, &objects, 1, graph.value(), {"n0", "n1"}, nullptr};
  NodeSetup small;
  small.net.self = {0};
  small.object_bytes = objects.largest_wire_bytes();
  const auto no_room = check_budget(fetching, small);
  REQUIRE_FALSE(no_room);
  CHECK(no_room.problem().what.find("raise object_bytes") != std::string::npos);
}
