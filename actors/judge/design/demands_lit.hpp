// Shared by the sources of `Demands`: a building lit by candidates, and sums of their light.
// Internal to this folder. Thread rule: as demands.hpp.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <vector>

#include "actors/judge/design/demands.hpp"

namespace luxodus {

/// Illuminance that counts as none [lx]: a ten-thousandth of the smallest limit.
inline constexpr double no_light_lx = 1e-5;
inline const glm::dvec3 floor_normal(0, 0, 1);
/// Places of rows already lie above the floor, so no lift is added [m].
inline constexpr double lifted_already = 0;

/// Places rounded to a micrometre, as keys.
using PlaceKey = std::array<int64_t, 3>;
PlaceKey key_of_place(const glm::dvec3& place);

/// A term for each candidate whose value is above `smallest`.
Terms terms_of(const std::vector<double>& values, double smallest);
/// Each term times the factor of its candidate.
Terms times(const Terms& terms, const std::vector<double>& factors);
/// Sum over places of the best candidate there, without barred ones. Requires: options sorted by
/// place.
double max_from(const std::vector<Term>& light, const std::vector<LayoutOption>& options);

/// Whether a demand is on the illuminance at single points of the floor.
constexpr bool is_at_points(DemandKind kind) {
  return kind == DemandKind::minimum || kind == DemandKind::early || kind == DemandKind::failed;
}
inline bool same_demand(const ConstraintGroup& group, const PointOffPlace& point) {
  return group.kind == point.kind && group.rule == point.rule && group.subject == point.subject;
}

/// The building with or without furniture.
struct Demands::Lit {
  Lit(const SceneDescription& scene, std::unique_ptr<Building> made, std::vector<uint32_t> places)
      : building(std::move(made)), light(scene, *building, std::move(places)) {}

  std::unique_ptr<Building> building;
  CodeLight light;
  std::map<PlaceKey, uint32_t> points;  // indices of points by place
};

}  // namespace luxodus
