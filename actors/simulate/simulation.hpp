// A run on simulated nodes: the production code of all nodes in one thread, by virtual time, under
// the faults of a plan; checked after every event, and its flux against the plain loop's, bit for
// bit. Thread rule: one thread.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "actors/simulate/sim_nodes.hpp"
#include "actors/supervise/planned_nodes.hpp"

namespace luxodus {

/// A scene for many simulated runs, and what they must leave.
class SimScene {
 public:
  /// Traces the reference with the plain loop. Requires: a scene of several cells where runs shall
  /// fetch; particles >= 1.
  SimScene(std::shared_ptr<const CompiledScene> scene, uint64_t seed, int64_t particles);

  const std::shared_ptr<const CompiledScene>& scene() const { return scene_; }
  uint64_t seed() const { return seed_; }
  int64_t particles() const { return particles_; }
  /// A run that has traced nothing. `resident`: with all geometry at hand.
  std::unique_ptr<LocalRun> fresh_run(bool resident) const;
  /// What differs from the plain loop's result, for people; "" where no bit does.
  std::string difference(const LocalRun& run) const;

 private:
  const std::shared_ptr<const CompiledScene> scene_;
  const uint64_t seed_;
  const int64_t particles_;
  std::unique_ptr<LocalRun> reference_;
};

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

/// Errors: options that contradict each other or the scene.
Result<SimReport> simulate(const SimScene& scene, const SimOptions& options);

}  // namespace luxodus
