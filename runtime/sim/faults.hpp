// What goes wrong in a simulated world: what every link does to frames, and what happens to nodes
// and links at given moments. Plain values, drawn from a seed or read from a file.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/core/clock.hpp"
#include "runtime/net/net_config.hpp"

namespace luxodus {

/// Of every link, each way. Shares are of frames.
struct LinkTraits {
  Nanoseconds delay = microseconds(50);   // one way, at least
  Nanoseconds jitter = microseconds(20);  // on top, uniform
  double tail_share = 0;                  // of frames that take `tail` longer
  Nanoseconds tail = milliseconds(50);
  double bytes_per_second = 1e9;
  size_t queue_bytes = 4 << 20;  // on the way at once; beyond it a link is full
  double loss = 0;
  double duplication = 0;
  double reordering = 0;  // overtaken by what is sent within `tail`
  double corruption = 0;  // with a few bits turned
  double ghosts = 0;      // kept back for seconds, and delivered to whoever has the name by then
};

struct Fault {
  enum class Kind : uint8_t {
    crash,      // node: it is gone with all it knew; begins anew after `lasts`
    pause,      // node: it stands still and its clock goes on
    slow,       // node: all its work takes `factor` as long
    cut,        // a to b: frames are lost, nobody is told
    clog,       // a to b: frames wait until it is over
    disconnect  // a and b: the connection breaks, frames on the way are lost, both are told
  };
  Kind kind = Kind::crash;
  Nanoseconds at = 0;
  Nanoseconds lasts = 0;
  NodeId node;  // or the sender
  NodeId peer;  // the receiver
  double factor = 1;
};

inline constexpr int fault_kinds = 6;
const char* name_of(Fault::Kind kind);

struct FaultPlan {
  LinkTraits links;
  std::vector<Fault> faults;  // in any order
  /// From here on links only delay, and nothing new happens.
  Nanoseconds healed_at = 0;
};

/// What a world of faults is drawn for.
struct SwarmFrame {
  std::vector<Edge> edges;
  uint16_t nodes = 0;
  /// Nodes that are never crashed.
  std::vector<NodeId> spared;
  Nanoseconds lasts = seconds(30);  // healed from then on
};

/// Which kinds of trouble there are at all is drawn first, so that every seed has a different mix;
/// then how much of each, and when.
FaultPlan swarm(uint64_t seed, const SwarmFrame& frame);

}  // namespace luxodus
