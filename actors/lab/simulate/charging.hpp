// Production parts of a node that work as usual and advance the node's virtual clock by the cost of
// the work. Time passes where the work is done: between two objects on a ray, not at the end of its
// particle, so that one fiber's waits overlap with other fibers' computation as on a real node.
// Thread rule: the simulation's thread.
#pragma once

#include <memory>

#include "actors/cast/node/node_setup.hpp"
#include "actors/lab/simulate/sim_costs.hpp"
#include "runtime/sim/sim_clock.hpp"

namespace luxodus {

/// Charges fractions of a nanosecond to a clock: the remainder is charged later.
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

/// Real tracing. All makers require: the clock outlives what they make.
TracerMaker charged_tracers(SimClock& clock, const SimCosts& costs);
/// Real building by `make`.
BuilderMaker charged_builders(SimClock& clock, const SimCosts& costs, const BuilderMaker& make);

}  // namespace luxodus
