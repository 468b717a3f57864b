// Costs of work on a simulated node [ns], as measured on a real machine (`luxodus study calibrate`)
// or assumed. Everything that is not listed takes no virtual time. Plain values; any thread.
#pragma once

#include "runtime/core/clock.hpp"

namespace luxodus {

struct SimCosts {
  // Tracing.
  double particle_ns = 10'000;  // of a particle: its birth, and its share of a portion
  double ray_ns = 0;            // of a flight: free path, candidates, the event at its end
  double collision_ns = 0;      // of a collision with a medium, in addition
  double reference_ns = 0;      // of an access to a resident object by a ray
  double look_ns = 0;           // of a unit of eye paths, without its references
  // The node's loop.
  double switch_ns = 0;  // of a fiber that resumes and suspends
  double turn_ns = 1000;
  // Objects.
  double build_ns = 0;       // of any object
  double build_byte_ns = 0;  // in addition, per serialised byte
  // What is counted.
  double lease_ns = 0;       // of opening and closing a batch and merging it into a node's totals
  double pack_byte_ns = 0;   // of a flush, at the worker
  double count_byte_ns = 0;  // of a flush, at the controller
  // Links.
  double receive_ns = 2000;  // of a frame
  double send_ns = 0;
  double frame_byte_ns = 0;  // at either end
  double wake_ns = 0;        // latency until an idle node sees an arrival; not CPU time
  double rest_ns = 0;        // of going idle and waking again

  friend bool operator==(const SimCosts&, const SimCosts&) = default;
};

constexpr Nanoseconds whole_ns(double span_ns) {
  return static_cast<Nanoseconds>(span_ns + 0.5);
}

}  // namespace luxodus
