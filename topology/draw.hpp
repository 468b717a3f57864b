// A graph as a picture: SVG to look at, DOT for Graphviz and other tools. Copies of one link by
// rotation have one colour. Equal graphs, equal bytes; no scripts, nothing from outside. Any
// thread.
#pragma once

#include <string>
#include <string_view>

#include "topology/graph.hpp"

namespace luxodus {

/// `title` stands above the drawing, as it is.
std::string graph_svg(const Graph& graph, std::string_view title);

/// With the same places, pinned: `neato -n` keeps them.
std::string graph_dot(const Graph& graph, std::string_view title);

}  // namespace luxodus
