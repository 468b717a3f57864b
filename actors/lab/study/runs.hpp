// One run of a study: on simulated nodes, in virtual time with measured costs, or on real nodes of
// this process. Either way the nodes are the production ones, set up by the same code and measured
// by the same counters. Thread rule: the calling thread.
#pragma once

#include <atomic>

#include "actors/cast/process/planned_nodes.hpp"
#include "actors/lab/simulate/recording.hpp"
#include "actors/lab/study/results.hpp"
#include "actors/lab/study/study_file.hpp"

namespace luxodus {

/// Inputs of one run. All references outlive the run.
struct StudyRun {
  const Study& study;
  const StudyPoint& point;
  std::shared_ptr<const CompiledScene> scene;
  uint64_t seed = 1;
  SimCosts costs;                        // of simulated nodes
  const Recording* recording = nullptr;  // replayed instead of tracing, if there is one
};

/// A graph of this topology, with a controller. Errors: no such graph; more nodes than a graph may
/// have.
Result<Graph> study_graph(const std::string& topology, uint32_t nodes, uint32_t links);

/// Particles of the run, in whole batches.
int64_t particles_of(const Study& study, const StudyPoint& point);

/// Options for the point's nodes. Errors: those of study_graph; a cache without room.
Result<NodesOptions> nodes_of(const StudyRun& run);

/// Errors: options that contradict each other or the scene; a run that does not end; `interrupt`.
Result<StudyResult> run_simulated(const StudyRun& run, const std::atomic<bool>& interrupt);
Result<StudyResult> run_real(const StudyRun& run, const std::atomic<bool>& interrupt);

}  // namespace luxodus
