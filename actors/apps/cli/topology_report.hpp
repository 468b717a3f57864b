// Reports of `luxodus topology` about graphs: text, and JSON for programs. Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "actors/results/formats/json_out.hpp"
#include "topology/graph.hpp"
#include "topology/measure.hpp"

namespace luxodus::cli {

/// "32 nodes, 64 links (at most 4 a node), rotation 4".
std::string title_of(const Graph& graph);

std::string measures_text(const Graph& graph, const Measures& measures);
Json measures_json(const Graph& graph, const Measures& measures);

/// A graph to compare with others of as many nodes, or why there is none.
struct Compared {
  std::string name;
  std::optional<Graph> graph;
  std::string why_not;
};

std::string comparison_text(const std::vector<Compared>& graphs);
Json comparison_json(const std::vector<Compared>& graphs);

}  // namespace luxodus::cli
