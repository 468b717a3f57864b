// The tables that net_bench prints. One thread.
#pragma once

#include <cstddef>

#include "runtime/core/clock.hpp"

namespace luxodus::bench {

/// Round trips, requests and objects a second of the network alone, by transport; each figure is
/// measured for `span`.
void print_links(Nanoseconds span);
/// Objects a second that fibers fetch, and their processor time, by size and number of fibers; only
/// one row if these are given, that is, not 0.
void print_fetches(Nanoseconds span, size_t bytes, size_t fibers);
/// What an application of the library sees: requests a second, each measured for `span`; a killed
/// process; memory of a fiber. Requires: the process has no other threads.
void print_nodes(Nanoseconds span);

/// The same work by the runtime and by other libraries, in turn: each figure is measured seven
/// times for a quarter of `span`. Only one row of objects if these are given. Requires: the process
/// has no other threads.
void print_peers(Nanoseconds span, size_t bytes, size_t in_flight);

}  // namespace luxodus::bench
