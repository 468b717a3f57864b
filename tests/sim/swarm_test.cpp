// Runs under faults drawn from seeds: 50 seeds in every test run and 200 in full, each twice, and
// those that once found a bug (tests/sim/seeds). More: `luxodus sim SCENE --seeds 0..10000`.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "actors/cast/names/role.hpp"
#include "actors/lab/simulate/simulation.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/kit/test_length.hpp"

using namespace luxodus;

namespace {

constexpr int64_t particles = 2000;
constexpr int64_t batches = 40;
constexpr int cells = 16;

SimScene scene_of(const std::string& name, int64_t traced = particles,
                  int64_t of_a_batch = particles / batches) {
  spdlog::set_level(spdlog::level::off);
  auto read = read_scene(std::string(LUX_SOURCE_DIR) + "/scenes/library/" + name + ".toml");
  REQUIRE(read.scene);
  auto description = std::make_shared<SceneDescription>(std::move(*read.scene));
  description->run.batch_particles = of_a_batch;
  const auto scenario = find_scenario(*description, "");
  REQUIRE(scenario.ok());
  auto scene = compile_scene(description, scenario.value(), {cells});
  REQUIRE(scene.ok());
  return {scene.value(), 1, traced};
}

SimOptions options_of(uint64_t seed, int nodes) {
  SimOptions options;
  options.seed = seed;
  options.nodes = nodes;
  options.work = seconds(30);
  options.faults_last = seconds(15);
  return options;
}

/// Runs it twice; returns the report of the first.
SimReport checked(const SimScene& scene, const std::string& name, const SimOptions& options) {
  const auto once = simulate(scene, options);
  const auto twice = simulate(scene, options);
  REQUIRE(once.ok());
  REQUIRE(twice.ok());
  INFO("luxodus sim scenes/library/"
       << name << ".toml --seed " << options.seed << " --nodes " << options.nodes << " --particles "
       << particles << " --work " << options.work / seconds(1) << "s --faults-last "
       << options.faults_last / seconds(1) << "s --fan-out " << options.fan_out);
  CHECK(once->failure == "");
  CHECK(once->trace_hash == twice->trace_hash);
  return once.value();
}

/// Two workers and a controller, on links without other faults.
SimOptions small_run() {
  SimOptions options = options_of(1, 2);
  options.draw_nodes = false;
  options.faults = false;
  options.work = seconds(1);
  options.plan.emplace();
  options.plan->links.delay = microseconds(50);
  return options;
}

/// Total of the faults over several seeds.
struct Trouble {
  uint64_t crashes = 0, lost = 0, harmed = 0, fenced = 0, fetches = 0, rare_ways = 0, snapshots = 0;
  void add(const SimReport& report) {
    crashes += report.world.crashes;
    lost += report.world.lost;
    harmed += report.world.corrupted;
    fenced += report.leases_fenced;
    fetches += report.caches.fetches;
    rare_ways += report.rare_ways;
    snapshots += report.snapshots;
  }
};

void check_swarm(uint64_t part) {
  const SimScene scene = scene_of("empty_room");
  Trouble all;
  for (uint64_t seed = 25 * part; seed < 25 * (part + 1); ++seed)
    all.add(checked(scene, "empty_room", options_of(seed, 2 + static_cast<int>(seed % 5))));
  // The faults did happen.
  CHECK(all.crashes > 0);
  CHECK(all.lost > 100);
  CHECK(all.harmed > 0);
  CHECK(all.fenced > 0);
  CHECK(all.fetches > 0);
  CHECK(all.rare_ways > 1000);
  CHECK(all.snapshots > 0);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("swarms of faults change no bit, and a seed is one run", "[sim]",
                       ((uint64_t part), part), 0, 1) {
  check_swarm(part);
}
TEMPLATE_TEST_CASE_SIG("more swarms of faults change no bit, and a seed is one run",
                       "[sim][.][long]", ((uint64_t part), part), 2, 3, 4, 5, 6, 7) {
  check_swarm(part);
}

TEST_CASE("swarms change no bit of a run in smoke", "[sim]") {
  const SimScene scene = scene_of("smoke_tank");
  const uint64_t seeds = test::in_full() ? 5 : 2;
  for (uint64_t seed = 1000; seed < 1000 + seeds; ++seed)
    checked(scene, "smoke_tank", options_of(seed, 3));
}

TEST_CASE("swarms change no bit of a run on 32 nodes", "[sim]") {
  const SimScene scene = scene_of("empty_room");
  const uint64_t seeds = test::in_full() ? 2 : 1;
  for (uint64_t seed = 2000; seed < 2000 + seeds; ++seed) {
    SimOptions options = options_of(seed, 32);
    options.work = seconds(240);
    checked(scene, "empty_room", options);
  }
}

// Two and three levels, whose coordinators crash, pause and are cut off like all other nodes.
TEST_CASE("swarms change no bit of a run with coordinators of coordinators", "[sim][levels]") {
  const SimScene scene = scene_of("empty_room");
  Trouble all;
  const uint64_t seeds = test::in_full() ? 40 : 8;
  for (uint64_t seed = 3000; seed < 3000 + seeds; ++seed) {
    SimOptions options = options_of(seed, 7 + static_cast<int>(seed % 4) * 6);
    options.fan_out = 3;
    options.work = seconds(60);
    all.add(checked(scene, "empty_room", options));
  }
  CHECK(all.crashes > 0);
  CHECK(all.rare_ways > 1000);
}

TEST_CASE("without faults nothing is lost, leased again or refused", "[sim]") {
  const SimScene scene = scene_of("empty_room");
  SimOptions options = options_of(1, 4);
  options.faults = false;
  options.draw_nodes = false;
  const SimReport report = checked(scene, "empty_room", options);
  CHECK(report.leases == batches);
  CHECK(report.leases_fenced == 0);
  CHECK(report.flushes_refused == 0);
  CHECK(report.world.crashes == 0);
  CHECK(report.rare_ways == 0);
}

// Systematic: the small run is repeated with a single fault at every possible place.
TEST_CASE("a small run survives the loss of any one of its frames", "[sim]") {
  const SimScene scene = scene_of("empty_room", particles / 5);
  const SimOptions options = small_run();
  const uint64_t frames = simulate(scene, options).value().world.frames;
  REQUIRE(frames > 50);
  for (uint64_t frame = 0; frame < frames; ++frame) {
    SimOptions one = options;
    one.plan->lost_frame = frame;
    const auto report = simulate(scene, one);
    INFO("frame " << frame << " of " << frames << " is lost");
    REQUIRE(report.ok());
    REQUIRE(report->failure == "");
    REQUIRE(report->world.lost >= 1);
  }
}

TEMPLATE_TEST_CASE_SIG("a small run bears the crash of any node after any event", "[sim]",
                       ((uint16_t node), node), 0, 1, 2) {
  const SimScene scene = scene_of("empty_room", particles / 5);
  const SimOptions options = small_run();
  const uint64_t events = simulate(scene, options).value().world.events;
  REQUIRE(events > 300);
  for (uint64_t event = 1; event < events; ++event) {
    SimOptions one = options;
    Fault crash;
    crash.node = {node};
    crash.lasts = milliseconds(700);
    crash.after_events = event;
    one.plan->faults.push_back(crash);
    const auto report = simulate(scene, one);
    INFO("node " << node << " crashes after event " << event << " of " << events);
    REQUIRE(report.ok());
    REQUIRE(report->failure == "");
  }
}

TEST_CASE("a controller with a full disk that crashes continues from a snapshot", "[sim]") {
  const SimScene scene = scene_of("empty_room");
  SimOptions options = small_run();
  options.work = seconds(60);
  const NodeId controller{2};
  // Right after the journal's header no flush finds space any more.
  options.plan->faults.push_back({Fault::Kind::full_disk, 1, seconds(60), controller, {}});
  const SimReport whole = simulate(scene, options).value();
  CHECK(whole.failure == "");
  CHECK(whole.snapshots >= 2);  // one every 10 s
  Fault crash;
  crash.node = controller;
  crash.lasts = milliseconds(700);
  crash.after_events = whole.world.events * 3 / 4;
  options.plan->faults.push_back(crash);
  const SimReport begun_anew = simulate(scene, options).value();
  CHECK(begun_anew.failure == "");
  CHECK(begun_anew.world.crashes == 1);
  CHECK(begun_anew.recovered > 0);
}

// Their node leaves; others trace its batches, and serve the parts that it held.
TEST_CASE("a failed actor of a worker takes down its node, and the others give the same bits",
          "[sim][supervision]") {
  const SimScene scene = scene_of("office_floor");
  for (const char* actor : {"tracer", "part_server"}) {
    INFO(actor);
    SimOptions options = small_run();
    options.nodes = 3;
    options.work = seconds(30);
    options.patience = seconds(20);
    options.fixed.object_bytes = 1 << 20;
    options.fixed.replicas = 2;
    Fault failure;
    failure.kind = Fault::Kind::failure;
    failure.at = seconds(3);
    failure.lasts = 1;
    failure.node = {1};
    failure.actor = actor;
    options.plan->faults.push_back(failure);
    const SimReport report = simulate(scene, options).value();
    CHECK(report.failure == "");
    CHECK(report.leases_fenced > 0);
    CHECK(role_name(report.caches.failed) == std::string(actor));
  }
}

TEST_CASE("a display that fails in the middle of a run restarts, and keeps the same flux",
          "[sim][supervision]") {
  const SimScene scene = scene_of("empty_room");
  for (const NodeId node : {NodeId{0}, NodeId{2}}) {  // a worker, and the controller
    SimOptions options = small_run();
    options.work = seconds(20);
    options.fixed.display_node = node;
    for (const Nanoseconds at : {seconds(2), seconds(5), seconds(10)}) {
      Fault failure;
      failure.kind = Fault::Kind::failure;
      failure.at = at;
      failure.lasts = 1;
      failure.node = node;
      failure.actor = "display";
      options.plan->faults.push_back(failure);
    }
    CHECK(simulate(scene, options).value().failure == "");
  }
}

// Hundreds of leases are late when one frame of their flush is lost. Separate messages about each
// of them once left no room for the answer to the flush, so that the next was late as well, and so
// on.
TEST_CASE("a lost frame of a flush of many leases costs only the leases of that time", "[sim]") {
  constexpr int64_t traced = 4000;
  const SimScene scene = scene_of("empty_room", traced, 2);
  SimOptions options = small_run();
  options.fixed.lease_time = seconds(2);
  options.work = seconds(40);
  const SimReport whole = simulate(scene, options).value();
  REQUIRE(whole.flushes_refused == 0);
  uint64_t max_fenced = 0, max_refused = 0;
  for (uint64_t frame = 0; frame < whole.world.frames; frame += 40) {
    SimOptions one = options;
    one.plan->lost_frame = frame;
    const SimReport report = simulate(scene, one).value();
    REQUIRE(report.failure == "");
    max_fenced = std::max(max_fenced, report.leases_fenced);
    max_refused = std::max(max_refused, report.flushes_refused);
  }
  CHECK(max_fenced > NetConfig{}.outbox_messages);  // some frame belonged to such a flush
  CHECK(max_refused <= 2);
}

// A node that leads others may crash after any event: what it had merged is traced again, once.
TEST_CASE("a run of two levels survives the crash of a coordinator after any event",
          "[sim][levels]") {
  const SimScene scene = scene_of("empty_room", particles / 5);
  SimOptions options = small_run();
  options.nodes = 5;
  options.fan_out = 3;
  const uint64_t events = simulate(scene, options).value().world.events;
  REQUIRE(events > 300);
  // The first vertex leads some of the others: topology/coordination_tree.hpp.
  const uint64_t step = test::in_full() ? 1 : 5;
  for (uint64_t event = 1; event < events; event += step) {
    for (const uint16_t node : {uint16_t{0}, uint16_t{1}}) {
      SimOptions one = options;
      Fault crash;
      crash.node = {node};
      crash.lasts = milliseconds(700);
      crash.after_events = event;
      one.plan->faults.push_back(crash);
      const auto report = simulate(scene, one);
      INFO("node " << node << " crashes after event " << event << " of " << events);
      REQUIRE(report.ok());
      REQUIRE(report->failure == "");
    }
  }
}

// The other workers were told long ago that there is no more work: they must be told when there is
// again. They once asked by themselves, every 2 s.
TEST_CASE("a lost worker costs its leases and their work, and no further waiting", "[sim]") {
  const SimScene scene = scene_of("empty_room");
  SimOptions options = options_of(1, 4);
  options.draw_nodes = false;
  options.faults = false;
  options.work = seconds(4);
  options.plan.emplace();
  options.plan->links.delay = microseconds(50);
  for (const Nanoseconds lease_time : {seconds(4), seconds(5), seconds(6)}) {
    options.fixed.lease_time = lease_time;
    options.plan->faults.clear();
    const SimReport whole = simulate(scene, options).value();
    REQUIRE(whole.failure == "");
    Fault crash;
    crash.node = NodeId{1};
    crash.lasts = seconds(100);
    crash.after_events = whole.world.events / 4;
    options.plan->faults.push_back(crash);
    const SimReport lost = simulate(scene, options).value();
    CHECK(lost.failure == "");
    REQUIRE(lost.leases_fenced > 0);
    const auto fenced = static_cast<Nanoseconds>(lost.leases_fenced);
    const Nanoseconds retracing = options.work * fenced / batches / 3;
    CHECK(lost.took <= whole.took + lease_time + retracing + milliseconds(200));
  }
}

// Each is a command that once failed, and the bug that it found.
TEST_CASE("seeds that once found a bug pass", "[sim]") {
  std::ifstream file(std::string(LUX_SOURCE_DIR) + "/tests/sim/seeds");
  REQUIRE(file);
  int seeds = 0;
  for (std::string line; std::getline(file, line);) {
    const std::string words = line.substr(0, line.find('#'));
    if (words.find_first_not_of(' ') == std::string::npos) continue;
    ++seeds;
    const std::string command =
        std::string("cd " LUX_SOURCE_DIR " && ") + LUX_PROGRAM + " sim " + words + " > /dev/null";
    INFO(command);
    CHECK(std::system(command.c_str()) == 0);
  }
  CHECK(seeds > 0);
}

TEST_CASE("the largest possible seed runs once, and seed ranges that reach it end", "[sim]") {
  const auto said = [](const std::string& words) {
    const std::string command =
        std::string("cd " LUX_SOURCE_DIR " && ") + LUX_PROGRAM +
        " sim scenes/library/empty_room.toml --particles 100 --faults none " + words + " 2>&1";
    std::string text;
    FILE* const pipe = ::popen(command.c_str(), "r");
    REQUIRE(pipe != nullptr);
    char piece[512];
    while (std::fgets(piece, sizeof piece, pipe) != nullptr) text += piece;
    INFO(command << "\n" << text);
    CHECK(::pclose(pipe) == 0);
    return text;
  };
  CHECK(said("--seed 18446744073709551615").find("1 seeds, 0 failed") != std::string::npos);
  CHECK(said("--seeds 18446744073709551612..18446744073709551615").find("3 seeds, 0 failed") !=
        std::string::npos);
}
