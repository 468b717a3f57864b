// Suggests, in seconds, further luminaires for a building as it is: for users of the live view who
// move luminaires by hand. Uses the rules of the scene and direct light in clear air; the result is
// not assessed. Thread rule: as design.hpp.
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

/// A copy of a luminaire of the scene, to be added.
struct SuggestedLuminaire {
  std::string of;
  glm::dvec3 position{0};
  glm::dvec3 aim{0, 0, -1};
};

/// A place with the share of the missing light that one luminaire of the best type gives there.
struct HelpfulPlace {
  glm::dvec3 position{0};
  double share = 0;
};

struct Suggestion {
  std::vector<SuggestedLuminaire> luminaires;  // with these all demands hold
  LayoutEnd end = LayoutEnd::unknown;
  double bound = 0;    // lower bound on the number of luminaires
  double missing = 0;  // share of rows that are violated now
  double least = 0;    // least share of a row's requirement now
  std::vector<HelpfulPlace> helpful;
};

/// Each place with the contribution of its best option to violated rows, as a share of all that
/// they miss. It uses numbers only, no geometry. Requires: a layout of the problem.
std::vector<std::pair<uint32_t, double>> helpful_places(const LayoutProblem& problem,
                                                        const Layout& layout);

/// Luminaires of the scene stay as they are. Only types that equal a luminaire of the scene are
/// placed, without rotation about their aim.
/// Errors: as assess; no such type; no place for a luminaire; nothing to light.
Result<Suggestion> suggest(const std::shared_ptr<const SceneDescription>& scene,
                           const SuggestOptions& options, const std::atomic<bool>& interrupt);

}  // namespace luxodus
