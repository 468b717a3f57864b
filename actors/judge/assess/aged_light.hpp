// Groups the sources of a scene by how far their light has aged, so that one set of paths gives
// both the state at the end of the rated duration and the state when all was new. Flux is linear:
// the new light of a group is its aged light divided by the remaining share. Pure functions; any
// thread.
#pragma once

#include "scenes/light/transport/compile.hpp"

namespace luxodus {

/// Distinct remaining shares of new light in a scene. The first is 1, for sources that do not age.
struct AgeingShares {
  std::vector<double> shares{1};
  /// Whether the fluxes of all new luminaires are known; else new light is that or more.
  bool new_light_known = true;

  /// The mixture that turns aged light into new light, in a scene grouped by group_by_ageing.
  GroupMixture renewal() const;
  bool any() const { return shares.size() > 1; }
};

/// Remaining share of an emitter's new light in an operation: 1 if the scene states no factor, and
/// 1 for an emitter that is dark then.
double aged_share(const Emitter& emitter, Operation operation);

/// Assigns every source to the group of its share. Errors: more shares than limits::ageings.
Result<AgeingShares> group_by_ageing(SceneDescription& scene, Operation operation);

}  // namespace luxodus
