// Whether the minima hold with luminaires mounted off their places. Each new luminaire may be off
// by a distance in any direction, all at once; at each point the worst direction of each counts.
// Illuminance is that of the code mode. Thread rule: one thread, which has rows computed by others.
// Design: docs/decisions/0058-tolerance-of-place.md.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/design/demands.hpp"

namespace luxodus {

/// The tightest place of one demand.
struct ShareOffPlace {
  DemandKind kind = DemandKind::minimum;
  RuleId rule = RuleId::none;
  Subject subject;
  double share = 0;  // of the rule's minimum, without the planning margin
  glm::dvec3 place{0};
  double missing = 0;  // missing to the minimum, in the demand's unit; 0 if it holds
  double least = 0;    // required value, in the demand's unit
  std::vector<std::pair<double, glm::dvec3>>
      broken{};  // all places where it does not hold, with their shares
};

struct PlaceTolerance {
  double distance_m = 0;
  std::vector<ShareOffPlace> demands;  // minima of illuminance, the tightest first

  double least() const { return demands.empty() ? 1 : demands.front().share; }
  bool holds() const { return demands.empty() || !(demands.front().missing > 0); }
};

/// Copies of each candidate at its planned place and at the places where it may be instead, in
/// sequence; their `place` is the index of the candidate. Places in bodies or behind obstacles are
/// left out.
/// Errors: as compile_scene.
Result<std::vector<LuminaireCandidate>> displaced_copies(
    const OffPlaceScene& of, const std::vector<LuminaireCandidate>& candidates);

/// Points at which rows are added: the worst ones of each demand that does not hold, spaced apart.
std::vector<PointOffPlace> broken_points(const PlaceTolerance& tolerance);

/// `chosen`: the candidates of a layout. Luminaires are not mounted in bodies or behind obstacles,
/// so such places are left out.
/// Errors: as compile_scene.
Result<PlaceTolerance> tolerance_of(const SceneDescription& scene, const DesignSettings& design,
                                    const std::vector<LuminaireCandidate>& chosen,
                                    const std::vector<CodeChoice>& codes, const Scenario& doors,
                                    int threads);

}  // namespace luxodus
