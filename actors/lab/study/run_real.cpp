#include <stdlib.h>

#include <filesystem>

#include "actors/cast/process/in_process.hpp"
#include "actors/lab/study/runs.hpp"
#include "actors/lab/study/worker_processes.hpp"

namespace luxodus {

namespace {

namespace fs = std::filesystem;

/// A temporary folder for sockets, removed at the end.
class SocketFolder {
 public:
  SocketFolder() {
    std::string name = (fs::temp_directory_path() / "luxodus-XXXXXX").string();
    if (::mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~SocketFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  SocketFolder(const SocketFolder&) = delete;
  SocketFolder& operator=(const SocketFolder&) = delete;
  /// Empty if it could not be made.
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Like run_on_nodes, with each worker in a process of its own.
Result<StopReason> run_on_processes(LocalRun& run, NodesOptions options, const StopRule& stop,
                                    const std::atomic<bool>& interrupt, NodesReport& counted) {
  const SocketFolder folder;
  if (folder.path().empty()) return problem("cannot make a folder for local sockets");
  options.sockets = folder.path();
  const SystemClock clock;
  const auto made = PlannedNodes::make(run, options, stop, static_cast<uint64_t>(clock.now()) | 1);
  if (!made) return made.problem();
  const PlannedNodes& nodes = *made.value();
  WorkerProcesses workers;
  if (auto ok = workers.start(nodes); !ok) return ok.problem();
  ZmqContext context({});
  const auto reason = run_controller(
      nodes.setup(), {clock, context}, nodes.controller(),
      {run, stop, interrupt, [](const Progress&) {}}, [&] { return workers.failed(); }, &counted);
  if (!reason) return reason;
  auto did = workers.join();
  if (!did) return did.problem();
  counted.workers = did.value();
  return reason;
}

}  // namespace

Result<StudyResult> run_real(const StudyRun& run, const std::atomic<bool>& interrupt) {
  auto nodes = nodes_of(run);
  if (!nodes) return nodes.problem();
  if (nodes->nodes > limits::nodes_in_process)
    return problem("one machine takes " + std::to_string(limits::nodes_in_process) +
                   " real nodes at most");
  const bool resident = nodes->object_bytes == 0;
  LocalRun local =
      resident ? LocalRun(run.scene, run.seed, 1) : LocalRun(run.scene, run.seed, 1, nullptr);
  StopRule stop;
  stop.particles = particles_of(run.study, run.point);
  NodesReport report;
  const auto ended =
      run.study.word(run.point, "on") == "processes"
          ? run_on_processes(local, nodes.value(), stop, interrupt, report)
          : run_on_nodes(
                local, nodes.value(), stop, interrupt, [](const Progress&) {}, &report);
  if (!ended) return ended.problem();
  if (ended.value() != StopReason::particles)
    return problem(std::string("the run ended early: ") + name_of(ended.value()));
  StudyResult result;
  result.seconds = 1e-9 * static_cast<double>(report.took);
  result.particles = static_cast<double>(local.particles());
  result.nodes = nodes->nodes;
  result.workers = report.workers;
  result.busy_s = 1e-9 * static_cast<double>(report.workers.processor_ns);
  result.leases = static_cast<double>(report.leases);
  result.fenced = static_cast<double>(report.leases_fenced);
  result.flush_bytes = static_cast<double>(report.flush_bytes);
  result.longest_turn_s = 1e-9 * static_cast<double>(report.longest_turn);
  result.flux_hash = flux_hash_of(local.totals());
  return result;
}

}  // namespace luxodus
