// The controller's node: it leases batches, counts flushes and ends the run; it forwards messages
// of others if the graph says so. Thread rule: made and run on one thread.
#pragma once

#include "actors/cast/coordinator/run_coordinator.hpp"
#include "actors/cast/node/node_metrics.hpp"
#include "actors/cast/node/node_setup.hpp"

namespace luxodus {

/// What a controller leads: a run, when it ends, and who hears of it.
struct ControlledRun {
  LocalRun& run;  // counting continues from what it holds
  const StopRule& stop;
  const std::atomic<bool>& interrupt;
  std::function<void(const Progress&)> report;
  FlushKeeper* keeper = nullptr;  // is given every flush before it counts; null: no journal
};

class ControllerNode {
 public:
  /// Requires: all references outlive this.
  ControllerNode(const RunSetup& setup, const NodeSetup& node, ControlledRun lead,
                 const NodeSeams& seams);

  /// From the shell's next turn on waits for the workers and runs the run, until it has ended or
  /// `broken` returns true.
  void start(std::function<bool()> broken);

  NodeShell& shell() { return shell_; }
  const NodeShell& shell() const { return shell_; }
  const RunCoordinator& coordinator() const { return coordinator_; }
  /// Null if the run is shown elsewhere or not at all.
  const DisplayActor* display() const { return display_ ? &*display_ : nullptr; }

 private:
  JournalActor* make_journal(FlushKeeper* keeper, const NodeSeams& seams);
  bool end_run(const Verdict& verdict);
  bool is_shown() const { return !display_ || display_->done(); }

  const RunSetup& setup_;
  const NodeSetup& node_;
  const NodeId self_;
  NodeShell shell_;
  std::unique_ptr<BlockingCalls> disk_calls_;  // of the journal
  std::optional<JournalActor> journal_;        // if counted flushes are journaled
  std::unique_ptr<BlockingCalls> calls_;       // of the coordinator
  std::unique_ptr<BlockingCalls> display_calls_;
  std::optional<DisplayActor> display_;  // if the run is shown here
  RunCoordinator coordinator_;
  std::optional<NodeMetrics> metrics_;
};

}  // namespace luxodus
