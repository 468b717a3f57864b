// One run of a study: on simulated nodes, by virtual time and measured costs, or on real nodes of
// this process. Either way the nodes are the production ones, set up by the same code, and the
// numbers are counted by the same counters.
// Thread rule: the calling thread.
#pragma once

#include <atomic>

#include "actors/cast/process/planned_nodes.hpp"
#include "actors/lab/simulate/recording.hpp"
#include "actors/lab/study/results.hpp"
#include "actors/lab/study/study_file.hpp"

namespace luxodus {

/// What one run is of. All that is referred to outlives the run.
struct StudyRun {
  const Study& study;
  const StudyPoint& point;
  std::shared_ptr<const CompiledScene> scene;
  uint64_t seed = 1;
  SimCosts costs;                        // of simulated nodes
  const Recording* recording = nullptr;  // replayed instead of tracing, where there is one
};

/// Of a kind, with a controller. Errors: no such graph; more nodes than a graph may have.
Result<Graph> study_graph(const std::string& topology, uint32_t nodes, uint32_t links);

/// Particles of the run, whole batches.
int64_t particles_of(const Study& study, const StudyPoint& point);

/// Nodes as the point wants them. Errors: as study_graph; a cache without room.
Result<NodesOptions> nodes_of(const StudyRun& run);

/// Errors: options that contradict each other or the scene; a run that does not end; `interrupt`.
Result<StudyResult> run_simulated(const StudyRun& run, const std::atomic<bool>& interrupt);
Result<StudyResult> run_real(const StudyRun& run, const std::atomic<bool>& interrupt);

}  // namespace luxodus
