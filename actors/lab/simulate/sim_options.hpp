// What a simulated run is like, and what is told of it. Plain values.
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
  uint32_t fan_out = 0;  // nodes that a coordinator leads; 0: as usual for so many
  /// What the nodes are like is drawn from the seed: fibers, budgets, windows, times.
  bool draw_nodes = true;
  NodesOptions fixed;      // otherwise
  bool rare_ways = false;  // on purpose, of nodes that are not drawn as well
  bool faults = true;      // drawn from the seed, unless there is a plan
  Nanoseconds faults_last = seconds(30);
  std::optional<FaultPlan> plan;
  /// All particles on one worker take so long.
  Nanoseconds work = seconds(60);
  /// After healing, a run that has not ended is stuck.
  Nanoseconds patience = seconds(1800);
};

/// What tracing costs in such a run.
inline SimCosts costs_of(const SimOptions& options, int64_t particles) {
  SimCosts costs;
  costs.particle_ns = static_cast<double>(options.work) / static_cast<double>(particles);
  return costs;
}

struct SimReport {
  std::string failure;  // "": the run ended as it must
  Nanoseconds virtual_time = 0;
  Nanoseconds took = 0;  // of it, from the first lease to the last flush that was counted
  uint64_t trace_hash = 0;
  SimWorld::Counters world;
  int64_t recovered = 0;   // batches, by controllers that began anew
  uint64_t snapshots = 0;  // that journals became
  uint64_t leases = 0;
  uint64_t leases_fenced = 0;
  uint64_t flushes_refused = 0;
  WorkerReport caches;     // of all lives of all workers
  uint64_t rare_ways = 0;  // taken on purpose, of Buggify
  std::string nodes;       // what they were like, for people
};

}  // namespace luxodus
