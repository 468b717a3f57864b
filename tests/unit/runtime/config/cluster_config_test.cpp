#include "runtime/config/cluster_config.hpp"

#include <filesystem>
#include <set>

#include "tests/unit/runtime/config/cluster_kit.hpp"

namespace luxodus {
namespace {

constexpr NodeId id(uint16_t n) {
  return NodeId{n};
}

/// On host a: n0 and n1 in one process, m alone; on host b: the controller, number 3.
const std::string mixed = run_part + "id = 255\n" + two_hosts("10.0.0.1", "lux2") +
                          "[keys]\nfolder = \"k\"\n" + controller_part + "host = \"b\"\n" +
                          worker_part + "count = 2\nhost = \"a\"\nprocess = \"p\"\n" +
                          "[[node]]\nname = \"m\"\nhost = \"a\"\n";
const std::vector<Edge> all_edges{{id(0), id(1)}, {id(0), id(2)}, {id(0), id(3)},
                                  {id(1), id(2)}, {id(1), id(3)}, {id(2), id(3)}};

}  // namespace

TEST_CASE("workers are numbered in the order of the file and the controller is the last",
          "[runtime][config]") {
  const ClusterConfig cluster = good(mixed);
  CHECK(cluster.workers() == 3);
  CHECK(find_node(cluster, "n0") == id(0));
  CHECK(find_node(cluster, "m") == id(2));
  CHECK(find_node(cluster, "c") == cluster.controller());
  CHECK_FALSE(find_node(cluster, "x").has_value());
  REQUIRE(cluster.processes.size() == 3);
  CHECK(cluster.processes[0].nodes == std::vector<NodeId>{id(0), id(1)});
  CHECK(cluster.processes[2].name == "c");
}

TEST_CASE("a link is memory in a process, a local socket on a host, TCP beyond",
          "[runtime][config]") {
  const ClusterConfig cluster = good(mixed);
  CHECK(carrier_between(cluster, id(0), id(1)) == Carrier::memory);
  CHECK(carrier_between(cluster, id(1), id(2)) == Carrier::local);
  CHECK(carrier_between(cluster, id(2), id(3)) == Carrier::tcp);
  const ClusterConfig loud = good(mixed + "[links]\nsame_host = \"tcp\"\n");
  CHECK(carrier_between(loud, id(0), id(1)) == Carrier::memory);
  CHECK(carrier_between(loud, id(1), id(2)) == Carrier::tcp);
}

TEST_CASE("of two neighbours one listens where the other connects to", "[runtime][config]") {
  // Host b is known by name, which cannot be bound: there it listens to all.
  const ClusterConfig cluster = good(mixed);
  std::set<std::string> listening;
  for (uint16_t n = 0; n < 4; ++n) {
    for (const Endpoints& e : links_of(cluster, id(n), all_edges).listen) {
      CHECK(listening.insert(e.control).second);
      CHECK(listening.insert(e.bulk).second);
    }
  }
  for (uint16_t n = 0; n < 4; ++n) {
    const NodeLinks links = links_of(cluster, id(n), all_edges);
    CHECK(links.connect.size() == n);
    for (const auto& [neighbour, where] : links.connect) {
      CHECK(neighbour < id(n));
      CHECK(listening.count(where.control) == 1);
      CHECK(listening.count(where.bulk) == 1);
    }
  }
  const auto of_first = links_of(cluster, id(0), all_edges).listen;
  REQUIRE(of_first.size() == 3);
  CHECK(of_first[0].control == "inproc://luxodus/r/ff/n0.control");
  CHECK(of_first[1].bulk == "ipc://@luxodus/r/ff/n0.bulk");
  CHECK(of_first[2].control == "tcp://10.0.0.1:27600");
  CHECK(links_of(cluster, id(3), all_edges).listen.empty());
  CHECK(cluster.hosts[1].listen == "*");
}

TEST_CASE("ports follow from the host's first port unless they are given", "[runtime][config]") {
  const ClusterConfig cluster = good(
      mixed + "port = 5000\n[observe]\nmetrics_port = 9000\nallow_host = \"lux.example.org\"\n");
  CHECK(cluster.observe.allow_host == "lux.example.org");
  CHECK(cluster.nodes[0].port == 27600);
  CHECK(cluster.nodes[1].port == 27602);
  CHECK(cluster.nodes[2].port == 5000);
  CHECK(cluster.nodes[3].port == 27600);  // on another host
  CHECK(cluster.processes[0].metrics_port == 9000);
  CHECK(cluster.processes[1].metrics_port == 9001);
  CHECK(cluster.processes[2].metrics_port == 9000);
}

TEST_CASE("only links that can leave a host need keys", "[runtime][config]") {
  CHECK_FALSE(uses_tcp(good(small_cluster)));
  CHECK(leaves_host(good(mixed)));
  const std::string tcp = "[links]\nsame_host = \"tcp\"\n";
  const ClusterConfig loopback = good(small_cluster + tcp);
  CHECK(uses_tcp(loopback));
  CHECK_FALSE(leaves_host(loopback));
  CHECK(only_problem(run_part + host_part + "listen = \"0.0.0.0\"\n" + controller_part +
                     worker_part + tcp)
            .what.find("no keys") != std::string::npos);
  // A name that only begins like a loopback address is no loopback address.
  CHECK(only_problem(run_part + host_part + "address = \"127.example.org\"\n" + controller_part +
                     worker_part + tcp)
            .what.find("no keys") != std::string::npos);
}

TEST_CASE("the longest names give local socket names that the system accepts",
          "[runtime][config]") {
  const std::string longest(limits::cluster_name_chars, 'x');
  const ClusterConfig cluster =
      good("[run]\nname = \"" + longest + "\"\nscene = \"s\"\nid = 9000000000000000000\n" +
           host_part + "[[node]]\nname = \"" + longest + "\"\n" + controller_part);
  const std::vector<Edge> edges{{id(0), id(1)}};
  const std::string name = links_of(cluster, id(0), edges).listen.at(0).control;
  constexpr size_t max_sun_path = 107;  // unix(7)
  CHECK(name.size() - std::string("ipc://").size() <= max_sun_path);
}

TEST_CASE("a node's network has the run's level and id, and its own number", "[runtime][config]") {
  const ClusterConfig cluster = good(mixed + "[links]\nhop_limit = 7\nbulk_window_chunks = 32\n");
  const NetConfig net = net_config(cluster, id(2));
  CHECK(net.self == id(2));
  CHECK(net.nodes == 4);
  CHECK(net.hop_limit == 7);
  CHECK(net.bulk_window_bytes == 2 * defaults::bulk_window_bytes);
  CHECK(net.identity.run_id == 255);
  CHECK(net.identity.level == Level::bit);
  CHECK(net.identity.node == id(2));
}

TEST_CASE("names are valid as parts of file, unit and socket names", "[runtime][config]") {
  for (const char* name : {"n", "n0", "lux-1.example", "A_b", "0"}) CHECK(check_name(name));
  for (const char* name :
       {"", "-n", ".", "..", ".n", "a b", "a/b", "a'b", "a%b", "a\nb", "\xc3\xa9"})
    CHECK_FALSE(check_name(name));
  CHECK_FALSE(check_name(std::string(33, 'n')));
}

TEST_CASE("an address is four numbers or a host name", "[runtime][config]") {
  for (const char* address : {"10.0.0.1", "lux1", "lux-1.example.org", "localhost", "3com.com"})
    CHECK(check_address(address));
  for (const char* address : {"", "10.0.0", "10.0.0.256", "::1", "a..b", ".a", "a.", "-a", "a b",
                              "a:1", "*", "$(x)", "a/b"})
    CHECK_FALSE(check_address(address));
}

TEST_CASE("the shipped clusters are valid, and the shipped scenes that they name exist",
          "[runtime][config]") {
  namespace fs = std::filesystem;
  struct Row {
    const char* file;
    size_t hosts, workers, processes;
    bool keys;
  };
  for (const Row& row :
       {Row{"one_host.toml", 1, 8, 1, false}, Row{"three_hosts.toml", 3, 6, 7, true},
        Row{"eight_hosts.toml", 8, 32, 9, true}}) {
    const ReadCluster read =
        read_cluster(fs::path(LUX_SOURCE_DIR) / "actors/apps/cli/examples" / row.file);
    INFO(row.file << "\n" << all_problems(read));
    REQUIRE(read.cluster.has_value());
    CHECK(read.cluster->hosts.size() == row.hosts);
    CHECK(read.cluster->workers() == row.workers);
    CHECK(read.cluster->processes.size() == row.processes);
    CHECK(leaves_host(*read.cluster) == row.keys);
    CHECK(fs::exists(read.cluster->run.scene));
  }
}

TEST_CASE("a controller that traces has a worker for it in its process", "[runtime][config]") {
  const ClusterConfig alone = good(run_part + host_part + controller_part + "traces = true\n");
  REQUIRE(alone.nodes.size() == 2);
  CHECK(alone.nodes[0].name == "c-tracer");
  CHECK(alone.nodes[0].role == NodeRole::worker);
  CHECK(alone.node(alone.controller()).name == "c");
  REQUIRE(alone.processes.size() == 1);
  CHECK(alone.processes[0].name == "c");
  CHECK(alone.processes[0].nodes.size() == 2);
  const Problem taken = only_problem(run_part + host_part + controller_part +
                                     "traces = true\n[[node]]\nname = \"c-tracer\"\n");
  CHECK(taken.what.find("there is a node") != std::string::npos);
}

}  // namespace luxodus
