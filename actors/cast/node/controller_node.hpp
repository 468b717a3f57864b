// The controller's node: lends, counts, ends the run; it passes others' messages on where the graph
// has it do so. Made and run on one thread.
#pragma once

#include "actors/cast/coordinator/run_coordinator.hpp"
#include "actors/cast/node/node_metrics.hpp"
#include "actors/cast/node/node_setup.hpp"

namespace luxodus {

class ControllerNode {
 public:
  /// Goes on from what `run` holds. What is counted is given to `keeper` first. Requires: all
  /// outlive this.
  ControllerNode(const RunSetup& setup, const NodeSetup& node, LocalRun& run, const StopRule& stop,
                 const std::atomic<bool>& interrupt, std::function<void(const Progress&)> report,
                 const NodeSeams& seams, FlushKeeper* keeper = nullptr);

  /// From the shell's next turn on this waits for the workers and runs the run, until it has ended
  /// or `broken` says that it cannot go on.
  void start(std::function<bool()> broken);

  NodeShell& shell() { return shell_; }
  const NodeShell& shell() const { return shell_; }
  const RunCoordinator& coordinator() const { return coordinator_; }
  /// Null where the run is shown elsewhere, or nowhere.
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
  std::optional<JournalActor> journal_;        // where what is counted is kept
  std::unique_ptr<BlockingCalls> calls_;       // of the coordinator
  std::unique_ptr<BlockingCalls> display_calls_;
  std::optional<DisplayActor> display_;  // where the run is shown here
  RunCoordinator coordinator_;
  std::optional<NodeMetrics> metrics_;
};

}  // namespace luxodus
