// Whether the minima hold when luminaires are mounted a little off: each new luminaire may be off
// by a distance in any direction, all at once, and at each point each is where it gives least.
// Numbers of the code mode's own light. Thread rule: one thread, which has rows run on others. Why
// so: docs/decisions/0058-tolerance-of-place.md.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/design/demands.hpp"

namespace luxodus {

/// Of one demand, where it is tightest.
struct ShareOffPlace {
  DemandKind kind = DemandKind::minimum;
  RuleId rule = RuleId::none;
  Subject subject;
  double share = 0;  // of the minimum of the rule, without the planning margin
  glm::dvec3 place{0};
  double missing = 0;  // to that minimum, in the unit of the demand; 0 where it holds
  double least = 0;    // what is asked for, in the unit of the demand
  std::vector<std::pair<double, glm::dvec3>>
      broken{};  // all places where it does not hold, with their shares
};

struct PlaceTolerance {
  double distance_m = 0;
  std::vector<ShareOffPlace> demands;  // minima of illuminance; the tightest first

  double least() const { return demands.empty() ? 1 : demands.front().share; }
  bool holds() const { return demands.empty() || !(demands.front().missing > 0); }
};

/// Each candidate where it is planned and where it may be instead, one after another; their `place`
/// is its number. Places that lie in bodies, or behind what is in between, are none.
/// Errors: as compile_scene.
Result<std::vector<LuminaireCandidate>> displaced_copies(
    const OffPlaceScene& of, const std::vector<LuminaireCandidate>& candidates);

/// The points at which to ask for more: of each demand that does not hold its worst, apart from
/// each other.
std::vector<PointOffPlace> broken_points(const PlaceTolerance& tolerance);

/// `chosen`: the candidates of a layout. Places that lie in bodies, or behind what is in between,
/// are none that a luminaire is mounted at.
/// Errors: as compile_scene.
Result<PlaceTolerance> tolerance_of(const SceneDescription& scene, const DesignSettings& design,
                                    const std::vector<LuminaireCandidate>& chosen,
                                    const std::vector<CodeChoice>& codes, const Scenario& doors,
                                    int threads);

}  // namespace luxodus
