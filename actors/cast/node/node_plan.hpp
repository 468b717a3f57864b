// What a node of a setup may take in memory, said before it takes it: one term for each pool, array
// and budget, with the sentence that derives it. Beside what nodes take stands what their process
// holds once for all of them, the scene. Pure functions of the setup; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "actors/cast/node/node_setup.hpp"
#include "runtime/actor/scheduler.hpp"
#include "runtime/core/memory_plan.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

/// What a node's scheduler is made with.
SchedulerLimits worker_limits(const RunSetup& run, const NodeSetup& node);
SchedulerLimits controller_limits(const NodeSetup& node);
/// Their networks: who coordinates may have two words at once for everyone whom it leads.
NetConfig worker_net(const RunSetup& run, const NodeSetup& node);
NetConfig controller_net(const RunSetup& run, const NodeSetup& node);

/// The display's, where the node has one.
DisplayConfig display_config(const NodeSetup& node);

/// The cache of a worker that fetches objects.
CacheConfig cache_config(const SceneObjects& objects, const NodeSetup& node);

/// What a worker's tally takes: scores of open batches, totals and a flush, or its key
/// `tally_bytes` where that is less.
MemoryPlan tally_plan(const CompiledScene& scene, const NodeSetup& node);

MemoryPlan worker_plan(const RunSetup& run, const NodeSetup& node);
MemoryPlan controller_plan(const RunSetup& run, const NodeSetup& node);

/// Whether the budgets of this worker do. Errors: which key, and what it needs.
Result<void> check_budget(const RunSetup& run, const NodeSetup& node);

/// Tables for people: nodes of equal plans share one. `workers` may be empty.
std::string plan_text(const RunSetup& run, const std::vector<NodeSetup>& workers,
                      const std::optional<NodeSetup>& controller);

}  // namespace luxodus
