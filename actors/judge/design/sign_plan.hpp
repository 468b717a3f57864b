// Which signs hang where, and where their arrows point: the fewest, or the cheapest, so that
// everywhere on a route a sign ahead belongs to this route, points along it, and is near enough by
// the rules. Found before the luminaires, which signs that are lit from outside ask for. Thread
// rule: as design.hpp. Why so: docs/decisions/0057-signs-before-luminaires.md.
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
/// Signs of all types and arrows at all places: who sees each is computed.
inline constexpr size_t sign_candidates = 20'000;
}  // namespace limits

/// A sign of the plan. An existing one has its own name and type `existing_sign`.
struct PlacedSign {
  static constexpr size_t existing = static_cast<size_t>(-1);

  std::string name;
  size_t type = existing;  // of DesignSettings::sign_types
  SignSpot spot;
  std::vector<LeadsTo> leads_to;
  bool is_new() const { return type != existing; }
};

/// Places of a route from which no sign guides: none of the candidates is seen there, or in every
/// plan that was tried signs hide each other.
struct UnguidedPlaces {
  std::string route;
  size_t places = 0, of = 0;
  bool behind_furniture = false;  // without furniture one would be seen from all of them
  bool behind_signs = false;      // one would be seen from all of them without the other new signs
  glm::dvec3 first{0};            // the first of them, on the floor
};

struct SignPlan {
  std::vector<PlacedSign> signs;     // those of the scene that stay first
  std::vector<std::string> removed;  // signs of the scene that go
  LayoutEnd end = LayoutEnd::unknown;
  double objective = 0, bound = 0;
  size_t places = 0, candidates = 0;  // of new signs
  SignsLeftOut left_out;
  std::vector<UnguidedPlaces> unguided;

  /// Whether the rules for the distance to signs hold on a route by this plan.
  bool guides(const std::string& route) const;
};

struct SignPlanOptions {
  std::vector<CodeChoice> codes;
  Scenario doors;
  double seconds = 30;  // of all searches: a plan whose signs hide each other is made again
  uint64_t seed = 1;
  int threads = 1;
};

/// `scene`: as the circuits of the judged state leave it; it has routes.
/// Errors: as compile_scene; more signs than a limit; no plan exists, or none was found in time.
Result<SignPlan> plan_signs(const SceneDescription& scene, const DesignSettings& design,
                            const SignPlanOptions& options, const std::atomic<bool>& interrupt,
                            const SolveProgress& progress);

/// The scene with the signs of a plan, as a variant on disk gives it.
std::shared_ptr<const SceneDescription> with_signs(const SceneDescription& scene,
                                                   const SignPlan& plan);

}  // namespace luxodus
