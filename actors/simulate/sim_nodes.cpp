#include "actors/simulate/sim_nodes.hpp"

#include <fmt/format.h>

#include "runtime/core/check.hpp"

namespace luxodus {

namespace {

/// Traces for real, and lets the node's clock pass as if it had taken what it costs.
class ChargedTracer final : public BatchTracer {
 public:
  ChargedTracer(std::unique_ptr<BatchTracer> real, SimClock& clock, const SimCosts& costs)
      : real_(std::move(real)), clock_(clock), costs_(costs) {}

  void trace(int group, uint64_t first, int64_t count, BatchScores& scores) override {
    real_->trace(group, first, count, scores);
    clock_.charge(count * costs_.particle);
  }
  uint32_t look_units() const override { return real_->look_units(); }
  void look(int64_t batch, uint32_t unit, BatchScores& scores) override {
    real_->look(batch, unit, scores);
    clock_.charge(costs_.particle);
  }

 private:
  const std::unique_ptr<BatchTracer> real_;
  SimClock& clock_;
  const SimCosts costs_;
};

NodeSeams worker_seams(SimWorld& world, NodeId self, const SimCosts& costs) {
  SimClock& clock = world.clock(self);
  const auto make_tracer = [&clock, costs](const CompiledScene& scene, const GeometryAccess& access,
                                           uint64_t seed) {
    return std::make_unique<ChargedTracer>(make_batch_tracer(scene, access, seed), clock, costs);
  };
  return {clock, world.transport(self), make_tracer};
}

/// Has all fibers return, as they do when they are cancelled.
void end_fibers(Fibers& fibers) {
  fibers.cancel_all();
  while (fibers.live() > 0) {
    LUX_CHECK(fibers.any_ready(), "a cancelled fiber rests where nothing can end it");
    (void)fibers.run_next();
  }
}

std::string fault_of(const NodeShell& shell, const Fibers& fibers) {
  if (fibers.live() > fibers.capacity()) return "more fibers than there are";
  if (shell.finished() && fibers.live() > 0)
    return fmt::format("it has left, and has {}", fibers.describe_live());
  return "";
}

}  // namespace

// ---- workers -----------------------------------------------------------------------------------

SimWorker::SimWorker(const RunSetup& run, const NodeSetup& node, SimWorld& world,
                     const SimCosts& costs, WorkerReport& all)
    : node_(node), all_(all), worker_(run, node, worker_seams(world, node.net.self, costs)) {
  worker_.start([] { return false; });
}

SimWorker::~SimWorker() {
  if (worker_.objects() != nullptr) all_.add(worker_.objects()->report());
}

void SimWorker::die() {
  end_fibers(worker_.shell().scheduler().fibers());
}

std::string SimWorker::fault() const {
  const Scheduler& scheduler = worker_.shell().scheduler();
  if (auto fault = fault_of(worker_.shell(), scheduler.fibers()); !fault.empty()) return fault;
  if (worker_.objects() == nullptr) return "";
  const ObjectCache::Counters& cache = worker_.objects()->cache().counters();
  if (cache.resident_bytes > node_.object_bytes)
    return fmt::format("{} B are resident, with a budget of {} B", cache.resident_bytes,
                       node_.object_bytes);
  if (cache.pinned_bytes > cache.resident_bytes) return "more bytes are pinned than resident";
  if (cache.builds > worker_.objects()->report().fetches)
    return "an object was built twice for one fetch";
  return "";
}

// ---- the controller ----------------------------------------------------------------------------

SimController::SimController(const RunSetup& setup, const NodeSetup& node, LocalRun& run,
                             const StopRule& stop, SimWorld& world, FlushKeeper* keeper)
    : run_(run),
      node_(
          setup, node, run, stop, interrupt_, [](const Progress&) {},
          {world.clock(node.net.self), world.transport(node.net.self)}, keeper) {
  node_.start([] { return false; });
}

Nanoseconds SimController::turn() {
  counted_ = controller().counters().batches;
  const Nanoseconds due = node_.shell().turn();
  went_back_ = went_back_ || controller().counters().batches < counted_;
  return due;
}

void SimController::die() {
  end_fibers(node_.shell().scheduler().fibers());
}

std::string SimController::fault() const {
  if (auto fault = fault_of(node_.shell(), node_.shell().scheduler().fibers()); !fault.empty())
    return fault;
  if (went_back_) return "counted batches have become fewer";
  if (!controller().adding() && !run_.totals().ledger().closes())
    return "the ledger does not close";
  return "";
}

}  // namespace luxodus
