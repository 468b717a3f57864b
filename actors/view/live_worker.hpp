// A node that traces for a live view: batches of whatever state of the building it is asked for.
// It holds the whole scene. It says that it is there while it has nothing to do, traces what it is
// lent a portion a turn, and answers each lease once. Thread rule: the node's thread, but for
// LiveStates.
#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <string>

#include "actors/supervise/node_setup.hpp"
#include "actors/supervise/node_shell.hpp"
#include "actors/supervise/node_threads.hpp"
#include "actors/tally/flush_codec.hpp"
#include "runtime/messaging/node_actor.hpp"
#include "scenes/transport/readout.hpp"

namespace luxodus {

/// A state of the building, compiled.
struct LiveState {
  explicit LiveState(std::shared_ptr<const CompiledScene> of)
      : scene(std::move(of)), index(device, *scene) {}
  std::shared_ptr<const CompiledScene> scene;
  EmbreeDevice device;
  SceneIndex index;
};

/// What the nodes of a process share: the last state that any of them was asked for. Any thread.
class LiveStates {
 public:
  explicit LiveStates(std::shared_ptr<const SceneDescription> scene) : scene_(std::move(scene)) {}
  /// Compiles it, unless it is the last. Errors: as parse_edits and compile_live.
  Result<std::shared_ptr<const LiveState>> get(const std::string& edits);

 private:
  const std::shared_ptr<const SceneDescription> scene_;
  std::mutex mutex_;
  std::string edits_;
  std::shared_ptr<const LiveState> state_;
};

class LiveWorker {
 public:
  /// Requires: all outlive this.
  LiveWorker(const RunSetup& run, const NodeSetup& node, const NodeSeams& seams,
             LiveStates& states);
  ~LiveWorker();

  /// From the shell's next turn on this traces what it is asked for, until the live view ends or
  /// `stop` says so.
  void start(std::function<bool()> stop);
  NodeShell& shell() { return shell_; }
  /// Why it ended without the live view.
  const std::optional<Problem>& fault() const { return fault_; }

 private:
  struct Order {
    TraceBatches what;
    std::string edits;
  };
  /// What traces one state; made anew for another.
  struct Tracing {
    Tracing(std::shared_ptr<const LiveState> of, uint64_t seed);
    std::shared_ptr<const LiveState> state;
    std::unique_ptr<BatchTracer> tracer;
    BatchScores scores;
    Totals totals;
    FlushEncoder encoder;
  };
  struct Answer {
    BatchesTraced message;
    SharedBytes payload;
  };

  class LiveTracer;
  void take(const Letter<TraceBatches>& order);
  void look();
  void work();
  void wake();
  void drop_orders();
  void foresee(const std::string& edits);
  Result<void> enter(const Order& order);
  std::string trace_portion(const Order& order);
  void answer(std::string fault);
  void send_answers();

  const NodeSetup& node_;
  LiveStates& states_;
  NodeShell shell_;
  std::unique_ptr<LiveTracer> tracer_;
  std::function<bool()> stop_;
  std::deque<Order> orders_;  // the first is in work
  int64_t traced_ = 0;        // particles of it
  std::string edits_;         // of tracing_
  uint64_t seed_ = 0;         // likewise
  std::unique_ptr<Tracing> tracing_;
  std::deque<Answer> answers_;  // that have not left yet
  bool working_ = false;        // a timer is set for work()
  bool ended_ = false;
  bool heard_ = false;
  Nanoseconds began_;
  std::optional<Nanoseconds> unreachable_since_;
  std::optional<Problem> fault_;
};

/// Runs one until it has left; see WorkerThreads. Errors: as join_links; a live view that never
/// came, or was lost.
Result<WorkerReport> run_live_worker(const RunSetup& run, const Machine& machine,
                                     const NodeSetup& node, const std::function<bool()>& stop,
                                     LiveStates& states);

}  // namespace luxodus
