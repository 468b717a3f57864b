// Processes that vanish during a run: the others finish with the same bits, or end with a result
// that can be continued.
#include "tests/examples/cluster_kit.hpp"

using namespace luxodus::program;

namespace {

ClusterText workers(int count, const std::string& run) {
  ClusterText text;
  text.workers = count;
  text.run = run;
  text.more = "[timeouts]\nlost_s = 1\n" + slow_workers(count);
  return text;
}

}  // namespace

TEST_CASE("a killed worker is dispensable: the others give the same bits", "[cluster]") {
  const TemporaryFolder folder;
  const RunningCluster nodes = start(write_cluster(folder, workers(3, "particles = 400_000\n")), 3);
  nodes.workers[1]->kill(SIGKILL);
  CHECK(nodes.controller->wait() == 0);
  INFO(nodes.controller->text());
  CHECK(nodes.workers[0]->wait() == 0);
  CHECK(nodes.workers[2]->wait() == 0);
  check_plain_flux(folder, "400k");
}

TEST_CASE("a worker that is killed and restarted is accepted, with the same bits", "[cluster]") {
  const TemporaryFolder folder;
  const std::string cluster = write_cluster(folder, workers(2, "particles = 400_000\n"));
  RunningCluster nodes = start(cluster, 2);
  nodes.workers[0]->kill(SIGKILL);
  CHECK(nodes.workers[0]->wait() == 128 + SIGKILL);
  nodes.workers[0] = node(cluster, "n0");
  CHECK(nodes.controller->wait() == 0);
  INFO(nodes.controller->text());
  CHECK(nodes.workers[0]->wait() == 0);
  CHECK(nodes.workers[1]->wait() == 0);
  check_plain_flux(folder, "400k");
}

TEST_CASE("a controller that is killed and restarted begins anew, with the same bits",
          "[cluster]") {
  const TemporaryFolder folder;
  ClusterText text = workers(2, "particles = 400_000\n");
  text.more = "[timeouts]\nlost_s = 60\n" + slow_workers(2);
  const std::string cluster = write_cluster(folder, text);
  RunningCluster nodes = start(cluster, 2);
  nodes.controller->kill(SIGKILL);
  CHECK(nodes.controller->wait() == 128 + SIGKILL);
  nodes.controller = node(cluster, "controller");
  CHECK(nodes.controller->wait() == 0);
  INFO(nodes.controller->text());
  CHECK(nodes.workers[0]->wait() == 0);
  CHECK(nodes.workers[1]->wait() == 0);
  check_plain_flux(folder, "400k");
}

TEST_CASE("a worker whose controller has vanished ends and says so", "[cluster]") {
  const TemporaryFolder folder;
  ClusterText text = workers(2, endless);
  text.more += "[observe]\nlog_level = \"debug\"\n";
  const RunningCluster nodes = start(write_cluster(folder, text), 2);
  REQUIRE(nodes.controller->says("flush=taken node=0"));  // so they know of it
  REQUIRE(nodes.controller->says("flush=taken node=1"));
  nodes.controller->kill(SIGKILL);
  for (const auto& worker : nodes.workers) {
    CHECK(worker->wait() == 1);
    CHECK(worker->said("no way has led to the controller for 1 s (lost_s)"));
  }
}

TEST_CASE("a killed worker ends the run if it holds a shard of the totals", "[cluster][shards]") {
  const TemporaryFolder folder;
  ClusterText text = workers(2, endless);
  text.more += "[observe]\nlog_level = \"debug\"\n[tally]\nshards = [\"n1\"]\n";
  const RunningCluster nodes = start(write_cluster(folder, text), 2);
  REQUIRE(nodes.controller->says("flush=taken"));
  nodes.workers[1]->kill(SIGKILL);
  CHECK(nodes.controller->wait() == 1);
  INFO(nodes.controller->text());
  CHECK(nodes.controller->said("n1 is lost, and with it a shard of the totals"));
  CHECK(nodes.workers[0]->wait() == 1);
  CHECK(nodes.workers[0]->said("a shard of the totals"));
  CHECK_FALSE(fs::exists(folder / "out" / "flux.lux"));
  CHECK_FALSE(fs::exists(folder / "out" / "result.json"));
}

TEST_CASE("a worker that is killed and restarted beside shards is accepted, with the same bits",
          "[cluster][shards]") {
  const TemporaryFolder folder;
  ClusterText text = workers(3, "particles = 400_000\n");
  text.more += "[tally]\nshards = [\"n0\", \"n2\"]\n";
  const std::string cluster = write_cluster(folder, text);
  RunningCluster nodes = start(cluster, 3);
  nodes.workers[1]->kill(SIGKILL);
  CHECK(nodes.workers[1]->wait() == 128 + SIGKILL);
  nodes.workers[1] = node(cluster, "n1");
  CHECK(nodes.controller->wait() == 0);
  INFO(nodes.controller->text());
  for (const auto& worker : nodes.workers) CHECK(worker->wait() == 0);
  check_plain_flux(folder, "400k");
}

TEST_CASE("a controller whose workers have all vanished leaves a result that can be continued",
          "[cluster]") {
  const TemporaryFolder folder;
  ClusterText text = workers(2, endless);
  text.more += "[observe]\nlog_level = \"debug\"\n";
  const RunningCluster nodes = start(write_cluster(folder, text), 2);
  REQUIRE(nodes.controller->says("flush=taken"));
  for (const auto& worker : nodes.workers) worker->kill(SIGKILL);
  CHECK(nodes.controller->wait() == 1);
  INFO(nodes.controller->text());
  CHECK(nodes.controller->said("all workers were lost"));
  CHECK(slurp(folder / "out" / "result.json").find("workers lost") != std::string::npos);
  check_goes_on(folder);
}

TEST_CASE("a cluster that is told to end leaves whole batches that can be continued", "[cluster]") {
  const TemporaryFolder folder;
  ClusterText text = workers(2, endless);
  text.more += "[observe]\nlog_level = \"debug\"\n";
  SECTION("with all totals at the controller") {}
  SECTION("with shards of the totals") {
    text.more += "[tally]\nshards = [\"n0\", \"n1\"]\n";
  }
  const RunningCluster nodes = start(write_cluster(folder, text), 2);
  REQUIRE(nodes.controller->says("flush=taken"));
  for (const auto& worker : nodes.workers) worker->kill(SIGTERM);
  nodes.controller->kill(SIGTERM);
  CHECK(nodes.controller->wait() == 130);
  INFO(nodes.controller->text());
  for (const auto& worker : nodes.workers) CHECK(worker->wait() == 0);
  check_goes_on(folder);
}

TEST_CASE("a disk that fills up under the journal ends the journal, and not the run",
          "[cluster][loss]") {
  const TemporaryFolder folder;
  ClusterText text = workers(2, "particles = 800_000\n");
  text.more =
      "[lease]\nduration_s = 4\n[[faults.event]]\nkind = \"full_disk\"\n"
      "node = \"controller\"\nat_s = 0.2\nlasts_s = 1000\n" +
      slow_workers(2);
  RunningCluster nodes = start(write_cluster(folder, text), 2);
  CHECK(nodes.controller->wait() == 0);
  INFO(nodes.controller->text());
  CHECK(nodes.controller->said("journal=failed"));
  for (const auto& worker : nodes.workers) CHECK(worker->wait() == 0);
  check_plain_flux(folder, "800k");
}

TEST_CASE("a disk that is full when a cluster ends has room for the results", "[cluster][loss]") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out", kept = folder / "kept";
  fs::create_directories(out);
  fs::create_directories(kept);
  const std::string mount = "mount -t tmpfs -o size=14m none " + out.string();
  if (std::system(("unshare -rm " + mount + " 2>/dev/null").c_str()) != 0) {
    WARN("skipped: no file system of a few MiB can be mounted here");
    return;
  }
  // The room reserved for the results is all that this disk has: nothing is left for a journal.
  const std::string cluster = write_cluster(folder, workers(1, "particles = 400_000\n"));
  const Outcome up =
      shell(folder, "unshare -rm sh -c '" + mount + " && " + LUX_PROGRAM + " cluster up " +
                        cluster + " && cp -r " + out.string() + "/. " + kept.string() + "'");
  INFO(up.err);
  REQUIRE(up.code == 0);
  CHECK(up.err.find("journal=failed") != std::string::npos);
  fs::remove(out);
  fs::rename(kept, out);
  check_plain_flux(folder, "400k");
}

TEST_CASE("stopping cluster up stops all its nodes, and the results are written",
          "[cluster][loss]") {
  const TemporaryFolder folder;
  const std::string cluster = write_cluster(folder, workers(2, endless));
  Process up(LUX_PROGRAM, {"cluster", "up", cluster});
  REQUIRE(up.says("run=begun"));
  up.kill(SIGTERM);
  // Its output ends when the last process that shares it has ended.
  CHECK(up.wait() == 130);
  INFO(up.text());
  CHECK(particles_in(folder) > 0);
}

TEST_CASE("a controller that is killed and restarted continues from its journal",
          "[cluster][loss]") {
  const TemporaryFolder folder;
  ClusterText text = workers(2, "particles = 800_000\n");
  text.more =
      "[timeouts]\nlost_s = 30\n[lease]\nduration_s = 4\n[observe]\nlog_level = \"debug\"\n" +
      slow_workers(2);
  const std::string cluster = write_cluster(folder, text);
  RunningCluster nodes = start(cluster, 2);
  REQUIRE(nodes.controller->says("flush=taken"));
  nodes.controller->kill(SIGKILL);
  CHECK(nodes.controller->wait() == 128 + SIGKILL);
  CHECK_FALSE(fs::exists(folder / "out" / "flux.lux"));
  const fs::path journal = folder / "out" / "run.journal";
  std::ofstream(journal, std::ios::app) << "what a crash has torn";
  nodes.controller = node(cluster, "controller");
  const int code = nodes.controller->wait();
  INFO(nodes.controller->text());
  CHECK(code == 0);
  CHECK(nodes.controller->said("journal=torn bytes=21"));
  CHECK(nodes.controller->said("run=recovered"));
  for (const auto& worker : nodes.workers) CHECK(worker->wait() == 0);
  check_plain_flux(folder, "800k");
  CHECK_FALSE(fs::exists(journal));
}
