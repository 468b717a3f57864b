// A graph as a text that people read and other programs too: TOML, of which this reader takes
// exactly what the writer writes (comments and spacing are free). See README.md for an example.
// The text is all it knows: reading and writing files, whole or not at all, is the caller's.
// Pure; any thread.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "runtime/core/result.hpp"
#include "topology/graph.hpp"

namespace luxodus {

namespace limits {
/// Bytes of a graph's file: that of the complete graph of 65 vertices or of 1024 with 64 links
/// each, 33000 links of 14 bytes, is half of it.
inline constexpr size_t graph_file_bytes = size_t{1} << 20;
}  // namespace limits

/// The text of a graph: equal graphs, equal bytes.
std::string graph_text(const Graph& graph);

/// The graph of a text. `file` is named in what is wrong. Errors: the first thing that is wrong,
/// with its line: not this format or version, a key that is unknown, missing or given twice, a
/// number or link that cannot be, a graph that is none (fault_of), a hash that is not the graph's.
Result<Graph> parse_graph(std::string_view text, const std::string& file);

}  // namespace luxodus
