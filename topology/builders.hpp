// Graphs with a name, which a minimum-path graph is compared with. Each is numbered so that its
// rotation, where it has one, shows. Pure; any thread.
#pragma once

#include <cstdint>

#include "runtime/core/result.hpp"
#include "topology/graph.hpp"

namespace luxodus {

/// All builders. Errors: sizes beyond the limits, or with which there is no such graph.

Result<Graph> make_ring(uint32_t nodes);

/// As near to a square as the nodes divide: 5 x 8 for 40; a path where the nodes are a prime.
Result<Graph> make_mesh(uint32_t nodes);
/// The same with its borders joined; a ring where the nodes are a prime.
Result<Graph> make_torus(uint32_t nodes);

/// Errors: also if nodes are no power of two.
Result<Graph> make_hypercube(uint32_t nodes);

/// Every node has three children, as far as the nodes last.
Result<Graph> make_ternary_tree(uint32_t nodes);

/// Node v is linked to v +- 1 and v +- chord, with the chord for which the paths are shortest
/// (a circulant C(n; 1, s), or chordal ring).
Result<Graph> make_chordal_ring(uint32_t nodes);

/// Joined at random with so many links a node: a chordal ring of many chords whose links were
/// exchanged until nothing of it is left. Errors: also if nodes x links is odd, or links >= nodes.
Result<Graph> make_random_regular(uint32_t nodes, uint32_t links, uint64_t seed);

/// The same workers and a controller that forwards nothing, linked to so many of them, spread over
/// their numbers. These workers then have a link more. Errors: a controller already; no vertex
/// left.
Result<Graph> with_controller(const Graph& graph, uint32_t links);

}  // namespace luxodus
