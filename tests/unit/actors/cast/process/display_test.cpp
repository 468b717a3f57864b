// The display of a run on nodes: it gets the plain loop's totals on any node; losing it loses
// nothing, and without it there are no results.
#include <spdlog/spdlog.h>

#include <catch2/catch.hpp>
#include <stdexcept>
#include <string>

#include "actors/cast/node/node_plan.hpp"
#include "actors/cast/process/in_process.hpp"
#include "tests/unit/actors/cast/process/equal_bits.hpp"
#include "tests/unit/actors/cast/process/library_scene.hpp"

using namespace luxodus;

namespace {

/// Keeps copies of what it should show, and fails on request.
class NotedWork final : public RunOutput {
 public:
  explicit NotedWork(const LocalRun& base) : base_(base) {}
  std::unique_ptr<LocalRun> fresh_run() override { return base_.empty_copy(); }
  uint64_t picture_bytes() const override { return 12345; }
  bool wants_show() override { return shown < shows_wanted; }
  void show(const LocalRun& run) override {
    ++shown;
    CHECK(run.totals().balance().closes());
  }
  Result<void> keep_flux(const LocalRun& run, StopReason why) override {
    done += "flux ";
    if (throws-- > 0) throw std::runtime_error("the pen broke");
    if (!refuses.empty()) return problem(refuses);
    kept = copy_of(run);
    reason = why;
    return {};
  }
  Result<void> write_results(const LocalRun& run, StopReason) override {
    done += "results ";
    if (throws_late-- > 0) throw std::runtime_error("the ink dried");
    CHECK(differences(*kept, run) == 0);
    return {};
  }

  int shows_wanted = 0;
  std::atomic<int> shown{0};
  int throws = 0, throws_late = 0;  // number of failures: before the flux is kept, and after
  std::string refuses;
  std::string done;
  std::unique_ptr<LocalRun> kept;
  StopReason reason = StopReason::interrupted;

 private:
  std::unique_ptr<LocalRun> copy_of(const LocalRun& run) const {
    auto copy = base_.empty_copy();
    for (int g = 0; g < run.totals().groups(); ++g)
      copy->totals().restore(g, run.totals().state(g));
    copy->totals().restore_ledger(run.totals().balance());
    copy->resume(run.batches(), run.missing());
    return copy;
  }
  const LocalRun& base_;
};

struct Shown {
  explicit Shown(int64_t particles)
      : run(scene_of("smoke_tank", "", 1), 1, 1), plain(run.shared_scene(), 1, 2) {
    spdlog::set_level(spdlog::level::off);
    stop.particles = particles;
    options.nodes = 3;
    options.lost = seconds(1);
    options.display = &work;
  }
  Result<StopReason> go() { return run_on_nodes(run, options, stop, nobody, ignore); }
  void check_kept() {
    plain.run(stop, nobody, ignore);
    REQUIRE(work.kept);
    CHECK(differences(plain, *work.kept) == 0);
    CHECK(work.kept->batches() == plain.batches());
    CHECK(work.reason == StopReason::particles);
  }
  LocalRun run, plain;
  NotedWork work{run};
  NodesOptions options;
  StopRule stop;
};

}  // namespace

TEST_CASE("a display gets the totals of the plain loop, and writes flux before results",
          "[nodes][display]") {
  Shown shown(100'000);
  SECTION("on the controller's node") {}
  SECTION("on a worker's node") {
    shown.options.display_node = NodeId{1};
  }
  SECTION("with totals in shards") {
    shown.options.tally_shards = 3;
  }
  SECTION("on a worker's node, with totals in shards, far away") {
    shown.options.display_node = NodeId{0};
    shown.options.tally_shards = 3;
    shown.options.link_delay = milliseconds(5);
  }
  const auto ended = shown.go();
  REQUIRE(ended.ok());
  CHECK(ended.value() == StopReason::particles);
  CHECK(shown.work.done == "flux results ");
  shown.check_kept();
}

TEST_CASE("previews during a run change no bit", "[nodes][display]") {
  Shown shown(2'000'000);
  shown.work.shows_wanted = 1000;
  SECTION("on the controller's node") {}
  SECTION("on a worker's node, with totals in shards") {
    shown.options.display_node = NodeId{2};
    shown.options.tally_shards = 2;
  }
  REQUIRE(shown.go().ok());
  CHECK(shown.work.shown > 0);
  shown.check_kept();
}

TEST_CASE("a display that fails restarts and asks again, without loss of flux",
          "[nodes][display][supervision]") {
  Shown shown(100'000);
  shown.work.throws = 2;
  SECTION("on the controller's node") {}
  SECTION("on a worker's node") {
    shown.options.display_node = NodeId{1};
  }
  REQUIRE(shown.go().ok());
  CHECK(shown.work.done == "flux flux flux results ");
  shown.check_kept();
}

TEST_CASE("a display that fails when the flux is on the disk writes the results from there",
          "[nodes][display][supervision]") {
  Shown shown(50'000);
  shown.work.throws_late = 2;
  SECTION("on the controller's node") {}
  SECTION("on a worker's node") {
    shown.options.display_node = NodeId{2};
  }
  REQUIRE(shown.go().ok());
  CHECK(shown.work.done == "flux results results results ");
  shown.check_kept();
}

TEST_CASE("results that can never be written end the run with an error",
          "[nodes][display][supervision]") {
  Shown shown(50'000);
  shown.work.throws_late = 1000;
  const auto ended = shown.go();
  REQUIRE_FALSE(ended.ok());
  CHECK(ended.problem().what.find("the display has failed more than 5 times") != std::string::npos);
  shown.check_kept();
}

TEST_CASE("a display that fails repeatedly ends the run with an error",
          "[nodes][display][supervision]") {
  Shown shown(50'000);
  shown.work.throws = 1000;
  const auto ended = shown.go();
  REQUIRE_FALSE(ended.ok());
  CHECK(ended.problem().what.find(
            "the display has failed more than 5 times in 60 s: the pen broke") !=
        std::string::npos);
  CHECK(shown.work.kept == nullptr);
}

TEST_CASE("a run whose flux cannot be written reports it", "[nodes][display]") {
  Shown shown(50'000);
  shown.work.refuses = "the disk is full";
  SECTION("on the controller's node") {}
  SECTION("on a worker's node") {
    shown.options.display_node = NodeId{1};
  }
  const auto ended = shown.go();
  REQUIRE_FALSE(ended.ok());
  CHECK(ended.problem().what.find("the disk is full") != std::string::npos);
}

TEST_CASE("the memory plan of the display's node includes its copy and its pictures",
          "[nodes][display]") {
  Shown shown(1);
  const std::string plan = plan_on_nodes(shown.run, shown.options).value();
  for (const char* term :
       {"mailbox of the display", "totals that are shown", "totals for the display", "pictures"})
    CHECK(plan.find(term) != std::string::npos);
  shown.options.display = nullptr;
  const std::string without = plan_on_nodes(shown.run, shown.options).value();
  CHECK(without.find("display") == std::string::npos);
}
