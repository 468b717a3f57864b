#include "actors/supervise/worker.hpp"

#include "actors/supervise/node_plan.hpp"
#include "actors/supervise/residency_setup.hpp"

namespace luxodus {

namespace {

LeaseClientConfig lease_config(const NodeSetup& node, NodeTrace* trace) {
  LeaseClientConfig config;
  config.controller = node.controller;
  config.start = node.start;
  config.lost = node.lost;
  config.trace = trace;
  return config;
}

PhotonConfig photon_config(const NodeSetup& node, NodeTrace* trace) {
  PhotonConfig config = node.photons;
  config.trace = trace;
  return config;
}

}  // namespace

Worker::Worker(const RunSetup& run, const NodeSetup& node, const NodeSeams& seams)
    : run_(run),
      node_(node),
      trace_(run.observation == nullptr ? nullptr : run.observation->trace_of(node.net.self)),
      shell_({node.net, worker_limits(node), ShellConfig{}.room_bytes_most, node.shutdown_phase},
             run.graph, seams.clock, seams.transport),
      cells_(run.objects == nullptr ? nullptr
                                    : std::make_unique<FetchingCells>(run, node, shell_, trace_)),
      leases_(lease_config(node, trace_), shell_.scheduler(), shell_.network()),
      photons_(run.scene,
               cells_ ? GeometryAccess::through(*run.proxies, cells_->source())
                      : GeometryAccess::resident(*run.index),
               run.seed, photon_config(node, trace_), shell_.scheduler(), leases_,
               seams.make_tracer) {}

Worker::~Worker() = default;

void Worker::show_to(Observation& seen) {
  metrics_.emplace(run_.names, node_.net.self, "worker", shell_.scheduler(), shell_.network());
  leases_.add_metrics(metrics_->registry());
  photons_.add_metrics(metrics_->registry());
  if (cells_) cells_->add_metrics(metrics_->registry());
  metrics_->add_rate({"particles_per_second", "", "Particles traced in a second.", ""},
                     photons_.counters().particles);
  metrics_->start(seen);
}

void Worker::start(std::function<bool()> stop) {
  stop_ = std::move(stop);
  shell_.add([this](const Delivery& d) { return leases_.deliver(d); });
  leases_.start(photons_);
  if (cells_) cells_->pin(node_.pins);
  photons_.start();
  if (run_.observation != nullptr) show_to(*run_.observation);
  shell_.begin([this] { return may_leave(); });
  shell_.scheduler().seal();
}

bool Worker::may_leave() {
  if (leases_.ended()) return true;
  if (!stop_()) return false;
  const Nanoseconds now = shell_.scheduler().clock().now();
  if (leave_at_ == never) {
    leave_at_ = now + node_.shutdown_phase;
    leases_.drain();
  }
  return leases_.drained() || now >= leave_at_;
}

Result<WorkerReport> Worker::result() const {
  if (leases_.fault()) return *leases_.fault();
  WorkerReport report = cells_ ? cells_->report() : WorkerReport{};
  report.waited = shell_.scheduler().counters().waited;
  return report;
}

}  // namespace luxodus
