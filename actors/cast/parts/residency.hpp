// Who traces what, who holds what, who keeps what: a plan for the nodes of a run that cannot hold
// its whole scene, made from a profile of references. Batches belong to source groups, so a node
// that prefers some groups asks for some objects; it pins those it visits most, and objects are
// held near the nodes that visit them. It says how often objects will be found resident, so that a
// wrong profile shows. It decides no result: any plan gives the same bits. Pure; any thread.
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
  std::vector<uint64_t> wire_bytes;         // by object: what it takes to hold it for all
  std::vector<uint64_t> built_bytes;        // by object: what it takes to have it ready
  std::vector<uint64_t> resident_bytes;     // by node: for built objects, the pinned included
  std::vector<uint64_t> pinned_bytes;       // by node: of these for pinned ones
  std::vector<std::vector<uint32_t>> hops;  // [node][node]
  uint32_t replicas = 1;
};

struct NodeResidency {
  /// By source group: 0 for that of which the node shall trace most, and so on.
  std::vector<uint32_t> group_ranks;
  std::vector<uint32_t> pins;  // objects, the most visited for their bytes first
  uint64_t pinned_bytes = 0;
  uint64_t held_bytes = 0;  // for all
  double expected_hit_rate = 0;
};

struct Residency {
  std::vector<NodeResidency> nodes;
  std::vector<std::vector<NodeId>> holders;  // by object, the best placed first
  double expected_hit_rate = 0;              // of all nodes' references
};

/// The plan. Groups lie on a line, each as long as its work and beside one that visits like
/// objects; nodes share the line evenly. Pins are those of most visits a byte. An object's holder
/// is where visits x hops are fewest among nodes that have room: none holds more than 1.5 times its
/// share. Requires: a share for each group; 1 <= replicas <= nodes; at least one node.
Residency plan_residency(const ResidencyRequest& request);

/// What one node asks of an object, in any unit that is the same for all.
struct ObjectDemand {
  double references = 0;
  double visits = 0;  // histories that come at all: at most `references`
  uint64_t bytes = 0;
};

/// The share of references that finds its object in a cache of `bytes` that lets the one unused for
/// the longest go. Visits come independently, so an object is there as it comes within the cache's
/// characteristic time (H. Che, Y. Tung, Z. Wang, "Hierarchical web caching systems", IEEE JSAC 20
/// (2002); for sizes: N. Choungmo Fofack et al., Computer Networks 65 (2014)); what a history
/// refers to again it finds. 1 where nothing is asked.
double lru_hit_rate(std::span<const ObjectDemand> objects, uint64_t bytes);

}  // namespace luxodus
