#include "actors/supervise/worker.hpp"

namespace luxodus {

Worker::Worker(const RunSetup& run, const NodeSetup& node)
    : node_(node),
      transport_(run.context, {node.net.self, node.keys, node.insecure}, run.clock),
      shell_({node.net, scheduler_limits_of(node)}, run.graph, run.clock, transport_),
      cells_(run.objects == nullptr ? nullptr : std::make_unique<FetchingCells>(run, node, shell_)),
      leases_({node.controller}, shell_.scheduler(), shell_.network()),
      photons_(run.scene,
               cells_ ? GeometryAccess::through(*run.proxies, cells_->source())
                      : GeometryAccess::resident(*run.index),
               run.seed, node.photons, shell_.scheduler(), leases_) {}

Worker::~Worker() = default;

Result<WorkerReport> Worker::run(const std::function<bool()>& stop) {
  if (auto joined = join_links(transport_, node_); !joined.ok()) return joined.problem();
  shell_.add([this](const Delivery& d) { return leases_.deliver(d); });
  leases_.start(photons_);
  photons_.start();
  shell_.run_until([&] { return leases_.ended() || stop(); });
  return cells_ ? cells_->report() : WorkerReport{};
}

}  // namespace luxodus
