// Moves luminaires of a layout between places of the grid, so that minima hold with more to spare
// at the same number of luminaires. Derivative-free search (BOBYQA, Powell 2009), one luminaire
// after another, with the light of the code mode at each position. No other source includes NLopt.
// Equal layouts give equal results, unless a time limit or an interrupt ends the search.
// Thread rule: one thread, which has rows computed by others.
#pragma once

#include <atomic>
#include <functional>

#include "actors/judge/design/demands.hpp"

namespace luxodus {

struct RefineOptions {
  std::vector<CodeChoice> codes;
  Scenario doors;
  double seconds = 30;
  int threads = 1;
};

struct Refinement {
  std::vector<LuminaireCandidate> luminaires;  // as given, but moved
  size_t moved = 0;
  /// Least share of the planned value over all minima, before and after.
  double before = 0, after = 0;
  int evaluations = 0;
  std::unique_ptr<Demands> demands;  // of the moved luminaires, each as an option
};

/// `chosen`: the candidates of a layout; `all`: the demands of all candidates. Points that
/// furniture hides from all candidates may stay hidden; no move hides more, or leaves a gap between
/// points that luminaires reach. Existing luminaires are not moved. Errors: as compile_scene.
Result<Refinement> refine_layout(const SceneDescription& scene, const DesignSettings& design,
                                 const std::vector<LuminaireCandidate>& chosen, const Demands& all,
                                 const RefineOptions& options, const std::atomic<bool>& interrupt,
                                 const std::function<void(double least)>& progress);

}  // namespace luxodus
