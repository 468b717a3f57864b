#include "actors/cast/process/node_threads.hpp"

#include <algorithm>
#include <ctime>
#include <exception>

#include "runtime/core/denormals.hpp"

namespace luxodus {

namespace {

/// CPU time of the calling thread [ns], without that of other processes.
uint64_t processor_ns() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<uint64_t>(seconds(now.tv_sec) + now.tv_nsec);
}

}  // namespace

// ---- workers ---------------------------------------------------------------------------------

Result<WorkerReport> run_worker(const RunSetup& run, const Machine& machine, const NodeSetup& node,
                                const std::function<bool()>& stop) {
  return run_worker_by(make_batch_tracer, run, machine, node, stop);
}

Result<WorkerReport> run_worker_by(const TracerMaker& make_tracer, const RunSetup& run,
                                   const Machine& machine, const NodeSetup& node,
                                   const std::function<bool()>& stop) {
  NodeTransport transport(machine, node);
  NodeSeams seams = transport.seams();
  seams.make_tracer = make_tracer;
  Worker worker(run, node, seams);
  if (auto joined = join_links(transport.sockets(), node); !joined) return joined.problem();
  worker.start(stop);
  const uint64_t before = processor_ns();
  worker.shell().run();
  auto result = worker.result();
  if (result) {
    result.value().processor_ns = processor_ns() - before;
    return result;
  }
  return problem(run.name_of(node.net.self) + ": " + result.problem().what +
                     transport.meeting_trouble(worker.shell().network()),
                 result.problem().kind);
}

WorkerThreads::WorkerThreads(const RunSetup& run, const Machine& machine,
                             const std::vector<NodeSetup>& nodes, const std::function<bool()>& stop,
                             const RunWorker& run_one) {
  for (const NodeSetup& node : nodes)
    threads_.emplace_back(
        [this, &run, &machine, &node, stop, run_one] { work(run, machine, node, stop, run_one); });
}

void WorkerThreads::work(const RunSetup& run, const Machine& machine, const NodeSetup& node,
                         const std::function<bool()>& stop, const RunWorker& run_one) {
  flush_denormals();
  Problem wrong;
  try {
    auto done = run_one(run, machine, node, stop);
    const std::lock_guard lock(mutex_);
    if (done) {
      if (done->failed != ActorName::none && !lost_)
        lost_ = luxodus::problem(run.name_of(node.net.self) + ": the " + spoken_name(done->failed) +
                                     " has failed, and its node has left; its log says why",
                                 ProblemKind::lost_peer);
      return reports_.push_back(done.value());
    }
    wrong = done.problem();
  } catch (const std::exception& e) {
    wrong = luxodus::problem("node " + std::to_string(node.net.self.value) + ": " + e.what(),
                             ProblemKind::system);
  }
  const std::lock_guard lock(mutex_);
  if (!failed_) problem_ = wrong;
  failed_ = true;
}

void WorkerThreads::join() {
  for (std::thread& thread : threads_)
    if (thread.joinable()) thread.join();
  std::sort(reports_.begin(), reports_.end(),
            [](const WorkerReport& a, const WorkerReport& b) { return a.node < b.node; });
}

WorkerReport WorkerThreads::report() const {
  WorkerReport all;
  for (const WorkerReport& one : reports_) all.add(one);
  return all;
}

Problem WorkerThreads::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

// ---- the controller --------------------------------------------------------------------------

Result<StopReason> run_controller(const RunSetup& setup, const Machine& machine,
                                  const NodeSetup& node, ControlledRun lead,
                                  const std::function<bool()>& broken, NodesReport* counted) {
  NodeTransport transport(machine, node);
  LocalRun& run = lead.run;
  ControllerNode here(setup, node, std::move(lead), transport.seams());
  if (auto joined = join_links(transport.sockets(), node); !joined) return joined.problem();
  const Nanoseconds began = machine.clock.now();
  here.start(broken);
  here.shell().run();
  const RunCoordinator& controller = here.coordinator();
  run.add_seconds(static_cast<double>(machine.clock.now() - began - controller.over_for()) * 1e-9);
  const Network& network = here.shell().network();
  if (const auto& verdict = here.shell().supervisor().verdict())
    return problem(setup.name_of(node.net.self) + ": " + verdict->text, ProblemKind::system);
  if (controller.fault())
    return problem(setup.name_of(node.net.self) + ": " + controller.fault()->what +
                       transport.meeting_trouble(network),
                   controller.fault()->kind);
  if (here.display() != nullptr && here.display()->fault()) return *here.display()->fault();
  if (counted != nullptr) {
    const Coordinator::Counters& c = controller.counters();
    *counted = {c.flushes_taken,
                c.flush_bytes,
                c.leases,
                c.fenced,
                network.counters().frames_received,
                controller.shard_counters(),
                {},
                {},
                std::nullopt,
                controller.took(),
                here.shell().scheduler().counters().longest_turn};
  }
  return controller.reason();
}

}  // namespace luxodus
