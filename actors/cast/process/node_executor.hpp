// Nodes as an executor: the coordinator of changing states (StateCoordinator) on a node with a
// thread of its own, and the link between that thread and the caller's. Thread rule: start(),
// Executor's functions and destruction on the caller's thread; fault() and counters() from any.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "actors/cast/coordinator/state_coordinator.hpp"
#include "actors/cast/node/node_setup.hpp"
#include "actors/results/run/executor.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

class NodeExecutor final : public Executor {
 public:
  /// Listens, and waits for workers from now on. Requires: all references outlive this. Errors:
  /// those of join_links.
  static Result<std::unique_ptr<NodeExecutor>> start(const RunSetup& run, const Machine& machine,
                                                     const NodeSetup& node);
  /// Tells the workers that it ends.
  ~NodeExecutor() override;
  NodeExecutor(const NodeExecutor&) = delete;
  NodeExecutor& operator=(const NodeExecutor&) = delete;

  /// Makes workers build the state in advance.
  void foresee(const StateObject& state) override;
  void enter(const StateObject& state) override;
  /// Waits for workers if there are none; see Executor.
  void trace(Work& work) override;

  /// Errors: none of its workers will ever come, since they work for another run.
  Result<void> goes_on() const;

  struct Counters {
    uint64_t leases = 0;
    uint64_t fenced = 0;
    uint64_t refused = 0;  // flushes
    size_t workers = 0;    // present
    uint64_t stuck = 0;    // consecutive looks at which no worker could enter the state
  };
  Counters counters() const;

 private:
  class Door;
  NodeExecutor(const RunSetup& run, const NodeSetup& node) : run_(run), node_(node) {}
  void work(const Machine& machine);
  void begun(Result<void> outcome);
  void ask_node();
  void do_what_is_wished();
  void note(const StateCoordinator& coordinator);

  const RunSetup& run_;
  const NodeSetup& node_;
  // Guards everything below.
  mutable std::recursive_mutex mutex_;  // a work may be done while it is begun
  std::condition_variable_any changed_;
  std::optional<StateObject> foreseen_, entered_;  // and not passed on yet
  Work* next_ = nullptr;                           // to be begun
  bool stops_ = false;
  bool tracing_ = false;  // a work is in progress, or requested
  bool ends_ = false;
  bool started_ = false;
  Counters counters_;
  Result<void> state_;
  // Owned by the node's thread.
  NodeShell* shell_ = nullptr;
  StateCoordinator* coordinator_ = nullptr;
  std::thread thread_;
};

}  // namespace luxodus
