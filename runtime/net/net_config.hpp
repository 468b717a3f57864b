// Configuration of a node's network: its identity, its links, and its memory limits. Plain values;
// any thread.
#pragma once

#include <cstddef>
#include <vector>

#include "proto/messages.hpp"
#include "runtime/core/buggify.hpp"
#include "runtime/net/link_state.hpp"

namespace luxodus {

/// A link of the graph. Requires: a < b.
struct Edge {
  NodeId a, b;
  friend auto operator<=>(const Edge&, const Edge&) = default;
};
constexpr Edge edge_between(NodeId one, NodeId other) {
  return one < other ? Edge{one, other} : Edge{other, one};
}

/// Next hop for every destination; `no_node` if there is no route.
struct NextHops {
  std::vector<NodeId> next;
};
inline constexpr NodeId no_node{0xFFFF};

namespace defaults {
/// Chunk of an object or a flush: 0.5 ms of a 1 Gb/s link, so that others get their turn.
inline constexpr size_t bulk_chunk_bytes = 65536;
/// Chunk of urgent messages: at present none is longer.
inline constexpr size_t small_chunk_bytes = 4096;
/// Twice bandwidth x round trip, since grants come by half windows: 16 x (64 KB + overhead) covers
/// 4 Gb/s at 1 ms. Objects of 100 kB on one host took 1.5 times the processor time with 4 chunks.
/// The memory of a window is touched only as far as frames wait.
inline constexpr size_t bulk_window_bytes = 16 * (bulk_chunk_bytes + 128);
inline constexpr size_t small_window_bytes = 4 * (small_chunk_bytes + 128);
/// The graph of 32 nodes has diameter 3, and 5 after any three failures; larger graphs set more.
inline constexpr uint8_t hop_limit = 5;
/// Messages made here that wait for the network, per kind: one for each fetch of a burst; further
/// messages wait with their fibers.
inline constexpr size_t outbox_messages = 64;
/// Messages in several pieces that arrive at this node at once.
inline constexpr size_t assemblies = 64;
/// The longest message [bytes]: objects are far smaller.
inline constexpr size_t max_message_bytes = 64 << 20;
}  // namespace defaults

struct NetConfig {
  NodeId self;
  Incarnation incarnation;  // random, not 0
  Identity identity;
  size_t nodes = 0;         // in the run
  std::vector<Edge> edges;  // of the whole graph
  LinkTimes times;
  uint8_t hop_limit = defaults::hop_limit;
  size_t small_chunk_bytes = defaults::small_chunk_bytes;
  size_t bulk_chunk_bytes = defaults::bulk_chunk_bytes;
  size_t small_window_bytes = defaults::small_window_bytes;  // per pool
  size_t bulk_window_bytes = defaults::bulk_window_bytes;
  size_t outbox_messages = defaults::outbox_messages;
  size_t assemblies = defaults::assemblies;
  size_t max_message_bytes = defaults::max_message_bytes;
  /// Whether a link falls as soon as its connection is gone: a killed peer is known within
  /// milliseconds. Otherwise the peer has the time of missed beats to come back.
  bool falls_with_connection = false;
  Nanoseconds assembly_patience = seconds(10);  // without a new chunk
  Buggify* buggify = nullptr;                   // rare paths, or null

  size_t chunk_bytes(Kind kind) const {
    return is_bulk(kind) ? bulk_chunk_bytes : small_chunk_bytes;
  }
  size_t window_bytes(Kind kind) const {
    return is_bulk(kind) ? bulk_window_bytes : small_window_bytes;
  }
  static constexpr bool is_bulk(Kind kind) { return kind == Kind::reply || kind == Kind::commit; }
};

}  // namespace luxodus
