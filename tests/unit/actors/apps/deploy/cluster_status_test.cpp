// The lines of `luxodus status`, made from the pages of the processes.
#include "actors/apps/deploy/cluster_status.hpp"

#include <catch2/catch.hpp>

#include "actors/cast/node/observation.hpp"

using namespace luxodus;

namespace {

AskedProcess process_of(const std::string& name, std::vector<std::string> nodes) {
  return {name, {"127.0.0.1", 1}, std::move(nodes)};
}

const std::string page_of_a =
    "luxodus_process_resident_bytes 1048576\n"
    "luxodus_node_info{node=\"a\",role=\"worker\",number=\"0\"} 1\n"
    "luxodus_led_by{node=\"a\"} 2\n"
    "luxodus_fibers_live{node=\"a\"} 40\n"
    "luxodus_mailbox_waiting{node=\"a\",actor=\"tracer\"} 2\n"
    "luxodus_mailbox_waiting{node=\"a\",actor=\"tally_shard\"} 3\n"
    "luxodus_mailbox_rejected_total{node=\"a\",actor=\"tracer\"} 1\n"
    "luxodus_actor_restarts_total{node=\"a\",actor=\"tracer\"} 0\n"
    "luxodus_actor_restarts_total{node=\"a\",actor=\"display\"} 2\n"
    "luxodus_cache_hits_total{node=\"a\"} 90\n"
    "luxodus_cache_misses_total{node=\"a\"} 4\n"
    "luxodus_cache_joined_total{node=\"a\"} 6\n"
    "luxodus_link_credit_bytes{node=\"a\",neighbour=\"b\"} 1000\n"
    "luxodus_link_credit_bytes{node=\"a\",neighbour=\"c\"} 24\n"
    "luxodus_batches_total{node=\"a\"} 12\n"
    "luxodus_link_phase{node=\"a\",neighbour=\"b\"} 2\n"
    "luxodus_link_phase{node=\"a\",neighbour=\"c\"} 3\n";

}  // namespace

TEST_CASE("a node's line has its own numbers, and the state seen by its neighbours",
          "[supervise][status]") {
  const std::vector<AskedProcess> processes{process_of("p", {"a"}), process_of("q", {"b", "c"})};
  const std::string page_of_others =
      "luxodus_node_info{node=\"b\",role=\"worker\",number=\"1\"} 1\n"
      "luxodus_led_by{node=\"b\"} 7\n"
      "luxodus_node_info{node=\"c\",role=\"controller\",number=\"2\"} 1\n"
      "luxodus_batches_counted_total{node=\"c\"} 30\n";
  const auto rows = status_of(processes, {page_of_a, page_of_others});
  REQUIRE(rows.size() == 3);
  CHECK(rows[0].node == "a");
  CHECK(rows[0].process == "p");
  CHECK(rows[0].state == NodeState::up);
  CHECK(rows[0].role == "worker");
  CHECK(rows[0].led_by == "c");
  CHECK(rows[1].led_by == "node 7");  // no page states its name
  CHECK(rows[2].led_by.empty());
  CHECK(rows[0].fibers == 40.0);
  CHECK(rows[0].letters == 5.0);
  CHECK(rows[0].letters_rejected == 1.0);
  CHECK(rows[0].restarts == 2.0);
  CHECK_FALSE(rows[1].letters.has_value());
  CHECK(rows[0].hit_rate == 0.9);
  CHECK(rows[0].credit_bytes == 1024.0);
  CHECK(rows[0].batches == 12.0);
  CHECK(rows[0].process_bytes == 1048576.0);
  CHECK_FALSE(rows[0].resident_bytes.has_value());
  CHECK(rows[1].state == NodeState::up);
  CHECK(rows[2].state == NodeState::suspect);
  CHECK(rows[2].role == "controller");
  CHECK(rows[2].batches == 30.0);
}

TEST_CASE("nodes of a process that does not answer are down, each with the reason",
          "[supervise][status]") {
  const std::vector<AskedProcess> processes{process_of("p", {"a"}), process_of("q", {"b", "c"}),
                                            process_of("r", {"d"})};
  const auto rows =
      status_of(processes, {page_of_a, problem("127.0.0.1:1: Connection refused"), std::string()});
  REQUIRE(rows.size() == 4);
  CHECK(rows[0].state == NodeState::up);
  CHECK(rows[1].state == NodeState::down);
  CHECK(rows[2].state == NodeState::down);
  CHECK(rows[3].state == NodeState::starting);
  const std::string table = status_table(rows);
  CHECK(std::count(table.begin(), table.end(), '\n') == 5);
  CHECK(table.find("Connection refused") != std::string::npos);
  CHECK(table.find(" \n") == std::string::npos);
}

TEST_CASE("status reads the pages that processes serve about their nodes", "[supervise][status]") {
  ObserveOptions options;
  options.metrics_port = 0;
  const auto seen = Observation::start(options);
  REQUIRE(seen.ok());
  uint64_t batches = 3;
  for (const char* name : {"n0", "n1", "n0"}) {  // the second n0 is of a later run
    auto metrics = std::make_unique<Metrics>(name);
    metrics->add_counter({"batches", "", "Batches.", ""}, batches);
    Metrics& shown = seen.value()->show(std::move(metrics));
    ++batches;
    REQUIRE(shown.publish());
  }
  AskedProcess process;
  process.url = {"127.0.0.1", seen.value()->port().value()};
  const auto rows = status_of({process}, ask({process}, seconds(30)));
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].node == "n0");
  CHECK(rows[0].batches == 6.0);
  CHECK(rows[1].batches == 5.0);
  CHECK(rows[0].process_bytes.value_or(0) > 0);
}

TEST_CASE("a cluster without a metrics port gets a message with the missing key",
          "[supervise][status]") {
  ClusterConfig cluster;
  cluster.file = "c.toml";
  cluster.hosts.push_back({"here", "10.0.0.1", "*", 27600});
  cluster.nodes.push_back({"a", NodeRole::worker, true, true, 0, 0, 27600, {}});
  cluster.processes.push_back({"a", 0, {NodeId{0}}, 0});
  cluster.observe.metrics_address = "0.0.0.0";
  const auto none = processes_of(cluster);
  REQUIRE_FALSE(none.ok());
  CHECK(none.problem().what.find("metrics_port") != std::string::npos);
  cluster.processes[0].metrics_port = 9464;
  const auto asked = processes_of(cluster);
  REQUIRE(asked.ok());
  CHECK(asked.value()[0].url.text() == "http://10.0.0.1:9464/metrics");
  CHECK(asked.value()[0].nodes == std::vector<std::string>{"a"});
  cluster.observe.metrics_address = "127.0.0.1";
  CHECK(processes_of(cluster).value()[0].url.host == "127.0.0.1");
}
