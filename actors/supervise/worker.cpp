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
  config.tally_bytes = node.tally_bytes;
  return config;
}

}  // namespace

Worker::Worker(const RunSetup& run, const NodeSetup& node, const NodeSeams& seams)
    : run_(run),
      node_(node),
      trace_(run.observation == nullptr ? nullptr : run.observation->trace_of(node.net.self)),
      shell_({node.net, worker_limits(run, node), ShellConfig{}.max_room_bytes, node.shutdown_phase,
              run.routes},
             run.graph, seams.clock, seams.transport),
      objects_(run.objects == nullptr ? nullptr
                                      : std::make_unique<FetchingObjects>(
                                            run, node, shell_, seams.make_builder, trace_)),
      shard_(own_shard()),
      slices_(run.shards, post()),
      leases_(lease_config(node, trace_), shell_.scheduler(), shell_.network(), slices_),
      photons_(run.scene,
               objects_ ? GeometryAccess::through(*run.proxies, objects_->source())
                        : GeometryAccess::resident(*run.index),
               run.seed, photon_config(node, trace_), shell_.scheduler(), leases_,
               seams.make_tracer) {}

Worker::~Worker() = default;

/// To this node's own shard and lease client messages come between turns, as from the network.
SendFunction Worker::post() {
  return
      [this](NodeId to, const MessageId& id, const Message& message, const SharedBytes& payload) {
        if (to != node_.net.self) {
          shell_.network().send(to, id, message, payload);
          return;
        }
        own_messages_.push_back({id, message, payload});
        Scheduler& scheduler = shell_.scheduler();
        scheduler.timers().set(scheduler.clock().now(), [this] { deliver_own(); });
      };
}

void Worker::deliver_own() {
  const OwnMessage own = std::move(own_messages_.front());
  own_messages_.pop_front();
  const Delivery delivery{node_.net.self, own.id, 0, own.message, own.payload.bytes};
  if (!shard_ || !shard_->deliver(delivery)) leases_.deliver(delivery);
}

std::unique_ptr<TallyShard> Worker::own_shard() {
  const size_t shard = run_.shards.shard_of(node_.net.self);
  if (shard == 0) return nullptr;
  const TallyLayout& layout = run_.scene.layout;
  const BinRange bins = run_.shards.range(shard, layout.totals());
  return std::make_unique<TallyShard>(TallyShardConfig{node_.net.self, node_.controller, bins},
                                      layout, static_cast<int>(run_.scene.groups.size()),
                                      shell_.scheduler(), post());
}

void Worker::show_to(Observation& seen) {
  metrics_.emplace(run_.names, node_.net.self, "worker", shell_.scheduler(), shell_.network());
  leases_.add_metrics(metrics_->registry());
  photons_.add_metrics(metrics_->registry());
  if (shard_) shard_->add_metrics(metrics_->registry());
  if (objects_) objects_->add_metrics(metrics_->registry());
  metrics_->add_rate({"particles_per_second", "", "Particles traced in a second.", ""},
                     photons_.counters().particles);
  metrics_->start(seen);
}

void Worker::start(std::function<bool()> stop) {
  stop_ = std::move(stop);
  shell_.add([this](const Delivery& d) { return leases_.deliver(d); });
  if (shard_) shell_.add([this](const Delivery& d) { return shard_->deliver(d); });
  leases_.start(photons_);
  if (objects_) objects_->pin(node_.pins);
  photons_.start();
  if (run_.observation != nullptr) show_to(*run_.observation);
  shell_.begin([this] { return may_leave(); });
  shell_.tell_newcomers([this](NodeId neighbour) { leases_.tell_end(neighbour); });
  shell_.scheduler().seal();
}

bool Worker::may_leave() {
  if (leases_.ended()) return true;
  if (!stop_()) return false;
  if (leases_.over()) return true;  // it would but have passed others' word on
  const Nanoseconds now = shell_.scheduler().clock().now();
  if (leave_at_ == never) {
    leave_at_ = now + node_.shutdown_phase;
    leases_.drain();
  }
  // What it holds of the totals goes with it: it stays until the run ends, if that is soon.
  const bool leaves = (leases_.drained() && !shard_) || now >= leave_at_;
  if (leaves) leases_.say_goodbye();
  return leaves;
}

Result<WorkerReport> Worker::result() const {
  if (leases_.fault()) return *leases_.fault();
  WorkerReport report = objects_ ? objects_->report() : WorkerReport{};
  report.waited = shell_.scheduler().counters().waited;
  report.tally_full = photons_.counters().tally_full;
  report.max_tally_bytes = photons_.counters().max_tally_bytes;
  return report;
}

}  // namespace luxodus
