// Workers and controllers in a simulated world: production nodes with the world's clock and links,
// whose tracing takes virtual time. Thread rule: the simulation's thread.
#pragma once

#include "actors/cast/node/controller_node.hpp"
#include "actors/cast/node/worker.hpp"
#include "actors/lab/simulate/charging.hpp"
#include "runtime/core/result.hpp"
#include "runtime/sim/sim_world.hpp"

namespace luxodus {

/// A node whose invariants are checked.
class CheckedNode : public SimNode {
 public:
  /// Errors: the first of its invariants that does not hold. Cheap.
  virtual Result<void> check() const = 0;
  /// Errors: it has left without having done its part.
  virtual Result<void> outcome() const = 0;
  /// How long it trusts its workers' confirmations of the end.
  virtual Nanoseconds word_is_fresh() const { return 0; }
};

/// Makes all fibers return, as after a cancellation.
void end_fibers(Fibers& fibers);
/// Errors: what is wrong with the fibers of a node.
Result<void> check_fibers(const NodeShell& shell, const Fibers& fibers);

/// A node's access to the world, in which real work takes the time of its cost.
NodeSeams charged_seams(SimWorld& world, NodeId self, const SimCosts& costs,
                        const BuilderMaker& builders, Buggify* buggify = nullptr);

/// Builders of all nodes of a world, on one device: a thousand Embree devices need more memory maps
/// than a process may have.
BuilderMaker builders_on_one_device();

class SimWorker final : public CheckedNode {
 public:
  /// Adds the node's cache statistics to `all` at its end. Requires: all references outlive this;
  /// `clock` is that of the seams.
  SimWorker(const RunSetup& run, const NodeSetup& node, const NodeSeams& seams, SimClock& clock,
            const SimCosts& costs, WorkerReport& all);
  ~SimWorker() override;

  Nanoseconds turn() override;
  bool finished() const override { return worker_.shell().finished(); }
  void die() override;
  Result<void> check() const override;
  Result<void> outcome() const override;
  Nanoseconds word_is_fresh() const override {
    return worker_.coordinator() == nullptr ? 0 : worker_.coordinator()->word_is_fresh();
  }
  const Worker& worker() const { return worker_; }

 private:
  const NodeSetup& node_;
  WorkerReport& all_;
  Meter meter_;
  const SimCosts costs_;
  struct Charged {
    uint64_t resumes = 0, batches = 0, flush_bytes = 0, counted_bytes = 0;
  };
  Charged charged_;
  Worker worker_;
};

class SimController final : public CheckedNode {
 public:
  /// Requires: all references outlive this.
  SimController(const RunSetup& setup, const NodeSetup& node, LocalRun& run, const StopRule& stop,
                SimWorld& world, const SimCosts& costs, FlushKeeper* keeper);

  Nanoseconds turn() override;
  bool finished() const override { return node_.shell().finished(); }
  void die() override;
  Result<void> check() const override;
  Result<void> outcome() const override;
  Nanoseconds word_is_fresh() const override { return coordinator().word_is_fresh(); }
  const RunCoordinator& coordinator() const { return node_.coordinator(); }
  /// Longest turn of its loop [ns], by charged time.
  uint64_t longest_turn() const { return node_.shell().scheduler().counters().longest_turn; }

 private:
  const LocalRun& run_;
  Meter meter_;
  const SimCosts costs_;
  uint64_t charged_flush_bytes_ = 0;
  const std::atomic<bool> interrupt_{false};
  ControllerNode node_;
  uint64_t counted_ = 0;  // batches, before the last turn
  bool went_back_ = false;
};

}  // namespace luxodus
