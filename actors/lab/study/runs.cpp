#include "actors/lab/study/runs.hpp"

#include <fmt/format.h>

#include <cmath>

#include "actors/cast/parts/scene_objects.hpp"
#include "topology/builders.hpp"
#include "topology/shipped.hpp"

namespace luxodus {

namespace {

constexpr uint32_t controller_links = 4;
/// Runs of the search for a minimum-path graph that does not ship.
constexpr uint32_t amp_runs = 4;

Result<Graph> named_graph(const std::string& topology, uint32_t nodes, uint32_t links) {
  if (topology == "amp") {
    AmpRequest request;
    request.nodes = nodes;
    request.links = links;
    request.runs = amp_runs;
    return minimum_path_graph(request);
  }
  if (topology == "torus") return make_torus(nodes);
  if (topology == "mesh") return make_mesh(nodes);
  if (topology == "hypercube") return make_hypercube(nodes);
  if (topology == "ring") return make_ring(nodes);
  if (topology == "chordal-ring") return make_chordal_ring(nodes);
  if (topology == "ternary-tree") return make_ternary_tree(nodes);
  return make_random_regular(nodes, links, 1);
}

}  // namespace

Result<Graph> study_graph(const std::string& topology, uint32_t nodes, uint32_t links) {
  auto graph = named_graph(topology, nodes, links);
  if (!graph) return graph;
  return with_controller(graph.value(), controller_links);
}

int64_t particles_of(const Study& study, const StudyPoint& point) {
  const bool weak = study.word(point, "scaling") == "weak";
  return study.whole(point, "particles") * (weak ? study.whole(point, "nodes") : 1);
}

Result<NodesOptions> nodes_of(const StudyRun& run) {
  const auto number = [&](const char* key) { return run.study.number(run.point, key); };
  const auto whole = [&](const char* key) { return run.study.whole(run.point, key); };
  NodesOptions nodes;
  nodes.nodes = static_cast<int>(whole("nodes"));
  nodes.links = static_cast<int>(whole("links"));
  nodes.fan_out = static_cast<uint32_t>(whole("fan_out"));
  nodes.tally_shards = static_cast<int>(whole("tally_shards"));
  auto graph = study_graph(run.study.word(run.point, "topology"),
                           static_cast<uint32_t>(nodes.nodes), static_cast<uint32_t>(nodes.links));
  if (!graph) return graph.problem();
  nodes.graph = std::move(graph).value();
  nodes.fibers = static_cast<size_t>(whole("fibers"));
  nodes.prefetch = static_cast<size_t>(whole("prefetch"));
  nodes.profile_share = number("profile");
  nodes.sharing = false;  // each stands for a machine
  nodes.link_delay = std::llround(1e6 * number("delay_ms"));
  nodes.link_bytes_per_second = number("bytes_per_second");
  nodes.lease_time = std::llround(1e9 * number("lease_s"));
  if (number("cache") > 0)
    nodes.object_bytes =
        static_cast<size_t>(number("cache") * static_cast<double>(built_bytes_of(*run.scene)));
  // Only a plan pins objects.
  if (nodes.profile_share <= 0) nodes.pinned_share = 0;
  return nodes;
}

}  // namespace luxodus
