#include "actors/lab/simulate/sim_nodes.hpp"

#include <fmt/format.h>

#include "actors/cast/parts/built_parts.hpp"
#include "runtime/core/check.hpp"
#include "runtime/sim/simulated_calls.hpp"

namespace luxodus {

void end_fibers(Fibers& fibers) {
  fibers.cancel_all();
  while (fibers.live() > 0) {
    LUX_CHECK(fibers.any_ready(), "a cancelled fiber rests where nothing can end it");
    (void)fibers.run_next();
  }
}

Result<void> check_fibers(const NodeShell& shell, const Fibers& fibers) {
  if (fibers.live() > fibers.capacity())
    return problem("more fibers than there are", ProblemKind::bug);
  if (shell.finished() && fibers.live() > 0)
    return problem(fmt::format("it has left, and has {}", fibers.describe_live()),
                   ProblemKind::bug);
  return {};
}

namespace {

/// Blocking calls that take virtual time.
CallsMaker calls_in_virtual_time(Buggify* buggify) {
  return [buggify](Scheduler& scheduler) {
    return std::make_unique<SimulatedCalls>(scheduler, [buggify] {
      return rarely(buggify, Buggify::Site::slow_disk) ? milliseconds(300) : milliseconds(1);
    });
  };
}

NodeSeams disk_seams(SimWorld& world, const NodeSetup& node) {
  NodeSeams seams{world.clock(node.net.self), world.transport(node.net.self)};
  seams.make_calls = calls_in_virtual_time(node.buggify);
  return seams;
}

}  // namespace

// ---- workers -----------------------------------------------------------------------------------

NodeSeams charged_seams(SimWorld& world, NodeId self, const SimCosts& costs,
                        const BuilderMaker& builders, Buggify* buggify) {
  SimClock& clock = world.clock(self);
  return {clock, world.transport(self), charged_tracers(clock, costs),
          charged_builders(clock, costs, builders), calls_in_virtual_time(buggify)};
}

BuilderMaker builders_on_one_device() {
  return [device = std::make_shared<BuildDevice>()](const CompiledScene& scene,
                                                    const SceneParts& parts) {
    return std::make_unique<PartBuilder>(scene, parts, device);
  };
}

SimWorker::SimWorker(const RunSetup& run, const NodeSetup& node, const NodeSeams& seams,
                     SimClock& clock, const SimCosts& costs, WorkerReport& all)
    : node_(node), all_(all), meter_(clock), costs_(costs), worker_(run, node, seams) {
  worker_.start([] { return false; });
}

SimWorker::~SimWorker() {
  WorkerReport report = worker_.objects() != nullptr ? worker_.objects()->report() : WorkerReport{};
  if (const auto& verdict = worker_.shell().supervisor().verdict()) report.failed = verdict->actor;
  report.longest_turn = worker_.shell().scheduler().counters().longest_turn;
  all_.add(report);
}

/// Charges the loop's work other than tracing and building, after its turn.
Nanoseconds SimWorker::turn() {
  const Nanoseconds due = worker_.shell().turn();
  const uint64_t resumes = worker_.shell().scheduler().counters().resumes;
  const uint64_t batches = worker_.photons() ? worker_.photons()->counters().batches : 0;
  const uint64_t counted =
      worker_.coordinator() ? worker_.coordinator()->counters().flush_bytes : 0;
  const uint64_t flush_bytes = worker_.tracer().counters().flush_bytes;
  meter_.charge(costs_.switch_ns * static_cast<double>(resumes - charged_.resumes) +
                costs_.lease_ns * static_cast<double>(batches - charged_.batches) +
                costs_.pack_byte_ns * static_cast<double>(flush_bytes - charged_.flush_bytes) +
                costs_.count_byte_ns * static_cast<double>(counted - charged_.counted_bytes));
  charged_ = {resumes, batches, flush_bytes, counted};
  return due;
}

void SimWorker::die() {
  end_fibers(worker_.shell().scheduler().fibers());
}

Result<void> SimWorker::check() const {
  const Scheduler& scheduler = worker_.shell().scheduler();
  if (auto ok = check_fibers(worker_.shell(), scheduler.fibers()); !ok) return ok.problem();
  const SubCoordinator* leads = worker_.coordinator();
  if (leads != nullptr && !leads->adding() && !leads->merged().balance().closes())
    return problem("the ledger of a coordinator does not close", ProblemKind::bug);
  if (worker_.objects() == nullptr) return {};
  const ObjectCache::Counters& cache = worker_.objects()->server().cache().counters();
  if (cache.resident_bytes > node_.object_bytes)
    return problem(fmt::format("{} B are resident, with a budget of {} B", cache.resident_bytes,
                               node_.object_bytes),
                   ProblemKind::bug);
  if (cache.pinned_bytes > cache.resident_bytes)
    return problem("more bytes are pinned than resident", ProblemKind::bug);
  if (cache.builds > worker_.objects()->server().fetcher().counters().fetches)
    return problem("an object was built twice for one fetch", ProblemKind::bug);
  return {};
}

Result<void> SimWorker::outcome() const {
  const auto result = worker_.result();
  return result ? Result<void>() : result.problem();
}

// ---- the controller ----------------------------------------------------------------------------

SimController::SimController(const RunSetup& setup, const NodeSetup& node, LocalRun& run,
                             const StopRule& stop, SimWorld& world, const SimCosts& costs,
                             FlushKeeper* keeper)
    : run_(run),
      meter_(world.clock(node.net.self)),
      costs_(costs),
      node_(setup, node, {run, stop, interrupt_, [](const Progress&) {}, keeper},
            disk_seams(world, node)) {
  node_.start([] { return false; });
}

Nanoseconds SimController::turn() {
  counted_ = coordinator().counters().batches;
  const Nanoseconds due = node_.shell().turn();
  went_back_ = went_back_ || coordinator().counters().batches < counted_;
  const uint64_t flush_bytes = coordinator().counters().flush_bytes;
  meter_.charge(costs_.count_byte_ns * static_cast<double>(flush_bytes - charged_flush_bytes_));
  charged_flush_bytes_ = flush_bytes;
  return due;
}

void SimController::die() {
  end_fibers(node_.shell().scheduler().fibers());
}

Result<void> SimController::check() const {
  if (auto ok = check_fibers(node_.shell(), node_.shell().scheduler().fibers()); !ok)
    return ok.problem();
  if (went_back_) return problem("counted batches have become fewer", ProblemKind::bug);
  if (!coordinator().adding() && !run_.totals().balance().closes())
    return problem("the ledger does not close", ProblemKind::bug);
  return {};
}

/// A display that has written the results may be gone when a controller restarts.
Result<void> SimController::outcome() const {
  if (coordinator().fault() && !coordinator().lost_display()) return *coordinator().fault();
  return {};
}

}  // namespace luxodus
