// Memory plan of a node: one term for each pool, array and budget, with the sentence that derives
// it. It is made before anything is allocated, and includes what the process holds once for all its
// nodes: the scene. Pure functions of the setup; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "actors/cast/node/node_setup.hpp"
#include "runtime/actor/scheduler.hpp"
#include "runtime/core/memory_plan.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

/// Limits of a node's scheduler.
SchedulerLimits worker_limits(const RunSetup& run, const NodeSetup& node);
SchedulerLimits controller_limits(const NodeSetup& node);
/// Network settings: a coordinator may send everyone whom it leads two messages at once.
NetConfig worker_net(const RunSetup& run, const NodeSetup& node);
NetConfig controller_net(const RunSetup& run, const NodeSetup& node);

/// The display's configuration, for a node that has one.
DisplayConfig display_config(const NodeSetup& node);

/// The cache of a worker that fetches objects.
CacheConfig cache_config(const SceneObjects& objects, const NodeSetup& node);

/// Memory of a worker's tally: scores of open batches, totals and a flush, or `tally_bytes` if that
/// is smaller.
MemoryPlan tally_plan(const CompiledScene& scene, const NodeSetup& node);

MemoryPlan worker_plan(const RunSetup& run, const NodeSetup& node);
MemoryPlan controller_plan(const RunSetup& run, const NodeSetup& node);

/// Whether the budgets of this worker do. Errors: which key, and what it needs.
Result<void> check_budget(const RunSetup& run, const NodeSetup& node);

/// Tables for people; nodes with equal plans share one. `workers` may be empty.
std::string plan_text(const RunSetup& run, const std::vector<NodeSetup>& workers,
                      const std::optional<NodeSetup>& controller);

}  // namespace luxodus
