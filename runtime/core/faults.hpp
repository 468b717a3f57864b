// What shall go wrong, on purpose: what every link does to frames, and what happens to nodes and
// links at given moments. The same on real links (faulty_transport.hpp) and in a simulated world.
// Plain values, read from a file or drawn from a seed.
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

/// Of every link, each way. Shares are of frames.
struct LinkTraits {
  Nanoseconds delay = 0;   // one way, at least
  Nanoseconds jitter = 0;  // on top, uniform
  double tail_share = 0;   // of frames that take up to `tail` longer
  Nanoseconds tail = 0;
  double bytes_per_second = 0;   // 0: as fast as may be
  size_t queue_bytes = 4 << 20;  // on the way at once; beyond it a link is full
  double loss = 0;
  double duplication = 0;
  double reordering = 0;  // overtaken by what is sent within `tail`
  double corruption = 0;  // with a few bits turned
  double ghosts = 0;      // come once more, seconds later, to whoever has the name by then

  /// Whether a link does anything of its own.
  bool any() const {
    return delay > 0 || jitter > 0 || tail_share > 0 || bytes_per_second > 0 || loss > 0 ||
           duplication > 0 || reordering > 0 || corruption > 0 || ghosts > 0;
  }
};

struct Fault {
  enum class Kind : uint8_t {
    crash,        // node: it is gone with all it knew; a simulated one begins anew after `lasts`
    pause,        // node: it stands still and its clock goes on
    slow,         // node: all its work takes `factor` as long
    cut,          // node to peer: frames are lost, nobody is told
    clog,         // node to peer: frames wait until it is over
    disconnect,   // node and peer: the connection breaks, frames on the way are lost, both are told
    full_disk,    // node: what it keeps for a crash finds no room
    failed_read,  // node: of the scene it reads nothing, as from a broken disk
    failure       // node: the next handler of its `actor` throws
  };
  Kind kind = Kind::crash;
  Nanoseconds at = 0;  // since the start
  Nanoseconds lasts = 0;
  NodeId node;  // or the sender
  NodeId peer;  // the receiver
  double factor = 1;
  /// In a simulated world, instead of `at`: after so many events.
  std::optional<uint64_t> after_events = {};
  std::string actor = {};  // of `failure`: its name on the node

  bool holds(Nanoseconds moment) const { return moment >= at && moment < at + lasts; }
};

inline constexpr int fault_kinds = 9;
/// Those that swarm() draws: all but the last.
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
  /// In a simulated world: one frame, counted from 0 as they are sent, that is lost.
  std::optional<uint64_t> lost_frame = {};
  /// From here on links only delay, and nothing new happens.
  Nanoseconds healed_at = std::numeric_limits<Nanoseconds>::max();

  bool any() const { return links.any() || !faults.empty(); }
  /// Whether a fault of this kind holds at a node, that far from the start.
  bool holds(Fault::Kind kind, NodeId node, Nanoseconds moment) const;
};

/// What a link does to one frame that was given to it.
struct FrameFate {
  Nanoseconds hold = 0;  // until it arrives, beside what is before it on the wire
  bool lost = false;
  bool harmed = false;
  bool overtaken = false;            // it keeps no order
  std::optional<Nanoseconds> again;  // a copy arrives so much later
  std::optional<Nanoseconds> ghost;  // likewise, whatever has become of the connection
};

/// Draws fates, in the order in which frames are sent.
class LinkTroubles {
 public:
  LinkTroubles(const LinkTraits& traits, uint64_t seed, uint64_t stream)
      : traits_(traits), random_(seed, RandomStream::simulation) {
    random_.start(stream);
  }

  /// `healed`: it is only delayed.
  FrameFate next(bool healed);
  /// Turns a few bits.
  void harm(std::span<std::byte> bytes);
  /// How long a frame of so many bytes keeps the wire busy.
  Nanoseconds wire_time(size_t bytes) const;

 private:
  bool chance(double share) { return share > 0 && random_.uniform_double() < share; }
  Nanoseconds uniform(Nanoseconds most);

  const LinkTraits traits_;
  Random random_;
};

}  // namespace luxodus
