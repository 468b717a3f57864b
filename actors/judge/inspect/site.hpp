// What the inspectors of this room share: the scene with the doors of one scenario and all lights
// lit, in clear air, and the list of findings. Each inspector is a function for one family of
// findings. Thread rule: called from one thread.
#pragma once

#include <fmt/format.h>

#include <optional>

#include "actors/judge/inspect/building.hpp"
#include "actors/judge/inspect/inspect.hpp"
#include "scenes/light/transport/surroundings.hpp"

namespace luxodus {

using Findings = std::vector<Finding>;

/// Largest depth at which a floor below a thing is searched [m].
inline constexpr double floor_below_m = 30;

/// "0.15 m", "4 mm", "12.3 km"; "(1.00, 2.50, 0.00)".
std::string length_text(double length_m);
std::string place_text(const glm::dvec3& place);
/// "37 %"; never rounded to 0 or 100 %: "over 99 %", "under 1 %".
std::string percent_text(double share);
/// "wall" (scene.toml:12)
std::string object_text(const Object& object);

/// Mean of a spectrum weighted by V(lambda), in equal-energy light.
double luminous_mean(const Spectrum& spectrum);

/// A finding of a sign: 'sign "exit" ' and what is wrong with it.
Finding sign_finding(Severity severity, const char* kind, const Sign& sign,
                     const std::string& what);

/// Whether it is smaller than a button, or larger than any site: metres for millimetres, or the
/// reverse.
bool no_buildings_size(const glm::dvec3& size);

/// Detects places farther from every solid than ten times the height of the building.
class Remoteness {
 public:
  explicit Remoteness(const SceneDescription& scene);
  /// The message about `subject`; none if the place is near enough.
  std::optional<std::string> told(const std::string& subject, const glm::dvec3& place) const;

 private:
  std::vector<Bounds> objects_;
  double height_m_ = 0;
};

/// Whether people look for signs, or walk: then a cause of wrong verdicts is a warning.
bool judges_people(const SceneDescription& scene);
/// Whether a grid belongs to a fire simulation, whose first grid says so.
bool is_of_simulation(const SceneDescription& scene, const Medium& m);
/// Objects with the tag "furniture".
bool is_furniture(const Object& object);

struct Site {
  const SceneDescription& scene;  // as it is described
  const Building& building;       // compiled from it: first the emitters, in order
  Remoteness remote;

  bool in_body(const GeometryAccess& access, const glm::dvec3& place) const {
    return building.in_solid(access, place);
  }
  bool is_outside(const GeometryAccess& access, const glm::dvec3& place) const {
    return luxodus::is_outside(building.scene(), access, building.local(place));
  }
  /// Whether a hit surface shows the inner side of its body.
  bool is_back(const FacedSurface& facing) const {
    return facing.surface < scene.objects.size() &&
           facing.front == (building.turned()[facing.surface] != 0);
  }
};

/// Which surfaces are furniture.
std::vector<char> furniture_of(const Site& site);
/// The nearest wall, floor or body within `length_m`, ignoring signs, luminaires and transparent
/// surfaces, the body `own_body`, and furniture unless `furniture`.
std::optional<FacedSurface> solid_ahead(const Site& site, const GeometryAccess& access,
                                        const glm::dvec3& from, const glm::dvec3& direction,
                                        double length_m, bool furniture = true, int own_body = 0);

// For one state of the doors. Sets `outside`: for each emitter, whether it is outside.
void inspect_luminaires(const Site& site, Findings& out, std::vector<char>& outside);
void inspect_judged_places(const Site& site, Findings& out);
/// For the light of a scenario with these doors.
void inspect_near_field(const Site& site, const Scenario& scenario, Findings& out);
/// Sets `misplaced`: for each sign, whether it has a finding.
void inspect_signs(const Site& site, Findings& out, std::vector<char>& misplaced);
/// Orientation of signs and eyes. `misplaced`: from inspect_signs.
void inspect_postures(const Site& site, const std::vector<char>& misplaced, Findings& out);
/// The readers of signs, and signs in doorways. `misplaced`: from inspect_signs.
void inspect_sign_sight(const Site& site, const std::vector<char>& misplaced, Findings& out);
void inspect_eyes(const Site& site, Findings& out);
void inspect_routes(const Site& site, Findings& out);
void inspect_route_plan(const Site& site, Findings& out);
void inspect_areas(const Site& site, Findings& out);
void inspect_area_parts(const Site& site, Findings& out);
void inspect_furniture(const Site& site, Findings& out);
void inspect_leaves(const Site& site, Findings& out);
void inspect_emphasis(const Site& site, Findings& out);
/// `outside`: from inspect_luminaires.
void inspect_planes(const Site& site, const std::vector<char>& outside, Findings& out);
void inspect_plane_shapes(const Site& site, Findings& out);
void inspect_turned_rooms(const Site& site, Findings& out);
// For the scene as written.
void inspect_sizes(const SceneDescription& scene, Findings& out);
void inspect_imports(const SceneDescription& scene, Findings& out);
/// Doors of any building that are as high as if feet had been read as metres.
void inspect_feet(const SceneDescription& scene, Findings& out);
/// Parts that an import has marked as solids that are not closed.
void inspect_open_solids(const SceneDescription& scene, Findings& out);
void inspect_doubled_objects(const SceneDescription& scene, Findings& out);
void inspect_doors(const SceneDescription& scene, Findings& out);
void inspect_reach(const SceneDescription& scene, Findings& out);
void inspect_fluxes(const SceneDescription& scene, Findings& out);
/// Luminaires that go off with the mains among others with the same file that do not.
void inspect_odd_ones(const SceneDescription& scene, Findings& out);
void inspect_materials(const SceneDescription& scene, Findings& out);
void inspect_sign_light(const SceneDescription& scene, Findings& out);
void inspect_smoke_numbers(const SceneDescription& scene, Findings& out);
/// For these scenarios and the settings of the assessment.
void inspect_smoke_settings(const SceneDescription& scene, const std::vector<Scenario>& scenarios,
                            Findings& out);
void inspect_states(const SceneDescription& scene, const std::vector<Scenario>& scenarios,
                    Findings& out);

/// Media of a scenario that overlap. `scene`: compiled with its media.
void inspect_media(const CompiledScene& scene, Findings& out);
/// Smoke of a scenario that lies mostly outside the building. Not for data sets: the meshes of
/// simulations extend outside.
void inspect_smoke_places(const Building& smoky, Findings& out);
/// Flames of a scenario in bodies, outside, or two in one place. `misplaced`: for each medium, adds
/// those of the first two kinds.
void inspect_flames(const Building& smoky, Findings& out, std::vector<char>& misplaced);
/// Eyes in smoke that hides everything. `smoky`: a building with its media.
void inspect_smoke(const SceneDescription& scene, const Building& smoky, Findings& out);
/// People, and signs they look at, outside the meshes of fire simulations.
void inspect_fire_meshes(const SceneDescription& scene, const Building& smoky, Findings& out);
/// Smoke from floor to ceiling at the judged places.
void inspect_columns(const SceneDescription& scene, const Building& smoky, Findings& out);

/// Emitters that are outside or misplaced, whose light is not meant for the rooms.
struct Misplaced {
  std::vector<char> emitters, signs, media;
};

/// The share of a scenario's light in clear air that leaves the scene by each side, except through
/// panes and from misplaced emitters; none without light.
struct EscapeShares {
  std::array<double, 6> by_side{};
  double standard_error = 0;     // of their sum
  double rays_per_particle = 0;  // until a particle is absorbed or escapes; infinite if none was
};
std::optional<EscapeShares> escape_shares(const SceneDescription& scene, const Scenario& scenario,
                                          const Misplaced& misplaced, int threads);
/// The warning, if more than 1 % leaves by sides that are not declared open.
std::optional<Finding> open_rooms(const SceneDescription& scene, const EscapeShares& shares);
/// An error if no light is ever absorbed or escapes, also with the smoke of `scenario`; a warning
/// if hardly any is.
std::optional<Finding> white_rooms(const SceneDescription& scene, const Scenario& scenario,
                                   const EscapeShares& shares);

}  // namespace luxodus
