#include <filesystem>
#include <fstream>

#include "runtime/config/cluster_file.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/runtime/config/cluster_kit.hpp"

namespace luxodus {

namespace {
std::string wrong(const std::string& text) {
  return only_problem(text).text();
}
}  // namespace

TEST_CASE("a cluster without faults has none, and one with faults has those of its file",
          "[runtime][config]") {
  CHECK_FALSE(good(small_cluster).faults.any());
  const FaultPlan plan =
      good(
          small_cluster +
          "[faults]\nseed = 9\ndelay_ms = 1.5\nloss = 0.25\nqueue_bytes = \"1 MiB\"\nuntil_s = 10\n"
          "[[faults.event]]\nkind = \"cut\"\nnode = \"n\"\npeer = \"c\"\nat_s = 2\nlasts_s = 0.5\n"
          "[[faults.event]]\nkind = \"slow\"\nnode = \"c\"\nat_s = 3\nfactor = 4\n")
          .faults;
  CHECK(plan.any());
  CHECK(plan.seed == 9);
  CHECK(plan.links.delay == microseconds(1500));
  CHECK(plan.links.loss == 0.25);
  CHECK(plan.links.queue_bytes == 1 << 20);
  CHECK(plan.healed_at == seconds(10));
  REQUIRE(plan.faults.size() == 2);
  CHECK(plan.faults[0].kind == Fault::Kind::cut);
  CHECK(plan.faults[0].node == NodeId{0});
  CHECK(plan.faults[0].peer == NodeId{1});
  CHECK(plan.faults[0].at == seconds(2));
  CHECK(plan.faults[0].lasts == milliseconds(500));
  CHECK(plan.faults[1].kind == Fault::Kind::slow);
  CHECK(plan.faults[1].factor == 4);
  CHECK(plan.faults[1].lasts == seconds(1));
}

TEST_CASE("faults of unknown nodes, or without enough nodes, are reported with their line",
          "[runtime][config]") {
  const std::string event = "[[faults.event]]\nat_s = 1\n";
  CHECK(wrong(small_cluster + event + "kind = \"pause\"\nnode = \"m\"\n").find("no node \"m\"") !=
        std::string::npos);
  CHECK(wrong(small_cluster + event + "kind = \"cut\"\nnode = \"n\"\n").find("say 'peer'") !=
        std::string::npos);
  CHECK(wrong(small_cluster + event + "kind = \"pause\"\nnode = \"n\"\npeer = \"c\"\n")
            .find("between two") != std::string::npos);
  CHECK(wrong(small_cluster + event + "kind = \"failure\"\nnode = \"n\"\n").find("say 'actor'") !=
        std::string::npos);
  CHECK(wrong(small_cluster + event + "kind = \"pause\"\nnode = \"n\"\nactor = \"tracer\"\n")
            .find("'actor' is for") != std::string::npos);
  CHECK(wrong(small_cluster + event + "kind = \"flood\"\nnode = \"n\"\n").find("flood") !=
        std::string::npos);
  CHECK(wrong(small_cluster + event + "node = \"n\"\n").find("'kind' is missing") !=
        std::string::npos);
  CHECK(wrong(small_cluster + "[faults]\nloss = 1.5\n").find("loss") != std::string::npos);
}

TEST_CASE("a file with only faults refers to the given nodes", "[runtime][config]") {
  const test::TemporaryFolder folder;
  const auto path = folder.write("faults.toml",
                                 "[faults]\ncorruption = 0.5\n[[faults.event]]\nkind = \"crash\"\n"
                                 "node = \"second\"\nat_s = 1\n");
  const ReadFaults read = read_fault_file(path, {"first", "second"});
  REQUIRE(read.plan);
  CHECK(read.plan->links.corruption == 0.5);
  REQUIRE(read.plan->faults.size() == 1);
  CHECK(read.plan->faults[0].node == NodeId{1});
  const ReadFaults other = read_fault_file(path, {"first"});
  CHECK_FALSE(other.plan);
  REQUIRE(other.problems.list().size() == 1);
  CHECK(other.problems.list()[0].where.line == 5);
  std::filesystem::remove(path);
  CHECK_FALSE(read_fault_file(path, {"first"}).plan);
}

}  // namespace luxodus
