// Where luminaires may stand: places on a grid over routes and areas, or listed ones, each at its
// mounting height, with every type and turn; and the emergency luminaires that are there. What may
// not be is left out and counted, by its reason. Thread rule: one thread, which has rows run on
// others.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/inspect/building.hpp"
#include "runtime/core/result.hpp"
#include "scenes/emergency/rule_sets.hpp"
#include "scenes/light/world/design.hpp"

namespace luxodus {

namespace limits {
/// Places, and luminaires of all types and turns at them: each has a column of the program, and its
/// light at every point is computed.
inline constexpr size_t design_places = 5'000, design_candidates = 20'000;
}  // namespace limits

/// Movable luminaires that are alike, on one storey: places are found for all of them together.
struct MovablePool {
  uint32_t number = 0, size = 0;  // size: luminaires
};

/// One luminaire that may be there.
struct LuminaireCandidate {
  static constexpr size_t existing = static_cast<size_t>(-1);

  size_t type = existing;  // of DesignSettings::types
  uint32_t place = 0;      // candidates of one place exclude each other
  glm::dvec3 position{0};
  glm::dvec3 floor{0};                  // of the route or area that it was found from
  std::optional<glm::dvec3> outward{};  // from the wall that it is on, level, of unit length
  std::optional<glm::dvec3> aim{};      // of one on a wall; else it looks as its type
  double rotation_deg = 0;              // as a change of the variant writes it
  std::string name;                     // of an existing luminaire
  bool fixed = false;
  std::optional<MovablePool> pool{};  // of one that may be moved
  bool moved = false;                 // one of its pool, at another place: `name` is one of them
  bool barred = false;                // it may not stay where it is
};

/// How many places or candidates were left out, and why.
struct LeftOut {
  size_t no_ceiling = 0, in_bodies = 0, near_walls = 0, near_signs = 0, keep_out = 0, taken = 0;
  size_t too_low = 0, glaring = 0;  // candidates
  size_t no_wall = 0;               // places for luminaires on walls: nothing flat is there
};

/// A type of which there are no candidates: its supply does not last as long as the rules ask for.
struct UnusedType {
  std::string name, rules;  // the set that asks for more
  double lasts_h = 0, asked_h = 0;
};

/// The same in a sentence. English.
std::string unused_words(const UnusedType& type);

struct Candidates {
  std::vector<LuminaireCandidate> all;  // existing luminaires first
  size_t places = 0;                    // of new luminaires
  LeftOut left_out;
  std::vector<std::string> removed;  // luminaires of the scene that go in any case
  std::vector<UnusedType> unused;    // types that last too short
};

/// The scene with nothing but candidates as emergency luminaires, in their order; each has a
/// number for a name. Bodies of luminaires that may be there are left out.
SceneDescription scene_of(const SceneDescription& scene, const DesignSettings& design,
                          const std::vector<LuminaireCandidate>& candidates);

/// The emitter of a candidate, at its place.
Emitter emitter_of(const SceneDescription& scene, const DesignSettings& design,
                   const LuminaireCandidate& candidate);

/// Light to compile the geometry of a scene with that has none of its own.
const Emitter& some_light(const DesignSettings& design);

/// Where no type gives light as the judged state leaves its circuit.
Result<void> gives_any_light(const DesignSettings& design);

/// Whether a sign hangs nearer to a place than a clearance, seen from above.
bool near_sign(const SceneDescription& scene, const glm::dvec3& p, double clearance_m);

/// Whether a place lies in a keep-out zone of its storey.
bool kept_out(const SceneDescription& scene, const DesignSettings& design, const glm::dvec3& place);

/// `scene`: with its emergency luminaires; `doors`: a scenario that gives the doors. Candidates
/// that a rule of `codes` forbids by themselves (glare, height) are left out.
/// Errors: no candidate is left, or more than a limit; a scene that cannot be compiled.
Result<Candidates> find_candidates(const SceneDescription& scene, const DesignSettings& design,
                                   const std::vector<CodeChoice>& codes, const Scenario& doors,
                                   int threads);

/// Whether a luminaire may hang over a place, by the same rules as candidates: for places between
/// those of the grid. One thread.
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
  /// On the storey of `near`, at the mounting height there; none where it may not be.
  std::optional<Place> place_over(const glm::dvec2& plan, const glm::dvec3& near) const;

 private:
  struct Parts;
  explicit PlaceCheck(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
};

}  // namespace luxodus
