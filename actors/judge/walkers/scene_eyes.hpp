// What eyes at given places and times find in a scene: which signs they read, by estimates that
// were traced before anybody walks, and the smoke at them. Thread rule: one thread, which has rows
// and batches traced by others.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "actors/judge/assess/over_time.hpp"
#include "actors/judge/inspect/building.hpp"
#include "actors/judge/visibility_map/sign_estimates.hpp"
#include "actors/judge/walkers/people.hpp"

namespace luxodus {

struct EyesRequest {
  StatesToAssess states;           // the scene over time, or its only state
  AssessOptions options;           // as of SignEstimates; names the scenario
  std::vector<std::string> signs;  // names; empty: nobody reads any
  std::vector<glm::dvec3> eyes;    // where eyes may be; as of SignEstimates
};

class SceneEyes {
 public:
  /// Requires: the request outlives it. Errors: as SignEstimates::make.
  static Result<std::unique_ptr<SceneEyes>> make(const EyesRequest& request,
                                                 const std::atomic<bool>& interrupt,
                                                 const AssessProgress& progress);

  /// Requires: times that do not descend. Errors: those of reading and compiling a state.
  Result<FoundByEyes> find(double time_s, const std::vector<glm::dvec3>& eyes);

 private:
  /// A state of the scene with its smoke; no building where it has none.
  struct Smoke {
    size_t state = 0;
    std::unique_ptr<Building> building;
  };
  explicit SceneEyes(const EyesRequest& request);
  Result<const Building*> smoke_of(size_t state);
  Result<std::vector<double>> extinctions(double time_s, const std::vector<glm::dvec3>& eyes);

  const EyesRequest& request_;
  std::vector<double> times_s_;               // of the states; one time 0 for the only one
  std::unique_ptr<SignEstimates> estimates_;  // null: no signs
  std::vector<Smoke> smoke_;                  // of the states around the last time
};

}  // namespace luxodus
