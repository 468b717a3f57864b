// Production parts of a node that do what they always do, and let the node's virtual clock pass as
// if it had taken what it costs. Time passes where the work is done: between two objects that a ray
// looks into, not at the end of its particle, so that what a fiber waits for overlaps with what
// others compute as it does on a real node.
// Thread rule: the simulation's thread.
#pragma once

#include <memory>

#include "actors/cast/node/node_setup.hpp"
#include "actors/lab/simulate/sim_costs.hpp"
#include "runtime/sim/sim_clock.hpp"

namespace luxodus {

/// A clock that is charged by fractions of a nanosecond: what is left over is charged later.
class Meter {
 public:
  /// Requires: `clock` outlives this.
  explicit Meter(SimClock& clock, Spent what = Spent::other) : clock_(clock), what_(what) {}
  void charge(double work_ns) {
    owed_ns_ += work_ns;
    const auto whole = static_cast<Nanoseconds>(owed_ns_);
    owed_ns_ -= static_cast<double>(whole);
    clock_.charge(whole, what_);
  }

 private:
  SimClock& clock_;
  const Spent what_;
  double owed_ns_ = 0;
};

/// Traces for real. Requires of all makers: the clock outlives what is made.
TracerMaker charged_tracers(SimClock& clock, const SimCosts& costs);
/// Has `make` build for real.
BuilderMaker charged_builders(SimClock& clock, const SimCosts& costs, const BuilderMaker& make);

}  // namespace luxodus
