#include "actors/judge/assess/assessment_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "actors/judge/assess/judged_state.hpp"
#include "actors/judge/assess/luminaire_sheets.hpp"
#include "actors/judge/assess/plan_cut.hpp"
#include "actors/judge/inspect/site.hpp"
#include "runtime/core/base64.hpp"
#include "scenes/emergency/far_field.hpp"
#include "scenes/emergency/rules.hpp"
#include "scenes/formats/images/logo.hpp"
#include "scenes/formats/images/page_picture.hpp"
#include "scenes/light/geometry/polygon.hpp"

namespace luxodus {

namespace {

const char* word_of(EmitterShape shape) {
  constexpr const char* words[] = {"point", "rectangle", "disc", "sphere", "tube", "mesh"};
  return words[static_cast<size_t>(shape)];
}

const char* word_of(Distribution distribution) {
  constexpr const char* words[] = {"lambertian", "isotropic",  "cosine_power",
                                   "spot",       "collimated", "photometric file"};
  return words[static_cast<size_t>(distribution)];
}

const char* word_of(SignLighting lighting) {
  constexpr const char* words[] = {"internal", "external", "photoluminescent"};
  return words[static_cast<size_t>(lighting)];
}

const char* word_of(MaterialKind kind) {
  constexpr const char* words[] = {"lambertian", "glossy",     "mirror",
                                   "glass_pane", "dielectric", "open"};
  return words[static_cast<size_t>(kind)];
}

const char* word_of(MediumKind kind) {
  constexpr const char* words[] = {"homogeneous", "layered", "bounded", "data_set"};
  return words[static_cast<size_t>(kind)];
}

LuminaireRecord luminaire_of(const Emitter& e) {
  const char* unit = e.radiometric ? "W" : "lm";
  const bool emergency = e.emergency_flux > 0;
  LuminaireRecord out{.name = e.name,
                      .file = e.file,
                      .product = e.product,
                      .shape = word_of(e.shape),
                      .distribution = word_of(e.distribution),
                      .position = centre_of(e),
                      .floor_m = {},
                      .circuit = e.circuit,
                      .operation = !emergency         ? "mains"
                                   : e.mains_flux > 0 ? "maintained"
                                                      : "non-maintained",
                      .mains_flux = {e.mains_flux, unit},
                      .emergency_flux = {e.emergency_flux, unit},
                      .maintenance_factor = e.maintenance_factor,
                      .end_of_duration_factor = e.end_of_duration_factor,
                      .emergency_ageing = e.emergency_ageing,
                      .ifc_guid = e.ifc_guid,
                      .opening_m = {},
                      .onset = e.onset,
                      .sheet = 0};
  if (e.opening_m != glm::dvec3(0)) out.opening_m = e.opening_m;
  return out;
}

/// "" of no colour.
std::string name_at(const Sign& sign, ColourIndex colour) {
  return colour < sign.colours.size() ? sign.colours[colour].name : "";
}

SignRecord sign_of(const Sign& s) {
  SignRecord out{.name = s.name,
                 .position = s.frame.origin,
                 .floor_m = {},
                 .facing = s.frame.axes[2],
                 .file = s.file,
                 .text = s.text,
                 .width_m = s.width_m,
                 .height_m = s.height_m,
                 .smallest_detail_m = s.smallest_detail_m,
                 .double_sided = s.double_sided,
                 .lighting = word_of(s.lighting),
                 .circuit = s.circuit,
                 .ifc_guid = s.ifc_guid,
                 .legend = name_at(s, s.face.legend),
                 .ground = name_at(s, s.face.ground),
                 .colours = {}};
  for (const FaceColour& colour : s.colours) {
    FaceColourRecord& record = out.colours.emplace_back(FaceColourRecord{colour.name, {}, {}});
    if (s.lighting == SignLighting::external) continue;
    record.mains_cd_m2 = colour.mains_cd_m2;
    record.emergency_cd_m2 = colour.emergency_cd_m2;
  }
  return out;
}

AreaRecord area_of(const AssessedArea& area, bool is_task) {
  AreaRecord out{area.name, is_task, area.outline, area.z_m, area.ifc_guid, {}};
  if (is_task) out.mains_lx = area.mains_lx;
  return out;
}

/// The extinction of a layer or a body as the scene states it.
LayerRecord optics_of(const SmokeOptics& optics) {
  return {.extinction_per_m = optics.extinction.sigma_t,
          .wavelength_nm = optics.extinction.wavelength_nm,
          .angstrom = optics.extinction.angstrom,
          .albedo = luminous_mean(optics.albedo),
          .asymmetry = optics.phase.g,
          .z_low_m = {},
          .z_high_m = {}};
}

MediumRecord medium_of(const Medium& medium) {
  MediumRecord out{medium.name, word_of(medium.kind), {}, {}};
  for (const Layer& layer : medium.layers) {
    LayerRecord& row = out.layers.emplace_back(optics_of(layer.optics));
    row.z_low_m = layer.z_low;
    row.z_high_m = layer.z_high;
  }
  if (medium.layers.empty()) out.layers.push_back(optics_of(medium.optics));
  if (medium.emission) out.flame_power_w = medium.emission->power_w;
  return out;
}

MaterialRecord material_of(const Material& m, size_t objects) {
  MaterialRecord out{.name = m.name,
                     .kind = word_of(m.kind),
                     .objects = objects,
                     .reflectance = {},
                     .specular = {},
                     .transmittance = {},
                     .ior = {},
                     .picture = m.reflectance_image != nullptr};
  if (m.kind == MaterialKind::lambertian || m.kind == MaterialKind::glossy)
    out.reflectance = luminous_mean(m.reflectance);
  if (m.kind == MaterialKind::glossy || m.kind == MaterialKind::mirror)
    out.specular = luminous_mean(m.specular);
  if (m.kind == MaterialKind::glass_pane)
    out.transmittance = luminous_mean(m.internal_transmittance);
  if (m.kind == MaterialKind::glass_pane || m.kind == MaterialKind::dielectric) out.ior = m.ior;
  return out;
}

ProjectRecord project_of(const ProjectSettings& p) {
  ProjectRecord out{p.name, p.client, p.address, p.document,  p.revision,
                    p.date, p.author, p.checker, p.north_deg, ""};
  if (p.logo.empty()) return out;
  if (const auto logo = read_logo(p.logo); logo) out.logo_png = base64(logo.value());
  return out;
}

PlacesRecord places_of(const SceneDescription& scene) {
  PlacesRecord out;
  for (const EscapeRoute& route : scene.routes)
    out.routes.push_back({route.name, route.path, route.width_m});
  for (const AssessedArea& area : scene.open_areas) out.areas.push_back(area_of(area, false));
  for (const AssessedArea& area : scene.task_areas) out.areas.push_back(area_of(area, true));
  for (const EmphasisPoint& point : scene.emphasis)
    out.emphasis.push_back({point.name,
                            std::string(emphasis_words[static_cast<size_t>(point.kind)]),
                            point.position, point.ifc_guid});
  return out;
}

/// Whether a thing on this floor stands or hangs in a room.
bool holds(const RoomRecord& room, const glm::dvec3& place, const std::optional<double>& floor_m) {
  constexpr double one_storey_m = 1;
  return std::abs(floor_m.value_or(place.z) - room.z_m) < one_storey_m &&
         is_within(room.outline, glm::dvec2(place));
}

/// The rooms of the scene; if it names none, its areas.
std::vector<RoomRecord> rooms_of(const SceneDescription& scene, const AssessmentRecord& record) {
  std::vector<const AssessedArea*> areas;
  for (const AssessedArea& room : scene.rooms) areas.push_back(&room);
  if (areas.empty())
    for (const auto* list : {&scene.open_areas, &scene.task_areas})
      for (const AssessedArea& area : *list) areas.push_back(&area);
  std::vector<RoomRecord> out;
  for (const AssessedArea* area : areas) {
    RoomRecord room{.name = area->name,
                    .outline = area->outline,
                    .z_m = area->z_m,
                    .area_m2 = signed_area(area->outline),
                    .ifc_guid = area->ifc_guid};
    for (const LuminaireRecord& one : record.luminaires)
      if (holds(room, one.position, one.floor_m))
        ++(one.emergency_flux.value > 0 ? room.emergency : room.mains);
    for (const SignRecord& sign : record.signs)
      room.signs += holds(room, sign.position + 0.05 * sign.facing, sign.floor_m);
    out.push_back(std::move(room));
  }
  return out;
}

std::vector<MaterialRecord> materials_of(const SceneDescription& scene) {
  std::vector<size_t> uses(scene.materials.size(), 0);
  for (const Object& object : scene.objects) ++uses[static_cast<size_t>(object.material)];
  std::vector<MaterialRecord> out;
  for (size_t i = 0; i < scene.materials.size(); ++i)
    out.push_back(material_of(scene.materials[i], uses[i]));
  return out;
}

ScenarioRecord scenario_of(const SceneDescription& scene, const std::string& name) {
  ScenarioRecord out;
  out.name = name;
  const auto at = std::find_if(scene.scenarios.begin(), scene.scenarios.end(),
                               [&](const Scenario& s) { return s.name == name; });
  if (at == scene.scenarios.end()) return out;
  out.operation = at->operation;
  if (at->says_seconds) out.seconds_after_failure = at->seconds_after_failure;
  out.smoke_factor = at->smoke_factor;
  for (const Scenario::Factor& f : at->media) out.media.push_back({f.name, f.factor});
  for (const Scenario::Factor& f : at->circuits) out.circuits.push_back({f.name, f.factor});
  out.doors_open = at->doors_open;
  out.doors_closed = at->doors_closed;
  return out;
}

/// The reader of scenes applies the same limit.
static_assert(limits::backdrop_lines == limits::plan_lines);

}  // namespace

std::vector<BackdropRecord> backdrops_of(const SceneDescription& scene) {
  std::vector<BackdropRecord> out;
  for (const Backdrop& backdrop : scene.backdrops) {
    BackdropRecord one;
    one.floors = {backdrop.low_m, backdrop.high_m};
    if (backdrop.picture) {
      const auto picture = read_backdrop_picture(backdrop.file);
      if (!picture) continue;
      one.corner = backdrop.corner;
      one.across = backdrop.across;
      one.up = backdrop.up;
      one.png = base64(picture->png);
    } else {
      one.lines = longest_lines(backdrop.lines);
    }
    out.push_back(std::move(one));
  }
  return out;
}

void add_inputs(const SceneDescription& scene, const Assessment& assessment,
                AssessmentRecord& record) {
  record.project = project_of(scene.project);
  record.scenario = scenario_of(scene, assessment.state.scenario);
  for (const Emitter& emitter : scene.emitters) record.luminaires.push_back(luminaire_of(emitter));
  for (const Sign& sign : scene.signs) record.signs.push_back(sign_of(sign));
  for (size_t i = 0; i < assessment.luminaire_floors.size(); ++i)
    record.luminaires[i].floor_m = assessment.luminaire_floors[i];
  for (size_t i = 0; i < assessment.sign_floors.size(); ++i)
    record.signs[i].floor_m = assessment.sign_floors[i];
  add_sheets(scene, record);
  record.places = places_of(scene);
  record.rooms = rooms_of(scene, record);
  record.surfaces = assessment.surfaces;
  record.materials = materials_of(scene);
  for (const Medium& medium : scene.media) record.media.push_back(medium_of(medium));
  for (const Camera& camera : scene.cameras) record.cameras.push_back(camera.name);
  record.plan = {assessment.levels, route_grid_m, area_grid_m, floor_plane_m, backdrops_of(scene)};
}

}  // namespace luxodus
