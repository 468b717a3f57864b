// Workers and controllers as a simulated world drives them: the production nodes, whose clock and
// links are the world's and whose tracing takes virtual time. Thread rule: the simulation's thread.
#pragma once

#include <string>

#include "actors/supervise/controller_node.hpp"
#include "actors/supervise/worker.hpp"
#include "runtime/sim/sim_world.hpp"

namespace luxodus {

/// What work costs a node of a simulation.
struct SimCosts {
  Nanoseconds particle = microseconds(10);
};

/// A node that also tells what is wrong with it.
class CheckedNode : public SimNode {
 public:
  /// The first of its invariants that does not hold, for people; "" where all do. Cheap.
  virtual std::string fault() const = 0;
};

class SimWorker final : public CheckedNode {
 public:
  /// What its cache did is added to `all` when it ends. Requires: all references outlive this.
  SimWorker(const RunSetup& run, const NodeSetup& node, SimWorld& world, const SimCosts& costs,
            WorkerReport& all);
  ~SimWorker() override;

  Nanoseconds turn() override { return worker_.shell().turn(); }
  bool finished() const override { return worker_.shell().finished(); }
  void die() override;
  std::string fault() const override;

 private:
  const NodeSetup& node_;
  WorkerReport& all_;
  Worker worker_;
};

class SimController final : public CheckedNode {
 public:
  /// Requires: all outlive this.
  SimController(const RunSetup& setup, const NodeSetup& node, LocalRun& run, const StopRule& stop,
                SimWorld& world, FlushKeeper* keeper);

  Nanoseconds turn() override;
  bool finished() const override { return node_.shell().finished(); }
  void die() override;
  std::string fault() const override;
  const Controller& controller() const { return node_.controller(); }

 private:
  const LocalRun& run_;
  const std::atomic<bool> interrupt_{false};
  ControllerNode node_;
  uint64_t counted_ = 0;  // batches, before the last turn
  bool went_back_ = false;
};

}  // namespace luxodus
