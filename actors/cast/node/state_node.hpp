// The node that has states of a scene traced: it leases the batches of the current work. Thread
// rule: made and run on one thread.
#pragma once

#include "actors/cast/coordinator/state_coordinator.hpp"
#include "actors/cast/node/node_setup.hpp"
#include "runtime/node/node_shell.hpp"

namespace luxodus {

class StateNode {
 public:
  /// `done` is called after each work. Requires: all references outlive this.
  StateNode(const RunSetup& run, const NodeSetup& node, const NodeSeams& seams,
            std::function<void()> done);

  /// Each turn of the shell calls `look` first; the node ends when its workers have heard of the
  /// end.
  void start(std::function<void()> look);

  NodeShell& shell() { return shell_; }
  const NodeShell& shell() const { return shell_; }
  StateCoordinator& coordinator() { return coordinator_; }
  const StateCoordinator& coordinator() const { return coordinator_; }

 private:
  NodeShell shell_;
  StateCoordinator coordinator_;
};

}  // namespace luxodus
