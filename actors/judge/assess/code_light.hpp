// The building and its emergency light as the codes look at them: direct light alone, in clear air,
// of each emergency luminaire by itself. `code_mode` applies rules to it, and `actors/judge/design`
// finds layouts by it, so that both count alike. Thread rule: one thread, which has rows run on
// others.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "actors/judge/assess/level_screens.hpp"
#include "actors/judge/inspect/building.hpp"
#include "scenes/emergency/rules.hpp"

namespace luxodus {

/// The scene with emergency fluxes and luminances of signs as the circuits of the judged state
/// leave them, never above what is stated: a luminaire that the state has switched off lights no
/// check.
SceneDescription as_switched(const SceneDescription& scene, const Scenario& state);

/// The building as the codes look at it: no media, emergency luminaires alone.
SceneDescription code_scene(const SceneDescription& scene, bool furnished);

/// Emergency operation, with the doors of a scenario.
Scenario code_scenario(const SceneDescription& scene, const Scenario& doors);

/// Where a point of emphasis is looked at from: before its front, else from all around it, since a
/// door's or a stair's point may lie in the door or the step itself.
std::vector<glm::dvec3> beside(const EmphasisPoint& point);

/// Where a luminaire near a sign must be in sight of: just before its face.
glm::dvec3 before_face(const Sign& sign);

/// Points of an area that belong to nobody's body.
struct AreaPoints {
  std::vector<glm::dvec3> places;  // on its plane
  size_t in_bodies = 0;            // left out: nobody walks or works in furniture and walls
};

class CodeLight {
 public:
  /// `places`: a number for each emergency luminaire; those of one number hang in one place, one
  /// after another, so that what hides the first hides all of them. Empty: each has its own.
  /// Requires: `building` is made of code_scene(scene, ...) in code_scenario; both outlive this.
  CodeLight(const SceneDescription& scene, const Building& building,
            std::vector<uint32_t> places = {});

  /// What each luminaire gives at places, a little above them, on a surface that faces `normal`.
  std::vector<LitPoint> lit(const std::vector<glm::dvec3>& places, const glm::dvec3& normal,
                            double lift_m) const;
  /// Of points of a square grid `border_m` or more from the edge of an area.
  AreaPoints points_of(const AssessedArea& area, double border_m) const;
  /// On the front of equipment, of each luminaire; none where it does not say its front.
  std::optional<std::vector<double>> vertical_lux(const EmphasisPoint& point) const;
  /// Mean on the face of a sign that is lit from outside, of each luminaire; empty for others.
  std::vector<double> lux_on_face(const Sign& sign) const;
  /// Whether each luminaire is seen from any of the places, and shines there.
  LinesOfSight seen_from(const std::vector<glm::dvec3>& places) const;
  /// The floor that a thing hangs over: what is met below it, without furniture; a route's or an
  /// area's where that is met a little below.
  std::optional<double> floor_under(const glm::dvec3& place) const;

 private:
  /// Those on one storey, by number; what hides all of it is looked for once.
  struct Storey {
    Bounds box;
    std::vector<uint32_t> luminaires;
    std::vector<Bounds> boxes;  // of each
  };
  void find_storeys();
  /// Luminaires that no floor slab certainly hides from a place, ascending.
  std::vector<uint32_t> in_question(const glm::dvec3& place) const;
  /// The first of those in the place of a luminaire.
  uint32_t leader_of(uint32_t luminaire) const {
    while (!leads(luminaire)) --luminaire;
    return luminaire;
  }
  bool leads(uint32_t i) const { return places_.empty() || i == 0 || places_[i] != places_[i - 1]; }
  std::vector<uint32_t> columns_of(const std::vector<uint32_t>& luminaires) const;

  /// At one point, of each luminaire [lx].
  std::vector<double> light_at(const GeometryAccess& access, const glm::dvec3& place,
                               const glm::dvec3& normal) const;
  /// Whether a luminaire sends any of its light to a place.
  bool shines_at(const GeometryAccess& access, size_t luminaire, const glm::dvec3& place) const;

  const SceneDescription& scene_;
  const Building& building_;
  LevelScreens screens_;
  std::vector<uint32_t> luminaires_;  // emergency luminaires among the scene's emitters
  std::vector<uint32_t> columns_;     // the same among the compiled emitters
  std::vector<uint32_t> places_;      // of each
  std::vector<Storey> storeys_;
};

}  // namespace luxodus
