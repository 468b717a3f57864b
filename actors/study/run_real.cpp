#include "actors/study/runs.hpp"
#include "actors/supervise/in_process.hpp"

namespace luxodus {

Result<StudyResult> run_real(const StudyRun& run, const std::atomic<bool>& interrupt) {
  auto nodes = nodes_of(run);
  if (!nodes.ok()) return nodes.problem();
  if (nodes->nodes > limits::nodes_in_process)
    return Problem{
        {},
        "one process takes " + std::to_string(limits::nodes_in_process) + " real nodes at most"};
  const bool resident = nodes->object_bytes == 0;
  LocalRun local =
      resident ? LocalRun(run.scene, run.seed, 1) : LocalRun(run.scene, run.seed, 1, nullptr);
  StopRule stop;
  stop.particles = particles_of(run.study, run.point);
  NodesReport report;
  const auto ended = run_on_nodes(
      local, nodes.value(), stop, interrupt, [](const Progress&) {}, &report);
  if (!ended.ok()) return ended.problem();
  if (ended.value() != StopReason::particles)
    return Problem{{}, std::string("the run ended early: ") + name_of(ended.value())};
  StudyResult result;
  result.seconds = 1e-9 * static_cast<double>(report.took);
  result.particles = static_cast<double>(local.particles());
  result.nodes = nodes->nodes;
  result.workers = report.workers;
  result.busy_s = 1e-9 * static_cast<double>(report.workers.processor_ns);
  result.leases = static_cast<double>(report.leases);
  result.fenced = static_cast<double>(report.leases_fenced);
  result.flush_bytes = static_cast<double>(report.flush_bytes);
  result.flux_hash = flux_hash_of(local.totals());
  return result;
}

}  // namespace luxodus
