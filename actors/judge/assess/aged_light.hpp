// Light of a state told apart by how far it has aged, so that one set of paths gives the state at
// the end of the rated duration and the state when all was new. Flux is linear: new light is the
// aged light of each source group over the share that is left of it. Pure; any thread.
#pragma once

#include "scenes/light/transport/compile.hpp"

namespace luxodus {

/// The shares of new light that are left in a scene, each once. The first is 1: what does not age.
struct AgeingShares {
  std::vector<double> shares{1};

  /// New light of aged light, in a scene that group_by_ageing has grouped.
  GroupMixture renewal() const;
  bool any() const { return shares.size() > 1; }
};

/// What is left of an emitter's new light in an operation: 1 where nothing is said, and of one that
/// is dark.
double aged_share(const Emitter& emitter, Operation operation);

/// Puts every source into the group of its share.
/// Errors: more shares than limits::ageings.
Result<AgeingShares> group_by_ageing(SceneDescription& scene, Operation operation);

}  // namespace luxodus
