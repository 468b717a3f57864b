// Plans signs: which hang where, and where their arrows point. The plan has the fewest signs or the
// lowest cost, such that everywhere on a route a sign ahead belongs to this route, points along it,
// and is within the distance of the rules. It is made before the luminaires, since externally lit
// signs need luminaires. Thread rule: as design.hpp. Design:
// docs/decisions/0057-signs-before-luminaires.md.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "actors/judge/design/layout_problem.hpp"
#include "actors/judge/design/sign_places.hpp"
#include "actors/judge/design/solve_layout.hpp"
#include "scenes/emergency/rule_sets.hpp"

namespace luxodus {

namespace limits {
/// Signs of all types and arrows at all places; for each it is computed who sees it.
inline constexpr size_t sign_candidates = 20'000;
}  // namespace limits

/// A sign of the plan. An existing sign keeps its name and has the type `existing`.
struct PlacedSign {
  static constexpr size_t existing = static_cast<size_t>(-1);

  std::string name;
  size_t type = existing;  // index into DesignSettings::sign_types
  SignSpot spot;
  std::vector<LeadsTo> leads_to;
  bool is_new() const { return type != existing; }
};

/// Places of a route from which no sign guides: no candidate is visible there, or new signs hide
/// each other in every plan that was tried.
struct UnguidedPlaces {
  std::string route;
  size_t places = 0, of = 0;
  bool behind_furniture = false;  // a candidate is visible from all of them without furniture
  bool behind_signs = false;      // a sign is visible from all of them without the other new signs
  glm::dvec3 first{0};            // the first of these places, on the floor
  static constexpr void fields(auto&& field, auto& m) {
    field("route", m.route)("places", m.places)("of", m.of);
    field("behind_furniture", m.behind_furniture)("behind_signs", m.behind_signs);
    field("first", m.first);
  }
};

struct SignPlan {
  std::vector<PlacedSign> signs;     // first the signs of the scene that stay
  std::vector<std::string> removed;  // signs of the scene that are removed
  LayoutEnd end = LayoutEnd::unknown;
  double objective = 0, bound = 0;
  size_t places = 0, candidates = 0;  // for new signs
  SignsLeftOut left_out;
  std::vector<UnguidedPlaces> unguided;

  /// Whether the plan satisfies the rules for the distance to signs on a route.
  bool guides(const std::string& route) const;
};

struct SignPlanOptions {
  std::vector<CodeChoice> codes;
  Scenario doors;
  double seconds = 30;  // for all searches; plans whose signs hide each other are solved again
  uint64_t seed = 1;
  int threads = 1;
};

/// `scene`: after the circuits of the judged state; it has routes.
/// Errors: as compile_scene; more signs than a limit; no plan exists, or none was found in time.
Result<SignPlan> plan_signs(const SceneDescription& scene, const DesignSettings& design,
                            const SignPlanOptions& options, const std::atomic<bool>& interrupt,
                            const SolveProgress& progress);

/// The scene with the signs of a plan, as a variant on disk gives it.
std::shared_ptr<const SceneDescription> with_signs(const SceneDescription& scene,
                                                   const SignPlan& plan);

}  // namespace luxodus
