// Workers of a run, each in a process of its own on this machine: copies of this process at the
// time of their start, so they have the same scene and plan. They connect through local sockets.
// Thread rule: one thread, and no other thread of this process may hold a lock when workers start.
#pragma once

#include <sys/types.h>

#include <vector>

#include "actors/cast/node/fetching_objects.hpp"
#include "actors/cast/process/planned_nodes.hpp"

namespace luxodus {

class WorkerProcesses {
 public:
  /// Kills those that still run.
  ~WorkerProcesses();
  WorkerProcesses() = default;
  WorkerProcesses(const WorkerProcesses&) = delete;
  WorkerProcesses& operator=(const WorkerProcesses&) = delete;

  /// Starts all workers of the plan. Requires: no ZeroMQ context is open here yet. Errors: the
  /// system cannot start a process.
  Result<void> start(const PlannedNodes& nodes);
  /// Whether one has ended with an error.
  bool failed();
  /// Waits until all have ended, and returns their combined statistics. Errors: one that failed.
  Result<WorkerReport> join();

 private:
  struct Worker {
    pid_t pid;
    int report;  // reading end of a pipe
    bool runs;
  };
  void reap(Worker& worker, int options);

  std::vector<Worker> workers_;
  bool failed_ = false;
};

}  // namespace luxodus
