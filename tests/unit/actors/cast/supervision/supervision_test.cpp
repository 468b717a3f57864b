// What happens to a node and its run when an actor throws: the table, and a test of each row.
#include "actors/cast/supervision/supervision.hpp"

#include <spdlog/spdlog.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "actors/cast/journal/flush_keeper.hpp"
#include "actors/cast/node/controller_node.hpp"
#include "actors/cast/process/in_process.hpp"
#include "tests/unit/actors/cast/process/equal_bits.hpp"
#include "tests/unit/actors/cast/process/library_scene.hpp"
#include "tests/unit/runtime/actor/node_kit.hpp"

using namespace luxodus;

namespace {

/// Splits "| a | b | c |" into its cells, trimmed.
std::vector<std::string> cells_of_row(const std::string& line) {
  std::vector<std::string> cells;
  for (size_t at = line.find('|'); at != std::string::npos;) {
    const size_t end = line.find('|', at + 1);
    if (end == std::string::npos) break;
    std::string cell = line.substr(at + 1, end - at - 1);
    cell.erase(0, cell.find_first_not_of(' '));
    cell.erase(cell.find_last_not_of(' ') + 1);
    cells.push_back(cell);
    at = end;
  }
  return cells;
}

/// Rows of the table in actors/README.md that begins with these headings.
std::vector<std::vector<std::string>> documented() {
  std::ifstream in(std::string(LUX_SOURCE_DIR) + "/actors/README.md");
  std::vector<std::vector<std::string>> rows;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("| actor that fails |")) inside = true;
    if (!inside) continue;
    if (line.empty()) break;
    rows.push_back(cells_of_row(line));
  }
  return rows;
}

struct Order {};

/// Throws on request.
class Thrower final
    : public Actor<Thrower, ControlLane<Accepts<Order, 4, WhenFull::reject>>, DataLane<>> {
 public:
  explicit Thrower(Scheduler& scheduler) : Actor(scheduler, "thrower") {}
  void on(const Order&) { throw std::runtime_error("it broke"); }

 private:
  void reset() override {}
};

struct Stage {
  Stage() { spdlog::set_level(spdlog::level::off); }
  void fail() {
    REQUIRE(actor.offer(Order{}) == Offered::taken);
    node.settle();
  }
  test::Node node;
  Supervisor supervisor{node.scheduler, NodeId{3}};
  Thrower actor{node.scheduler};
};

NodesOptions nodes_with(ActorName actor, NodeId node, Nanoseconds at) {
  spdlog::set_level(spdlog::level::off);
  NodesOptions options;
  options.nodes = 3;
  options.lost = seconds(1);
  Fault fault;
  fault.kind = Fault::Kind::failure;
  fault.at = at;
  fault.lasts = seconds(1);
  fault.node = node;
  fault.actor = role_name(actor);
  options.faults.push_back(fault);
  return options;
}

constexpr NodeId controller_of_three{3};

/// The problem of a run that would not end by itself.
std::string problem_of_endless_run(const NodesOptions& options) {
  LocalRun run(scene_of("smoke_tank", "", 1), 1, 1);
  const auto ended = run_on_nodes(run, options, {}, nobody, ignore);
  REQUIRE_FALSE(ended.ok());
  return ended.problem().what;
}

/// Throws at its second trace.
class BreakingTracer final : public BatchTracer {
 public:
  explicit BreakingTracer(std::unique_ptr<BatchTracer> real) : real_(std::move(real)) {}
  void trace(int group, uint64_t first, int64_t count, BatchScores& scores) override {
    if (++traced_ == 2) throw std::runtime_error("the tracer broke");
    real_->trace(group, first, count, scores);
  }
  uint32_t look_units() const override { return real_->look_units(); }
  void look(int64_t batch, uint32_t unit, BatchScores& scores) override {
    real_->look(batch, unit, scores);
  }

 private:
  std::unique_ptr<BatchTracer> real_;
  int traced_ = 0;
};

struct BreakingKeeper final : FlushKeeper {
  Result<void> keep(std::span<const int64_t>, std::span<const std::byte>) override {
    throw std::runtime_error("the keeper broke");
  }
  bool is_whole() const override { return true; }
};

/// Nodes of this process with parts chosen by the test.
struct OwnNodes {
  OwnNodes(LocalRun& own_run, const NodesOptions& options, const StopRule& rule)
      : run(own_run),
        stop(rule),
        nodes(std::move(PlannedNodes::make(run, options, stop, 77).value())) {}
  Result<StopReason> go(const RunWorker& run_one, FlushKeeper* keeper) {
    const Machine machine{clock, context};
    WorkerThreads workers(
        nodes->setup(), machine, nodes->workers(), [] { return false; }, run_one);
    auto reason =
        run_controller(nodes->setup(), machine, nodes->controller(),
                       {run, stop, nobody, ignore, keeper}, [&] { return workers.failed(); });
    workers.join();
    lost = workers.lost();
    failed = workers.failed();
    return reason;
  }
  LocalRun& run;
  const StopRule stop;
  const SystemClock clock;
  std::unique_ptr<PlannedNodes> nodes;
  ZmqContext context{{}};
  std::optional<Problem> lost;
  bool failed = false;
};

}  // namespace

TEST_CASE("the table of supervision in the README equals the program's", "[supervision]") {
  const auto rows = documented();
  REQUIRE(rows.size() == supervision_rules.size() + 2);  // headings and a separator line
  for (size_t i = 0; i < supervision_rules.size(); ++i) {
    const SupervisionRule& rule = supervision_rules[i];
    std::string name = role_name(rule.actor);
    std::replace(name.begin(), name.end(), '_', ' ');
    const std::vector<std::string>& row = rows[i + 2];
    REQUIRE(row.size() >= 3);
    CHECK(row[0] == name);
    CHECK(row[1] == restarts_text(rule));
    CHECK(row[2] == name_of(rule.then));
  }
}

TEST_CASE("every actor with an address has a supervision rule", "[supervision]") {
  for (size_t name = 1; name < role_names.size(); ++name)
    CHECK(supervision_rule(static_cast<ActorName>(name)) != nullptr);
}

TEST_CASE("an actor is restarted as often as its rule says, and then the remedy applies",
          "[supervision]") {
  for (const SupervisionRule& rule : supervision_rules) {
    INFO(role_name(rule.actor));
    Stage stage;
    bool run_ended = false;
    stage.supervisor.end_runs_by([&](const Verdict&) {
      run_ended = true;
      return false;
    });
    watch(stage.supervisor, rule.actor, stage.actor);
    for (size_t i = 0; i < rule.restarts; ++i) {
      stage.fail();
      CHECK_FALSE(stage.actor.failed());
      CHECK_FALSE(stage.supervisor.verdict().has_value());
    }
    stage.fail();
    CHECK(stage.actor.failed());
    REQUIRE(stage.supervisor.verdict().has_value());
    CHECK(stage.supervisor.verdict()->remedy == rule.then);
    CHECK(stage.supervisor.verdict()->text.find("it broke") != std::string::npos);
    CHECK(run_ended == (rule.then == Remedy::end_run));
    const Supervisor::Counters& counted = stage.supervisor.counters(role_name(rule.actor));
    CHECK(counted.failures == rule.restarts + 1);
    CHECK(counted.restarts == rule.restarts);
  }
}

TEST_CASE("failures far apart in time are not counted together", "[supervision]") {
  Stage stage;
  const SupervisionRule& rule = *supervision_rule(role::display);
  watch(stage.supervisor, rule.actor, stage.actor);
  for (size_t i = 0; i < 3 * rule.restarts; ++i) {
    stage.fail();
    stage.node.advance(rule.within / static_cast<Nanoseconds>(rule.restarts) + 1);
  }
  CHECK_FALSE(stage.supervisor.verdict().has_value());
  CHECK(stage.actor.life() == 3 * rule.restarts + 1);
}

TEST_CASE("a failed coordinator ends the run with an error, and its workers with it",
          "[supervision]") {
  const std::string what =
      problem_of_endless_run(nodes_with(role::coordinator, controller_of_three, milliseconds(300)));
  CHECK(what.find("controller: the coordinator has failed: a failure on purpose") == 0);
}

TEST_CASE("a failed journal ends the run with an error, and its workers with it", "[supervision]") {
  spdlog::set_level(spdlog::level::off);
  LocalRun run(scene_of("smoke_tank", "", 1), 1, 1);
  NodesOptions options;
  OwnNodes nodes(run, options, {});
  BreakingKeeper keeper;
  const auto ended = nodes.go(run_worker, &keeper);
  REQUIRE_FALSE(ended.ok());
  CHECK(ended.problem().what.find("the journal has failed: the keeper broke") != std::string::npos);
  CHECK(nodes.failed);
}

TEST_CASE("a failed shard of the totals ends the run, as losing its node does",
          "[supervision][shards]") {
  NodesOptions options = nodes_with(role::tally_shard, {1}, seconds(1));
  options.tally_shards = 3;
  const std::string what = problem_of_endless_run(options);
  CHECK(what.find("n1 is lost, and with it a shard of the totals") != std::string::npos);
}

TEST_CASE("a photon-thread that throws takes down its node, and the others give the same bits",
          "[supervision]") {
  const auto scene = scene_of("smoke_tank", "", 1);
  StopRule stop;
  stop.particles = 200'000;
  LocalRun plain(scene, 1, 2);
  plain.run(stop, nobody, ignore);
  LocalRun run(scene, 1, 1);
  NodesOptions options;
  options.nodes = 3;
  options.lost = seconds(1);
  spdlog::set_level(spdlog::level::off);
  OwnNodes nodes(run, options, stop);
  const auto breaking = [](const RunSetup& setup, const Machine& machine, const NodeSetup& node,
                           const std::function<bool()>& end) -> Result<WorkerReport> {
    if (node.net.self != NodeId{1}) return run_worker(setup, machine, node, end);
    NodeTransport transport(machine, node);
    NodeSeams seams = transport.seams();
    seams.make_tracer = [](const CompiledScene& of, const GeometryAccess& access, uint64_t seed) {
      return std::make_unique<BreakingTracer>(make_batch_tracer(of, access, seed));
    };
    Worker worker(setup, node, seams);
    if (auto joined = join_links(transport.sockets(), node); !joined) return joined.problem();
    worker.start(end);
    worker.shell().run();
    return worker.result();
  };
  const auto ended = nodes.go(breaking, nullptr);
  REQUIRE(ended.ok());
  CHECK(ended.value() == StopReason::particles);
  CHECK_FALSE(nodes.failed);
  REQUIRE(nodes.lost.has_value());
  CHECK(nodes.lost->what == "n1: the tracer has failed, and its node has left; its log says why");
  CHECK(differences(plain, run) == 0);
}
