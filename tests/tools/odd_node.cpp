// odd_node CLUSTER NODE WHAT: a worker of a cluster that announces another protocol, isa, build or
// fingerprint than its own, like another version of the program, or another processor. Otherwise it
// is the worker of `luxodus node`. Exits with 1 and its reason.
#include <unistd.h>

#include <cstdio>
#include <string>

#include "actors/cast/process/cluster_process.hpp"
#include "actors/cast/process/node_threads.hpp"
#include "runtime/config/cluster_file.hpp"
#include "runtime/core/isolated_job.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"

using namespace luxodus;

namespace {

bool make_odd(Identity& identity, const std::string& what) {
  if (what == "protocol")
    ++identity.protocol;
  else if (what == "isa")
    identity.isa = "x86-64-v9";
  else if (what == "build")
    identity.build = "9.9.9";
  else if (what == "fingerprint")
    identity.fingerprint ^= 1;
  else
    return false;
  return true;
}

int run(const std::string& file, const std::string& name, const std::string& what) {
  const ReadCluster read = read_cluster(file);
  if (!read.cluster) return 2;
  const ClusterConfig& cluster = *read.cluster;
  const auto self = find_node(cluster, name);
  auto graph = graph_of(cluster);
  auto scene = read_scene(cluster.run.scene.string());
  if (!self || !graph.ok() || !scene.scene) return 2;
  const auto description = std::make_shared<const SceneDescription>(std::move(*scene.scene));
  auto compiled = compile_scene(description, find_scenario(*description, "").value(), {1});
  if (!compiled.ok()) return 2;
  const LocalRun local(compiled.value(), description->run.seed, 1);
  const SystemClock clock;
  ZmqContext context({});
  const RunSetup setup{local.scene(), &local.index(), nullptr, nullptr,
                       local.seed(),  graph.value(),  {},      nullptr};
  NodeSetup node;
  node.net = net_config(cluster, *self);
  node.net.incarnation = {static_cast<uint64_t>(::getpid())};
  complete(node.net, setup);
  if (!make_odd(node.net.identity, what)) return 2;
  node.links = links_of(cluster, *self, node.net.edges);
  node.controller = cluster.controller();
  node.start = cluster.timeouts.start;
  const auto ended = run_worker(setup, {clock, context}, node, [] { return false; });
  if (ended.ok()) return 0;
  std::fprintf(stderr, "%s\n", ended.problem().text().c_str());
  return 1;
}

}  // namespace

int main(int count, char** words) {
  if (const auto served = luxodus::serve_isolated_job(count, words)) return *served;
  if (count == 4) return run(words[1], words[2], words[3]);
  std::fprintf(stderr, "usage: odd_node CLUSTER NODE protocol|isa|build|fingerprint\n");
  return 2;
}
