#include "actors/apps/view/live_json.hpp"

#include <algorithm>

#include "runtime/core/base64.hpp"
#include "scenes/light/optics/spectrum.hpp"

namespace luxodus {

namespace {

Json place(const glm::dvec3& p) {
  return {p.x, p.y, p.z};
}

/// Linear sRGB of a radiance by band; its weighted sum is the luminance.
Json colour(const Bands& bands, const std::vector<double>& radiance) {
  std::array<double, 3> xyz{};
  for (size_t b = 0; b < radiance.size(); ++b) {
    const Band& band = bands[static_cast<int>(b)];
    xyz[0] += radiance[b] * band.x_per_w;
    xyz[1] += radiance[b] * band.lm_per_w;
    xyz[2] += radiance[b] * band.z_per_w;
  }
  const auto rgb = linear_srgb_from_xyz(xyz);
  return {rgb[0], rgb[1], rgb[2]};
}

Json scenarios_json(const SceneDescription& scene) {
  Json out = Json::array();
  for (const Scenario& s : scene.scenarios)
    out.push_back({{"name", s.name}, {"operation", name_of(s.operation)}});
  return out;
}

/// The times of all states, and the shown one; null with a single state.
Json states_json(const SceneDescription& scene, const SceneEdits& edits) {
  if (!scene.time || !edits.at_s) return {};
  return {{"from", scene.time->from_s},
          {"to", scene.time->to_s},
          {"step", scene.time->step_s},
          {"at", *edits.at_s},
          {"mains_fail_at", optional_json(scene.time->mains_fail_at_s)}};
}

double number_of(const std::map<std::string, double>& numbers, const std::string& group) {
  const auto at = numbers.find(group);
  return at == numbers.end() ? 1.0 : at->second;
}

const char* light_name(ShownLight light) {
  constexpr const char* names[] = {"new", "kept", "before"};
  return names[static_cast<size_t>(light)];
}

Json groups_json(const LiveGeneration& generation, const LiveDimming& dimming, bool follows) {
  const CompiledScene& scene = *generation.scene;
  Json out = Json::array();
  for (size_t g = 0; g < scene.groups.size(); ++g) {
    Json group = {{"name", scene.groups[g].name}, {"kind", "luminaire"}};
    for (const CompiledEmitter& e : scene.emitters) {
      if (e.group != static_cast<int>(g)) continue;
      if (e.sign != none_index) group["kind"] = "sign";
      if (e.medium != none_index) group["kind"] = "flame";
      group["position"] = place(scene.local_origin + glm::dvec3(e.origin));
      break;
    }
    group["factor"] = number_of(dimming.factors, scene.groups[g].name);
    group["share"] = number_of(dimming.shares, scene.groups[g].name);
    group["light"] = light_name(follows ? generation.lights[g] : ShownLight::none);
    out.push_back(std::move(group));
  }
  return out;
}

bool was_added(const SceneEdits& edits, bool is_sign, const std::string& name) {
  return std::any_of(edits.added.begin(), edits.added.end(), [&](const SceneEdits::Copy& copy) {
    return copy.is_sign == is_sign && copy.name == name;
  });
}

std::string texels_of(const SignFace& face) {
  std::string bytes;
  for (const ColourIndex colour : face.colour) bytes.push_back(static_cast<char>(colour));
  return base64(bytes);
}

Json signs_json(const CompiledScene& scene, const SceneEdits& edits) {
  Json out = Json::array();
  for (const CompiledSign& face : scene.signs) {
    if (face.back) continue;
    const Sign& sign = scene.description->signs[face.sign];
    Json colours = Json::array();
    for (const CompiledFaceColour& one : face.colours)
      colours.push_back(colour(scene.bands, one.radiance));
    out.push_back({{"name", sign.name},
                   {"position", place(sign.frame.origin)},
                   {"facing", place(sign.frame.axes[2])},
                   {"up", place(sign.frame.axes[1])},
                   {"width", sign.width_m},
                   {"height", sign.height_m},
                   {"double_sided", sign.double_sided},
                   {"columns", sign.face.width},
                   {"rows", sign.face.height},
                   {"texels", texels_of(sign.face)},
                   {"colours", std::move(colours)},
                   {"group", group_of_sign(sign.name)},
                   {"added", was_added(edits, true, sign.name)}});
  }
  return out;
}

Json luminaires_json(const SceneDescription& scene, const SceneEdits& edits) {
  Json out = Json::array();
  for (const Emitter& e : scene.emitters)
    out.push_back({{"name", e.name},
                   {"position", place(e.frame.origin)},
                   {"group", group_of_luminaire(e.name)},
                   {"added", was_added(edits, false, e.name)}});
  return out;
}

Json shape_json(const std::optional<LiveFlameShape>& shape) {
  if (!shape) return {};
  return {{"low", place(shape->low)},
          {"size", place(shape->size)},
          {"extinction", shape->extinction_per_m},
          {"seed", shape->seed}};
}

Json flames_json(const LiveGeneration& generation) {
  Json out = Json::array();
  if (!generation.flames) return out;
  for (const LiveFlame& flame : *generation.flames)
    out.push_back({{"group", flame.group},
                   {"low", place(flame.low)},
                   {"size", place(flame.size)},
                   {"count", {flame.count.x, flame.count.y, flame.count.z}},
                   {"colour", {flame.colour[0], flame.colour[1], flame.colour[2]}},
                   {"cells", base64(flame.cells)},
                   {"shape", shape_json(flame.shape)}});
  return out;
}

Json rgb_json(const std::array<double, 3>& rgb) {
  return {rgb[0], rgb[1], rgb[2]};
}

const char* shape_name(EmitterKind kind) {
  switch (kind) {
    case EmitterKind::disc:
      return "disc";
    case EmitterKind::sphere:
      return "sphere";
    case EmitterKind::tube:
      return "tube";
    case EmitterKind::mesh:
      return "mesh";
    default:
      return "rectangle";
  }
}

Json lamps_json(const LiveLamps& lamps) {
  Json out = Json::array();
  for (const LiveLamp& lamp : lamps.lamps) {
    Json corners = Json::array();
    for (const glm::dvec3& corner : lamp.corners) corners.push_back(place(corner));
    out.push_back({{"group", lamp.group},
                   {"shape", shape_name(lamp.kind)},
                   {"position", place(lamp.origin)},
                   {"axes", {place(lamp.axes[0]), place(lamp.axes[1]), place(lamp.axes[2])}},
                   {"size", place(lamp.size)},
                   {"corners", std::move(corners)},
                   {"colour", rgb_json(lamp.colour)},
                   {"table", lamp.table},
                   {"of_luminaire", lamp.of_luminaire}});
  }
  return out;
}

Json lamp_tables_json(const LiveLamps& lamps) {
  Json out = Json::array();
  for (const LampTable& table : lamps.tables)
    out.push_back({{"peak", table.peak},
                   {"polar", limits::lamp_polar},
                   {"azimuth", limits::lamp_azimuth},
                   {"values", base64(table.values)}});
  return out;
}

Json gloss_json(const std::vector<LiveGloss>& all) {
  Json out = Json::array();
  for (const LiveGloss& gloss : all)
    out.push_back({{"surface", gloss.surface},
                   {"back", gloss.back},
                   {"mirrored", rgb_json(gloss.mirrored)},
                   {"spread", gloss.spread},
                   {"roughness", gloss.roughness}});
  return out;
}

/// Lines of a plan are left out beyond what a page takes in a list, instead of the whole scene.
bool has_room(const Json& list, size_t corners) {
  constexpr size_t listed = 4096;
  return list.size() < listed && corners <= listed;
}

Json places(const std::vector<glm::dvec3>& all) {
  Json out = Json::array();
  for (const glm::dvec3& one : all) out.push_back(place(one));
  return out;
}

Json routes_json(const SceneDescription& scene) {
  Json out = Json::array();
  for (const EscapeRoute& route : scene.routes)
    if (has_room(out, route.path.size()))
      out.push_back({{"name", route.name}, {"width", route.width_m}, {"path", places(route.path)}});
  return out;
}

/// Open areas and task areas.
Json areas_json(const SceneDescription& scene) {
  Json out = Json::array();
  for (const auto* areas : {&scene.open_areas, &scene.task_areas})
    for (const AssessedArea& area : *areas) {
      if (!has_room(out, area.outline.size())) continue;
      Json outline = Json::array();
      for (const glm::dvec2& corner : area.outline) outline.push_back({corner.x, corner.y});
      out.push_back({{"name", area.name}, {"outline", std::move(outline)}, {"z", area.z_m}});
    }
  return out;
}

Json emphasis_json(const SceneDescription& scene) {
  Json out = Json::array();
  for (const EmphasisPoint& point : scene.emphasis)
    if (has_room(out, 1))
      out.push_back({{"name", point.name}, {"position", place(point.position)}});
  return out;
}

Json voxels_json(const CompiledScene& scene) {
  const VoxelGrid& grid = scene.voxels;
  if (!(grid.edge > 0)) return {};
  return {{"low", place(scene.local_origin + glm::dvec3(grid.low))},
          {"edge", grid.edge},
          {"count", {grid.nx, grid.ny, grid.nz}}};
}

}  // namespace

std::map<std::string, double> LiveDimming::both() const {
  std::map<std::string, double> out = factors;
  for (const auto& [group, share] : shares) out.try_emplace(group, 1.0).first->second *= share;
  return out;
}

Json optional_json(const std::optional<double>& value) {
  return value ? number_json(*value) : Json();
}

Json live_scene_json(const SceneDescription& scene, const LiveGeneration& generation,
                     const LiveDimming& dimming, bool editor, bool follows) {
  const CompiledScene& compiled = *generation.scene;
  const LiveLook& look = *generation.look;
  Json observers = Json::array(), cameras = Json::array();
  for (const Observer& o : scene.observers)
    observers.push_back({{"name", o.name}, {"eye", place(o.eye)}, {"gaze", place(o.gaze)}});
  for (const Camera& c : scene.cameras) {
    if (c.cut_m) continue;  // a walker there would stand above the roof
    cameras.push_back({{"name", c.name},
                       {"eye", place(c.eye)},
                       {"target", place(c.target)},
                       {"up", place(c.up)},
                       {"fov_deg", c.vertical_fov_deg}});
  }
  return {{"type", "scene"},
          {"generation", generation.number},
          {"name", scene.name},
          {"title", scene.title},
          {"scenarios", scenarios_json(*compiled.description)},
          {"states", states_json(scene, generation.edits)},
          {"scenario", compiled.scenario.name},
          {"smoke", generation.edits.smoke},
          {"seconds", optional_json(dimming.seconds)},
          {"low", place(compiled.bounds.low)},
          {"high", place(compiled.bounds.high)},
          {"relaid", follows && generation.triangles_before != nullptr},
          {"groups", groups_json(generation, dimming, follows)},
          {"signs", signs_json(compiled, generation.edits)},
          {"luminaires", luminaires_json(*compiled.description, generation.edits)},
          {"routes", routes_json(scene)},
          {"areas", areas_json(scene)},
          {"emphasis", emphasis_json(scene)},
          {"north_deg", scene.project.north_deg},
          {"observers", observers},
          {"cameras", cameras},
          {"voxels", voxels_json(compiled)},
          {"flames", flames_json(generation)},
          {"lamps", lamps_json(look.lamps)},
          {"lamp_tables", lamp_tables_json(look.lamps)},
          {"gloss", gloss_json(look.gloss)},
          {"editor", editor}};
}

Json progress_json(const LiveProgress& progress) {
  return {{"type", "progress"},
          {"generation", progress.generation},
          {"particles", progress.particles},
          {"relative_error", number_json(progress.relative_error)},
          {"seconds", progress.seconds},
          {"groups_of_before", progress.groups_of_before},
          {"done", progress.done}};
}

Json answer_json(const LiveAnswer& answer) {
  return {{"type", "probe"},
          {"id", answer.id},
          {"illuminance", number_json(answer.illuminance.value)},
          {"illuminance_error", number_json(answer.illuminance.standard_error)},
          {"luminance", number_json(answer.luminance.value)},
          {"luminance_error", number_json(answer.luminance.standard_error)},
          {"surface", answer.surface}};
}

}  // namespace luxodus
