// Named graphs, for comparison with minimum-path graphs. Each is numbered so that its rotation, if
// it has one, applies. Pure; any thread.
#pragma once

#include <cstdint>

#include "runtime/core/result.hpp"
#include "topology/graph.hpp"

namespace luxodus {

/// All builders. Errors: sizes beyond the limits, or without such a graph.

Result<Graph> make_ring(uint32_t nodes);

/// The most nearly square grid: 5 x 8 for 40; a path if the number is prime.
Result<Graph> make_mesh(uint32_t nodes);
/// A mesh with its borders joined; a ring if the number is prime.
Result<Graph> make_torus(uint32_t nodes);

/// Errors: also if `nodes` is no power of two.
Result<Graph> make_hypercube(uint32_t nodes);

/// Every node has three children, until the nodes run out.
Result<Graph> make_ternary_tree(uint32_t nodes);

/// Node v is linked to v +- 1 and v +- chord, with the chord that gives the shortest paths (a
/// circulant C(n; 1, s), or chordal ring).
Result<Graph> make_chordal_ring(uint32_t nodes);

/// A random graph with this many links per node: a circulant whose links are exchanged until its
/// order is lost. Errors: also if nodes x links is odd, or links >= nodes.
Result<Graph> make_random_regular(uint32_t nodes, uint32_t links, uint64_t seed);

/// Adds a controller that forwards nothing and is linked to `links` workers, spread over their
/// numbers; these workers get one link more. Errors: a controller exists, or the vertex limit is
/// reached.
Result<Graph> with_controller(const Graph& graph, uint32_t links);

}  // namespace luxodus
