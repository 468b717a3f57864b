// Candidates for emergency luminaires: places on a grid over routes and areas, or listed places,
// each at its mounting height, with every type and rotation; and the existing luminaires. Places
// and candidates that are not allowed are left out and counted by reason. Which candidates are
// chosen is decided elsewhere (solve_layout.hpp). Thread rule: one thread, which has rows computed
// by others.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/inspect/building.hpp"
#include "runtime/core/result.hpp"
#include "scenes/emergency/rule_sets.hpp"
#include "scenes/light/world/design.hpp"

namespace luxodus {

namespace limits {
/// Places, and candidates of all types and rotations at them: each candidate is a column of the
/// integer program, and its light at every point is computed.
inline constexpr size_t design_places = 5'000, design_candidates = 20'000;
}  // namespace limits

/// Movable luminaires of one kind on one storey; their places are chosen together.
struct MovablePool {
  uint32_t number = 0, size = 0;  // number of luminaires
};

/// A luminaire that a layout may contain.
struct LuminaireCandidate {
  static constexpr size_t existing = static_cast<size_t>(-1);

  size_t type = existing;  // index into DesignSettings::types
  uint32_t place = 0;      // candidates of one place exclude each other
  glm::dvec3 position{0};
  glm::dvec3 floor{0};  // of the route or area below it
  std::optional<glm::dvec3>
      outward{};                    // horizontal unit vector away from the wall on which it hangs
  std::optional<glm::dvec3> aim{};  // aim of a luminaire on a wall; none: that of its type
  double rotation_deg = 0;          // as in a change of the variant
  std::string name;                 // of an existing luminaire
  bool fixed = false;
  std::optional<MovablePool> pool{};  // of a movable luminaire
  bool moved = false;   // a luminaire of its pool at another place; `name` is one of the pool
  bool barred = false;  // it must not stay at its place
};

/// Numbers of places and candidates that were left out, by reason.
struct LeftOut {
  size_t no_ceiling = 0, in_bodies = 0, near_walls = 0, near_signs = 0, keep_out = 0, taken = 0;
  size_t too_low = 0, glaring = 0;  // candidates
  size_t no_wall = 0;               // places for luminaires on walls without a flat wall
  static constexpr void fields(auto&& field, auto& m) {
    field("no_ceiling", m.no_ceiling)("in_bodies", m.in_bodies)("near_walls", m.near_walls);
    field("near_signs", m.near_signs)("keep_out", m.keep_out)("too_low", m.too_low);
    field("glaring", m.glaring)("no_wall", m.no_wall);
  }
};

/// A type without candidates: its battery does not last as long as the rules require.
struct UnusedType {
  std::string name, rules;  // the rule set that requires more
  double lasts_h = 0, asked_h = 0;
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name)("lasts_h", m.lasts_h)("asked_h", m.asked_h)("rules", m.rules);
  }
};

/// An English sentence that says so.
std::string unused_words(const UnusedType& type);

struct Candidates {
  std::vector<LuminaireCandidate> all;  // existing luminaires first
  size_t places = 0;                    // number of places for new luminaires
  LeftOut left_out;
  std::vector<std::string> removed;  // luminaires of the scene that are removed in any case
  std::vector<UnusedType> unused;    // types whose battery does not last long enough
};

/// The scene with the candidates as its only emergency luminaires, in their order and named by
/// their index. Existing luminaires get no bodies.
SceneDescription scene_of(const SceneDescription& scene, const DesignSettings& design,
                          const std::vector<LuminaireCandidate>& candidates);

/// The emitter of a candidate at its place.
Emitter emitter_of(const SceneDescription& scene, const DesignSettings& design,
                   const LuminaireCandidate& candidate);

/// An emitter with which a scene without light can be compiled.
const Emitter& some_light(const DesignSettings& design);

/// Whether places over the route or area of this name are candidates.
bool is_wanted(const DesignSettings& design, const std::string& name);

/// Errors: no type gives light, since the judged state switches its circuit off.
Result<void> gives_any_light(const DesignSettings& design);

/// Whether a sign hangs within `clearance_m` of a place, seen from above.
bool near_sign(const SceneDescription& scene, const glm::dvec3& p, double clearance_m);

/// Whether a place is in a keep-out zone of its storey.
bool kept_out(const SceneDescription& scene, const DesignSettings& design, const glm::dvec3& place);

/// `scene`: with its emergency luminaires; `doors`: a scenario that gives the doors. Candidates
/// that violate a rule of `codes` by themselves (glare, height) are left out.
/// Errors: no candidate is left, or more than a limit; a scene that cannot be compiled.
Result<Candidates> find_candidates(const SceneDescription& scene, const DesignSettings& design,
                                   const std::vector<CodeChoice>& codes, const Scenario& doors,
                                   int threads);

/// Whether a luminaire may hang over a place between those of the grid, by the same rules as
/// candidates. Thread rule: one thread.
class PlaceCheck {
 public:
  /// Errors: as compile_scene. Requires: the design outlives this.
  static Result<std::unique_ptr<PlaceCheck>> make(const SceneDescription& scene,
                                                  const DesignSettings& design,
                                                  const Scenario& doors, int threads);
  ~PlaceCheck();

  struct Place {
    glm::dvec3 position, floor;
  };
  /// The place on the storey of `near` at the mounting height there; none if it is not allowed.
  std::optional<Place> place_over(const glm::dvec2& plan, const glm::dvec3& near) const;

 private:
  struct Parts;
  explicit PlaceCheck(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
};

}  // namespace luxodus
