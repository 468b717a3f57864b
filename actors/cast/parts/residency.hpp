// The residency plan: which node traces, holds and pins what in a run whose nodes cannot hold the
// whole scene, computed from a reference profile. Batches belong to source groups, so a node that
// prefers some groups requests some objects; it pins those it visits most, and objects are held
// near the nodes that visit them. The plan includes an expected hit rate, so that a wrong profile
// shows. It affects no result: any plan gives the same bits. Pure; any thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "actors/cast/parts/reference_profile.hpp"

namespace luxodus {

struct ResidencyRequest {
  const ReferenceProfile& profile;
  std::vector<double> group_share;  // of all batches
  int64_t batch_particles = 0;
  std::vector<uint64_t> wire_bytes;         // by object: memory to hold it for all
  std::vector<uint64_t> built_bytes;        // by object: memory of the built object
  std::vector<uint64_t> resident_bytes;     // by node: for built objects, including pinned ones
  std::vector<uint64_t> pinned_bytes;       // by node: share of these for pinned objects
  std::vector<std::vector<uint32_t>> hops;  // [node][node]
  uint32_t replicas = 1;
};

struct NodeResidency {
  /// By source group: 0 for the group of which the node should trace most, and so on.
  std::vector<uint32_t> group_ranks;
  std::vector<uint32_t> pins;  // objects, the most visits per byte first
  uint64_t pinned_bytes = 0;
  uint64_t held_bytes = 0;  // held for all
  double expected_hit_rate = 0;
};

struct Residency {
  std::vector<NodeResidency> nodes;
  std::vector<std::vector<NodeId>> holders;  // by object, the best placed first
  double expected_hit_rate = 0;              // over all nodes' references
};

/// Computes the plan. Groups are placed on a line, each as long as its work and next to one with
/// similar visits; nodes share the line evenly. Pins have the most visits per byte. An object's
/// holder is where visits x hops are fewest among nodes with room: none holds more than 1.5 times
/// its share. Requires: a share for each group; 1 <= replicas <= nodes; at least one node.
Residency plan_residency(const ResidencyRequest& request);

/// Demand of one node for an object, in any common unit.
struct ObjectDemand {
  double references = 0;
  double visits = 0;  // histories that request it at all: at most `references`
  uint64_t bytes = 0;
};

/// Hit rate of an LRU cache of `bytes`. Visits are independent, so an object is resident if it was
/// visited within the cache's characteristic time (H. Che, Y. Tung, Z. Wang, "Hierarchical web
/// caching systems", IEEE JSAC 20 (2002); for sizes: N. Choungmo Fofack et al., Computer Networks
/// 65 (2014)); repeated references of a history are hits. 1 without references.
double lru_hit_rate(std::span<const ObjectDemand> objects, uint64_t bytes);

}  // namespace luxodus
