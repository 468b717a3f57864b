// One process of a cluster: reads the scene named in the cluster file, makes the graph, and runs
// the nodes that belong to the process; if the controller is among them, it ends up with the
// results. Every process reads the same files and derives the same setup; the handshake between
// nodes verifies that. Thread rule: called from one thread, which becomes the controller's if that
// is here.
#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>

#include "actors/cast/process/in_process.hpp"
#include "actors/cast/process/run_journal.hpp"
#include "runtime/config/cluster_config.hpp"

namespace luxodus {

/// The graph that a cluster file names or asks for. Errors: an invalid graph, or one that is not of
/// this cluster's size.
Result<Graph> graph_of(const ClusterConfig& cluster);

/// The smallest object budget of a worker [bytes].
uint64_t smallest_object_bytes(const ClusterConfig& cluster);

/// Cells of the partition: enough that a sixteenth of the smallest budget holds one. A pure
/// function of file and scene, so all nodes agree.
int cells_for(const ClusterConfig& cluster, uint64_t built_geometry_bytes);

/// The workers among which objects are distributed.
std::vector<NodeId> holders_of(const ClusterConfig& cluster);

/// Work of a process's nodes other than the run that their file describes.
struct NodeWork {
  RunWorker worker;
  /// Runs on the calling thread, until its work is over.
  std::function<Result<StopReason>(const RunSetup& run, const Machine& machine,
                                   const NodeSetup& node)>
      controller;
};

/// A process of a cluster, prepared to run.
class ClusterProcessRun {
 public:
  /// Reads keys, scene and graph for `nodes` (all of one process). Errors: files that are missing
  /// or wrong; missing keys.
  static Result<std::unique_ptr<ClusterProcessRun>> prepare(const ClusterConfig& cluster,
                                                            const std::vector<NodeId>& nodes);
  ~ClusterProcessRun();

  /// Whether a node of this process shows the run.
  bool shows() const;
  /// Runs the nodes until the run has ended; if the controller is here, returns why it ended.
  /// `display` shows it. Requires: shows(), or `display` is null. Errors: those of join_links; a
  /// worker that failed; results that could not be written.
  Result<std::optional<StopReason>> run(const std::atomic<bool>& interrupt,
                                        const std::function<void(const Progress&)>& report,
                                        RunOutput* display);
  /// Like run(), for other work, for which every node holds the whole scene. It is not journaled.
  /// Errors: those of run(); a scene larger than some node's budget.
  Result<std::optional<StopReason>> run(const std::atomic<bool>& interrupt, const NodeWork& work);

  /// Counts the nodes' references to objects, with this share of the run's particles. Errors:
  /// budgets that hold the whole scene, so that nothing is fetched.
  Result<ReferenceProfile> profile(double share) const;
  /// After run() with a profile: lines of residency_table() for this process's nodes.
  const std::vector<std::string>& residency_lines() const { return residency_lines_; }

  /// The totals, if the controller is here.
  const LocalRun& local_run() const { return *run_; }
  /// Removes the journal, once the results are written.
  void forget_journal() const;
  /// Releases the disk space that the journal has reserved, for the results.
  void make_room() const;
  int cells() const { return cells_; }

 private:
  ClusterProcessRun(const ClusterConfig& cluster, Graph graph)
      : cluster_(cluster), graph_(std::move(graph)) {}

  /// Holders of an object: one may be lost.
  uint32_t replicas() const {
    return std::min<uint32_t>(2, static_cast<uint32_t>(cluster_.workers()));
  }
  struct Prepared;
  Result<std::unique_ptr<Prepared>> prepare_nodes(RunOutput* display);
  Result<void> load_scene();
  /// Other nodes would request damaged objects of this process's scene file again and again.
  Result<void> check_stored_objects() const;
  Result<void> load_keys(const std::vector<NodeId>& nodes);
  Result<std::optional<Residency>> planned_residency(const RunSetup& run) const;
  Result<NodeSetup> setup_of(NodeId self, const RunSetup& run) const;
  Result<void> open_journal(const Clock& clock);
  ObserveOptions observe_options() const;
  Result<void> write_trace(const Observation& seen) const;

  const ClusterConfig cluster_;
  const Graph graph_;
  int cells_ = 1;
  bool fetches_ = false;  // the scene is larger than a node's budget
  std::vector<NodeId> nodes_;
  std::map<NodeId, KeyPair> keys_;
  std::map<NodeId, std::string> public_keys_;
  std::unique_ptr<LocalRun> run_;
  std::unique_ptr<RunJournal> journal_;  // if the controller is here
  std::vector<std::string> residency_lines_;
};

}  // namespace luxodus
