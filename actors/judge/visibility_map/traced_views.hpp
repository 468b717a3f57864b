// Light of views of signs by traced paths, pooled over passes: the rounds of an assessment
// (actors/judge/assess/sights_in_lights.hpp) for views that are asked for one by one. Thread rule:
// one thread, which has batches traced by others.
#pragma once

#include <vector>

#include "actors/judge/assess/assessment.hpp"
#include "actors/judge/assess/round_state.hpp"
#include "actors/judge/assess/view_light.hpp"

namespace luxodus {

/// Batches of a pass, whose spread gives the errors.
inline constexpr int64_t view_batches = 64;

class TracedViews {
 public:
  /// Requires: all arguments outlive this; if nodes trace, the scenario is in the scene's file.
  TracedViews(const JudgedScene& judged, const AssessOptions& options)
      : judged_(judged), options_(options) {}

  /// A view that may be traced. Returns its number.
  size_t add(const glm::dvec3& eye, uint32_t sign, bool back);

  /// Traces `paths` paths of each batch to each part of these views, with random numbers of its
  /// own. Requires: views ascend. Errors: as compile_round; as the executor; `interrupt`.
  Result<void> trace(const std::vector<size_t>& views, int64_t paths,
                     const std::atomic<bool>& interrupt, const AssessProgress& progress);

  /// Paths to each part of a view so far; 0 also of a view that is edge-on within rounding.
  double paths(size_t view) const { return views_[view].paths; }
  /// Whether a batch found more light than is counted: from the face or before it, and from beyond
  /// it. Nothing is known of that light then.
  bool is_face_lost(size_t view) const { return views_[view].face_lost; }
  bool is_beyond_lost(size_t view) const { return views_[view].beyond_lost; }
  /// With errors by the spread of the paths alone. Requires: paths(view) > 0.
  const ViewLight& light(size_t view, size_t mixture) const {
    return views_[view].light[mixture].sample_mean();
  }
  int64_t all_paths() const { return all_paths_; }

 private:
  struct View {
    glm::dvec3 eye;
    uint32_t sign;
    bool back;
    double paths = 0;
    bool face_lost = false, beyond_lost = false;  // see is_face_lost
    std::vector<PooledLight> light = {};          // by mixture
  };
  RoundState state_of(const std::vector<size_t>& views, int64_t paths) const;
  void pool(const CompiledScene& scene, const Totals& totals, double paths,
            const std::vector<size_t>& views);

  const JudgedScene& judged_;
  const AssessOptions& options_;
  std::vector<View> views_;
  int passes_ = 0;
  int64_t all_paths_ = 0;
};

}  // namespace luxodus
