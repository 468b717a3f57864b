// What the parts of `Demands` share: a building in which candidates are lit, and sums of their
// light. Not for other files.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <vector>

#include "actors/judge/design/demands.hpp"

namespace luxodus {

/// Light that adds less than this is none [lx]: a ten-thousandth of the smallest limit.
inline constexpr double no_light_lx = 1e-5;
inline const glm::dvec3 floor_normal(0, 0, 1);
/// Places of rows lie above the floor [m].
inline constexpr double lifted_already = 0;

/// Places as keys: to a micrometre.
using PlaceKey = std::array<int64_t, 3>;
PlaceKey key_of_place(const glm::dvec3& place);

/// Values above the smallest, by candidate.
Terms terms_of(const std::vector<double>& values, double smallest);
/// Each times the factor of its candidate.
Terms times(const Terms& terms, const std::vector<double>& factors);
/// Of the best candidate of each place that is not barred. Requires: options by place.
double max_from(const std::vector<Term>& light, const std::vector<LayoutOption>& options);

/// Illuminance at single points of the floor.
constexpr bool is_at_points(DemandKind kind) {
  return kind == DemandKind::minimum || kind == DemandKind::early || kind == DemandKind::failed;
}
inline bool same_demand(const ConstraintGroup& group, const PointOffPlace& point) {
  return group.kind == point.kind && group.rule == point.rule && group.subject == point.subject;
}

/// With furniture or without.
struct Demands::Lit {
  Lit(const SceneDescription& scene, std::unique_ptr<Building> made, std::vector<uint32_t> places)
      : building(std::move(made)), light(scene, *building, std::move(places)) {}

  std::unique_ptr<Building> building;
  CodeLight light;
  std::map<PlaceKey, uint32_t> points;  // that are there, by their places
};

}  // namespace luxodus
