// Clusters displayed by a node other than the controller's, and actors that fail on purpose, as a
// user starts them.
#include "tests/examples/cluster_kit.hpp"

using namespace luxodus::program;

namespace {

ClusterText shown_by(const std::string& node, const std::string& run) {
  ClusterText text;
  text.workers = 3;
  text.run = run;
  text.more =
      "[timeouts]\nlost_s = 1\n[display]\nnode = \"" + node + "\"\n" + slow_workers(text.workers);
  return text;
}

/// An actor of a node fails at this time after its start.
std::string failure(const std::string& node, const std::string& actor, const std::string& at_s) {
  return "[[faults.event]]\nkind = \"failure\"\nnode = \"" + node + "\"\nactor = \"" + actor +
         "\"\nat_s = " + at_s + "\n";
}

void check_all_end_well(const RunningCluster& nodes) {
  const int code = nodes.controller->wait();
  INFO(nodes.controller->text());
  CHECK(code == 0);
  for (const auto& worker : nodes.workers) {
    const int of_worker = worker->wait();
    INFO(worker->text());
    CHECK(of_worker == 0);
  }
}

}  // namespace

TEST_CASE("a worker that displays the run writes the results of the plain loop",
          "[cluster][display]") {
  const TemporaryFolder folder;
  const RunningCluster nodes =
      start(write_cluster(folder, shown_by("n1", "particles = 400_000\n")), 3);
  check_all_end_well(nodes);
  CHECK(nodes.workers[1]->said("in " + fs::canonical(folder / "out").string()));
  CHECK(fs::exists(folder / "out" / "result.json"));
  CHECK_FALSE(fs::exists(folder / "out" / "run.journal"));
  check_plain_flux(folder, "400k");
}

TEST_CASE("a display that is killed and restarted loses no flux", "[cluster][display]") {
  const TemporaryFolder folder;
  const std::string cluster = write_cluster(folder, shown_by("n1", "particles = 400_000\n"));
  RunningCluster nodes = start(cluster, 3);
  nodes.workers[1]->kill(SIGKILL);
  CHECK(nodes.workers[1]->wait() == 128 + SIGKILL);
  nodes.workers[1] = node(cluster, "n1");
  check_all_end_well(nodes);
  check_plain_flux(folder, "400k");
  const std::string result = slurp(folder / "out" / "result.json");
  CHECK(result.find("\"finished\": false") == std::string::npos);
}

TEST_CASE(
    "a run whose display does not return keeps its journal, and the next display completes it",
    "[cluster][display]") {
  const TemporaryFolder folder;
  const std::string cluster = write_cluster(folder, shown_by("n1", "particles = 400_000\n"));
  RunningCluster nodes = start(cluster, 3);
  nodes.workers[1]->kill(SIGKILL);
  CHECK(nodes.controller->wait() == 1);
  INFO(nodes.controller->text());
  CHECK(nodes.controller->said("no way leads to n1, which was to write the results"));
  CHECK(fs::exists(folder / "out" / "run.journal"));
  CHECK_FALSE(fs::exists(folder / "out" / "flux.lux"));
  for (const size_t left : {0, 2}) (void)nodes.workers[left]->wait();
  const Outcome again = run_luxodus(folder, "cluster up " + cluster);
  INFO(again.err);
  CHECK(again.code == 0);
  CHECK_FALSE(fs::exists(folder / "out" / "run.journal"));
  check_plain_flux(folder, "400k");
}

TEST_CASE("a cluster that is told to end has its display write the results so far",
          "[cluster][display]") {
  const TemporaryFolder folder;
  ClusterText text = shown_by("n2", endless);
  text.more += "[observe]\nlog_level = \"debug\"\n";
  const RunningCluster nodes = start(write_cluster(folder, text), 3);
  REQUIRE(nodes.controller->says("flush=taken"));
  for (const auto& worker : nodes.workers) worker->kill(SIGTERM);
  nodes.controller->kill(SIGTERM);
  CHECK(nodes.controller->wait() == 130);
  INFO(nodes.controller->text());
  for (const auto& worker : nodes.workers) CHECK(worker->wait() == 0);
  check_goes_on(folder);
}

TEST_CASE("a tracer that fails makes its node leave, and the others give the same bits",
          "[cluster][supervision]") {
  const TemporaryFolder folder;
  ClusterText text;
  text.workers = 3;
  text.run = "particles = 1_200_000\n";
  text.more = "[timeouts]\nlost_s = 1\n" + failure("n1", "tracer", "1") + slow_workers(3);
  const RunningCluster nodes = start(write_cluster(folder, text), 3);
  CHECK(nodes.workers[1]->wait() == 1);
  INFO(nodes.workers[1]->text());
  CHECK(nodes.workers[1]->said("the tracer has failed: a failure on purpose"));
  CHECK(nodes.controller->wait() == 0);
  INFO(nodes.controller->text());
  CHECK(nodes.workers[0]->wait() == 0);
  CHECK(nodes.workers[2]->wait() == 0);
  check_plain_flux(folder, "1200k");
}

TEST_CASE("a coordinator or journal that fails ends the run, and the journal remains",
          "[cluster][supervision]") {
  for (const char* actor : {"coordinator", "journal"}) {
    INFO(actor);
    const TemporaryFolder folder;
    ClusterText text;
    text.workers = 2;
    text.run = endless;
    text.more = "[timeouts]\nlost_s = 5\n" + failure("controller", actor, "10") + slow_workers(2);
    const RunningCluster nodes = start(write_cluster(folder, text), 2);
    CHECK(nodes.controller->wait() == 1);
    INFO(nodes.controller->text());
    CHECK(nodes.controller->said("controller: the " + std::string(actor) +
                                 " has failed: a failure on purpose"));
    for (const auto& worker : nodes.workers) (void)worker->wait();
    CHECK(fs::exists(folder / "out" / "run.journal"));
    CHECK_FALSE(fs::exists(folder / "out" / "flux.lux"));
  }
}

TEST_CASE("a display that fails on purpose begins anew, and the run completes",
          "[cluster][supervision]") {
  const TemporaryFolder folder;
  ClusterText text = shown_by("n0", "particles = 600_000\n");
  text.more += failure("n0", "display", "0.5");
  const RunningCluster nodes = start(write_cluster(folder, text), 3);
  check_all_end_well(nodes);
  CHECK(nodes.workers[0]->said("a failure on purpose: it begins anew"));
  check_plain_flux(folder, "600k");
}

TEST_CASE("a display on an unknown node is rejected, with the one probably meant",
          "[cluster][display]") {
  const TemporaryFolder folder;
  const std::string cluster = write_cluster(folder, shown_by("controler", endless));
  const Outcome up = run_luxodus(folder, "cluster up " + cluster);
  CHECK(up.code == 2);
  CHECK(up.err.find("did you mean \"controller\"") != std::string::npos);
}
