// The text format of a graph, for people and other programs: TOML, of which this reader accepts
// what the writer writes (comments and spacing are free). See README.md for an example. It does no
// input or output: the caller reads and writes files atomically. Pure; any thread.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "runtime/core/result.hpp"
#include "topology/graph.hpp"

namespace luxodus {

namespace limits {
/// Longest graph file [bytes]: the complete graph of 65 vertices, or 1024 with 64 links each (33000
/// links of 14 bytes), takes half of it.
inline constexpr size_t graph_file_bytes = size_t{1} << 20;
}  // namespace limits

/// The text of a graph; equal graphs give equal bytes.
std::string graph_text(const Graph& graph);

/// Parses a graph; messages name `file`. Errors: the first mistake, with its line: another format
/// or version, a key that is unknown, missing or duplicated, an impossible number or link, an
/// invalid graph (fault_of), a hash that does not match the graph.
Result<Graph> parse_graph(std::string_view text, const std::string& file);

}  // namespace luxodus
