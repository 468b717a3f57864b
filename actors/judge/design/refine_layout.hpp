// Luminaires of a layout moved between the places of the grid, so that minima are kept with more to
// spare by as many of them: without gradients (BOBYQA, Powell 2009), one luminaire after another,
// each position lit by the code mode's own light. The only source that includes NLopt. The same
// layout gives the same one, unless a limit of time or an interrupt ends it. Thread rule: one
// thread, which has rows run on others.
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
  std::vector<LuminaireCandidate> luminaires;  // as they were given, moved
  size_t moved = 0;
  /// The least share of what is planned for, over all minima: before and after.
  double before = 0, after = 0;
  int evaluations = 0;
  std::unique_ptr<Demands> demands;  // of the moved ones; each is an option
};

/// `chosen`: the candidates of a layout; `all`: the demands of all candidates. What furniture hides
/// from all of these may be hidden: no move may hide more, and none leaves a gap between the points
/// that they reach. Existing luminaires stay. Errors: as compile_scene.
Result<Refinement> refine_layout(const SceneDescription& scene, const DesignSettings& design,
                                 const std::vector<LuminaireCandidate>& chosen, const Demands& all,
                                 const RefineOptions& options, const std::atomic<bool>& interrupt,
                                 const std::function<void(double least)>& progress);

}  // namespace luxodus
