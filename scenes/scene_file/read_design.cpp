// What `luxodus design` may place. Read when luminaires, routes and areas are there, and before
// what a variant changes, so that a variant has the same types as the scene that it includes.
#include <algorithm>
#include <filesystem>
#include <set>

#include "scenes/geometry/transform.hpp"
#include "scenes/scene_file/read_luminaires.hpp"
#include "scenes/scene_file/scene_readers.hpp"
#include "scenes/world/design.hpp"

namespace luxodus {

namespace {

/// A luminaire looks down if its aim is within this of it, as a cosine: half a degree.
constexpr double down_cosine = 0.99996;

/// The generic type: a white disc, as bright as common emergency downlights, with the factors that
/// projects usually state (maintenance 0.8, 0.7 left at the end of the rated duration).
constexpr double generic_lm = 200, generic_diameter_m = 0.1;
constexpr double generic_maintenance = 0.8, generic_end = 0.7;

/// At the origin, looking down, unturned.
void put_to_origin(Emitter& e) {
  // Down is a direction that a frame exists for.
  e.frame = frame_aiming(glm::dvec3(0), {0, 0, -1}).value();
}

DesignType generic_type(const SourcePlace& place) {
  DesignType type;
  type.name = "generic downlight";
  type.place = place;
  Emitter& e = type.emitter;
  e.name = type.name;
  e.place = place;
  e.shape = EmitterShape::disc;
  e.size = {generic_diameter_m, 0, 0};
  e.distribution = Distribution::lambertian;
  e.maintenance_factor = generic_maintenance;
  e.end_of_duration_factor = generic_end;
  e.emergency_ageing = generic_maintenance * generic_end;
  e.emergency_flux = generic_lm * e.emergency_ageing;
  e.onset = {{0, 0}, {0.3, 1}};
  put_to_origin(e);
  return type;
}

bool alike(const Emitter& a, const Emitter& b) {
  return a.web == b.web && a.shape == b.shape && a.size == b.size &&
         a.distribution == b.distribution && a.cosine_power == b.cosine_power &&
         a.emergency_flux == b.emergency_flux && a.emergency_ageing == b.emergency_ageing &&
         a.onset == b.onset && a.duration_s == b.duration_s && a.maintained == b.maintained;
}

/// The emergency luminaires of the scene that look down, each kind once, by the names of their
/// files.
std::vector<DesignType> types_of_scene(const SceneDescription& scene) {
  std::vector<DesignType> out;
  std::set<std::string> taken;
  for (const Emitter& e : scene.emitters) {
    if (!(e.emergency_flux > 0) || e.shape == EmitterShape::mesh) continue;
    if (e.frame.axes[2].z < down_cosine) continue;
    if (std::any_of(out.begin(), out.end(),
                    [&](const DesignType& type) { return alike(type.emitter, e); }))
      continue;
    DesignType type;
    const std::string file = std::filesystem::path(e.file).stem().string();
    type.name = file.empty() || taken.contains(file) ? e.name : file;
    taken.insert(type.name);
    type.place = e.place;
    type.emitter = e;
    type.emitter.name = type.name;
    put_to_origin(type.emitter);
    out.push_back(std::move(type));
  }
  return out;
}

/// The light of a luminaire that is in the scene. Keys of light beside it would say another.
void take_light_of(KeyReader& keys, const std::string& like, Emitter& e) {
  for (const char* key :
       {"file", "variant", "emitter", "duration_h", "point_source", "circuit", "group",
        "mains_factor", "maintenance_factor", "emergency", "emergency_flux", "emergency_factor",
        "end_of_duration_factor", "onset", "spectrum", "body_material"})
    if (keys.has(key))
      return keys.problem(
          key, "'" + std::string(key) + "' and 'like' exclude each other: '" + like + "' says it");
  const auto& emitters = keys.reading().scene.emitters;
  const auto at = std::find_if(emitters.begin(), emitters.end(),
                               [&](const Emitter& one) { return one.name == like; });
  if (at == emitters.end())
    return keys.problem("like", "there is no luminaire or emitter \"" + like + "\" to be like");
  if (at->shape == EmitterShape::mesh)
    return keys.problem("like",
                        "an emitter of shape mesh stays where its file says: it is no "
                        "type that can be placed");
  e = *at;
}

void read_design_type(const toml::Table& table, SceneReading& reading, DesignSettings& design) {
  KeyReader keys(table, {"design.type"}, reading);
  DesignType type;
  type.name = read_name(keys, "type of a design");
  type.place = keys.place();
  type.stated = true;
  type.emitter.place = type.place;
  const std::string from = keys.exactly_one({"like", "file"}, true);
  if (from == "like")
    take_light_of(keys, keys.text("like"), type.emitter);
  else if (from == "file")
    read_photometric_light(keys, type.emitter);
  type.emitter.name = type.name;
  put_to_origin(type.emitter);
  type.cost = keys.number("cost");
  type.watts = keys.number("watts");
  type.turns_deg = keys.numbers("turns_deg");
  if (keys.clean() && !(type.emitter.emergency_flux > 0))
    keys.problem("the type '" + type.name +
                 "' gives no light in an emergency: set 'emergency', and 'emergency_flux' or "
                 "'emergency_factor'");
  design.types.push_back(std::move(type));
}

void read_keep_out(const toml::Table& table, SceneReading& reading, DesignSettings& design) {
  KeyReader keys(table, {"design.keep_out"}, reading);
  KeepOut one;
  one.name = read_name(keys, "keep-out zone");
  one.place = keys.place();
  one.position = keys.point("position");
  one.radius_m = keys.number("radius");
  design.keep_outs.push_back(std::move(one));
}

template <class Word, size_t N>
Word word_of(KeyReader& keys, const char* key, const std::array<std::string_view, N>& words) {
  const auto at = std::find(words.begin(), words.end(), keys.choice(key));
  return static_cast<Word>(at == words.end() ? 0 : at - words.begin());
}

/// Names of luminaires, each in one list.
void read_named(KeyReader& keys, DesignSettings& design) {
  std::set<std::string> seen;
  for (const auto& [key, list] :
       {std::pair{"fixed", &design.fixed}, std::pair{"removable", &design.removable},
        std::pair{"removed", &design.removed}}) {
    if (keys.has(key)) *list = keys.texts(key);
    for (const std::string& name : *list) {
      const auto& emitters = keys.reading().scene.emitters;
      const auto at = std::find_if(emitters.begin(), emitters.end(),
                                   [&](const Emitter& e) { return e.name == name; });
      if (at == emitters.end())
        keys.problem(key, "'" + std::string(key) + "' names \"" + name +
                              "\", and there is no such luminaire");
      else if (!(at->emergency_flux > 0))
        keys.problem(key, "'" + std::string(key) + "' names \"" + name +
                              "\", which gives no light in an emergency");
      if (!seen.insert(name).second)
        keys.problem(key, "\"" + name +
                              "\" is named twice in 'fixed', 'removable' and 'removed': "
                              "a luminaire either stays, may go, or goes");
    }
  }
}

void check_over(KeyReader& keys, const DesignSettings& design) {
  const SceneDescription& scene = keys.reading().scene;
  const auto is_one = [](const auto& list, const std::string& name) {
    return std::any_of(list.begin(), list.end(), [&](const auto& o) { return o.name == name; });
  };
  for (const std::string& name : design.over)
    if (!is_one(scene.routes, name) && !is_one(scene.open_areas, name) &&
        !is_one(scene.task_areas, name))
      keys.problem("over", "'over' names \"" + name +
                               "\", and there is no such route, open area or task area");
}

}  // namespace

void read_design(const toml::Table& table, SceneReading& reading, DesignSettings& design) {
  KeyReader keys(table, {"design"}, reading);
  // Of several files of a scene each may say a part: what one leaves out stands.
  const auto says = [&](const char* key) { return keys.has(key); };
  design.place = keys.place();
  for (const toml::Table* type : keys.tables("type")) read_design_type(*type, reading, design);
  for (const toml::Table* zone : keys.tables("keep_out")) read_keep_out(*zone, reading, design);
  if (says("over")) design.over = keys.texts("over");
  check_over(keys, design);
  for (const auto& [key, value] :
       {std::pair{"spacing_m", &design.spacing_m},
        std::pair{"wall_clearance_m", &design.wall_clearance_m},
        std::pair{"sign_clearance_m", &design.sign_clearance_m},
        std::pair{"drop_m", &design.drop_m}, std::pair{"margin", &design.margin},
        std::pair{"weight_number", &design.weight_number},
        std::pair{"weight_cost", &design.weight_cost},
        std::pair{"weight_watts", &design.weight_watts}})
    if (says(key)) *value = keys.number(key);
  if (says("mounting_height_m")) design.mounting_height_m = keys.maybe_number("mounting_height_m");
  if (says("mounting_height_m") && says("drop_m"))
    keys.problem("drop_m", "'drop_m' and 'mounting_height_m' exclude each other");
  if (says("places")) design.places = keys.points("places");
  if (says("existing"))
    design.existing = word_of<ExistingLuminaires>(keys, "existing", existing_words);
  if (says("failure")) design.failure = word_of<FailureDemand>(keys, "failure", failure_words);
  if (says("objective"))
    design.objective = word_of<DesignObjective>(keys, "objective", objective_words);
  if (says("in_smoke")) design.in_smoke = keys.texts("in_smoke");
  if (says("alternatives")) design.alternatives = static_cast<size_t>(keys.integer("alternatives"));
  read_named(keys, design);
  if (design.objective == DesignObjective::weighted && design.weight_number == 0 &&
      design.weight_cost == 0 && design.weight_watts == 0)
    keys.problem("objective", "all three weights are 0: nothing is sought");
}

void complete_design(SceneReading& reading, DesignSettings design) {
  SceneDescription& scene = reading.scene;
  if (design.types.empty()) design.types = types_of_scene(scene);
  if (design.types.empty()) design.types.push_back(generic_type(design.place));
  scene.design = std::make_shared<const DesignSettings>(std::move(design));
}

}  // namespace luxodus
