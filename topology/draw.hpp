// Drawings of a graph: SVG, and DOT for Graphviz and other tools. Links of one rotation family have
// one colour. Equal graphs give equal bytes; no scripts, no external resources. Pure; any thread.
#pragma once

#include <string>
#include <string_view>

#include "topology/graph.hpp"

namespace luxodus {

/// `title` is printed above the drawing.
std::string graph_svg(const Graph& graph, std::string_view title);

/// DOT with the same positions, pinned: `neato -n` keeps them.
std::string graph_dot(const Graph& graph, std::string_view title);

}  // namespace luxodus
