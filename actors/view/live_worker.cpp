#include "actors/view/live_worker.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "actors/supervise/node_plan.hpp"
#include "actors/view/edits_text.hpp"
#include "actors/view/live_work.hpp"

namespace luxodus {

namespace {

/// Between words that it is there, and has nothing to do.
constexpr Nanoseconds word_every = milliseconds(250);
constexpr Nanoseconds send_again_after = milliseconds(1);
/// Particles of one turn: some 0.2 ms.
constexpr int64_t portion_particles = 128;
/// Leases at hand; more are not taken. A live view lends two at a time.
constexpr size_t max_orders = 8;
constexpr uint32_t max_lease_batches = 1 << 16;
/// What particles' ids have room for: see first_particle_of.
constexpr uint64_t max_batch_numbers = uint64_t{1} << 30;
constexpr uint32_t max_streams = (uint32_t{1} << 20) - 1;

}  // namespace

/// What a live view sends to.
class LiveWorker::LiveTracer final
    : public NodeActor<LiveTracer,
                       ControlLane<Accepts<Letter<TraceBatches>, 16, WhenFull::reject>,
                                   Accepts<Letter<LeaseGranted>, 16, WhenFull::reject>,
                                   Accepts<Letter<RunEnded>, 4, WhenFull::reject>>,
                       DataLane<>> {
 public:
  LiveTracer(LiveWorker& worker, NodeId self, NodeId view, NodeShell& shell)
      : NodeActor(shell.scheduler(), shell.actors(), {self, ActorName::tracer}, "live"),
        worker_(worker),
        coordinator_{view, ActorName::coordinator} {
    shell.actors().add(ActorName::tracer, *this);
  }

  void on(const Letter<TraceBatches>& order) {
    if (hears(order.from)) worker_.take(order);
  }
  /// A live view that waits for edits says so: by leases of nothing.
  void on(const Letter<LeaseGranted>& granted) { (void)hears(granted.from); }
  void on(const Letter<RunEnded>& ended) {
    if (hears(ended.from)) worker_.ended_ = true;
  }

  SendOutcome send(const Message& message, SharedBytes payload = {}) {
    return tell(coordinator_, message, std::move(payload));
  }

 private:
  bool hears(Address from) {
    if (from != coordinator_) return false;
    worker_.heard_ = true;
    return true;
  }

  LiveWorker& worker_;
  const Address coordinator_;
};

LiveWorker::~LiveWorker() = default;

Result<std::shared_ptr<const LiveState>> LiveStates::get(const std::string& edits) {
  const std::lock_guard lock(mutex_);
  if (state_ && edits == edits_) return state_;
  auto parsed = parse_edits(edits);
  if (!parsed) return parsed.problem();
  auto scene = compile_live(*scene_, parsed.value());
  if (!scene) return scene.problem();
  state_ = std::make_shared<LiveState>(std::move(scene).value());
  edits_ = edits;
  return state_;
}

LiveWorker::Tracing::Tracing(std::shared_ptr<const LiveState> of, uint64_t seed)
    : state(std::move(of)),
      tracer(make_batch_tracer(*state->scene, GeometryAccess::resident(state->index), seed)),
      totals(state->scene->layout, static_cast<int>(state->scene->groups.size()),
             photopic_weights(*state->scene)),
      encoder(static_cast<int>(state->scene->groups.size()), state->scene->layout.totals()) {}

LiveWorker::LiveWorker(const RunSetup& run, const NodeSetup& node, const NodeSeams& seams,
                       LiveStates& states)
    : node_(node),
      states_(states),
      shell_({node.net, worker_limits(run, node), ShellConfig{}.max_payload_bytes,
              node.shutdown_phase, run.routes},
             run.graph, seams.clock, seams.transport),
      tracer_(std::make_unique<LiveTracer>(*this, node.net.self, node.controller, shell_)),
      began_(seams.clock.now()) {}

void LiveWorker::start(std::function<bool()> stop) {
  stop_ = std::move(stop);
  look();
  shell_.begin([this] { return ended_ || stop_(); });
}

/// Says that it is there, and gives the live view up when that is gone.
void LiveWorker::look() {
  const Nanoseconds now = shell_.scheduler().clock().now();
  shell_.scheduler().timers().set(now + word_every, [this] { look(); });
  if (ended_) return;
  if (shell_.network().reaches(node_.controller))
    unreachable_since_.reset();
  else if (!unreachable_since_)
    unreachable_since_ = now;
  const auto give_up = [&](const char* what, Nanoseconds after, const char* key) {
    fault_ =
        problem(fmt::format("{} for {:g} s ({})", what, static_cast<double>(after) * 1e-9, key));
    ended_ = true;
  };
  if (!heard_ && now - began_ >= node_.start)
    return give_up("the live view has not been heard of", node_.start, "start_s");
  if (heard_ && unreachable_since_ && now - *unreachable_since_ >= node_.lost)
    return give_up("no way has led to the live view", node_.lost, "lost_s");
  if (orders_.empty() && answers_.empty()) tracer_->send(RequestLease{1});
}

void LiveWorker::take(const Letter<TraceBatches>& order) {
  const std::span<const std::byte> text = order.payload.bytes();
  std::string edits(reinterpret_cast<const char*>(text.data()), text.size());
  // Nobody waits for another state any more.
  if (!orders_.empty() && orders_.back().edits != edits) drop_orders();
  if (orders_.size() >= max_orders) return;
  orders_.push_back({order.body, std::move(edits)});
  wake();
}

/// And what they have given.
void LiveWorker::drop_orders() {
  orders_.clear();
  traced_ = 0;
  tracing_.reset();
}

void LiveWorker::wake() {
  if (working_) return;
  working_ = true;
  shell_.scheduler().timers().set(shell_.scheduler().clock().now(), [this] { work(); });
}

/// One portion, or what is left to be sent.
void LiveWorker::work() {
  working_ = false;
  send_answers();
  if (!orders_.empty() && orders_.front().what.batches == 0) {
    foresee(orders_.front().edits);
    orders_.pop_front();
  } else if (!orders_.empty()) {
    const Order& order = orders_.front();
    std::string fault = trace_portion(order);
    const int64_t all = tracing_ == nullptr
                            ? 0
                            : int64_t{order.what.batches} * tracing_->state->scene->batch_particles;
    if (!fault.empty() || traced_ >= all) answer(std::move(fault));
  }
  if (!orders_.empty()) return wake();
  if (answers_.empty()) return;
  working_ = true;
  shell_.scheduler().timers().set(shell_.scheduler().clock().now() + send_again_after,
                                  [this] { work(); });
}

/// Compiles what may be next. If it cannot be, that is said when it is asked for.
void LiveWorker::foresee(const std::string& edits) try {
  static_cast<void>(states_.get(edits));
} catch (const std::exception&) {
}

Result<void> LiveWorker::enter(const Order& order) {
  if (tracing_ && order.edits == edits_ && order.what.seed == seed_) return {};
  tracing_.reset();
  auto state = states_.get(order.edits);
  if (!state) return state.problem();
  tracing_ = std::make_unique<Tracing>(state.value(), order.what.seed);
  edits_ = order.edits;
  seed_ = order.what.seed;
  return {};
}

/// Why it cannot be traced; "" where it can.
std::string LiveWorker::trace_portion(const Order& order) try {
  if (const auto entered = enter(order); !entered) return entered.problem().text();
  const CompiledScene& scene = *tracing_->state->scene;
  if (order.what.group >= scene.groups.size() || order.what.batches > max_lease_batches ||
      order.what.first_batch > max_batch_numbers || order.what.stream > max_streams)
    return "there are no such batches";
  const int group = static_cast<int>(order.what.group);
  const int64_t in_batch = traced_ % scene.batch_particles;
  if (in_batch == 0) tracing_->scores.reset(scene.layout);
  const auto batch = static_cast<int64_t>(order.what.first_batch) + traced_ / scene.batch_particles;
  const int64_t count = std::min(portion_particles, scene.batch_particles - in_batch);
  tracing_->tracer->trace(group,
                          first_particle_of(scene, static_cast<int>(order.what.stream), batch) +
                              static_cast<uint64_t>(in_batch),
                          count, tracing_->scores);
  traced_ += count;
  if (in_batch + count == scene.batch_particles) tracing_->totals.merge(tracing_->scores, group);
  return "";
} catch (const std::exception& e) {
  tracing_.reset();
  return e.what();
}

void LiveWorker::answer(std::string fault) {
  Answer out;
  out.message.lease = orders_.front().what.lease;
  out.message.fault = fault.substr(0, limits::text_bytes);
  if (fault.empty()) {
    tracing_->encoder.begin(tracing_->totals);
    while (!tracing_->encoder.step(tracing_->state->scene->layout.totals())) continue;
    const auto bytes = std::make_shared<const std::vector<std::byte>>(tracing_->encoder.bytes());
    out.payload = {*bytes, bytes};
  }
  answers_.push_back(std::move(out));
  orders_.pop_front();
  traced_ = 0;
  send_answers();
}

void LiveWorker::send_answers() {
  while (!answers_.empty()) {
    const Answer& next = answers_.front();
    if (tracer_->send(next.message, next.payload) == SendOutcome::full) return;
    answers_.pop_front();  // without a way, the lease is fenced there
  }
}

Result<WorkerReport> run_live_worker(const RunSetup& run, const Machine& machine,
                                     const NodeSetup& node, const std::function<bool()>& stop,
                                     LiveStates& states) {
  NodeTransport transport(machine, node);
  LiveWorker worker(run, node, transport.seams(), states);
  if (auto joined = join_links(transport.sockets(), node); !joined) return joined.problem();
  worker.start(stop);
  worker.shell().run();
  if (!worker.fault()) return WorkerReport{};
  return problem(run.name_of(node.net.self) + ": " + worker.fault()->what +
                 transport.meeting_trouble(worker.shell().network()));
}

}  // namespace luxodus
