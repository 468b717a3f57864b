// Where further luminaires would go in a building as it stands now, in seconds: for somebody who
// moves luminaires by hand and wants the rest. By the rules of the scene and direct light in clear
// air; the answer is not assessed. Thread rule: as design.hpp.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "actors/judge/design/solve_layout.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

struct SuggestOptions {
  double seconds = 5;  // of the search
  int threads = 1;
};

/// A copy of a luminaire of the scene that would be added.
struct SuggestedLuminaire {
  std::string of;
  glm::dvec3 position{0};
  glm::dvec3 aim{0, 0, -1};
};

/// How much of all that is missing now one luminaire there would bring, the best type for it.
struct HelpfulPlace {
  glm::dvec3 position{0};
  double share = 0;
};

struct Suggestion {
  std::vector<SuggestedLuminaire> luminaires;  // with them all demands hold
  LayoutEnd end = LayoutEnd::unknown;
  double bound = 0;    // no layout has fewer
  double missing = 0;  // share of the demands' rows that do not hold now
  double least = 0;    // of what a row asks for, the least share that is there now
  std::vector<HelpfulPlace> helpful;
};

/// Each place with what the best of its options adds to rows that do not hold, as a share of all
/// that they miss. Numbers alone. Requires: a layout of the problem.
std::vector<std::pair<uint32_t, double>> helpful_places(const LayoutProblem& problem,
                                                        const Layout& layout);

/// All luminaires of the scene stay as they are. Only types that are like a luminaire of the scene
/// are placed, and none that is turned about its aim.
/// Errors: as assess; no such type; no place for a luminaire; nothing to light.
Result<Suggestion> suggest(const std::shared_ptr<const SceneDescription>& scene,
                           const SuggestOptions& options, const std::atomic<bool>& interrupt);

}  // namespace luxodus
