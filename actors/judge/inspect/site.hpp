// What the inspectors of this room share: the scene with the doors of one scenario and all lights
// lit, in clear air, and where findings go. Each inspector is a function of one family of findings.
#pragma once

#include <fmt/format.h>

#include <optional>

#include "actors/judge/inspect/building.hpp"
#include "actors/judge/inspect/inspect.hpp"
#include "scenes/light/transport/surroundings.hpp"

namespace luxodus {

using Findings = std::vector<Finding>;

/// A floor is looked for no deeper below a thing [m].
inline constexpr double floor_below_m = 30;

/// "0.15 m", "4 mm", "12.3 km"; "(1.00, 2.50, 0.00)".
std::string length_text(double length_m);
std::string place_text(const glm::dvec3& place);
/// "37 %"; what is not all and not nothing is never rounded to it: "over 99 %", "under 1 %".
std::string percent_text(double share);
/// "wall" (scene.toml:12)
std::string object_text(const Object& object);

/// Smaller than a button, or larger than any site: metres for millimetres, or the other way round.
bool no_buildings_size(const glm::dvec3& size);

/// Tells places that are farther from everything solid than ten times the height of the building.
class Remoteness {
 public:
  explicit Remoteness(const SceneDescription& scene);
  /// The sentence that says so of `subject`; none where the place is near enough.
  std::optional<std::string> told(const std::string& subject, const glm::dvec3& place) const;

 private:
  std::vector<Bounds> objects_;
  double height_m_ = 0;
};

/// Whether somebody looks for signs, or walks: what makes a verdict wrong is then a warning.
bool judges_people(const SceneDescription& scene);
/// Objects with the tag "furniture".
bool is_furniture(const Object& object);

struct Site {
  const SceneDescription& scene;  // as it is described
  const Building& building;       // of it: first the emitters, in their order
  Remoteness remote;

  bool in_body(const GeometryAccess& access, const glm::dvec3& place) const {
    return building.in_solid(access, place);
  }
  bool is_outside(const GeometryAccess& access, const glm::dvec3& place) const {
    return luxodus::is_outside(building.scene(), access, building.local(place));
  }
  /// Whether a surface that is met shows the side that its body's inside sees.
  bool is_back(const Facing& facing) const {
    return facing.surface < scene.objects.size() &&
           facing.front == (building.turned()[facing.surface] != 0);
  }
};

/// Furniture, by surface.
std::vector<char> furniture_of(const Site& site);
/// The nearest wall, floor or body within `length_m`; signs, luminaires and what lets light through
/// are none, and furniture only if `furniture`.
std::optional<Facing> solid_ahead(const Site& site, const GeometryAccess& access,
                                  const glm::dvec3& from, const glm::dvec3& direction,
                                  double length_m, bool furniture = true);

// Of one state of the doors. `outside`: by emitter, those that stand outside.
void inspect_luminaires(const Site& site, Findings& out, std::vector<char>& outside);
void inspect_judged_places(const Site& site, Findings& out);
/// In the light of a scenario with these doors.
void inspect_near_field(const Site& site, const Scenario& scenario, Findings& out);
/// `misplaced`: by sign, those of which anything is told.
void inspect_signs(const Site& site, Findings& out, std::vector<char>& misplaced);
/// How signs hang and eyes look. `misplaced`: as inspect_signs says.
void inspect_postures(const Site& site, const std::vector<char>& misplaced, Findings& out);
/// Whom signs serve, and doorways that they hang in. `misplaced`: as inspect_signs says.
void inspect_sign_sight(const Site& site, const std::vector<char>& misplaced, Findings& out);
void inspect_eyes(const Site& site, Findings& out);
void inspect_routes(const Site& site, Findings& out);
void inspect_route_plan(const Site& site, Findings& out);
void inspect_areas(const Site& site, Findings& out);
void inspect_area_parts(const Site& site, Findings& out);
void inspect_furniture(const Site& site, Findings& out);
void inspect_leaves(const Site& site, Findings& out);
void inspect_emphasis(const Site& site, Findings& out);
/// `outside`: as inspect_luminaires says.
void inspect_planes(const Site& site, const std::vector<char>& outside, Findings& out);
void inspect_plane_shapes(const Site& site, Findings& out);
void inspect_turned_rooms(const Site& site, Findings& out);
// Of the scene as it is written.
void inspect_sizes(const SceneDescription& scene, Findings& out);
void inspect_imports(const SceneDescription& scene, Findings& out);
/// Doors, of any building, as high as if feet had been read as metres.
void inspect_feet(const SceneDescription& scene, Findings& out);
void inspect_doubled_objects(const SceneDescription& scene, Findings& out);
void inspect_doors(const SceneDescription& scene, Findings& out);
void inspect_reach(const SceneDescription& scene, Findings& out);
void inspect_fluxes(const SceneDescription& scene, Findings& out);
/// Luminaires that fail with the mains among others of their file that do not.
void inspect_odd_ones(const SceneDescription& scene, Findings& out);
void inspect_materials(const SceneDescription& scene, Findings& out);
void inspect_sign_light(const SceneDescription& scene, Findings& out);
void inspect_smoke_numbers(const SceneDescription& scene, Findings& out);
/// Of these scenarios and the settings of the assessment.
void inspect_smoke_settings(const SceneDescription& scene, const std::vector<Scenario>& scenarios,
                            Findings& out);
void inspect_states(const SceneDescription& scene, const std::vector<Scenario>& scenarios,
                    Findings& out);

/// Media of a scenario that overlap. `scene`: compiled with its media.
void inspect_media(const CompiledScene& scene, Findings& out);
/// Smoke of a scenario that lies outside the building with much of it. Data sets are not asked: the
/// meshes of simulations reach outside.
void inspect_smoke_places(const Building& smoky, Findings& out);
/// Flames of a scenario in bodies, outside, two in one place. `misplaced`: by medium, those of the
/// first two, added to what it holds.
void inspect_flames(const Building& smoky, Findings& out, std::vector<char>& misplaced);
/// Eyes in smoke through which nothing can be seen. `smoky`: a building with its media.
void inspect_smoke(const SceneDescription& scene, const Building& smoky, Findings& out);
/// People and what they look at outside of the meshes of fire simulations.
void inspect_fire_meshes(const SceneDescription& scene, const Building& smoky, Findings& out);
/// Smoke from the floor to the ceiling of the places that are judged.
void inspect_columns(const SceneDescription& scene, const Building& smoky, Findings& out);

/// What stands outside or is told to stand wrong: its light is not meant for the rooms.
struct Misplaced {
  std::vector<char> emitters, signs, media;
};

/// Of the light of a scenario in clear air, the share that leaves the scene by each side and not
/// through a pane, what is misplaced left out; none where nothing is lit.
struct EscapeShares {
  std::array<double, 6> by_side{};
  double standard_error = 0;  // of their sum
};
std::optional<EscapeShares> escape_shares(const SceneDescription& scene, const Scenario& scenario,
                                          const Misplaced& misplaced, int threads);
/// The warning, if more than 1 % leaves by sides that are not declared open.
std::optional<Finding> open_rooms(const SceneDescription& scene, const EscapeShares& shares);

}  // namespace luxodus
