// Traces a round of paths from eyes (round_state.hpp), by threads or by nodes. One thread, which
// has batches traced by others.
#pragma once

#include <functional>
#include <memory>

#include "actors/judge/assess/assessment.hpp"
#include "actors/judge/assess/round_state.hpp"
#include "actors/results/run/local_run.hpp"

namespace luxodus {

/// RoundState::eye_path_factor with which each batch traces so many paths to each part of so many
/// views.
double eye_path_factor(int64_t paths, size_t views);

struct RoundRequest {
  RoundState state;
  uint64_t seed = 0;
  int64_t batches = 0;
};

/// The totals of a round. `tell`: receives the share that is done. Errors: as compile_round; as the
/// executor; `interrupt`.
Result<std::unique_ptr<LocalRun>> trace_round(const JudgedScene& judged,
                                              const RoundRequest& request,
                                              const AssessOptions& options,
                                              const std::atomic<bool>& interrupt,
                                              const std::function<void(double share)>& tell);

/// Number of paths from eyes that a round has traced.
int64_t eye_paths_of(const LocalRun& round);

}  // namespace luxodus
