#include "actors/lab/study/worker_processes.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <type_traits>

#include "actors/cast/process/node_threads.hpp"

namespace luxodus {

namespace {

static_assert(std::is_trivially_copyable_v<WorkerReport>, "it is sent as it lies in memory");

/// The whole life of a worker's process.
[[noreturn]] void work(const PlannedNodes& nodes, const NodeSetup& node, int report) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const SystemClock clock;
  bool ok = false;
  {
    ZmqContext context({});
    const auto did = run_worker(nodes.setup(), {clock, context}, node, [] { return false; });
    if (did) ok = ::write(report, &did.value(), sizeof(WorkerReport)) == sizeof(WorkerReport);
  }
  // Only the parent may clean up what it began (files, threads).
  ::_exit(ok ? 0 : 1);
}

/// Reads from a pipe, in any number of pieces.
bool read_report(int from, WorkerReport& report) {
  auto* at = reinterpret_cast<char*>(&report);
  for (size_t got = 0; got < sizeof report;) {
    const ssize_t count = ::read(from, at + got, sizeof report - got);
    if (count <= 0) return false;
    got += static_cast<size_t>(count);
  }
  return true;
}

}  // namespace

WorkerProcesses::~WorkerProcesses() {
  for (Worker& worker : workers_) {
    if (worker.runs) ::kill(worker.pid, SIGKILL);
    reap(worker, 0);
    ::close(worker.report);
  }
}

Result<void> WorkerProcesses::start(const PlannedNodes& nodes) {
  for (const NodeSetup& node : nodes.workers()) {
    std::array<int, 2> pipe{};
    if (::pipe(pipe.data()) != 0) return problem("the system opens no more pipes");
    const pid_t pid = ::fork();
    if (pid == 0) work(nodes, node, pipe[1]);
    ::close(pipe[1]);
    if (pid < 0) {
      ::close(pipe[0]);
      return problem("the system starts no more processes");
    }
    workers_.push_back({pid, pipe[0], true});
  }
  return {};
}

void WorkerProcesses::reap(Worker& worker, int options) {
  int status = 0;
  if (!worker.runs || ::waitpid(worker.pid, &status, options) != worker.pid) return;
  worker.runs = false;
  failed_ = failed_ || status != 0;
}

bool WorkerProcesses::failed() {
  for (Worker& worker : workers_) reap(worker, WNOHANG);
  return failed_;
}

Result<WorkerReport> WorkerProcesses::join() {
  WorkerReport all;
  for (Worker& worker : workers_) {
    WorkerReport report;
    const bool told = read_report(worker.report, report);
    reap(worker, 0);
    if (!told || failed_) return problem("a worker's process failed: see it with --log");
    all.add(report);
  }
  return all;
}

}  // namespace luxodus
