#include "actors/supervise/worker.hpp"

namespace luxodus {

namespace {

LeaseClientConfig lease_config(const NodeSetup& node) {
  LeaseClientConfig config;
  config.controller = node.controller;
  config.start = node.start;
  config.lost = node.lost;
  return config;
}

}  // namespace

Worker::Worker(const RunSetup& run, const NodeSetup& node)
    : node_(node),
      context_(run.context),
      transport_(run, node),
      shell_({node.net, scheduler_limits_of(node)}, run.graph, run.clock, transport_.transport()),
      cells_(run.objects == nullptr ? nullptr : std::make_unique<FetchingCells>(run, node, shell_)),
      leases_(lease_config(node), shell_.scheduler(), shell_.network()),
      photons_(run.scene,
               cells_ ? GeometryAccess::through(*run.proxies, cells_->source())
                      : GeometryAccess::resident(*run.index),
               run.seed, node.photons, shell_.scheduler(), leases_) {}

Worker::~Worker() = default;

Result<WorkerReport> Worker::run(const std::function<bool()>& stop) {
  if (auto joined = join_links(transport_.sockets(), node_); !joined.ok()) return joined.problem();
  shell_.add([this](const Delivery& d) { return leases_.deliver(d); });
  leases_.start(photons_);
  photons_.start();
  Nanoseconds leave_at = never;
  shell_.run_until([&] {
    if (leases_.ended()) return true;
    if (!stop()) return false;
    const Nanoseconds now = shell_.scheduler().clock().now();
    if (leave_at == never) {
      leave_at = now + node_.leave;
      leases_.drain();
    }
    return leases_.drained() || now >= leave_at;
  });
  if (leases_.fault())
    return Problem{{},
                   node_.name() + ": " + leases_.fault()->what +
                       meeting_trouble(transport_.sockets(), context_, shell_.network())};
  WorkerReport report = cells_ ? cells_->report() : WorkerReport{};
  report.waited = shell_.scheduler().counters().waited;
  return report;
}

}  // namespace luxodus
