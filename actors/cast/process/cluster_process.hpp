// One process of a cluster: reads the scene that the cluster's file names, makes the graph, and
// runs those nodes that belong to the process; where the controller is among them, the results are
// left with it. Every process reads the same files and comes to the same setup; the handshake
// between nodes checks that. Thread rule: called from one thread, which becomes the controller's
// where it is here.
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

/// The graph that a cluster's file names or asks for.
/// Errors: a graph that is none, or not of this cluster's size.
Result<Graph> graph_of(const ClusterConfig& cluster);

/// The smallest budget for objects of a worker [bytes].
uint64_t smallest_object_bytes(const ClusterConfig& cluster);

/// Cells of the partition: so many that a sixteenth of the smallest budget holds one. A pure
/// function of file and scene, so all nodes agree.
int cells_for(const ClusterConfig& cluster, uint64_t built_geometry_bytes);

/// The workers among which objects are shared out.
std::vector<NodeId> holders_of(const ClusterConfig& cluster);

/// What the nodes of a process do, where that is not the run that their file describes.
struct NodeWork {
  RunWorker worker;
  /// On the calling thread, until its work is over.
  std::function<Result<StopReason>(const RunSetup& run, const Machine& machine,
                                   const NodeSetup& node)>
      controller;
};

/// What a process of a cluster is about to do; kept while it runs.
class ClusterProcessRun {
 public:
  /// Reads keys, scene and graph for `nodes` (all of one process).
  /// Errors: files that are missing or wrong; keys that are missing.
  static Result<std::unique_ptr<ClusterProcessRun>> prepare(const ClusterConfig& cluster,
                                                            const std::vector<NodeId>& nodes);
  ~ClusterProcessRun();

  /// Whether the run is shown by a node of this process.
  bool shows() const;
  /// Runs the nodes until the run has ended; with the controller here, says why it ended. `display`
  /// shows it. Requires: shows(), or `display` is null.
  /// Errors: as join_links; a worker that failed; results that could not be written.
  Result<std::optional<StopReason>> run(const std::atomic<bool>& interrupt,
                                        const std::function<void(const Progress&)>& report,
                                        RunOutput* display);
  /// As run(), for other work, for which every node holds the whole scene. Nothing is kept of it.
  /// Errors: as run(); a scene that is more than some node's budget.
  Result<std::optional<StopReason>> run(const std::atomic<bool>& interrupt, const NodeWork& work);

  /// What nodes ask of objects, counted with this share of the run's particles.
  /// Errors: budgets that hold the whole scene, so that nothing is fetched.
  Result<ReferenceProfile> profile(double share) const;
  /// After run(), of a run with a profile: lines of residency_table() for the nodes that are here.
  const std::vector<std::string>& residency_lines() const { return residency_lines_; }

  /// The totals, where the controller is here.
  const LocalRun& local_run() const { return *run_; }
  /// The results are written: what was kept of the run for a crash goes.
  void forget_journal() const;
  /// The journal gives back the room that it has kept on its disk, for the results.
  void make_room() const;
  int cells() const { return cells_; }

 private:
  ClusterProcessRun(const ClusterConfig& cluster, Graph graph)
      : cluster_(cluster), graph_(std::move(graph)) {}

  /// Nodes that hold an object: one may be lost.
  uint32_t replicas() const {
    return std::min<uint32_t>(2, static_cast<uint32_t>(cluster_.workers()));
  }
  struct Prepared;
  Result<std::unique_ptr<Prepared>> prepare_nodes(RunOutput* display);
  Result<void> load_scene();
  /// What is damaged in the scene's file, other nodes would ask this process for again and again.
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
  bool fetches_ = false;  // the scene is more than a node's budget
  std::vector<NodeId> nodes_;
  std::map<NodeId, KeyPair> keys_;
  std::map<NodeId, std::string> public_keys_;
  std::unique_ptr<LocalRun> run_;
  std::unique_ptr<RunJournal> journal_;  // where the controller is here
  std::vector<std::string> residency_lines_;
};

}  // namespace luxodus
