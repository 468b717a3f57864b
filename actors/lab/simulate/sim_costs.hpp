// What work costs a node of a simulation [ns], as measured on a real machine (`luxodus study
// calibrate`) or as supposed. Everything that is not named here costs no virtual time. Plain
// values; any thread.
#pragma once

#include "runtime/core/clock.hpp"

namespace luxodus {

struct SimCosts {
  // Tracing.
  double particle_ns = 10'000;  // of a particle by itself: its birth, and its share of a portion
  double ray_ns = 0;            // of a flight: free path, candidates, the turn at its end
  double collision_ns = 0;      // of one with a medium, on top
  double reference_ns = 0;      // of an object that a ray looks into and that is resident
  double look_ns = 0;           // of a unit of eye paths, its references aside
  // The node's loop.
  double switch_ns = 0;  // of a fiber that runs and suspends
  double turn_ns = 1000;
  // Objects.
  double build_ns = 0;       // of any object
  double build_byte_ns = 0;  // on top, of each byte as it travels
  // What is counted.
  double lease_ns = 0;       // of a batch that is opened, closed and merged into a node's totals
  double pack_byte_ns = 0;   // of a flush, at the worker
  double count_byte_ns = 0;  // likewise, at the controller
  // Links.
  double receive_ns = 2000;  // of a frame
  double send_ns = 0;
  double frame_byte_ns = 0;  // at either end
  double wake_ns = 0;        // until a node that rests sees what has come; nobody's work
  double rest_ns = 0;        // of going to rest and waking again

  friend bool operator==(const SimCosts&, const SimCosts&) = default;
};

constexpr Nanoseconds whole_ns(double span_ns) {
  return static_cast<Nanoseconds>(span_ns + 0.5);
}

}  // namespace luxodus
