// A scene's description after all files it names have been read: plain values in SI units (m, sr,
// W, lm, cd/m2, 1/m, nm), one struct per TOML table, each with its source place for messages.
// scenes/formats/scene_file makes it; scenes/light/transport/compile.* compiles it for the tracer.
// Immutable once read; any thread.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/geometry/mesh.hpp"
#include "scenes/light/optics/medium.hpp"
#include "scenes/light/optics/photometric_web.hpp"
#include "scenes/light/optics/spectrum.hpp"

namespace luxodus {

/// Row-major picture, top row first, linear values in [0, 1]. channels: 1, 3 or 4.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float> texels;
};

// ---- materials and objects ---------------------------------------------------------------------

enum class MaterialKind {
  lambertian,  // reflectance
  glossy,      // reflectance (diffuse part) + specular through a GGX lobe with the given roughness
  mirror,      // specular
  glass_pane,  // thin pane: ior, transmittance of the glass itself (internal), no deviation
  dielectric,  // smooth refracting boundary of a solid: ior inside (behind the front side)
  open,        // not there: light passes, its flux is counted
};

struct Material {
  std::string name;
  SourcePlace place;
  MaterialKind kind = MaterialKind::lambertian;
  Spectrum reflectance = Spectrum::constant(0.5);  // diffuse, [0, 1]
  Spectrum specular = Spectrum::constant(0);       // [0, 1], reflectance + specular <= 1
  double roughness = 0.3;                          // GGX alpha, (0, 1]
  double ior = 1.52;
  Spectrum internal_transmittance = Spectrum::constant(1);  // of one pass, glass_pane
  std::shared_ptr<const Image> reflectance_image;           // multiplies reflectance; needs uv
};

struct Door {
  bool open = false;         // unless a scenario says otherwise
  glm::dvec3 hinge{0};       // a point of the hinge [m]
  glm::dvec3 axis{0, 0, 1};  // direction of the hinge
  double open_angle_deg = 90;
};

struct Object {
  std::string name;
  SourcePlace place;
  Mesh mesh;  // placed: scene coordinates
  int material = 0;
  int back_material = 0;    // of the triangles' backs; the same as material unless given
  double patch_edge_m = 0;  // maximum edge of a flux patch; 0: one patch per triangle
  bool one_patch = false;   // one patch per side for the whole object
  std::vector<std::string> tags;
  std::string group;  // surface group, "" for none
  std::optional<Door> door;
  /// Luminaires that this is the measured body of; their own light passes it (see Emitter::body).
  std::vector<std::string> body_of;
  int body = 0;  // number of the body that it is a part of; 0: of none
};

// ---- emitters ---------------------------------------------------------------------------------

enum class EmitterShape { point, rectangle, disc, sphere, tube, mesh };
enum class Distribution { lambertian, isotropic, cosine_power, spot, collimated, web };

/// What the stated flux on emergency supply is. `rated` (EN 60598-2-22): the least from 60 s after
/// the failure to the end of the duration, so that the battery's fall is in it. `initial`: that of
/// a full battery, which falls by the end of duration factor.
enum class EmergencyFluxIs { unstated, rated, initial };

/// One emitter, analytic or a luminaire of a photometric file. Surfaces emit along local -Z (the
/// luminaire frame: -Z is down); rectangle and disc lie in the local xy plane; a tube's axis is
/// local x.
/// What files and the scene say of a luminaire as a product, for schedules: it lights nothing.
struct ProductFacts {
  std::string maker, article, battery;  // "" where not stated
  double watts = 0;                     // input on mains [W]; 0 where not stated
  glm::dvec3 body_m{0};                 // extents along local x, y, z; 0 where not stated
  bool body_round = false;              // an upright cylinder
};

struct Emitter {
  std::string name;
  SourcePlace place;
  std::string circuit;  // "" for none
  std::string group;    // source group; "" takes the scene's rule
  EmitterShape shape = EmitterShape::point;
  Frame frame;
  glm::dvec3 size{
      0};     // rectangle: x, y; disc, sphere: x = diameter; tube: x = length, y = diameter
  Mesh mesh;  // shape mesh: scene coordinates, emits to the front side
  Distribution distribution = Distribution::lambertian;
  double cosine_power = 1;  // intensity ~ cos^n about -Z
  double spot_inner_deg =
      0;  // half angles about -Z: full inside, smooth cosine fall-off, zero outside
  double spot_outer_deg = 0;
  std::shared_ptr<const PhotometricWeb> web;
  Spectrum spectrum = equal_energy_shape();  // integral 1 over 380..780 nm
  // Flux emitted in each operating state, all factors applied. Photometric input is in lm,
  // radiometric in W.
  bool radiometric = false;
  double mains_flux = 0;              // [lm] or [W]
  double emergency_flux = 0;          // [lm] or [W]; 0 if the luminaire fails with the mains
  double emergency_ageing = 1;        // maintenance x end of duration: included in emergency_flux
  double maintenance_factor = 1;      // included in both fluxes
  double end_of_duration_factor = 1;  // included in emergency_flux
  EmergencyFluxIs emergency_flux_is = EmergencyFluxIs::unstated;
  /// Whether emergency_flux / emergency_ageing is the flux of a new luminaire. If not, that is
  /// more, by an unknown factor.
  bool initial_flux_known = true;
  bool maintained = false;  // an emergency luminaire that is also lit in mains operation
  std::string file;         // the photometric file, as the scene names it; "" if there is none
  std::string product;      // the luminaire's name in that file
  ProductFacts facts;       // none in a pack
  std::string ifc_guid;     // GlobalId in the model it came from; "" if none
  bool turned_in_file =
      false;                // its container turns it within the luminaire; the frame includes that
  glm::dvec3 opening_m{0};  // luminous opening: length, width, height; 0 if not given
  /// Run-up after a failure of the mains: time [s], share of emergency_flux; ascending in both,
  /// linear between rows, constant after the last. Empty: not given.
  std::vector<glm::dvec2> onset;
  std::optional<double> duration_s;  // of the emergency supply; dark afterwards
  std::string body_material;         // "" if none: returning light passes
  /// Its own body among the objects, 0 for none. Light on its way from the emitter passes it, since
  /// the intensities were measured with the body and lack its shadow; all other light meets it.
  int body = 0;
};

// ---- signs ------------------------------------------------------------------------------------

enum class SignLighting { internal, external, photoluminescent };

namespace limits {
inline constexpr size_t max_face_colours = 8;
}  // namespace limits

/// Place of a colour among those of its sign.
using ColourIndex = uint8_t;
/// None of them: a border, a lamp cover.
inline constexpr ColourIndex other_colour = 0xFF;

/// One colour of a sign's face.
struct FaceColour {
  std::string name;
  std::array<uint8_t, 3> drawn{};  // sRGB in drawings
  double mains_cd_m2 = 0;          // luminance along the normal
  double emergency_cd_m2 = 0;
  Spectrum shape = equal_energy_shape();  // of its own light, integral 1
  Spectrum reflectance = Spectrum::constant(0.7);
};

/// ISO 3864 white and green, with their luminances [cd/m2] in this order.
inline std::vector<FaceColour> white_and_green(const glm::dvec2& mains = glm::dvec2(0),
                                               const glm::dvec2& emergency = glm::dvec2(0)) {
  FaceColour white{.name = "white",
                   .drawn = {0xEC, 0xEC, 0xE7},
                   .mains_cd_m2 = mains.x,
                   .emergency_cd_m2 = emergency.x};
  FaceColour green{.name = "green",
                   .drawn = {0x23, 0x7F, 0x52},
                   .mains_cd_m2 = mains.y,
                   .emergency_cd_m2 = emergency.y,
                   .reflectance = Spectrum::constant(0.15)};
  return {std::move(white), std::move(green)};
}

/// A picture of the sign's colours. The contrast of legend and ground makes it legible; other
/// colours shine and reflect like them.
struct SignFace {
  int width = 0;  // texels; square texels up to rounding
  int height = 0;
  std::vector<ColourIndex> colour;  // top row first, as a reader sees it
  std::vector<float>
      relative_luminance;  // empty: uniform in each colour; else per texel, mean 1 per colour
  ColourIndex legend = 0;
  ColourIndex ground = 1;  // other_colour: the face has one colour

  /// Legend and ground in the order of the sign's colours: the parts that eye paths estimate.
  std::array<ColourIndex, 2> parts() const {
    return {std::min(legend, ground), std::max(legend, ground)};
  }
  size_t legend_part() const { return legend < ground ? 0 : 1; }
};

/// Direction of the arrow on a sign's front, as its reader sees it.
enum class SignArrow { left, right, ahead };

/// A route that a sign belongs to.
struct LeadsTo {
  std::string route;
  SignArrow arrow = SignArrow::ahead;
};

/// Letters of a text sign.
struct SignLetters {
  double height_m = 0;
  double stroke_m = 0;
};

struct Sign {
  std::string name;
  SourcePlace place;
  std::string circuit;
  std::string group;
  Frame frame;  // origin: centre of the face; local z: viewing direction (out of the face); local
                // y: up
  double width_m = 0;
  double height_m = 0;
  double smallest_detail_m = 0;
  std::optional<SignLetters> letters;
  std::string file;      // the drawing of its face, as the scene names it; "" if none
  std::string text;      // text on its face, if any
  std::string ifc_guid;  // GlobalId in the model it came from; "" if none
  bool double_sided = false;
  double thickness_m = 0.03;  // distance between the two faces
  std::vector<FaceColour> colours = white_and_green();
  SignFace face;
  SignLighting lighting = SignLighting::internal;
  std::optional<double> duration_s;  // of the emergency supply; dark afterwards
  std::vector<LeadsTo> leads_to;     // routes that it marks
  double angular_exponent = 0;       // luminance ~ cos^n from the normal; 0: Lambertian
  std::vector<glm::dvec2>
      decay;  // photoluminescent: time after excitation [s], share of the luminance
};

// ---- measurements -----------------------------------------------------------------------------

struct PlaneMeasure {
  std::string name;
  SourcePlace place;
  glm::dvec3 corner{0};  // cells run from here along the two edges; normal = normalize(cross(u, v))
  glm::dvec3 edge_u{1, 0, 0};
  glm::dvec3 edge_v{0, 1, 0};
  int cells_u = 1;
  int cells_v = 1;
};

struct ProbeMeasure {
  std::string name;
  SourcePlace place;
  glm::dvec3 position{0};
  glm::dvec3 normal{0, 0, 1};
};

struct SurfaceGroupMeasure {
  std::string name;
  SourcePlace place;
  std::vector<std::string> objects;  // names or tags
};

struct VolumeGroupMeasure {
  enum class Shape { box, sphere, shell, layer };
  std::string name;
  SourcePlace place;
  Shape shape = Shape::box;
  glm::dvec3 low{0}, high{0};  // box; layer: z only
  glm::dvec3 centre{0};
  double radius = 0;
  double inner_radius = 0;  // shell
};

struct CountingPlaneMeasure {
  std::string name;
  SourcePlace place;
  glm::dvec3 corner{0};
  glm::dvec3 edge_u{1, 0, 0};
  glm::dvec3 edge_v{0, 1, 0};
};

struct Observer {
  std::string name;
  SourcePlace place;
  glm::dvec3 eye{0};
  glm::dvec3 gaze{1, 0, 0};
  std::optional<std::vector<uint32_t>> signs;  // indices of the signs looked at; absent: all
};

struct Camera {
  std::string name;
  SourcePlace place;
  glm::dvec3 eye{0};
  glm::dvec3 target{1, 0, 0};
  glm::dvec3 up{0, 0, 1};
  double vertical_fov_deg = 60;
  int width = 640;
  int height = 360;
  /// Height above which the picture shows nothing, below the eye: a building seen from above
  /// without its ceilings. The light is that of the whole building. None: nothing is cut.
  std::optional<double> cut_m = {};
};

// ---- assessment --------------------------------------------------------------------------------

/// A defined way out, along the floor.
struct EscapeRoute {
  std::string name;
  SourcePlace place;
  std::vector<glm::dvec3> path;  // the centre line, in the direction of escape; at least two points
  double width_m = 0;
};

/// A floor that people cross without a defined way out (open area), or a work plane with a risk
/// that continues after the lights fail (task area).
struct AssessedArea {
  std::string name;
  SourcePlace place;
  std::vector<glm::dvec2> outline;  // counter-clockwise
  double z_m = 0;
  double mains_lx = 0;   // task area: maintained illuminance in mains operation
  std::string ifc_guid;  // GlobalId of its space in the model it came from; "" if none
};

/// A place that must have an emergency luminaire near it.
enum class EmphasisKind {
  exit_door,
  final_exit,
  stairs,
  level_change,
  direction_change,
  intersection,
  first_aid,
  fire_equipment,
  call_point,
  alarm_panel,
  refuge
};

/// Names of the kinds in scene files, in their order.
inline constexpr std::array<std::string_view, 11> emphasis_words{
    "exit_door",        "final_exit",   "stairs",    "level_change",
    "direction_change", "intersection", "first_aid", "fire_equipment",
    "call_point",       "alarm_panel",  "refuge"};

struct EmphasisPoint {
  std::string name;
  SourcePlace place;
  EmphasisKind kind = EmphasisKind::exit_door;
  glm::dvec3 position{0};
  std::optional<glm::dvec3> facing;  // direction that the front of equipment faces
  std::string ifc_guid;              // GlobalId in the model it came from; "" if none
};

/// Eyes that signs are judged for beside those of the stated age.
struct OtherEyes {
  std::string name;                 // as the scene names them: "75", "protan"
  std::optional<double> age_years;  // that of the assessment unless stated
  bool protan = false;              // without cones for long wavelengths
};

/// Assumptions about people and smoke.
struct AssessmentSettings {
  double age_years = 65;
  std::vector<OtherEyes> other_eyes;
  std::vector<double> eye_heights_m = {1.65, 1.2, 0.6};
  double spacing_m = 2;                 // spacing of observers along routes
  double luminance_before_cd_m2 = 100;  // of the view before the mains failed
  bool smoke_expected = true;           // smoke may occur where signs are (EN 1838)
  std::optional<bool> irritant_smoke;   // eye irritation: people see less than their eyes could
  std::vector<std::string> rules;       // rule sets, by name; empty: not given
  std::vector<std::string> deviations;  // national deviations from them, by name
  SourcePlace place;
};

namespace limits {
/// Largest number of states of one assessment over time; each is traced.
inline constexpr int max_states = 1000;
}  // namespace limits

/// The states that are assessed one after another, on one common clock.
struct TimeSettings {
  SourcePlace place;
  double from_s = 0, to_s = 0, step_s = 1;
  std::optional<double> mains_fail_at_s;    // absent: never
  std::optional<double> walking_speed_m_s;  // absent: nobody walks
};

/// Project data on a report's first page and in its footers. "" if not given.
struct ProjectSettings {
  std::string name, client, address, document, revision, date, author, checker;
  std::string logo;      // picture file, as the scene names it
  double north_deg = 0;  // direction of north, from +y towards +x, seen from above
  SourcePlace place;
};

/// A drawing of the building from another source, shown under plans of some floors. It is not
/// geometry and does not affect light.
struct Backdrop {
  SourcePlace place;
  std::string file;      // resolved path
  bool picture = false;  // PNG; else lines of a DXF
  glm::dvec2 corner{0};  // lower left corner of a picture [m]
  glm::dvec2 across{0};  // lower and left edges of a picture from there [m]
  glm::dvec2 up{0};
  std::vector<std::pair<glm::dvec2, glm::dvec2>> lines;  // lines of a drawing [m]
  double low_m = -1e7, high_m = 1e7;                     // heights of the floors it belongs to

  bool lies_under(double floor_m) const { return floor_m >= low_m && floor_m <= high_m; }
};

/// A side of the scene's bounding box.
enum class Side { west, east, south, north, bottom, top };  // -x, +x, -y, +y, -z, +z
inline constexpr std::array<std::string_view, 6> side_words{"west",  "east",   "south",
                                                            "north", "bottom", "top"};

// ---- scenarios and run ------------------------------------------------------------------------

enum class Operation { mains, emergency, dark };
inline constexpr std::array<const char*, 3> operation_words{"mains", "emergency", "dark"};
constexpr const char* name_of(Operation operation) {
  return operation_words[static_cast<size_t>(operation)];
}

struct Scenario {
  struct Factor {
    std::string name;
    double factor;
    SourcePlace change = {};  // the change of a variant that has scaled it; line 0: none
  };
  std::string name;
  SourcePlace place;
  Operation operation = Operation::mains;          // at the time of the state
  Operation written_operation = Operation::mains;  // after the mains have failed
  double seconds_after_failure = 0;  // for photoluminescent decay and the run-up of luminaires
  bool says_seconds = false;         // whether it is given; else luminaires are taken as fully on
  std::vector<Factor> circuits;      // by circuit name; others 1
  std::vector<Factor> media;         // extinction factor by medium name; 0 removes it
  double smoke_factor = 1;           // for every medium not named
  double emission_factor = 1;        // for flames
  std::vector<std::string> doors_open;  // by object name
  std::vector<std::string> doors_closed;
};

enum class GroupRule { one, by_circuit, by_emitter };

struct RunSettings {
  uint64_t seed = 1;
  int max_bands = 8;                  // 1 forces one band
  std::vector<double> band_edges_nm;  // empty: chosen automatically to distinguish the spectra
  double band_tolerance = 0.02;
  int64_t batch_particles = 0;  // 0: computed from the scene
  double voxel_edge_m = 0;      // 0: computed from the scene; only where a medium is
  bool voxels = true;
  bool analogue = false;   // sampled absorption instead of weighted survival
  bool stratified = true;  // low-discrepancy points for the first draws of histories and eye paths
  GroupRule groups = GroupRule::one;
  double eye_path_factor = 1.0;  // eye paths per batch, relative to the default
  std::vector<std::string>
      error_of;  // quantities whose error ends a run: see scenes/light/transport/error_target.hpp
  SourcePlace error_of_place;
};

/// Bulk data of a scene from a pack: see scenes/light/transport/packed_scene.hpp.
struct PackedScene;

/// Settings of `luxodus design`: see design.hpp.
struct DesignSettings;

/// Files and their hashes: see files_as_read.hpp.
class FilesAsRead;

struct SceneDescription {
  std::string name;
  std::string title;
  std::string file;
  RunSettings run;
  std::vector<Material> materials;
  std::vector<Object> objects;
  std::vector<Emitter> emitters;
  std::vector<Medium> media;
  std::vector<Sign> signs;
  std::vector<PlaneMeasure> planes;
  std::vector<ProbeMeasure> probes;
  std::vector<SurfaceGroupMeasure> surface_groups;
  std::vector<VolumeGroupMeasure> volume_groups;
  std::vector<CountingPlaneMeasure> counting_planes;
  std::vector<Observer> observers;
  std::vector<Camera> cameras;
  std::vector<EscapeRoute> routes;
  std::vector<AssessedArea> open_areas;
  std::vector<AssessedArea> task_areas;
  std::vector<EmphasisPoint> emphasis;
  std::vector<AssessedArea> rooms;  // named floors, for lists and plans; none in a pack
  AssessmentSettings assessment;
  ProjectSettings project;
  std::vector<Backdrop> backdrops;  // none in a pack
  std::optional<TimeSettings> time;
  std::optional<double> at_s;                    // time of this state, if one was given
  std::shared_ptr<const DesignSettings> design;  // null in a pack, and in scenes made by programs
  std::vector<Side> open_sides;                  // through which light is meant to leave
  std::vector<Scenario> scenarios;               // empty: mains, as described
  bool people_are_bodies = false;                // so states at other times have other surfaces
  uint64_t content_hash = 0;                     // hash of every file read
  std::shared_ptr<const FilesAsRead> files;      // null in a pack, and in scenes made by programs
  int64_t degenerate_triangles = 0;              // dropped on reading
  std::vector<Problem> warnings;                 // reported by `check`, not fatal
  std::vector<Problem> notes;  // reported by `check`: what a reader of the results should know
  /// Source of the triangles if they are not in the objects; else null.
  std::shared_ptr<const PackedScene> packed;
};

}  // namespace luxodus
