#include "actors/cast/node/worker.hpp"

#include "actors/cast/node/graph_routes.hpp"
#include "actors/cast/node/node_plan.hpp"
#include "actors/cast/node/residency_setup.hpp"
#include "actors/cast/supervision/supervision.hpp"

namespace luxodus {

namespace {

/// A person watches the picture: results leave before the delay is noticeable.
constexpr Nanoseconds flush_states_every = milliseconds(20);

TracingWorkerConfig tracer_config(const RunSetup& run, const NodeSetup& node, NodeTrace* trace) {
  TracingWorkerConfig config;
  config.self = node.net.self;
  std::vector<Vertex> coordinators{node.controller.value};
  if (run.tree != nullptr) coordinators = run.tree->coordinators_of(node.net.self.value);
  for (const Vertex leads : coordinators)
    config.coordinators.push_back({{static_cast<uint16_t>(leads)}, role::coordinator});
  config.start = node.start;
  config.lost = node.lost;
  config.rejoin = node.rejoin;
  config.trace = trace;
  if (run.states != nullptr) config.flush_every = flush_states_every;
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
      shell_({worker_net(run, node), worker_limits(run, node), ShellConfig{}.max_payload_bytes,
              node.shutdown_phase},
             reroute_on(run.graph, run.routes, node.net.self), seams.clock, seams.transport),
      objects_(run.objects == nullptr ? nullptr
                                      : std::make_unique<FetchingObjects>(
                                            run, node, shell_, seams.make_builder, trace_)),
      shard_(own_shard()),
      tracer_(tracer_config(run, node, trace_), run.shards, shell_.scheduler(), shell_.network(),
              shell_.actors()),
      photons_(own_photons(seams)),
      coordinator_(own_coordinator()),
      states_(own_states(seams)) {
  if (node.display == nullptr) return;
  display_calls_ = seams.make_calls(shell_.scheduler());
  display_.emplace(display_config(node), *node.display, *display_calls_, shell_.scheduler(),
                   shell_.network(), shell_.actors());
}

Worker::~Worker() = default;

std::unique_ptr<TallyShard> Worker::own_shard() {
  const size_t shard = run_.shards.shard_of(node_.net.self);
  if (shard == 0) return nullptr;
  const TallyLayout& layout = run_.scene.layout;
  const BinRange bins = run_.shards.range(shard, layout.totals());
  return std::make_unique<TallyShard>(TallyShardConfig{node_.net.self, node_.controller, bins},
                                      layout, static_cast<int>(run_.scene.groups.size()),
                                      shell_.scheduler(), shell_.actors());
}

std::unique_ptr<TracingFibers> Worker::own_photons(const NodeSeams& seams) {
  if (coordinates() || run_.states != nullptr) return nullptr;
  const GeometryAccess access = objects_
                                    ? GeometryAccess::through(*run_.proxies, objects_->source())
                                    : GeometryAccess::resident(*run_.index);
  return std::make_unique<TracingFibers>(run_.scene, access, run_.seed,
                                         photon_config(node_, trace_), shell_.scheduler(), tracer_,
                                         seams.make_tracer);
}

std::unique_ptr<StateTracer> Worker::own_states(const NodeSeams& seams) {
  if (run_.states == nullptr) return nullptr;
  return std::make_unique<StateTracer>(run_.scene, *run_.states, node_.photons.portion,
                                       shell_.scheduler(), tracer_, seams.make_tracer);
}

std::unique_ptr<SubCoordinator> Worker::own_coordinator() {
  if (!coordinates()) return nullptr;
  return std::make_unique<SubCoordinator>(coordinator_config(run_, node_), run_.scene, tracer_,
                                          shell_.scheduler(), shell_.network(), shell_.actors());
}

LeasedWork& Worker::work() {
  if (coordinator_) return *coordinator_;
  if (states_) return *states_;
  return *photons_;
}

void Worker::show_to(Observation& seen) {
  metrics_.emplace(run_.names, node_.net.self, coordinates() ? "coordinator" : "worker", shell_);
  tracer_.add_metrics(metrics_->registry());
  if (photons_) photons_->add_metrics(metrics_->registry());
  if (states_) states_->add_metrics(metrics_->registry());
  if (coordinator_) coordinator_->add_metrics(metrics_->registry());
  if (shard_) shard_->add_metrics(metrics_->registry());
  if (objects_) objects_->add_metrics(metrics_->registry());
  if (display_) display_->add_metrics(metrics_->registry());
  if (photons_ || states_)
    metrics_->add_rate({"particles_per_second", "", "Particles traced in a second.", ""},
                       photons_ ? photons_->counters().particles : states_->done().particles);
  else
    metrics_->add_rate({"particles_per_second", "", "Particles counted in a second.", ""},
                       coordinator_->counters().particles);
  metrics_->start(seen);
}

void Worker::start(std::function<bool()> stop) {
  stop_ = std::move(stop);
  add_to(shell_, role::tracer, tracer_);
  tracer_.start(work());
  if (coordinator_) {
    add_to(shell_, role::coordinator, *coordinator_);
    coordinator_->start();
  }
  if (shard_) {
    add_to(shell_, role::tally_shard, *shard_);
    shard_->start();
  }
  if (display_) {
    add_to(shell_, role::display, *display_);
    display_->begin();
  }
  shell_.supervisor().end_runs_by([this](const Verdict& verdict) { return end_run(verdict); });
  if (objects_) objects_->pin(node_.pins);
  if (photons_) photons_->start();
  if (states_) states_->start();
  if (run_.observation != nullptr) show_to(*run_.observation);
  shell_.supervisor().rehearse(node_.faults);
  shell_.begin([this] { return may_leave(); });
  shell_.tell_newcomers([this](NodeId neighbour) { tracer_.tell_end(neighbour); });
  shell_.scheduler().seal();
}

/// A failed display ends the run. If the coordinator does not hear of it, this node is lost to it,
/// as if a sub-coordinator had failed.
bool Worker::end_run(const Verdict& verdict) {
  if (display_ && verdict.actor == role::display) display_->tell_failure(verdict.text);
  return false;
}

/// A display that has heard of the end stays until everything is written.
bool Worker::may_leave() {
  const bool shows = display_ && !display_->done();
  if (tracer_.ended()) return !shows || tracer_.fault().has_value();
  if (!stop_()) return false;
  if (display_ && display_->is_ending()) return !shows;
  if (tracer_.over()) return !shows;  // it would only forward messages
  return leaves_early();
}

bool Worker::leaves_early() {
  const Nanoseconds now = shell_.scheduler().clock().now();
  if (leave_at_ == never) {
    leave_at_ = now + node_.shutdown_phase;
    tracer_.drain();
  }
  // Its shard of the totals would be lost with it, and the route to the display may lead through
  // it: then it stays until the run ends, if that is soon.
  const bool is_needed = shard_ || (run_.display && *run_.display != node_.controller);
  const bool leaves = (tracer_.drained() && !is_needed) || now >= leave_at_;
  if (leaves) tracer_.say_goodbye();
  return leaves;
}

Result<WorkerReport> Worker::result() const {
  if (tracer_.fault()) return *tracer_.fault();
  if (display_ && display_->fault()) return *display_->fault();
  WorkerReport report = objects_ ? objects_->report() : WorkerReport{};
  if (const auto& verdict = shell_.supervisor().verdict()) report.failed = verdict->actor;
  report.waited = shell_.scheduler().counters().waited;
  report.longest_turn = shell_.scheduler().counters().longest_turn;
  if (!photons_) return report;
  report.tally_full = photons_->counters().tally_full;
  report.max_tally_bytes = photons_->counters().max_tally_bytes;
  return report;
}

}  // namespace luxodus
