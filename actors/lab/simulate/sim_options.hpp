// Options and report of a simulated run. Plain values; any thread.
#pragma once

#include <optional>
#include <string>

#include "actors/cast/process/planned_nodes.hpp"
#include "actors/lab/simulate/sim_nodes.hpp"

namespace luxodus {

struct SimOptions {
  uint64_t seed = 0;
  int nodes = 4;  // workers
  int links = 4;
  uint32_t fan_out = 0;  // nodes that a coordinator leads; 0: the default for their number
  /// Draws the nodes' configuration from the seed: fibers, budgets, windows, times.
  bool draw_nodes = true;
  NodesOptions fixed;      // used if nodes are not drawn
  bool rare_ways = false;  // enables rare paths also for nodes that are not drawn
  bool faults = true;      // drawn from the seed, unless there is a plan
  Nanoseconds faults_last = seconds(30);
  std::optional<FaultPlan> plan;
  /// Duration of all particles on one worker.
  Nanoseconds work = seconds(60);
  /// A run that has not ended this long after healing is stuck.
  Nanoseconds patience = seconds(1800);
};

/// Cost of tracing in such a run.
inline SimCosts costs_of(const SimOptions& options, int64_t particles) {
  SimCosts costs;
  costs.particle_ns = static_cast<double>(options.work) / static_cast<double>(particles);
  return costs;
}

struct SimReport {
  std::string failure;  // "": the run ended correctly
  Nanoseconds virtual_time = 0;
  Nanoseconds took = 0;  // of it, from the first lease to the last counted flush
  uint64_t trace_hash = 0;
  SimWorld::Counters world;
  int64_t recovered = 0;   // batches, by restarted controllers
  uint64_t snapshots = 0;  // made from journals
  uint64_t leases = 0;
  uint64_t leases_fenced = 0;
  uint64_t flushes_refused = 0;
  WorkerReport caches;     // over all lives of all workers
  uint64_t rare_ways = 0;  // taken by Buggify
  std::string nodes;       // their configuration, for people
};

}  // namespace luxodus
