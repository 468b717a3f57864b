// Real processes over TCP, with faults between and within them: each case ends in the bits of the
// plain loop, and prints when the fault was detected and when the cluster had recovered.
#include "tests/examples/fault_kit.hpp"

using namespace luxodus::program;

namespace {

/// Workers that are suspected after 0.4 s of silence and given up 0.5 s later, and flush twice a
/// second. They compute at a quarter of their speed, so that the plain loop traces the same
/// particles quickly. A test whose wait fails ends after a minute.
ClusterText quick(int workers) {
  ClusterText text;
  text.workers = workers;
  text.run = std::string(endless) + "time_s = 60\n";
  text.more =
      "[timeouts]\nlost_s = 0.5\n[lease]\nduration_s = 2\n[observe]\nlog_level = \"debug\"\n";
  text.links = "beat_ms = 50\n";
  text.more += slow_workers(workers);
  return text;
}

ClusterText over_tcp(ClusterText text) {
  text.ports = free_ports(static_cast<size_t>(text.workers) + 1);
  return text;
}

std::string of_link(const std::string& word, int node, int neighbour) {
  return "link=" + word + " node=" + std::to_string(node) +
         " neighbour=" + std::to_string(neighbour) + "\n";
}

/// Silence is suspected first; if the connection is broken, and something is to be sent, it is
/// detected at once.
std::string change_of(int node, int neighbour) {
  return " node=" + std::to_string(node) + " neighbour=" + std::to_string(neighbour) + "\n";
}

std::string lost(int worker) {
  return "worker=lost node=" + std::to_string(worker) + " ";
}

std::string flush_of(int worker) {
  return "flush=taken node=" + std::to_string(worker) + " ";
}

/// Three workers with room for half of a scene, of which the last stores nothing: it fetches from
/// the other two, which both hold every object.
ClusterText fetching(const std::string& scene) {
  ClusterText text = quick(3);
  text.more.erase(text.more.find("[[faults.event]]"));  // the fetching worker is slow enough
  text.more.replace(text.more.find("duration_s = 2"), 14, "duration_s = 8");
  text.scene = scene;
  text.of_node["n2"] = "stores = false\n";
  text.more += "[budget]\nobject_bytes = \"1 MiB\"\nfibers = 256\n";
  return text;
}

std::string cells_of(const TemporaryFolder& folder) {
  return " --cells " + std::to_string(number_in(folder, "cells"));
}

/// Nine workers, of which three lead the other six.
ClusterText of_two_levels() {
  ClusterText text = quick(9);
  const std::string lease = "[lease]\n";
  text.more.insert(text.more.find(lease) + lease.size(), "fan_out = 3\n");
  return text;
}

/// The first of these workers that leads others, and one of those it leads, when it is gone.
size_t leader_among(const RunningCluster& nodes) {
  for (size_t i = 0; i < nodes.workers.size(); ++i) {
    (void)nodes.workers[i]->now();
    if (nodes.workers[i]->said("coordinator=begun")) return i;
  }
  FAIL("nobody leads others");
  return 0;
}

/// The workers of the lost leader work for another one, which takes their flushes.
void check_orphans(const RunningCluster& nodes, size_t leader) {
  size_t orphans = 0;
  const std::string lost_one = "coordinator=lost node=" + std::to_string(leader) + " ";
  for (size_t i = 0; i < nodes.workers.size(); ++i) {
    if (i == leader) continue;
    (void)nodes.workers[i]->now();
    if (nodes.workers[i]->said(lost_one)) ++orphans;
  }
  CHECK(orphans == 2);
}

/// Ends the run, and compares its results.
void end_with_same_bits(const TemporaryFolder& folder, const RunningCluster& nodes,
                        const FaultRow& row) {
  nodes.end();
  INFO(nodes.controller->text());
  check_goes_on(folder);
  row.end("same bits");
}

}  // namespace

TEST_CASE("half of the workers may be killed at once, or all but one, with the same bits",
          "[cluster][faults]") {
  const TemporaryFolder folder;
  const int killed = GENERATE(2, 3);
  const RunningCluster nodes = start(write_cluster(folder, over_tcp(quick(4))), 4);
  REQUIRE(nodes.controller->says(flush_of(1)));
  FaultRow row(std::to_string(killed) + " of 4 workers are killed", *nodes.controller);
  for (size_t i = 0; i < static_cast<size_t>(killed); ++i) nodes.workers[i]->kill(SIGKILL);
  row.noticed(change_of(4, 0));
  row.given_up(lost(killed - 1));
  row.well(flush_of(3));
  end_with_same_bits(folder, nodes, row);
}

TEST_CASE("when a sub-coordinator is killed, its workers join another one, with the same bits",
          "[cluster][faults][levels]") {
  const TemporaryFolder folder;
  const RunningCluster nodes = start(write_cluster(folder, over_tcp(of_two_levels())), 9);
  const size_t leader = leader_among(nodes);
  REQUIRE(nodes.controller->says(flush_of(static_cast<int>(leader))));
  FaultRow row("one of 3 coordinators below the controller is killed", *nodes.controller);
  nodes.workers[leader]->kill(SIGKILL);
  row.given_up(lost(static_cast<int>(leader)));
  row.well("flush=taken node=");
  end_with_same_bits(folder, nodes, row);
  check_orphans(nodes, leader);
}

TEST_CASE("a node that leads others may be suspended, and continues", "[cluster][faults][levels]") {
  const TemporaryFolder folder;
  const RunningCluster nodes = start(write_cluster(folder, over_tcp(of_two_levels())), 9);
  const size_t leader = leader_among(nodes);
  REQUIRE(nodes.controller->says(flush_of(static_cast<int>(leader))));
  FaultRow row("one of 3 coordinators is stopped (SIGSTOP)", *nodes.controller);
  nodes.workers[leader]->kill(SIGSTOP);
  row.given_up(lost(static_cast<int>(leader)));
  row.healed();
  nodes.workers[leader]->kill(SIGCONT);
  row.well("flush=taken node=");
  end_with_same_bits(folder, nodes, row);
}

TEST_CASE("a node that leads others may be cut off, with the same bits",
          "[cluster][faults][levels]") {
  const TemporaryFolder folder;
  size_t leader = 0;
  {
    const RunningCluster nodes = start(write_cluster(folder, over_tcp(of_two_levels())), 9);
    leader = leader_among(nodes);
    REQUIRE(nodes.controller->says("flush=taken node="));
    nodes.end();
    fs::remove_all(folder / "out");
  }
  const ProxiedCluster cluster = behind_proxy(folder, of_two_levels(), leader);
  RunningCluster nodes = start(cluster, 9, static_cast<int>(leader));
  REQUIRE(nodes.controller->says(flush_of(static_cast<int>(leader))));
  FaultRow row("one of 3 coordinators is cut off for more than lost_s", *nodes.controller);
  cluster.proxy->order("stall");
  row.given_up(lost(static_cast<int>(leader)));
  row.well("flush=taken node=");
  CHECK(nodes.workers[leader]->wait() == 1);
  check_orphans(nodes, leader);
  nodes.workers.erase(nodes.workers.begin() + static_cast<std::ptrdiff_t>(leader));
  end_with_same_bits(folder, nodes, row);
}

TEST_CASE("when all tracing nodes are lost, the nodes that lead them do not keep a run alive",
          "[cluster][faults][levels]") {
  const TemporaryFolder folder;
  ClusterText text = quick(4);
  const std::string lease = "[lease]\n";
  text.more.insert(text.more.find(lease) + lease.size(), "fan_out = 2\n");
  const RunningCluster nodes = start(write_cluster(folder, over_tcp(text)), 4);
  REQUIRE(nodes.controller->says("flush=taken"));
  int killed = 0;
  for (const auto& worker : nodes.workers) {
    (void)worker->now();
    if (worker->said("coordinator=begun")) continue;
    worker->kill(SIGKILL);
    ++killed;
  }
  CHECK(killed == 2);
  CHECK(nodes.controller->wait() == 1);
  INFO(nodes.controller->text());
  CHECK(nodes.controller->said("all workers were lost"));
  check_goes_on(folder, 1'000);
}

TEST_CASE("a coordinator that fails on a worker costs that worker, and the run continues",
          "[cluster][faults][levels]") {
  const TemporaryFolder folder;
  ClusterText text = of_two_levels();
  size_t leader = 0;
  {
    const RunningCluster nodes = start(write_cluster(folder, over_tcp(text)), 9);
    leader = leader_among(nodes);
    REQUIRE(nodes.controller->says("flush=taken node="));
    nodes.end();
    fs::remove_all(folder / "out");
  }
  const std::string name = "n" + std::to_string(leader);
  text.more += "[[faults.event]]\nkind = \"failure\"\nactor = \"coordinator\"\nnode = \"" + name +
               "\"\nat_s = 2\n[display]\nnode = \"" + name + "\"\n";
  RunningCluster nodes = start(write_cluster(folder, over_tcp(text)), 9);
  FaultRow row("one of 3 coordinators below the controller fails", *nodes.controller);
  row.given_up(lost(static_cast<int>(leader)));
  CHECK(nodes.workers[leader]->wait() == 1);
  row.well("flush=taken node=");
  CHECK_FALSE(nodes.controller->said("run=failed"));
}

TEST_CASE("a suspended worker is given up, and works again when it resumes", "[cluster][faults]") {
  const TemporaryFolder folder;
  const RunningCluster nodes = start(write_cluster(folder, over_tcp(quick(3))), 3);
  REQUIRE(nodes.controller->says(flush_of(1)));
  FaultRow row("a worker is stopped (SIGSTOP)", *nodes.controller);
  nodes.workers[1]->kill(SIGSTOP);
  row.noticed(change_of(3, 1));
  row.given_up(lost(1));
  row.healed();
  nodes.workers[1]->kill(SIGCONT);
  row.well(flush_of(1));
  end_with_same_bits(folder, nodes, row);
}

TEST_CASE("a partition that heals in time costs no worker, with the same bits",
          "[cluster][faults]") {
  const TemporaryFolder folder;
  ClusterText text = quick(3);
  text.more.replace(text.more.find("lost_s = 0.5"), 12, "lost_s = 30 ");
  const auto [how, what] = GENERATE(
      std::pair{"stall", "a worker is cut off and nobody is told, for less than lost_s"},
      std::pair{"refuse", "a worker is cut off and connections are refused, for less than lost_s"});
  const ProxiedCluster cluster = behind_proxy(folder, text, 1);
  const RunningCluster nodes = start(cluster, 3, 1);
  REQUIRE(nodes.controller->says(flush_of(1)));
  FaultRow row(what, *nodes.controller);
  cluster.proxy->order(how);
  row.noticed(change_of(3, 1));
  REQUIRE(nodes.controller->says(of_link("connecting", 3, 1)));
  row.healed();
  cluster.proxy->order("heal");
  row.well(flush_of(1));
  CHECK_FALSE(nodes.controller->said(lost(1)));
  end_with_same_bits(folder, nodes, row);
}

TEST_CASE("a worker cut off for long by a partition ends, and is accepted after a restart",
          "[cluster][faults]") {
  const TemporaryFolder folder;
  const ProxiedCluster cluster = behind_proxy(folder, quick(3), 1);
  RunningCluster nodes = start(cluster, 3, 1);
  REQUIRE(nodes.controller->says(flush_of(1)));
  FaultRow row("a worker is cut off for more than lost_s, and started again", *nodes.controller);
  cluster.proxy->order("stall");
  row.noticed(change_of(3, 1));
  row.given_up(lost(1));
  CHECK(nodes.workers[1]->wait() == 1);
  CHECK(nodes.workers[1]->said("no way has led to the controller for 0.5 s (lost_s)"));
  row.healed();
  cluster.proxy->order("heal");
  nodes.workers[1] = node(cluster.its, "n1");
  row.well(flush_of(1));
  end_with_same_bits(folder, nodes, row);
}

TEST_CASE("connections that break repeatedly cost time, with the same bits", "[cluster][faults]") {
  const TemporaryFolder folder;
  const ProxiedCluster cluster = behind_proxy(folder, quick(3), 1);
  const RunningCluster nodes = start(cluster, 3, 1);
  REQUIRE(nodes.controller->says(flush_of(1)));
  FaultRow row("all connections of a worker break, three times", *nodes.controller);
  for (int i = 0; i < 3; ++i) {
    const size_t from = nodes.controller->now();
    cluster.proxy->order("drop");
    REQUIRE(nodes.controller->says(flush_of(1), from));
  }
  row.well(flush_of(1));
  end_with_same_bits(folder, nodes, row);
}

TEST_CASE("a slow link with high latency delays its worker, with the same bits",
          "[cluster][faults]") {
  const TemporaryFolder folder;
  ClusterText text = quick(3);
  // A flush has megabytes: on such a link it takes longer than the two seconds of a lease.
  const std::string brief = "duration_s = 2\n", patient = "duration_s = 30\n";
  text.more.replace(text.more.find(brief), brief.size(), patient);
  const ProxiedCluster cluster = behind_proxy(folder, text, 1);
  const RunningCluster nodes = start(cluster, 3, 1);
  REQUIRE(nodes.controller->says(flush_of(1)));
  FaultRow row("a worker's links get 1 MB/s and 20 ms", *nodes.controller);
  cluster.proxy->order("delay 20");
  cluster.proxy->order("rate 1000000");
  row.well(flush_of(1));
  end_with_same_bits(folder, nodes, row);
}

TEST_CASE("corrupted bytes are detected and sent again, with the same bits", "[cluster][faults]") {
  const TemporaryFolder folder;
  const bool keys = GENERATE(false, true);
  ClusterText text = quick(2);
  // Workers at full speed: slow ones also write into frames how long these are to be held.
  text.more.erase(text.more.find("[[faults.event]]"));
  // CURVE may have to begin so often that both are unreachable for more than half a second; a run
  // that has lost all its workers ends.
  const std::string hasty = "lost_s = 0.5", patient = "lost_s = 30";
  text.more.replace(text.more.find(hasty), hasty.size(), patient);
  if (keys) text.more += "[keys]\nfolder = \"keys\"\n";
  const ProxiedCluster cluster = behind_proxy(folder, text, 1);
  if (keys) REQUIRE(run_luxodus(folder, "keygen --cluster " + cluster.its).code == 0);
  const RunningCluster nodes = start(cluster, 2, 1);
  REQUIRE(nodes.controller->says(flush_of(1)));
  // CURVE ends a connection at the first corrupted byte, and the next one is there within beats: so
  // often that a beat is missed, however slow the machine.
  FaultRow row(keys ? "one byte in 5000 of a worker's is harmed, with keys"
                    : "one byte in 50 000 of a worker's is harmed, without keys",
               *nodes.controller);
  cluster.proxy->order(keys ? "harm 5000" : "harm 50000");
  // Detected by the check of a frame; or by CURVE, which then ends the connection.
  row.noticed(keys ? of_link("suspect", 2, 1) : "net=malformed node=2 neighbour=1 ");
  row.healed();
  cluster.proxy->order("heal");
  row.well(flush_of(1));
  end_with_same_bits(folder, nodes, row);
}

TEST_CASE("a node whose thread is stuck is given up while its process lives, and comes back",
          "[cluster][faults]") {
  const TemporaryFolder folder;
  ClusterText text = over_tcp(quick(3));
  // Its process answers for it on the wire, and has another node that keeps working.
  for (const char* name : {"n1", "n2"}) text.of_node[name] = "process = \"pair\"\n";
  text.more += "[[faults.event]]\nkind = \"pause\"\nnode = \"n1\"\nat_s = 5\nlasts_s = 1.5\n";
  const std::string cluster = write_cluster(folder, text);
  RunningCluster nodes;
  nodes.controller = node(cluster, "controller");
  nodes.workers.push_back(node(cluster, "n0"));
  nodes.workers.push_back(std::make_unique<Process>(
      LUX_PROGRAM,
      std::vector<std::string>{"node", "--config", cluster, "--name", "n1", "--name", "n2"}));
  nodes.await_begin();
  FaultRow row("the thread of a node is stuck for 1.5 s", *nodes.controller);
  REQUIRE(nodes.workers[1]->says("fault=pause node=1"));
  row.begins();
  row.noticed(of_link("suspect", 3, 1));
  row.given_up(lost(1));
  REQUIRE(nodes.controller->says(flush_of(2), nodes.controller->now()));
  row.well(flush_of(1));
  end_with_same_bits(folder, nodes, row);
}

TEST_CASE("the holder of objects that all nodes request may be killed, with the same bits",
          "[cluster][faults]") {
  const TemporaryFolder folder;
  const RunningCluster nodes = start(write_cluster(folder, over_tcp(fetching(boxes(folder)))), 3);
  REQUIRE(nodes.controller->says(flush_of(2)));
  FaultRow row("one of two holders of all objects is killed", *nodes.controller);
  nodes.workers[0]->kill(SIGKILL);
  row.noticed(change_of(3, 0));
  row.given_up(lost(0));
  row.well(flush_of(2));
  nodes.end();
  INFO(nodes.controller->text());
  check_goes_on(folder, 4'000, boxes(folder), cells_of(folder));
  row.end("same bits");
}

TEST_CASE("particles that need objects without a holder are lost, and the run says so",
          "[cluster][faults]") {
  const TemporaryFolder folder;
  const std::string pack = (folder / "boxes.luxpack").string();
  const std::string skeleton = (folder / "skeleton.luxpack").string();
  REQUIRE(run_luxodus(folder, "pack " + boxes(folder) + " --cell-kib 16 --out " + pack).code == 0);
  REQUIRE(run_luxodus(folder, "pack " + pack + " --skeleton-only --out " + skeleton).code == 0);
  ClusterText text = over_tcp(fetching(pack));
  text.more.insert(text.more.find("lost_s"), "fetch_attempts = 1\n");
  const std::string cluster = write_cluster(folder, text);
  text.scene = skeleton;
  RunningCluster nodes;
  nodes.controller = node(cluster, "controller");
  for (const char* name : {"n0", "n1"}) nodes.workers.push_back(node(cluster, name));
  nodes.workers.push_back(node(write_cluster(folder, text, "of_n2"), "n2"));
  nodes.await_begin();
  REQUIRE(nodes.controller->says(flush_of(2)));
  FaultRow row("both holders of all objects are killed", *nodes.controller);
  nodes.workers[0]->kill(SIGKILL);
  nodes.workers[1]->kill(SIGKILL);
  row.noticed(change_of(3, 0));
  row.given_up("run=lost batches=");
  CHECK(nodes.controller->wait() == 1);
  INFO(nodes.controller->text() << nodes.workers[2]->text());
  CHECK(nodes.controller->said("lease=given_back"));
  CHECK(nodes.controller->said(" particles are lost: "));
  CHECK(nodes.workers[2]->wait() == 0);
  const std::string result = slurp(folder / "out" / "result.json");
  CHECK(result.find("\"stopped_by\": \"objects lost\"") != std::string::npos);
  // The result consists of whole batches, and lists the missing ones.
  check_goes_on(folder, 4'000, pack);
  row.end("exit 1, the particles that are lost, and what can be gone on from");
}

TEST_CASE("a second process under a node's name on its host ends, and the first continues",
          "[cluster][faults]") {
  const TemporaryFolder folder;
  const std::string cluster = write_cluster(folder, over_tcp(quick(2)));
  const RunningCluster nodes = start(cluster, 2);
  REQUIRE(nodes.controller->says(flush_of(1)));
  FaultRow row("a node is started twice on its host", *nodes.controller);
  const auto twin = node(cluster, "n1");
  CHECK(twin->wait() == 1);
  INFO(twin->text());
  CHECK(twin->said("cannot listen there: Address already in use"));
  row.well(flush_of(1));
  CHECK_FALSE(nodes.controller->said(lost(1)));
  end_with_same_bits(folder, nodes, row);
}

TEST_CASE("a second process under a node's name on another host does not affect the result",
          "[cluster][faults]") {
  const TemporaryFolder folder;
  ClusterText text = over_tcp(quick(3));
  const std::string cluster = write_cluster(folder, text);
  text.ports[1] = free_ports(1).front();  // a port that nobody connects to
  const std::string of_twin = write_cluster(folder, text, "of_twin");
  const RunningCluster nodes = start(cluster, 3);
  REQUIRE(nodes.controller->says(flush_of(1)));
  FaultRow row("a node is started twice, on two hosts", *nodes.controller);
  const auto twin = node(of_twin, "n1");
  REQUIRE(nodes.controller->says(flush_of(0), nodes.controller->now()));
  row.well(flush_of(0));
  end_with_same_bits(folder, nodes, row);
}

TEST_CASE("a metrics client that reads nothing blocks nobody", "[cluster][faults]") {
  const TemporaryFolder folder;
  ClusterText text = over_tcp(quick(2));
  std::vector<uint16_t> pages = free_ports(2);  // its three processes use these in order
  while (pages[1] != pages[0] + 2) pages = {pages[1], free_ports(1).front()};
  text.more.insert(text.more.find("log_level"),
                   "metrics_port = " + std::to_string(pages[0]) + "\n");
  const RunningCluster nodes = start(write_cluster(folder, text), 2);
  REQUIRE(nodes.controller->says(flush_of(1)));
  FaultRow row("ten who look at each process, and read nothing", *nodes.controller);
  std::vector<int> lookers;
  for (int i = 0; i < 30; ++i) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    place.sin_port = htons(static_cast<uint16_t>(pages[0] + i % 3));
    lookers.push_back(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    REQUIRE(::connect(lookers.back(), reinterpret_cast<sockaddr*>(&place), sizeof place) == 0);
    const std::string host = "127.0.0.1:" + std::to_string(pages[0] + i % 3);
    const std::string asked =
        i % 2 == 0 ? "GET /metrics HTTP/1.1\r\nHost: " + host + "\r\n\r\n" : "GET /met";
    CHECK(::send(lookers.back(), asked.data(), asked.size(), MSG_NOSIGNAL) > 0);
  }
  for (int i = 0; i < 3; ++i) REQUIRE(nodes.controller->says(flush_of(1), nodes.controller->now()));
  row.well(flush_of(0));
  CHECK_FALSE(nodes.controller->said("worker=lost"));
  end_with_same_bits(folder, nodes, row);
  for (const int looker : lookers) ::close(looker);
}
