#include "actors/cast/process/out_of_core_for.hpp"

#include <array>
#include <atomic>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "actors/cast/node/fetching_objects.hpp"
#include "actors/cast/node/graph_routes.hpp"
#include "actors/cast/node/node_plan.hpp"
#include "runtime/core/denormals.hpp"
#include "scenes/light/transport/packed_scene.hpp"
#include "topology/graph.hpp"

namespace luxodus {

namespace {

/// For a node without neighbours.
class NoTransport final : public Transport {
 public:
  explicit NoTransport(const Clock& clock) : quiet_(clock) {}

  Sent send(NodeId, Lane, std::span<const std::byte>, std::span<const std::byte>) override {
    return Sent::unreachable;
  }
  void renew(NodeId) override {}
  std::optional<Arrival> receive() override { return std::nullopt; }
  void wait_until(Nanoseconds until) override { quiet_.wait_until(until); }
  void wake() noexcept override { quiet_.wake(); }

 private:
  QuietSource quiet_;
};

/// The rows of one run(), shared by the threads.
struct Rows {
  Rows(int64_t rows, const ParallelFor::Finished& told) : count(rows), finished(told) {}

  const int64_t count;
  const ParallelFor::Finished& finished;
  std::atomic<int64_t> next{0};
  std::atomic<bool> failed{false};
  std::mutex mutex;
  int64_t done = 0;

  void do_all(const ParallelFor::Worker& worker) {
    for (int64_t row = next++; row < count && !failed; row = next++) {
      worker(row);
      const std::lock_guard lock(mutex);
      ++done;
      if (finished) finished(done);
    }
  }
};

Graph lonely_graph() {
  GraphPlan plan;
  plan.workers = 1;
  return Graph(std::move(plan));
}

}  // namespace

struct OutOfCoreParallelFor::Stored {
  explicit Stored(const CompiledScene& scene)
      : objects(scene, std::array{NodeId{0}}, 1), proxies(device, scene.cell_boxes) {}

  EmbreeDevice device;
  SceneObjects objects;
  ProxyScene proxies;
  Graph graph = lonely_graph();
  SystemClock clock;
};

OutOfCoreParallelFor::OutOfCoreParallelFor(std::shared_ptr<const CompiledScene> scene,
                                           const OutOfCoreConfig& config)
    : scene_(std::move(scene)), config_(config), stored_(std::make_unique<Stored>(*scene_)) {}
OutOfCoreParallelFor::~OutOfCoreParallelFor() = default;

namespace {

/// One thread's work: fibers on a node of its own, until the rows are done.
void work(const RunSetup& run, const NodeSetup& node, const Clock& clock,
          const ParallelFor::MakeWorker& make, Rows& rows) {
  flush_denormals();
  NoTransport transport(clock);
  NodeShell shell({node.net, worker_limits(run, node)},
                  reroute_on(run.graph, nullptr, node.net.self), clock, transport);
  FetchingObjects cells(run, node, shell);
  const GeometryAccess access = GeometryAccess::through(*run.proxies, cells.source());
  std::vector<ParallelFor::Worker> workers;
  for (size_t i = 0; i < node.photons.fibers; ++i) workers.push_back(make(access));
  size_t running = workers.size();
  for (const ParallelFor::Worker& worker : workers) {
    const auto body = [&rows, &worker, &cells, &running] {
      rows.do_all(worker);
      if (cells.source().spoilt()) rows.failed = true;
      --running;
    };
    LUX_CHECK(shell.scheduler().fibers().start("rows", body), "the plan counts a fiber for each");
  }
  shell.begin([&] { return running == 0; });
  shell.run();
}

/// Why rows could not get a part of the scene: checks the whole file, after a failure.
std::string unread_parts(const CompiledScene& scene) {
  if (const auto whole = check_objects(scene); !whole) return whole.problem().text();
  const auto& packed = scene.description->packed;
  return (packed != nullptr ? packed->file->name() : scene.description->file) +
         ": parts of this scene could not be read from where it is stored, and can be now: was the "
         "file replaced? Run again";
}

}  // namespace

void OutOfCoreParallelFor::run(int64_t rows, const MakeWorker& make,
                               const Finished& finished) const {
  if (rows == 0) return;
  SharedObjects shared_objects(stored_->objects.places().size());
  RunSetup run{*scene_, nullptr, &stored_->proxies, &stored_->objects, 0, stored_->graph,
               {},      nullptr};
  if (config_.sharing) run.shared = &shared_objects;
  NodeSetup node;
  node.net.self = {0};
  node.net.incarnation = {1};
  node.net.nodes = 1;
  node.photons.fibers = config_.fibers;
  node.stall = seconds(10);  // no heartbeats wait for a row, which may take long
  node.object_bytes = config_.object_bytes / static_cast<size_t>(config_.threads);
  Rows shared(rows, finished);
  std::string wrong;
  const auto guarded = [&] {
    try {
      work(run, node, stored_->clock, make, shared);
    } catch (const std::exception& e) {
      shared.failed = true;
      const std::lock_guard lock(shared.mutex);
      wrong = e.what();
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < config_.threads; ++i) threads.emplace_back(guarded);
  for (std::thread& thread : threads) thread.join();
  if (!wrong.empty()) throw std::runtime_error(wrong);
  if (shared.failed) throw std::runtime_error(unread_parts(*scene_));
}

}  // namespace luxodus
