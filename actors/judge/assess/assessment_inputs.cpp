#include "actors/judge/assess/assessment_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "actors/judge/assess/judged_state.hpp"
#include "actors/judge/assess/plan_cut.hpp"
#include "runtime/core/base64.hpp"
#include "scenes/emergency/rules.hpp"
#include "scenes/formats/images/logo.hpp"
#include "scenes/formats/images/page_picture.hpp"

namespace luxodus {

namespace {

/// Four significant digits: an illuminance map is for drawing, and its file stays small.
Json drawn_lux(double lux) {
  if (!std::isfinite(lux)) return nullptr;
  if (lux <= 0) return 0;
  const double step = std::pow(10.0, std::floor(std::log10(lux)) - 3);
  return step >= 1e-9 ? Json(std::stod(fmt::format("{:.4g}", lux))) : Json(0);
}

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

/// Mean of a spectrum weighted by V(lambda), in equal-energy light.
double luminous_mean(const Spectrum& s) {
  return s.integral_with(cie_y()) / cie_y().integral();
}

Json luminaire_json(const Emitter& e) {
  const char* unit = e.radiometric ? "W" : "lm";
  const bool emergency = e.emergency_flux > 0;
  Json out = {{"name", e.name},
              {"file", e.file},
              {"product", e.product},
              {"shape", word_of(e.shape)},
              {"distribution", word_of(e.distribution)},
              {"position", vector_json(e.frame.origin)},
              {"circuit", e.circuit},
              {"operation", !emergency         ? "mains"
                            : e.mains_flux > 0 ? "maintained"
                                               : "non-maintained"},
              {"mains_flux", exact_json(e.mains_flux, unit)},
              {"emergency_flux", exact_json(e.emergency_flux, unit)},
              {"maintenance_factor", e.maintenance_factor},
              {"end_of_duration_factor", e.end_of_duration_factor},
              {"emergency_ageing", e.emergency_ageing}};
  if (!e.ifc_guid.empty()) out["ifc_guid"] = e.ifc_guid;
  if (e.opening_m != glm::dvec3(0)) out["opening_m"] = vector_json(e.opening_m);
  if (e.shape == EmitterShape::mesh && !e.mesh.positions.empty()) {
    glm::dvec3 sum(0);
    for (const glm::dvec3& p : e.mesh.positions) sum += p;
    out["position"] = vector_json(sum / static_cast<double>(e.mesh.positions.size()));
  }
  Json& onset = out["onset"] = Json::array();
  for (const glm::dvec2& row : e.onset) onset.push_back({row.x, row.y});
  return out;
}

Json sign_json(const Sign& s) {
  Json out = {{"name", s.name},
              {"position", vector_json(s.frame.origin)},
              {"facing", vector_json(s.frame.axes[2])},
              {"file", s.file},
              {"text", s.text},
              {"width", exact_json(s.width_m, "m")},
              {"height", exact_json(s.height_m, "m")},
              {"smallest_detail", exact_json(s.smallest_detail_m, "m")},
              {"double_sided", s.double_sided},
              {"lighting", word_of(s.lighting)},
              {"circuit", s.circuit}};
  if (!s.ifc_guid.empty()) out["ifc_guid"] = s.ifc_guid;
  if (s.lighting != SignLighting::external) {
    out["mains_white"] = exact_json(s.mains.white_cd_m2, "cd/m2");
    out["mains_green"] = exact_json(s.mains.green_cd_m2, "cd/m2");
    out["emergency_white"] = exact_json(s.emergency.white_cd_m2, "cd/m2");
    out["emergency_green"] = exact_json(s.emergency.green_cd_m2, "cd/m2");
  }
  return out;
}

Json area_json(const AssessedArea& area, const char* kind) {
  Json outline = Json::array();
  for (const glm::dvec2& p : area.outline) outline.push_back({p.x, p.y});
  Json out = {{"name", area.name}, {"kind", kind}, {"outline", outline}, {"z", area.z_m}};
  if (!area.ifc_guid.empty()) out["ifc_guid"] = area.ifc_guid;
  return out;
}

/// The extinction of a layer or a body as the scene states it.
Json optics_json(const SmokeOptics& optics) {
  return {{"extinction", exact_json(optics.extinction.sigma_t, "1/m")},
          {"wavelength", exact_json(optics.extinction.wavelength_nm, "nm")},
          {"angstrom", optics.extinction.angstrom},
          {"albedo", luminous_mean(optics.albedo)},
          {"asymmetry", optics.phase.g}};
}

Json medium_json(const Medium& medium) {
  Json out = {{"name", medium.name}, {"kind", word_of(medium.kind)}};
  Json& layers = out["layers"] = Json::array();
  for (const Layer& layer : medium.layers) {
    Json row = optics_json(layer.optics);
    row["z_low"] = layer.z_low;
    row["z_high"] = layer.z_high;
    layers.push_back(std::move(row));
  }
  if (medium.layers.empty()) layers.push_back(optics_json(medium.optics));
  if (medium.emission) out["flame_power"] = exact_json(medium.emission->power_w, "W");
  return out;
}

}  // namespace

Json project_json(const ProjectSettings& p) {
  Json out = {{"name", p.name},         {"client", p.client},     {"address", p.address},
              {"document", p.document}, {"revision", p.revision}, {"date", p.date},
              {"author", p.author},     {"checker", p.checker},   {"north_deg", p.north_deg}};
  if (p.logo.empty()) return out;
  if (const auto logo = read_logo(p.logo); logo) out["logo_png"] = base64(logo.value());
  return out;
}

Json luminaires_json(const SceneDescription& scene) {
  Json out = Json::array();
  for (const Emitter& emitter : scene.emitters) out.push_back(luminaire_json(emitter));
  return out;
}

Json signs_json(const SceneDescription& scene) {
  Json out = Json::array();
  for (const Sign& sign : scene.signs) out.push_back(sign_json(sign));
  return out;
}

Json places_json(const SceneDescription& scene) {
  Json routes = Json::array(), areas = Json::array(), emphasis = Json::array();
  for (const EscapeRoute& route : scene.routes) {
    Json path = Json::array();
    for (const glm::dvec3& p : route.path) path.push_back(vector_json(p));
    routes.push_back({{"name", route.name}, {"path", path}, {"width", route.width_m}});
  }
  for (const AssessedArea& area : scene.open_areas) areas.push_back(area_json(area, "open"));
  for (const AssessedArea& area : scene.task_areas) {
    Json row = area_json(area, "task");
    row["mains_lx"] = area.mains_lx;
    areas.push_back(std::move(row));
  }
  for (const EmphasisPoint& point : scene.emphasis)
    emphasis.push_back({{"name", point.name},
                        {"kind", std::string(emphasis_words[static_cast<size_t>(point.kind)])},
                        {"position", vector_json(point.position)}});
  return {{"routes", routes}, {"areas", areas}, {"emphasis", emphasis}};
}

Json materials_json(const SceneDescription& scene) {
  std::vector<size_t> uses(scene.materials.size(), 0);
  for (const Object& object : scene.objects) ++uses[static_cast<size_t>(object.material)];
  Json out = Json::array();
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& m = scene.materials[i];
    Json row = {{"name", m.name}, {"kind", word_of(m.kind)}, {"objects", uses[i]}};
    const bool reflects = m.kind == MaterialKind::lambertian || m.kind == MaterialKind::glossy;
    if (reflects) row["reflectance"] = luminous_mean(m.reflectance);
    if (m.kind == MaterialKind::glossy || m.kind == MaterialKind::mirror)
      row["specular"] = luminous_mean(m.specular);
    if (m.kind == MaterialKind::glass_pane)
      row["transmittance"] = luminous_mean(m.internal_transmittance);
    if (m.kind == MaterialKind::glass_pane || m.kind == MaterialKind::dielectric)
      row["ior"] = m.ior;
    row["picture"] = m.reflectance_image != nullptr;
    out.push_back(std::move(row));
  }
  return out;
}

Json media_json(const SceneDescription& scene) {
  Json out = Json::array();
  for (const Medium& medium : scene.media) out.push_back(medium_json(medium));
  return out;
}

Json scenario_json(const SceneDescription& scene, const std::string& name) {
  Json out = {{"name", name}, {"operation", "mains"}, {"seconds_after_failure", nullptr}};
  const auto at = std::find_if(scene.scenarios.begin(), scene.scenarios.end(),
                               [&](const Scenario& s) { return s.name == name; });
  Json &media = out["media"] = Json::array(), &open = out["doors_open"] = Json::array(),
       &closed = out["doors_closed"] = Json::array(), &circuits = out["circuits"] = Json::array();
  if (at == scene.scenarios.end()) return out;
  out["operation"] = name_of(at->operation);
  if (at->says_seconds) out["seconds_after_failure"] = at->seconds_after_failure;
  out["smoke_factor"] = at->smoke_factor;
  for (const Scenario::Factor& f : at->media)
    media.push_back({{"name", f.name}, {"factor", f.factor}});
  for (const Scenario::Factor& f : at->circuits)
    circuits.push_back({{"name", f.name}, {"factor", f.factor}});
  for (const std::string& door : at->doors_open) open.push_back(door);
  for (const std::string& door : at->doors_closed) closed.push_back(door);
  return out;
}

Json plan_json(const Assessment& assessment) {
  Json levels = Json::array();
  for (const PlanLevel& level : assessment.levels) {
    Json walls = Json::array(), points = Json::array(), lux = Json::array();
    for (const auto& [a, b] : level.walls) walls.push_back({a.x, a.y, b.x, b.y});
    Json furniture = Json::array();
    for (const auto& [a, b] : level.furniture) furniture.push_back({a.x, a.y, b.x, b.y});
    for (const PlanPoint& p : level.points)
      points.push_back({p.place.x, p.place.y, p.place.z, p.lux});
    for (const double value : level.map.lux) lux.push_back(drawn_lux(value));
    levels.push_back({{"floor", level.floor_m},
                      {"walls", walls},
                      {"furniture", furniture},
                      {"points", points},
                      {"map",
                       {{"corner", {level.map.corner.x, level.map.corner.y}},
                        {"spacing", level.map.spacing_m},
                        {"columns", level.map.columns},
                        {"rows", level.map.rows},
                        {"lux", lux}}}});
  }
  return {{"levels", levels},
          {"route_grid", exact_json(route_grid_m, "m")},
          {"area_grid", exact_json(area_grid_m, "m")},
          {"height", exact_json(floor_plane_m, "m")}};
}

/// The reader of scenes applies the same limit.
static_assert(limits::backdrop_lines == limits::plan_lines);

Json backdrops_json(const SceneDescription& scene) {
  Json out = Json::array();
  const auto pair = [](const glm::dvec2& p) { return Json{p.x, p.y}; };
  for (const Backdrop& backdrop : scene.backdrops) {
    Json one = {{"floors", {backdrop.low_m, backdrop.high_m}}};
    if (backdrop.picture) {
      const auto picture = read_backdrop_picture(backdrop.file);
      if (!picture) continue;
      one["corner"] = pair(backdrop.corner);
      one["across"] = pair(backdrop.across);
      one["up"] = pair(backdrop.up);
      one["png"] = base64(picture->png);
    } else {
      Json& lines = one["lines"] = Json::array();
      for (const auto& [a, b] : longest_lines(backdrop.lines))
        lines.push_back({a.x, a.y, b.x, b.y});
    }
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace luxodus
