// Fault injection: what every link does to frames, and what happens to nodes and links at given
// moments. It works on real links (faulty_transport.hpp) and in a simulated world. Plain values,
// read from a file or drawn from a seed; LinkTroubles belongs to one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/core/clock.hpp"
#include "runtime/core/ids.hpp"
#include "runtime/core/random.hpp"

namespace luxodus {

/// Behaviour of every link, in each direction. Shares are fractions of frames.
struct LinkTraits {
  Nanoseconds delay = 0;   // one way, minimum
  Nanoseconds jitter = 0;  // uniform, on top of `delay`
  double tail_share = 0;   // frames that take up to `tail` longer
  Nanoseconds tail = 0;
  double bytes_per_second = 0;   // 0: unlimited
  size_t queue_bytes = 4 << 20;  // in flight at once; beyond it a link is full
  double loss = 0;
  double duplication = 0;
  double reordering = 0;  // overtaken by frames sent within `tail`
  double corruption = 0;  // with a few bits flipped
  double ghosts = 0;      // delivered once more, seconds later, to the name's owner by then

  /// Whether a link deviates from a perfect one.
  bool any() const {
    return delay > 0 || jitter > 0 || tail_share > 0 || bytes_per_second > 0 || loss > 0 ||
           duplication > 0 || reordering > 0 || corruption > 0 || ghosts > 0;
  }
};

struct Fault {
  enum class Kind : uint8_t {
    crash,  // node: loses its state and goes; in a simulation it restarts after `lasts`
    pause,  // node: it stops while its clock goes on
    slow,   // node: all its work takes `factor` times as long
    cut,    // node to peer: frames are lost silently
    clog,   // node to peer: frames wait until the fault is over
    // node and peer: the connection breaks, frames in flight are lost, both are notified
    disconnect,
    full_disk,    // node: its writes to the journal fail
    failed_read,  // node: its reads of objects fail, as from a broken disk
    failure       // node: the next handler of its `actor` throws
  };
  Kind kind = Kind::crash;
  Nanoseconds at = 0;  // since the start
  Nanoseconds lasts = 0;
  NodeId node;  // or the sender
  NodeId peer;  // the receiver
  double factor = 1;
  /// In a simulated world, instead of `at`: after this number of events.
  std::optional<uint64_t> after_events = {};
  std::string actor = {};  // for `failure`: the actor's name on the node

  bool holds(Nanoseconds moment) const { return moment >= at && moment < at + lasts; }
};

inline constexpr int fault_kinds = 9;
/// The kinds that swarm() draws: all but the last.
inline constexpr int drawn_fault_kinds = 8;
constexpr const char* name_of(Fault::Kind kind) {
  constexpr const char* names[] = {"crash",      "pause",     "slow",        "cut",    "clog",
                                   "disconnect", "full_disk", "failed_read", "failure"};
  return names[static_cast<size_t>(kind)];
}

struct FaultPlan {
  uint64_t seed = 1;
  LinkTraits links;
  std::vector<Fault> faults;  // in any order
  /// In a simulated world: the index of one frame to lose, counted from 0 in the order of sending.
  std::optional<uint64_t> lost_frame = {};
  /// From this moment on links only delay, and no new fault begins.
  Nanoseconds healed_at = std::numeric_limits<Nanoseconds>::max();

  bool any() const { return links.any() || !faults.empty(); }
  /// Whether a fault of this kind holds at a node at `moment` since the start.
  bool holds(Fault::Kind kind, NodeId node, Nanoseconds moment) const;
};

/// What a link does to one frame.
struct FrameFate {
  Nanoseconds hold = 0;  // until it arrives, beside the frames ahead of it on the wire
  bool lost = false;
  bool harmed = false;
  bool overtaken = false;            // exempt from the order of frames
  std::optional<Nanoseconds> again;  // a copy arrives this much later
  std::optional<Nanoseconds> ghost;  // likewise, even on a later connection
};

/// Draws fates, in the order in which frames are sent.
class LinkTroubles {
 public:
  LinkTroubles(const LinkTraits& traits, uint64_t seed, uint64_t stream)
      : traits_(traits), random_(seed, RandomStream::simulation) {
    random_.start(stream);
  }

  /// `healed`: the frame is only delayed.
  FrameFate next(bool healed);
  /// Flips a few bits.
  void harm(std::span<std::byte> bytes);
  /// How long a frame of `bytes` occupies the wire.
  Nanoseconds wire_time(size_t bytes) const;

 private:
  bool chance(double share) { return share > 0 && random_.uniform_double() < share; }
  Nanoseconds uniform(Nanoseconds most);

  const LinkTraits traits_;
  Random random_;
};

}  // namespace luxodus
